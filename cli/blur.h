#pragma once

#include "cli/arguments.h"
#include "methods/blurred_frame.h"

namespace burin {

/// Has a camera see through the lens of the command line. Throws UsageError.
void set_lens(const Arguments& arguments, CameraSettings& camera);

/// How the pictures of a scene are blurred: as it says, and the command line. `moves`: whether anything moves while the
/// shutter is open. Throws UsageError for kinds of files that have no blur, and for options without use.
Blur blur_of(const Scene& scene, const Camera& camera, const Arguments& arguments, bool moves, bool has_paths);

/// Notes that a command draws a scene without the blur that it has.
void note_missing_blur(const Scene& scene, const Camera& camera, const Arguments& arguments, const char* command);

}  // namespace burin
