#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "mesh/mesh.h"

// How smooth surfaces bend, from the meshes that stand for them.

namespace burin {

/// The normal of a smooth surface at a vertex, and how it turns: `turn` takes a way along the surface to the change of
/// the normal. Both in the object's units, before its transform.
struct VertexCurvature {
    glm::vec3 normal{0.0f};       ///< unit length; 0: the surface has none there, as at a tip
    std::array<float, 6> turn{};  ///< a symmetric matrix: xx, xy, xz, yy, yz, zz

    glm::dmat3 matrix() const {
        const auto [xx, xy, xz, yy, yz, zz] = turn;
        return {xx, xy, xz, xy, yy, yz, xz, yz, zz};
    }
};

/// MeshCurvature is the curvature of the smooth surface that a mesh stands for, at the corners of its triangles.
/// Surfaces end at creases: there a vertex has a value for each of them.
struct MeshCurvature {
    std::vector<std::uint32_t> corners;  ///< per triangle and corner, 3t + k: a number in `vertices`
    std::vector<VertexCurvature> vertices;

    const VertexCurvature& at(std::uint32_t triangle, std::size_t corner) const {
        return vertices[corners[3 * std::size_t{triangle} + corner]];
    }
};

/// Fits, on each polygon, the symmetric matrix that best gives the differences of the normals along its edges
/// (Rusinkiewicz 2004, for triangles), turns it into the tangent planes at its corners, and takes the mean of those
/// around a vertex that are not beyond a crease, weighted by the area that is nearest to the vertex. Normals are those
/// of make_smooth(), made exact for balls where polygons are all around a vertex. Never NaN; the number of threads and
/// the order of triangles do not matter.
MeshCurvature make_curvature(const Mesh& mesh, double cos_crease_angle, int threads);

/// The curvatures of a scene's meshes, which are made when they are first asked for and serve all views.
class SceneCurvatures {
  public:
    /// `mesh_count`: of the scene. `number`: of the mesh. The crease angle must be the same in all calls.
    const MeshCurvature& of(const Mesh& mesh, std::size_t number, std::size_t mesh_count, double cos_crease_angle,
                            int threads);

  private:
    std::vector<std::unique_ptr<const MeshCurvature>> meshes_;
};

/// The curvature of a surface at a place on a triangle in the direction of the eye, 1/world: > 0 where it bends away
/// from the eye. 0 where it is not known.
/// `to_view`: the linear part of the object's matrix, whose inverse is `from_view`. `towards_eye`: a normal of the
/// triangle on the side that the eye sees, `eye`: the unit vector from the place to the eye, both in view space.
/// `weights`: of the corners, with the sum 1.
double radial_curvature(const MeshCurvature& curvature, std::uint32_t triangle, const std::array<double, 3>& weights,
                        const glm::dmat3& from_view, const glm::dvec3& towards_eye, const glm::dvec3& eye);

}  // namespace burin
