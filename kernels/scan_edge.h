#pragma once

#include <cstdint>

// A polygon is drawn row by row from its edges on the grid of samples.

namespace burin {

/// An edge of a polygon on a grid of samples (see ScanConverter), from its upper to its lower end, in units of
/// 1 / (2 * 256 * samples per pixel) pixel: sample number i lies at kPitch i + kPitch / 2.
struct ScanEdge {
    static constexpr std::int64_t kPitch = 512;
    std::int64_t x0, y0, x1, y1;
    double per_dy;  ///< about 1 / (kPitch (y1 - y0))
};

}  // namespace burin
