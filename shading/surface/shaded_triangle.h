#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "kernels/place_kernels.h"
#include "shading/surface/shaded_surfaces.h"

namespace burin {

/// A place on a triangle, in view space.
struct SurfacePlace {
    glm::dvec3 position;
    glm::dvec3 normal;  ///< unit length, towards the eye; smooth, or that of the polygon
};

/// How a place changes by a pixel to the right, and by one down.
struct SurfaceChanges {
    glm::dvec3 position[2];
    glm::dvec3 normal[2];
};

/// A triangle as it is shaded. What its corners have is interpolated by weights that are affine on the screen before
/// they are divided by their sum (Olano and Greer 1997), so it need not be clipped, and what is interpolated stays
/// between the values at its corners.
class ShadedTriangle {
  public:
    ShadedTriangle() = default;
    ShadedTriangle(const ShadedSurfaces& surfaces, SurfaceId id);

    SurfaceId id() const { return id_; }
    bool is_smooth() const { return is_smooth_; }
    /// For loops over many places.
    PlaceTriangle view() const { return {&weights_[0].x, &corners_[0].x, &normals_[0].x, is_smooth_}; }
    /// At a place on the screen, in pixels.
    SurfacePlace at(glm::dvec2 pixel) const {
        const auto [weights, scale] = weights_at(pixel);
        const glm::dvec3 position = mean_of(corners_, weights) * scale;
        if (!is_smooth_) return {position, normals_[0]};
        const glm::dvec3 normal = mean_of(normals_, weights);
        return {position, normal * (1 / std::max(glm::length(normal), 1e-300))};
    }
    /// The shares of the corners in a place, with the sum 1.
    std::array<double, 3> shares_at(glm::dvec2 pixel) const {
        const auto [weights, scale] = weights_at(pixel);
        return {weights[0] * scale, weights[1] * scale, weights[2] * scale};
    }
    /// How the shares change by a pixel to the right, and by one down.
    std::array<std::array<double, 3>, 2> share_changes_at(glm::dvec2 pixel) const;
    /// The place is that at the pixel.
    SurfaceChanges changes_at(glm::dvec2 pixel, const SurfacePlace& place) const;
    /// Where a ray to a light begins that is to miss the neighbours of the triangle on a smooth surface: on that,
    /// about, as it is in front of the triangle (Hanika 2021).
    glm::dvec3 shadow_place(glm::dvec2 pixel) const;
    std::uint32_t object_id() const { return object_id_; }
    std::uint32_t material_id() const { return material_id_; }
    const glm::vec3& color() const { return color_; }

  private:
    struct Weights {
        double of[3];  ///< not negative
        double scale;  ///< 1 / their sum
    };
    Weights weights_at(glm::dvec2 pixel) const {
        const auto weight = [&](int k) {
            return std::max(weights_[k][0] + pixel.x * weights_[k][1] + pixel.y * weights_[k][2], 0.0);
        };
        const Weights weights{{weight(0), weight(1), weight(2)}, 1};
        const double sum = weights.of[0] + weights.of[1] + weights.of[2];
        if (!(sum > 0)) return {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 1};  // edge-on
        return {{weights.of[0], weights.of[1], weights.of[2]}, 1 / sum};
    }
    static glm::dvec3 mean_of(const glm::dvec3 (&at_corners)[3], const double (&weights)[3]) {
        return weights[0] * at_corners[0] + weights[1] * at_corners[1] + weights[2] * at_corners[2];
    }

    SurfaceId id_;
    bool is_smooth_ = false;
    std::uint32_t object_id_ = 0, material_id_ = 0;
    glm::vec3 color_{0.0f};
    /// Of each corner, before division: weight[0] + x weight[1] + y weight[2].
    glm::dvec3 weights_[3];
    glm::dvec3 corners_[3];
    glm::dvec3 normals_[3];
};

}  // namespace burin
