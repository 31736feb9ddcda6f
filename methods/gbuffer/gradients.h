#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "methods/gbuffer/differentials.h"
#include "methods/gbuffer/profile.h"
#include "methods/gbuffer/raster.h"

// The length of gradients tells where depth or normals change.

namespace burin {

/// Length of the gradient per sample by Sobel's operator (Irwin Sobel, Gary Feldman, 1968; as an
/// edge image of depth and normals: Aaron Hertzmann, "Introduction to 3D Non-Photorealistic
/// Rendering: Silhouettes and Outlines", SIGGRAPH 1999 course notes). Slope a gives |a|, a step of
/// height h gives h / 2 in both columns.
inline Raster<double> sobel_magnitude(const Raster<double>& image) {
    return raster_of(grown(image.rect(), -1), [&](int x, int y) {
        const Block<double> n = block_at(image, x, y);
        const double right = n.c + 2 * n.e + n.h - n.a - 2 * n.d - n.f;
        const double down = n.f + 2 * n.g + n.h - n.a - 2 * n.b - n.c;
        return std::sqrt(right * right + down * down) / 8;
    });
}

/// sobel_magnitude() over all components of a vector.
inline Raster<double> sobel_magnitude(const Raster<glm::dvec3>& image) {
    return raster_of(grown(image.rect(), -1), [&](int x, int y) {
        const Block<glm::dvec3> n = block_at(image, x, y);
        const glm::dvec3 right = n.c + 2.0 * n.e + n.h - n.a - 2.0 * n.d - n.f;
        const glm::dvec3 down = n.f + 2.0 * n.g + n.h - n.a - 2.0 * n.b - n.c;
        return std::sqrt(glm::dot(right, right) + glm::dot(down, down)) / 8;
    });
}

/// Squared difference of a normal to those of the four neighbours: |X-B|^2 + |X-G|^2 + |X-E|^2 +
/// |X-D|^2, as in deferred line rendering. Faces that meet at angle t along a row or column of
/// samples give 2 - 2 cos t on both sides.
inline Raster<double> normal_difference(const Raster<glm::dvec3>& normals) {
    return raster_of(grown(normals.rect(), -1), [&](int x, int y) {
        const glm::dvec3 center = normals.at(x, y);
        double sum = 0;
        for (const glm::dvec3& n :
             {normals.at(x, y - 1), normals.at(x, y + 1), normals.at(x + 1, y), normals.at(x - 1, y)}) {
            sum += glm::dot(center - n, center - n);
        }
        return sum;
    });
}

/// Creases of Philippe Decaudin, "Cartoon-Looking Rendering of 3D-Scenes", INRIA report 2919, 1996:
/// the profile image of each component of the normal, the strongest one counts.
inline Raster<float> normal_profile_image(const Raster<glm::dvec3>& normals, const ProfileParameters& parameters) {
    Raster<float> strongest(grown(normals.rect(), -2));
    for (int k = 0; k < 3; ++k) {
        const auto component =
            raster_of(normals.rect(), [&](int x, int y) { return static_cast<double>(normals.at(x, y)[k]); });
        const Raster<float> p = profile_image(first_order(component), parameters);
        strongest = raster_of(p.rect(), [&](int x, int y) { return std::max(strongest.at(x, y), p.at(x, y)); });
    }
    return strongest;
}

}  // namespace burin
