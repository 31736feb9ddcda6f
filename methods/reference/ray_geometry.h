#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/frame.h"

// Rays see the scene's triangles by this geometry, which shares no code with the rasterizers.

namespace burin {

/// A triangle of an object of the scene, as rays see it.
struct Facet {
    static constexpr std::uint32_t kNothing = 0xFFFFFFFFu;
    std::uint32_t object = kNothing;  ///< number in Scene::objects; kNothing = background
    std::uint32_t triangle = 0;

    bool is_background() const { return object == kNothing; }
    auto operator<=>(const Facet&) const = default;
};

/// The scene in view space for method `reference`: exact (double) corners, planes and normals of its
/// triangles. Independent of the rasterizers' geometry, nothing is snapped.
class RayGeometry {
  public:
    explicit RayGeometry(const Frame& frame);

    const Projection& projection() const { return projection_; }
    std::uint32_t object_count() const { return static_cast<std::uint32_t>(objects_.size()); }
    const Mesh& mesh(std::uint32_t object) const { return *objects_[object].mesh; }
    double coordinate_error() const { return coordinate_error_; }

    glm::dvec3 position(std::uint32_t object, std::uint32_t vertex) const {
        const Object& o = objects_[object];
        return glm::dvec3(o.to_view * glm::dvec4(o.mesh->position(vertex), 1.0));
    }
    void corners(Facet f, glm::dvec3 (&corners)[3]) const;
    /// Distance along the view axis of the facet's plane at a pixel position; infinite where the plane
    /// lies behind the eye or along the ray.
    double plane_distance(Facet f, glm::dvec2 pixel) const;
    /// plane_distance(), kept within the distances of the facet's corners: what a ray hits there.
    double distance(Facet f, glm::dvec2 pixel) const;
    /// Whether the planes of two facets are one, but for an error of distances, half a pixel from a position to all
    /// sides: where surfaces pass through each other they are not.
    bool are_one_around(Facet a, Facet b, glm::dvec2 pixel, double error) const;
    /// A distance counted in pixel widths: two of them differ by how many pixel widths (there) the places
    /// are apart.
    double depth_px(double distance) const {
        return projection_.orthographic ? distance * projection_.focal_px : std::log(distance) * projection_.focal_px;
    }
    /// How fast the plane's distance changes, in world units per pixel.
    double slope_per_px(Facet f, glm::dvec2 pixel) const;
    /// Unit normal of the polygon in view space by its winding, and on the side that the facet turns
    /// to the eye.
    glm::dvec3 polygon_normal(Facet f) const;
    glm::dvec3 normal_towards_eye(Facet f, glm::dvec2 pixel) const;
    /// Whether the triangle is so flat that rounding decides its normal: lower than 1/64 pixel and
    /// than 1/1024 of its length.
    bool is_sliver(Facet f) const;

    bool same_polygon(Facet a, Facet b) const {
        return a.object == b.object && mesh(a.object).polygon_of(a.triangle) == mesh(b.object).polygon_of(b.triangle);
    }
    std::uint32_t object_id(Facet f) const { return f.object + 1; }
    std::uint32_t polygon_id(Facet f) const {
        return objects_[f.object].first_polygon_id + mesh(f.object).input_place_of(f.triangle);
    }
    /// Number in Scene::materials.
    std::uint32_t material(Facet f) const {
        return objects_[f.object].source->materials[mesh(f.object).material_of(f.triangle)];
    }

  private:
    struct Object {
        const SceneObject* source = nullptr;
        const Mesh* mesh = nullptr;
        glm::dmat4 to_view{1.0};
        glm::dmat3 area_to_view{1.0};  // cofactors: takes area vectors along
        std::uint32_t first_polygon_id = 1;
    };
    Projection projection_;
    double coordinate_error_ = 0;
    std::vector<Object> objects_;
    /// Per mesh, area vectors of its polygons; empty if all are triangles.
    std::vector<std::vector<glm::dvec3>> polygon_areas_;
};

}  // namespace burin
