#pragma once

#include <limits>

#include "render/film.h"

namespace burin {

/// A pixel in which nothing is.
inline PixelResult background_pixel() {
    PixelResult pixel;
    pixel.distance = std::numeric_limits<float>::infinity();
    return pixel;
}

}  // namespace burin
