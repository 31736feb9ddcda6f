#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "mesh/body_sides.h"
#include "mesh/material_list.h"
#include "mesh/mesh.h"
#include "view/coincidence.h"
#include "view/depth_plane.h"
#include "view/projection.h"
#include "view/screen_polygon.h"

// The surfaces of a frame are meshes with a matrix each; corners, planes and order of any triangle are asked for here.

namespace burin {

class OrderMemory;

/// A triangle of an instance. Ordered by instance (that is, by object), then by triangle.
struct SurfaceId {
    static constexpr std::uint32_t kNoInstance = 0xFFFFFFFFu;
    std::uint32_t instance = kNoInstance;
    std::uint32_t triangle = 0;

    bool is_background() const { return instance == kNoInstance; }
    auto operator<=>(const SurfaceId&) const = default;
};
constexpr SurfaceId kBackground{};

/// Two triangles, the smaller one first.
struct SurfacePair {
    SurfaceId first, second;
    auto operator<=>(const SurfacePair&) const = default;
};

/// A mesh placed in front of the camera, with its numbers in the scene.
struct SurfaceInstance {
    const Mesh* mesh = nullptr;
    glm::dmat4 to_view{1.0};         ///< takes Mesh::local_position() (the origin included) to view space
    glm::dmat3 normal_to_view{1.0};  ///< takes area vectors to view space
    /// find_sharp_edges() of the mesh; nullptr: not made yet.
    const std::uint8_t* sharp_edges = nullptr;
    std::shared_ptr<const BodySides> body_sides;  ///< of the mesh
    std::uint32_t object_id = 0;                  ///< from 1
    std::uint32_t first_polygon_id = 0;           ///< id of the mesh's polygon 0; ids start from 1
    MaterialList materials;                       ///< per material number of the mesh: scene's material, from 0
};

/// All surfaces of a frame as the camera sees them: the one source of geometry for visibility and
/// lines. Nothing is copied per instance; corners are projected when asked for, always to the same
/// bits.
struct SurfaceSet {
    Projection projection;
    glm::dmat3 view_to_world{1.0};  ///< rotation, for normals
    std::vector<SurfaceInstance> instances;
    /// The nearness of the farthest corner of the scene's bounding box: all is at least as near. Where nearness would
    /// lose its precision for things that are not on the screen, it is that of the farthest vertex that is; what is
    /// farther has less.
    double farthest_nearness = 0;
    double coordinate_error = 0;  ///< how exact coordinates are, in world units

    const SurfaceInstance& instance_of(SurfaceId s) const { return instances[s.instance]; }
    const Mesh& mesh_of(SurfaceId s) const { return *instances[s.instance].mesh; }

    glm::dvec3 view_position(std::uint32_t instance, std::uint32_t vertex) const {
        const SurfaceInstance& i = instances[instance];
        const glm::dvec3 p = i.mesh->local_position(vertex);
        return glm::dvec3(i.to_view[0]) * p.x + glm::dvec3(i.to_view[1]) * p.y +
               (glm::dvec3(i.to_view[2]) * p.z + glm::dvec3(i.to_view[3]));
    }
    void view_corners(SurfaceId s, glm::dvec3 (&corners)[3]) const {
        const auto& t = mesh_of(s).triangles[s.triangle];
        for (int k = 0; k < 3; ++k) {
            corners[k] = view_position(s.instance, t[static_cast<std::size_t>(k)]);
        }
    }
    DepthPlane plane(SurfaceId s) const {
        glm::dvec3 corners[3];
        view_corners(s, corners);
        return snapped_depth_plane(projection, corners);
    }
    /// How the polygons of two triangles lie to each other, or the two triangles, if the polygons have many corners.
    /// Not all places are looked at where they are apart. For triangles of one polygon all is false.
    /// `memory`: keeps what searches for rounded copies compare, for the next ones; the answer is the same without it.
    SurfaceOrder order(SurfaceId a, SurfaceId b, OrderMemory* memory = nullptr) const;
    /// How the planes of the two triangles lie to each other at a place on the screen, in pixels.
    SurfaceOrder order_at(SurfaceId a, SurfaceId b, glm::dvec2 place) const { return compare(a, b, &place); }
    /// order(), or order_at() if the polygons have no place in common.
    SurfaceOrder order_near(SurfaceId a, SurfaceId b, glm::dvec2 place) const {
        const SurfaceOrder known = order(a, b);
        return known.have_common_place ? known : order_at(a, b, place);
    }
    bool coincide(SurfaceId a, SurfaceId b) const { return order(a, b).are_coincident(); }
    /// How two triangles lie to each other, without the rest of their polygons.
    SurfaceOrder order_of_triangles(SurfaceId a, SurfaceId b) const { return compare(a, b, nullptr); }
    ScreenPolygon screen_polygon(SurfaceId s) const {
        glm::dvec3 corners[3];
        view_corners(s, corners);
        return project_triangle(projection, corners);
    }
    /// Unit normal of the polygon in view space, in the direction of its winding.
    glm::dvec3 view_normal(SurfaceId s) const {
        const glm::dvec3 n = instance_of(s).normal_to_view * mesh_of(s).polygon_area_vector(s.triangle);
        return n / std::max(glm::length(n), 1e-300);
    }

    /// The polygon's unit normal on the side that the triangle turns to the eye. (A polygon that is
    /// not flat may have triangles that turn either way.)
    glm::dvec3 normal_towards_eye(SurfaceId s, glm::dvec2 pixel) const {
        glm::dvec3 corners[3], origin, ray;
        view_corners(s, corners);
        projection.view_ray(pixel, origin, ray);
        const glm::dvec3 facet = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::dvec3 normal = view_normal(s);
        return glm::dot(facet, ray) > 0 ? -normal : normal;
    }

    std::uint32_t object_id(SurfaceId s) const { return s.is_background() ? 0 : instance_of(s).object_id; }
    std::uint32_t polygon_id(SurfaceId s) const {
        return s.is_background() ? 0 : instance_of(s).first_polygon_id + mesh_of(s).input_place_of(s.triangle);
    }
    /// Whether the polygon ids of two triangles are equal, without looking them up far away in memory.
    bool are_of_one_polygon(SurfaceId a, SurfaceId b) const {
        return a == b ||
               (a.instance == b.instance && mesh_of(a).polygon_of(a.triangle) == mesh_of(a).polygon_of(b.triangle));
    }
    std::uint32_t material_id(SurfaceId s) const {
        return s.is_background() ? 0 : 1 + instance_of(s).materials[mesh_of(s).material_of(s.triangle)];
    }
    std::uint64_t triangle_count() const {
        std::uint64_t count = 0;
        for (const SurfaceInstance& i : instances) count += i.mesh->triangles.size();
        return count;
    }

  private:
    SurfaceOrder order_of_polygons(SurfaceId a, SurfaceId b) const;
    /// How far a triangle's plane may be off, as its corners are rounded to single precision. In world units.
    double rounding_error(SurfaceId s, const glm::dvec3 (&corners)[3]) const;
    /// Compares two triangles at one place, or wherever both are.
    SurfaceOrder compare(SurfaceId s, SurfaceId t, const glm::dvec2* place) const;
};

}  // namespace burin
