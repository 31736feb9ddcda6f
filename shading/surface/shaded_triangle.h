#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "shading/surface/shaded_surfaces.h"

namespace burin {

/// A place on a triangle, in view space, and how it changes by a pixel to the right and by one down.
struct SurfacePlace {
    glm::dvec3 position;
    glm::dvec3 normal;  ///< unit length, towards the eye; smooth, or that of the polygon
    glm::dvec3 position_change[2];
    glm::dvec3 normal_change[2];
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
    /// At a place on the screen, in pixels.
    SurfacePlace at(glm::dvec2 pixel, bool with_changes) const;
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
    Weights weights_at(glm::dvec2 pixel) const;

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
