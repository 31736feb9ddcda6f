#include "methods/polygon_outlines.h"

#include <algorithm>

namespace burin {

HalfEdge PolygonOutlines::across_diagonal(const Mesh& mesh, HalfEdge h) {
    for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) {
        if (mesh.polygon_of(g / 3) == mesh.polygon_of(h / 3)) return g;
    }
    return kNoHalfEdge;
}

PolygonOutlines::PolygonOutlines(const Mesh& mesh) {
    const auto triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
    first_triangle_.assign(std::size_t{mesh.polygon_count} + 1, 0);
    for (std::uint32_t t = 0; t < triangle_count; ++t) ++first_triangle_[mesh.polygon_of(t) + 1];
    for (std::size_t p = 1; p < first_triangle_.size(); ++p) first_triangle_[p] += first_triangle_[p - 1];
    triangles_.resize(triangle_count);
    std::vector<std::uint32_t> next(first_triangle_.begin(), first_triangle_.end() - 1);
    for (std::uint32_t t = 0; t < triangle_count; ++t) triangles_[next[mesh.polygon_of(t)]++] = t;

    const auto next_in_triangle = [](HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; };
    std::vector<bool> taken(mesh.next_on_edge.size());
    first_half_edge_.push_back(0);
    for (std::uint32_t p = 0; p < mesh.polygon_count; ++p) {
        const auto own = triangles(p);
        for (const std::uint32_t t : own) {
            for (HalfEdge start = 3 * t; start < 3 * t + 3; ++start) {
                if (taken[start] || across_diagonal(mesh, start) != kNoHalfEdge) continue;
                HalfEdge h = start;
                while (!taken[h]) {
                    taken[h] = true;
                    half_edges_.push_back(h);
                    // Goes around the corner at its end, over the diagonals, to the next outline edge.
                    h = next_in_triangle(h);
                    for (std::size_t i = 0; i < own.size(); ++i) {
                        const HalfEdge across = across_diagonal(mesh, h);
                        if (across == kNoHalfEdge) break;
                        h = next_in_triangle(across);
                    }
                    if (across_diagonal(mesh, h) != kNoHalfEdge) break;
                }
            }
        }
        first_half_edge_.push_back(static_cast<std::uint32_t>(half_edges_.size()));
    }
}

}  // namespace burin
