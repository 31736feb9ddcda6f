#include "mesh/edge_links.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include "base/huge_pages.h"
#include "base/interrupt.h"
#include "base/unfilled_vector.h"

namespace burin {
namespace {

/// Half-edges whose edges have the same owner, in lists: the newest one of each owner leads to the one before, and so
/// on. The owner of an edge is one of its vertices; the other one is its key.
struct EdgeLists {
    HalfEdge none;                       // the number behind the last half-edge ends the lists, and leads to itself
    std::vector<HalfEdge> newest;        // per vertex
    UnfilledVector<std::uint32_t> keys;  // per half-edge
    std::vector<HalfEdge> before;        // per half-edge; once its list is linked, the next one on its edge
};

EdgeLists list_edges(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count) {
    const std::size_t count = 3 * triangles.size();
    EdgeLists lists{static_cast<HalfEdge>(count), {}, {}, {}};
    lists.newest = large_vector(vertex_count, lists.none);
    reserve_large(lists.keys, count + 1);
    lists.keys.resize(count + 1);
    lists.keys[count] = 0xFFFFFFFFu;
    reserve_large(lists.before, count + 1);
    constexpr std::size_t kBlock = 64;
    std::array<std::uint32_t, 3 * kBlock> to, owners;
    for (std::size_t first = 0; first < triangles.size(); first += kBlock) {
        if (first % (1024 * kBlock) == 0) throw_if_interrupted();
        const std::size_t size = 3 * (std::min(triangles.size(), first + kBlock) - first);
        const std::uint32_t* const from = triangles[first].data();
        std::uint32_t* const keys = &lists.keys[3 * first];
        for (std::size_t i = 0; i < size; i += 3) {
            to[i] = from[i + 1];
            to[i + 1] = from[i + 2];
            to[i + 2] = from[i];
        }
        for (std::size_t i = 0; i < size; ++i) {
            // An even choice, however vertices are numbered: a vertex of a closed surface has six edges on average, and
            // owns three.
            const std::uint32_t u = from[i], v = to[i], differing = u ^ v, v_owns = (u < v ? 1u : 0u) ^ (differing & 1);
            owners[i] = u ^ (differing & (0u - v_owns));
            keys[i] = owners[i] ^ differing;
        }
        lists.before.resize(3 * first + size);
        for (std::size_t i = 0; i < size; ++i) {
            HalfEdge& newest = lists.newest[owners[i]];
            lists.before[3 * first + i] = newest;
            newest = static_cast<HalfEdge>(3 * first + i);
        }
    }
    lists.before.push_back(lists.none);
    return lists;
}

/// The first ones of a list, with nothing behind the last one.
template <std::size_t kSize>
struct Start {
    alignas(16) std::array<std::uint32_t, kSize> keys;
    alignas(16) std::array<HalfEdge, kSize> half_edges;
    HalfEdge rest;  // what follows

    void read(const EdgeLists& lists, HalfEdge h) {
        for (std::size_t i = 0; i < kSize; ++i) {
            half_edges[i] = h;
            keys[i] = lists.keys[h];
            h = lists.before[h];
        }
        rest = h;
    }
};

/// Bit i: numbers[i] is `number`.
template <std::size_t kSize>
std::uint32_t find_equal(const std::array<std::uint32_t, kSize>& numbers, std::uint32_t number) {
    std::uint32_t equal = 0;
#ifdef __SSE2__
    const auto four = [&](std::size_t i) {
        return _mm_cmpeq_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(&numbers[i])),
                               _mm_set1_epi32(static_cast<int>(number)));
    };
    for (std::size_t i = 0; i < kSize; i += 8) {
        const __m128i eight = _mm_packs_epi16(_mm_packs_epi32(four(i), four(i + 4)), _mm_setzero_si128());
        equal |= static_cast<std::uint32_t>(_mm_movemask_epi8(eight)) << i;
    }
#else
    for (std::size_t i = 0; i < kSize; ++i) equal |= (numbers[i] == number ? 1u : 0u) << i;
#endif
    return equal;
}

/// Links half-edges two by two, without branches. Returns whether there are more than two on an edge.
template <std::size_t kSize>
bool link_pairs(const Start<kSize>& start, EdgeLists& lists) {
    HalfEdge* const next = lists.before.data();
    const std::uint32_t used = ~find_equal(start.half_edges, lists.none);
    std::uint32_t more = 0;
    for (std::size_t i = 0; i < kSize; ++i) {
        const std::uint32_t own = 1u << i, others = find_equal(start.keys, start.keys[i]) ^ own;
        next[start.half_edges[i]] =
            start.half_edges[static_cast<std::size_t>(std::countr_zero(others != 0 ? others : own))];
        more |= others & (others - 1) & used;
    }
    return more != 0;
}

/// Keys and half-edges of a list.
using KeyedList = std::vector<std::pair<std::uint32_t, HalfEdge>>;

/// Links all of a list. Notes half-edges of edges that have more than two.
void link_by_sorting(KeyedList list, EdgeLists& lists, std::vector<HalfEdge>& crowded) {
    std::sort(list.begin(), list.end());
    for (std::size_t i = 0, first = 0; i < list.size(); ++i) {
        if (list[i].first != list[first].first) first = i;
        if (i > first) lists.before[list[i - 1].second] = list[i].second;
        lists.before[list[i].second] = list[first].second;
        if (i == first + 2) crowded.insert(crowded.end(), {list[first].second, list[first + 1].second});
        if (i > first + 1) crowded.push_back(list[i].second);
    }
}

/// Links a list if `start` is all of it; whether it is.
template <std::size_t kSize>
bool link_start(const Start<kSize>& start, EdgeLists& lists, std::vector<HalfEdge>& crowded) {
    if (start.rest != lists.none) return false;
    if (link_pairs(start, lists)) {
        KeyedList list;
        for (std::size_t i = 0; i < kSize && start.half_edges[i] != lists.none; ++i)
            list.emplace_back(start.keys[i], start.half_edges[i]);
        link_by_sorting(std::move(list), lists, crowded);
    }
    return true;
}

void link_list(HalfEdge newest, EdgeLists& lists, std::vector<HalfEdge>& crowded) {
    Start<16> start;
    start.read(lists, newest);
    if (link_start(start, lists, crowded)) return;
    KeyedList list;
    for (HalfEdge h = newest; h != lists.none; h = lists.before[h]) list.emplace_back(lists.keys[h], h);
    link_by_sorting(std::move(list), lists, crowded);
}

/// Equal for two triangles on one edge if and only if they have the same third vertex.
std::uint32_t vertices_xor(const std::array<std::uint32_t, 3>& triangle) {
    return triangle[0] ^ triangle[1] ^ triangle[2];
}

/// Whether a triangle has the vertices of an earlier one in the ring of its half-edge h; true also for
/// long rings. Triangles on one edge are twins if their third vertices are one.
bool has_twin(std::span<const std::array<std::uint32_t, 3>> triangles, const std::vector<HalfEdge>& next_on_edge,
              HalfEdge h) {
    const std::uint32_t own = vertices_xor(triangles[h / 3]);
    int length = 0;
    for (HalfEdge g = next_on_edge[h]; g != h; g = next_on_edge[g]) {
        if (vertices_xor(triangles[g / 3]) == own || ++length > 32) return true;
    }
    return false;
}

}  // namespace

std::vector<HalfEdge> link_edges(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertex_count,
                                 bool* has_twins) {
    EdgeLists lists = list_edges(triangles, vertex_count);
    std::vector<HalfEdge> crowded;
    constexpr std::size_t kBatch =
        32;  // some are read before the first is linked: what was just written is slow to read as vectors
    std::array<Start<8>, kBatch> starts;
    for (std::size_t first = 0; first < vertex_count; first += kBatch) {
        if (first % (4096 * kBatch) == 0) throw_if_interrupted();
        const std::size_t count = std::min(kBatch, vertex_count - first);
        for (std::size_t i = 0; i < count; ++i) {
            const HalfEdge soon = lists.newest[std::min(first + i + kBatch, vertex_count - 1)];
            __builtin_prefetch(&lists.before[soon], 1);
            __builtin_prefetch(&lists.keys[soon]);
            starts[i].read(lists, lists.newest[first + i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (!link_start(starts[i], lists, crowded)) link_list(lists.newest[first + i], lists, crowded);
        }
    }
    std::vector<HalfEdge> next = std::move(lists.before);
    next.pop_back();
    // Twins share all edges: where no more than two triangles meet, the next one on two edges is the same.
    bool twins = false;
    for (HalfEdge h = 0; h < next.size(); h += 3) {
        if (next[h] / 3 == next[h + 1] / 3 && next[h] != h) twins = true;
    }
    for (const HalfEdge h : crowded) twins = twins || has_twin(triangles, next, h);
    if (has_twins != nullptr) *has_twins = twins;
    return next;
}

BorderIndex index_borders(const Mesh& mesh) {
    std::vector<BorderIndex::Segment> segments;
    const std::size_t count = mesh.next_on_edge.size();
    const HalfEdge* const next = mesh.next_on_edge.data();
    constexpr std::size_t kBlock = 64;  // most have no border
    for (std::size_t first = 0; first < count; first += kBlock) {
        const std::size_t end = std::min(count, first + kBlock);
        std::uint32_t borders = 0;
        for (std::size_t h = first; h < end; ++h) borders += next[h] == static_cast<HalfEdge>(h) ? 1u : 0u;
        if (borders == 0) continue;
        for (auto h = static_cast<HalfEdge>(first); h < end; ++h) {
            if (next[h] != h) continue;
            const auto& t = mesh.triangles[h / 3];
            segments.push_back(
                {h, mesh.polygon_of(h / 3), mesh.local_position(t[h % 3]), mesh.local_position(t[(h + 1) % 3])});
        }
    }
    return BorderIndex(std::move(segments));
}

}  // namespace burin
