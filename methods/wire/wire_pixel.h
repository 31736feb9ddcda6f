#pragma once

#include "render/film.h"
#include "render/frame.h"
#include "view/depth_plane.h"

// The surface and the line of a pixel become what the film gets.

namespace burin {

/// A surface at the centre of a pixel, and the line over it.
struct WirePixel {
    SurfaceId surface;
    std::uint32_t slot = 0;  ///< where the tile keeps the surface's plane
    double nearness = -std::numeric_limits<double>::infinity();
    double line = 0;  ///< 0 to 1
    LineClass line_class = LineClass::polygon;

    /// The darkest line wins; of equal ones the class with the highest priority. So the order of
    /// edges does not matter.
    void draw(double darkness, LineClass c) {
        if (darkness > line || (darkness == line && c < line_class)) {
            line = darkness;
            line_class = c;
        }
    }
};

/// `plane` is the depth plane of pixel.surface. If `is_open`, the surface itself is not filled.
PixelResult finish_pixel(const Frame& frame, const WirePixel& pixel, const DepthPlane& plane, int x, int y,
                         bool is_open = false);

}  // namespace burin
