#pragma once

#include <memory>

#include "cli/arguments.h"
#include "cli/output_files.h"
#include "methods/method_table.h"
#include "render/frame.h"
#include "scene/scene.h"

namespace burin {

/// Loads the input as a scene with the command line's wishes worked in. Prints what its models' readers noted, but for
/// `info`. Throws InputError and UsageError: the latter where one of the outputs is a file that is read, before any
/// model is read if the scene file names it.
Scene load_input(const Arguments& arguments, const std::vector<OutputFile>& outputs = {});

/// The camera that the arguments ask for. Throws InputError and UsageError.
Camera camera_of(const Scene& scene, const Arguments& arguments);

/// The views on one sheet that the arguments ask for; none: one view, through camera_of(). Throws InputError and
/// UsageError.
std::vector<ViewOnSheet> views_of(const Scene& scene, const Arguments& arguments);

/// The frame that the arguments ask for. The scene must outlive it. Throws InputError and UsageError.
Frame frame_of(const Scene& scene, const Camera& camera, const Arguments& arguments,
               const PreparedScene* prepared = nullptr);

}  // namespace burin
