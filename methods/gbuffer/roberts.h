#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "methods/gbuffer/raster.h"

// Lines one sample wide are found by comparing along diagonals.

namespace burin {

/// Roberts' cross (Lawrence Roberts, 1963) looks at the 2x2 samples (x..x+1, y..y+1) and compares
/// along both diagonals. Lines are one sample wide and lie half a sample to the right and below.
/// Results lack the last column and row.

constexpr PixelRect without_last(PixelRect r) { return {r.x0, r.y0, r.x1 - 1, r.y1 - 1}; }

struct RobertsDepth {
    double relative_jump = 0.02;  ///< tau_d
    double slope = 1;             ///< k: faces seen at a grazing angle may jump more
    double fixed_distance = 0;    ///< instead of the distance, where that means nothing (orthographic)
};

/// 1 where sqrt((d00 - d11)^2 + (d10 - d01)^2) > tau_d min(d) (1 + k / (n.v)). `distance` is along
/// the view axis (large for the background), `facing` is n.v, the cosine between normal and view
/// ray.
inline Raster<float> roberts_depth(const Raster<double>& distance, const Raster<double>& facing,
                                   const RobertsDepth& parameters) {
    return raster_of(without_last(distance.rect()), [&](int x, int y) {
        const double d00 = distance.at(x, y), d10 = distance.at(x + 1, y);
        const double d01 = distance.at(x, y + 1), d11 = distance.at(x + 1, y + 1);
        const double nearest = std::min({d00, d10, d01, d11});
        const double scale = parameters.fixed_distance > 0 ? parameters.fixed_distance : nearest;
        const double grazing = std::max(
            std::min({facing.at(x, y), facing.at(x + 1, y), facing.at(x, y + 1), facing.at(x + 1, y + 1)}), 1e-3);
        const double limit = parameters.relative_jump * scale * (1 + parameters.slope / grazing);
        return std::hypot(d00 - d11, d10 - d01) > limit ? 1.0f : 0.0f;
    });
}

/// 1 where 1 - n00.n11 or 1 - n10.n01 is more than `limit` (1 - cos of the crease angle). Written
/// as half the squared difference, which is the same for unit normals and 0 between two samples of
/// background.
inline Raster<float> roberts_normal(const Raster<glm::dvec3>& normals, double limit) {
    return raster_of(without_last(normals.rect()), [&](int x, int y) {
        const glm::dvec3 falling = normals.at(x, y) - normals.at(x + 1, y + 1);
        const glm::dvec3 rising = normals.at(x + 1, y) - normals.at(x, y + 1);
        return 0.5 * std::max(glm::dot(falling, falling), glm::dot(rising, rising)) > limit ? 1.0f : 0.0f;
    });
}

/// 1 where any two of the four numbers differ.
inline Raster<float> roberts_id(const Raster<std::uint32_t>& ids) {
    return raster_of(without_last(ids.rect()), [&](int x, int y) {
        const std::uint32_t id = ids.at(x, y);
        return id != ids.at(x + 1, y) || id != ids.at(x, y + 1) || id != ids.at(x + 1, y + 1) ? 1.0f : 0.0f;
    });
}

}  // namespace burin
