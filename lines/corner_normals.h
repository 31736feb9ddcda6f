#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "lines/surface_walk.h"

// Smooth contours need normals at vertices, which are made from the polygons around.

namespace burin {

/// SmoothMesh says where a mesh is smooth, and has its normals there.
struct SmoothMesh {
    /// Per triangle, bit k: the surface is not smooth over half-edge k: a border, a crease, marked, of more
    /// than two triangles, or where a surface with one side only comes back to itself.
    std::vector<std::uint8_t> sharp;
    /// Unit normals, per triangle and corner: 3t + k. On one side of a smooth surface, however its triangles are wound.
    /// 0 where there is none: at tips.
    std::vector<glm::vec3> normals;

    bool is_sharp(HalfEdge h) const { return (sharp[h / 3] >> h % 3 & 1) != 0; }
};

/// Makes the normals at the vertices of a mesh, for smooth contours: each is the mean of the normals of the polygons
/// around that are not beyond a crease, weighted by their angles at the vertex (Thürmer and Wüthrich 1998). The order
/// of triangles does not matter. Where a polygon's own normal differs from that by more than the crease angle, as at
/// the tip of a cone, the surface has none.
SmoothMesh make_smooth(const Mesh& mesh, double cos_crease_angle);

/// Calls visit(corner) for `corner` and all others at its vertex that can be reached over smooth edges.
/// A corner has the number of the half-edge that starts there. Triangles may be wound either way.
template <typename Visit>
void visit_smooth_corners(const Mesh& mesh, const SmoothMesh& smooth, HalfEdge corner, const Visit& visit) {
    const auto turned = [](HalfEdge h, unsigned by) { return h - h % 3 + (h % 3 + by) % 3; };
    const auto start_of = [&mesh](HalfEdge h) { return mesh.triangles[h / 3][h % 3]; };
    visit(corner);
    for (const bool is_first_way : {true, false}) {
        HalfEdge at = corner;
        bool leaves_by_own = is_first_way;  // by the half-edge that starts there, or the one that ends there
        for (;;) {
            const HalfEdge exit = leaves_by_own ? at : turned(at, 2);
            if (smooth.is_sharp(exit)) break;
            const HalfEdge entry = mesh.next_on_edge[exit];
            leaves_by_own = start_of(entry) != start_of(corner);
            at = leaves_by_own ? turned(entry, 1) : entry;
            if (at == corner) return;
            visit(at);
        }
    }
}

}  // namespace burin
