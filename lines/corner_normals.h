#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lines/surface_walk.h"

namespace burin {

/// Where a mesh is smooth, and its normals there.
struct SmoothMesh {
    /// Per triangle, bit k: the surface is not smooth over half-edge k: a border, a crease, marked, or of
    /// more than two triangles.
    std::vector<std::uint8_t> sharp;
    /// Unit normals, per triangle and corner: 3t + k. 0 where there is none: at tips.
    std::vector<glm::vec3> normals;

    bool is_sharp(HalfEdge h) const { return (sharp[h / 3] >> h % 3 & 1) != 0; }
};

/// Normals at vertices: the mean of the normals of the polygons around that are not beyond a crease,
/// weighted by their angles at the vertex (Thürmer and Wüthrich 1998). The order of triangles does not matter.
/// Where a polygon's own normal differs from that by more than the crease angle, as at the tip of a cone, the
/// surface has none.
SmoothMesh make_smooth(const Mesh& mesh, double cos_crease_angle);

/// Calls visit(corner) for `corner` and all others at its vertex that can be reached over smooth edges.
/// A corner has the number of the half-edge that starts there.
template <typename Visit>
void visit_smooth_corners(const Mesh& mesh, const SmoothMesh& smooth, HalfEdge corner, const Visit& visit) {
    const auto turned = [](HalfEdge h, unsigned by) { return h - h % 3 + (h % 3 + by) % 3; };
    visit(corner);
    HalfEdge at = corner;
    while (!smooth.is_sharp(at)) {
        at = turned(mesh.next_on_edge[at], 1);
        if (at == corner) return;
        visit(at);
    }
    at = corner;
    while (!smooth.is_sharp(turned(at, 2))) {
        at = mesh.next_on_edge[turned(at, 2)];
        visit(at);
    }
}

}  // namespace burin
