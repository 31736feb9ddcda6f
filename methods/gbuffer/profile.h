#pragma once

#include <algorithm>
#include <cmath>

#include "methods/gbuffer/raster.h"

namespace burin {

struct ProfileParameters {
    double limit = 2;  ///< k_p: the variation of g that gives 1
    double power = 1;  ///< e: 1 Saito & Takahashi, 2 Decaudin
    bool gate = true;  ///< 0 where g is less than half of the largest g around
};

/// Profile image (depth jumps) of Saito & Takahashi 1990, from the first-order differential g:
/// p = min(((gmax - gmin) / k_p)^e, 1), with the extremes over 3x3 samples. The difference cancels
/// the large but steady g of faces seen at a grazing angle.
///
/// Beside an ideal step g is 0, h/2, h/2, 0, so that p answers in four columns. The gate keeps the
/// middle two.
inline Raster<float> profile_image(const Raster<double>& g, const ProfileParameters& parameters) {
    return raster_of(grown(g.rect(), -1), [&](int x, int y) {
        const Block<double> n = block_at(g, x, y);
        const auto [low, high] = std::minmax({n.a, n.b, n.c, n.d, n.x, n.e, n.f, n.g, n.h});
        if (parameters.gate && n.x < 0.5 * high) return 0.0f;
        const double p = std::pow((high - low) / parameters.limit, parameters.power);
        return static_cast<float>(std::min(p, 1.0));
    });
}

/// Internal edge image (creases) of Saito & Takahashi 1990, from both differentials: 0 where
/// g > jump_limit (k_g), which belongs to the profile, else min(|l| / crease_limit, 1).
inline Raster<float> internal_edge_image(const Raster<double>& g, const Raster<double>& l,
                                         double jump_limit, double crease_limit) {
    return raster_of(l.rect(), [&](int x, int y) {
        if (g.at(x, y) > jump_limit) return 0.0f;
        return static_cast<float>(std::min(std::abs(l.at(x, y)) / crease_limit, 1.0));
    });
}

}  // namespace burin
