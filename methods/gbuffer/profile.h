#pragma once

#include <algorithm>
#include <cmath>

#include "methods/gbuffer/raster.h"

// Jumps of depth become lines.

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

/// How far depth jumps beyond the slopes on either side, at the largest of the four steps to
/// neighbours: the step's distance from the interval between the steps before and after it, in the
/// same row or column. 0 on bends, creases and smooth surfaces, where steps lie between their
/// neighbours' (up to rounding); h beside a jump of height h between two planes.
inline Raster<double> jump_beyond_slopes(const Raster<double>& depth) {
    const auto beyond = [](double before, double p, double q, double after) {
        const auto [low, high] = std::minmax({p - before, after - q});
        return std::max({low - (q - p), (q - p) - high, 0.0});
    };
    return raster_of(grown(depth.rect(), -2), [&](int x, int y) {
        const auto row = [&](int i) { return depth.at(x + i, y); };
        const auto column = [&](int i) { return depth.at(x, y + i); };
        return std::max({beyond(row(-2), row(-1), row(0), row(1)), beyond(row(-1), row(0), row(1), row(2)),
                         beyond(column(-2), column(-1), column(0), column(1)),
                         beyond(column(-1), column(0), column(1), column(2))});
    });
}

/// The profile of jumps alone: creases, where g differs only because the slope does, are left to
/// the internal edges. A jump h between planes of equal slope has the g of h / 2, and stays as it is.
inline Raster<float> without_creases(const Raster<float>& profile, const Raster<double>& depth,
                                     const ProfileParameters& parameters) {
    const Raster<double> jump = jump_beyond_slopes(depth);
    return raster_of(common(profile.rect(), jump.rect()), [&](int x, int y) {
        const double most = std::pow(0.5 * jump.at(x, y) / parameters.limit, parameters.power);
        return static_cast<float>(std::min(static_cast<double>(profile.at(x, y)), most));
    });
}

/// Internal edge image (creases) of Saito & Takahashi 1990, from both differentials: 0 where
/// g > jump_limit (k_g), which belongs to the profile, else min(|l| / crease_limit, 1).
inline Raster<float> internal_edge_image(const Raster<double>& g, const Raster<double>& l, double jump_limit,
                                         double crease_limit) {
    return raster_of(l.rect(), [&](int x, int y) {
        if (g.at(x, y) > jump_limit) return 0.0f;
        return static_cast<float>(std::min(std::abs(l.at(x, y)) / crease_limit, 1.0));
    });
}

}  // namespace burin
