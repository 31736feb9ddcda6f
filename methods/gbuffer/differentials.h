#pragma once

#include <cmath>

#include "methods/gbuffer/raster.h"

// Images of depth and normals are differentiated, as by Saito and Takahashi.

namespace burin {

/// The differential operators of Takafumi Saito and Tokiichiro Takahashi, "Comprehensible Rendering
/// of 3-D Shapes", SIGGRAPH 1990. Results are one sample smaller on every side.

/// First order: g = (|A + 2B + C - F - 2G - H| + |C + 2E + H - A - 2D - F|) / 8.
///
/// On depth a x + b y it is |a| + |b|. Beside a step of height h it is h / 2 in both columns: lines
/// are two samples wide.
inline Raster<double> first_order(const Raster<double>& image) {
    return raster_of(grown(image.rect(), -1), [&](int x, int y) {
        const Block<double> n = block_at(image, x, y);
        return (std::abs(n.a + 2 * n.b + n.c - n.f - 2 * n.g - n.h) +
                std::abs(n.c + 2 * n.e + n.h - n.a - 2 * n.d - n.f)) /
               8;
    });
}

/// Second order: l = (8X - A - B - C - D - E - F - G - H) / 3.
///
/// On affine depth it is 0. A step of height h gives -h in front and h behind it. A crease of depth
/// s |x| gives -2s in one column if it lies on samples, -s in two if it lies between them; with
/// depth growing away from the eye, ridges (towards the eye) are negative and valleys positive.
inline Raster<double> second_order(const Raster<double>& image) {
    return raster_of(grown(image.rect(), -1), [&](int x, int y) {
        const Block<double> n = block_at(image, x, y);
        return (8 * n.x - n.a - n.b - n.c - n.d - n.e - n.f - n.g - n.h) / 3;
    });
}

}  // namespace burin
