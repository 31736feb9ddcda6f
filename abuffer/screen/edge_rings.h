#pragma once

#include "kernels/screen_triangle.h"
#include "mesh/mesh.h"

namespace burin {

/// Whether an edge belongs to exactly two triangles, as its side alone tells: an edge that is not sharp does. False for
/// some that do, too.
inline bool is_surely_pair(const ScreenMesh& mesh, HalfEdge h) {
    return mesh.sharp != nullptr && (mesh.sharp[h / 3] >> h % 3 & 1) == 0;
}

/// The lowest of the half-edges on the edge of `h`: it stands for the edge, whichever of its triangles a line was found
/// between. `next`: its partner. Rings are in ascending order: only the last half-edge turns back.
inline HalfEdge least_on_edge(const ScreenMesh& mesh, HalfEdge h, HalfEdge next) {
    if (is_surely_pair(mesh, h)) return next < h ? next : h;
    while (next > h) {
        h = next;
        next = mesh.partners[h];
    }
    return next;
}

}  // namespace burin
