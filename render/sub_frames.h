#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/shutter.h"

// A blurred frame is the mean of sub-frames: sharp pictures at moments while the shutter is open, each seen from one
// point of the lens. What stands here is numbers alone, equal to the bit on all machines.

namespace burin {

/// One of the pictures whose mean is a blurred one.
struct SubFrame {
    double time = 0;       ///< in frames relative to the frame
    glm::dvec2 lens{0.0};  ///< a point of the lens, in radii to the right and up
};

/// When that part (0 to 1) of the light has fallen onto the picture: in frames relative to the frame.
double shutter_time(const ShutterSettings& shutter, double part);

/// Points that fill the unit disc evenly, whatever their number: those of a sunflower (Vogel 1979).
std::vector<glm::dvec2> lens_points(int count);

/// A number prime to `count`: sub-frame i has lens point (i * step) mod count, so that time and radius do not go
/// together.
int lens_step(int count);

/// How many sub-frames hide their number, for points that move by `way_px` at most while the shutter is open, and
/// circles of confusion of up to `circle_px` pixels across. 1: nothing is blurred to be seen.
int automatic_sub_frames(double way_px, double circle_px);

/// All of them. `shutter`: nullptr for one moment, that of the frame itself.
std::vector<SubFrame> sub_frames(const ShutterSettings* shutter, bool has_lens, int count);

/// The middle of shutter and lens, for what has no mean, such as depth.
SubFrame middle_sub_frame(const ShutterSettings* shutter);

}  // namespace burin
