#include "mesh/edge_links.h"

#include <algorithm>
#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

struct Entry {
    std::uint32_t larger_vertex;
    HalfEdge half_edge;
    auto operator<=>(const Entry&) const = default;
};

/// Links the entries of one bucket: all half-edges whose smaller vertex is the same.
void link_bucket(std::span<Entry> bucket, std::vector<HalfEdge>& next_on_edge) {
    constexpr std::size_t kSmall = 32;  // above, sorting beats comparing all pairs
    if (bucket.size() > kSmall) std::sort(bucket.begin(), bucket.end());
    for (std::size_t i = 0; i < bucket.size(); ++i) {
        const HalfEdge first = bucket[i].half_edge;
        if (next_on_edge[first] != kNoHalfEdge) continue;
        HalfEdge last = first;
        for (std::size_t j = i + 1; j < bucket.size(); ++j) {
            if (bucket[j].larger_vertex == bucket[i].larger_vertex) {
                next_on_edge[last] = bucket[j].half_edge;
                last = bucket[j].half_edge;
            } else if (bucket.size() > kSmall) {
                break;
            }
        }
        next_on_edge[last] = first;
    }
}

}  // namespace

std::vector<HalfEdge> link_edges(std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::size_t vertex_count) {
    std::vector<std::uint32_t> bucket_end(vertex_count + 1, 0);
    for (const auto& t : triangles) {
        ++bucket_end[std::min(t[0], t[1]) + 1];
        ++bucket_end[std::min(t[1], t[2]) + 1];
        ++bucket_end[std::min(t[2], t[0]) + 1];
    }
    for (std::size_t v = 0; v < vertex_count; ++v) bucket_end[v + 1] += bucket_end[v];
    // Now bucket_end[v] is where bucket v starts; filling moves it to where the bucket ends.
    std::vector<Entry> entries(3 * triangles.size());
    HalfEdge h = 0;
    for (const auto& t : triangles) {
        for (const auto& [u, v] : {std::pair{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}) {
            entries[bucket_end[std::min(u, v)]++] = {std::max(u, v), h++};
        }
    }
    throw_if_interrupted();
    std::vector<HalfEdge> next_on_edge(3 * triangles.size(), kNoHalfEdge);
    std::size_t begin = 0;
    for (std::size_t v = 0; v < vertex_count; ++v) {
        link_bucket({entries.data() + begin, bucket_end[v] - begin}, next_on_edge);
        begin = bucket_end[v];
    }
    return next_on_edge;
}

BorderIndex index_borders(const Mesh& mesh) {
    std::vector<BorderIndex::Segment> segments;
    for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
        if (mesh.next_on_edge[h] != h) continue;
        const auto& t = mesh.triangles[h / 3];
        segments.push_back({h, mesh.polygon_of(h / 3), mesh.positions[t[h % 3]],
                            mesh.positions[t[(h + 1) % 3]]});
    }
    return BorderIndex(std::move(segments));
}

}  // namespace burin
