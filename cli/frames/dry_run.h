#pragma once

#include "cli/arguments.h"
#include "cli/farm/memory_forecast.h"
#include "cli/frames/render_job.h"

namespace burin {

/// What drawing the first frame of a job will take. Throws InputError and UsageError.
PictureLoad load_of(RenderJob& job, const Arguments& arguments);

/// Prints what a job would do, a line for each fact, or as JSON. Throws InputError and UsageError.
void tell_dry_run(RenderJob& job, const Arguments& arguments);

}  // namespace burin
