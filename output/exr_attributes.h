#pragma once

#include <optional>

#include "image/exr_options.h"
#include "render/frame.h"

namespace burin {

/// The attributes that tell of a frame and its camera (docs/conventions.md lists them). Nothing in them depends on
/// when, where or by which command line the picture was made. `image_counter`: the number of the frame, if the picture
/// is one of several. `has_camera`: the picture has one.
ExrOptions exr_options_of(const Frame& frame, std::optional<int> image_counter, bool has_camera);

/// Frames per second as a fraction: 24/1, 24000/1001.
ExrRational rational_of(double frames_per_second);

}  // namespace burin
