#include "mesh/edge_links.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "base/huge_pages.h"
#include "base/interrupt.h"

namespace burin {
namespace {

/// Edges met so far, in buckets of a few that one cache line holds whole. An edge is known by its
/// two vertices: the bucket is that of one, the other is the key.
class EdgeTable {
  public:
    explicit EdgeTable(std::size_t vertex_count)
        : buckets_(static_cast<Bucket*>(
              std::calloc(std::max<std::size_t>(1, vertex_count), sizeof(Bucket)))) {
        if (buckets_ == nullptr) throw std::bad_alloc();
        advise_huge_pages(buckets_.get(), vertex_count * sizeof(Bucket));
    }

    static constexpr HalfEdge kFull = kNoHalfEdge;

    /// Notes half-edge h as the newest one on edge uv. Returns the newest before, h itself if there
    /// was none, kFull if there is no place: then there is none for any half-edge of this edge.
    HalfEdge exchange(std::uint32_t u, std::uint32_t v, HalfEdge h) {
        const std::uint32_t owner = owner_of(u, v), other = u ^ v ^ owner;
        const HalfEdge before = exchange_in(owner, other, h);
        // A bucket that is full stays full, so that the next half-edge will come here too.
        return before == kFull ? exchange_in(other, owner, h) : before;
    }
    void prefetch(std::uint32_t u, std::uint32_t v) const {
        __builtin_prefetch(&buckets_.get()[owner_of(u, v)], 1);
    }

  private:
    /// The vertex in whose bucket the edge is if there is place. The choice is even, however
    /// vertices are numbered: a vertex of a closed surface has six edges on average, so three are
    /// in its bucket.
    static std::uint32_t owner_of(std::uint32_t u, std::uint32_t v) {
        const std::uint32_t u_owns = 0u - ((u < v ? 1u : 0u) ^ ((u ^ v) & 1));
        return v ^ ((u ^ v) & u_owns);
    }
    /// Without branches, which would guess wrong half of the time.
    HalfEdge exchange_in(std::uint32_t owner, std::uint32_t other, HalfEdge h) {
        const std::uint32_t key = other + 1;  // 0 = free
        Bucket& bucket = buckets_.get()[owner];
        const std::uint32_t is_known = slots_with(bucket.keys, key);
        // The slot of the edge, else the first one that is free.
        const std::uint32_t places = is_known | slots_with(bucket.keys, 0) << kSlots;
        if (places == 0) return kFull;
        const int slot = std::countr_zero(places) % static_cast<int>(kSlots);
        const HalfEdge newest = bucket.half_edges[slot];
        put_key(bucket.keys, slot, key);
        bucket.half_edges[slot] = h;
        return is_known != 0 ? newest : h;
    }

    static constexpr std::uint32_t kSlots = 4;
    struct alignas(16) Bucket {
        std::uint32_t keys[kSlots];
        HalfEdge half_edges[kSlots];
    };
    /// Bit i: keys[i] is `key`.
    static std::uint32_t slots_with(const std::uint32_t (&keys)[kSlots], std::uint32_t key) {
#ifdef __SSE2__
        const __m128i all = _mm_load_si128(reinterpret_cast<const __m128i*>(keys));
        const __m128i equal = _mm_cmpeq_epi32(all, _mm_set1_epi32(static_cast<int>(key)));
        return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(equal)));
#else
        std::uint32_t slots = 0;
        for (std::uint32_t i = 0; i < kSlots; ++i) slots |= (keys[i] == key ? 1u : 0u) << i;
        return slots;
#endif
    }
    /// keys[slot] = key where there is 0 or the same. All are written, for what is soon read at once would
    /// wait for one that was written alone.
    static void put_key(std::uint32_t (&keys)[kSlots], int slot, std::uint32_t key) {
#ifdef __SSE2__
        auto* const all = reinterpret_cast<__m128i*>(keys);
        const __m128i at = _mm_cmpeq_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(slot));
        const __m128i put = _mm_and_si128(at, _mm_set1_epi32(static_cast<int>(key)));
        _mm_store_si128(all, _mm_or_si128(_mm_load_si128(all), put));
#else
        keys[slot] = key;
#endif
    }
    struct Free {
        void operator()(Bucket* p) const { std::free(p); }
    };
    std::unique_ptr<Bucket, Free> buckets_;  // from calloc: fresh pages are zero without being written
};

/// A half-edge that found no place in the table.
struct LeftOver {
    std::uint32_t smaller_vertex, larger_vertex;
    HalfEdge half_edge;
    auto operator<=>(const LeftOver&) const = default;
};

void link_by_sorting(std::vector<LeftOver>& left_over, std::vector<HalfEdge>& next_on_edge) {
    std::sort(left_over.begin(), left_over.end());
    for (std::size_t i = 0, first = 0; i < left_over.size(); ++i) {
        const LeftOver& here = left_over[i];
        if (here.smaller_vertex != left_over[first].smaller_vertex ||
            here.larger_vertex != left_over[first].larger_vertex) {
            first = i;
        }
        if (i > first) next_on_edge[left_over[i - 1].half_edge] = here.half_edge;
        next_on_edge[here.half_edge] = left_over[first].half_edge;
    }
}

/// Whether a triangle has the vertices of an earlier one in the ring of its half-edge h; true also for
/// long rings. Triangles on one edge are twins if their third vertices are one.
bool has_twin(std::span<const std::array<std::uint32_t, 3>> triangles,
              const std::vector<HalfEdge>& next_on_edge, HalfEdge h) {
    const auto vertices = [&](HalfEdge g) {
        const auto& [a, b, c] = triangles[g / 3];
        return a ^ b ^ c;
    };
    const std::uint32_t own = vertices(h);
    int length = 0;
    for (HalfEdge g = next_on_edge[h]; g != h; g = next_on_edge[g]) {
        if (vertices(g) == own || ++length > 32) return true;
    }
    return false;
}

}  // namespace

std::vector<HalfEdge> link_edges(std::span<const std::array<std::uint32_t, 3>> triangles,
                                 std::size_t vertex_count, bool* has_twins) {
    std::vector<HalfEdge> next_on_edge;
    reserve_large(next_on_edge, 3 * triangles.size());
    EdgeTable table(vertex_count);
    std::vector<LeftOver> left_over;
    constexpr std::size_t kAhead = 16;
    bool twins = false;
    // Notes half-edge h; whether its edge was known.
    const auto link = [&](std::uint32_t u, std::uint32_t v, HalfEdge h) {
        const HalfEdge before = table.exchange(u, v, h);
        if (before == EdgeTable::kFull) {
            left_over.push_back({std::min(u, v), std::max(u, v), h});
            return true;
        }
        // The newest one of a ring leads back to the oldest.
        std::swap(next_on_edge[h], next_on_edge[before]);
        return before != h;
    };
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if ((t & 0xFFFF) == 0) throw_if_interrupted();
        if (t + kAhead < triangles.size()) {
            const auto& [a, b, c] = triangles[t + kAhead];
            table.prefetch(a, b);
            table.prefetch(b, c);
            table.prefetch(c, a);
        }
        const auto [a, b, c] = triangles[t];
        const auto h = static_cast<HalfEdge>(3 * t);
        next_on_edge.insert(next_on_edge.end(), {h, h + 1, h + 2});
        const bool ab = link(a, b, h), bc = link(b, c, h + 1), ca = link(c, a, h + 2);
        // Twins share all three edges.
        if (ab & bc & ca && next_on_edge[h] != h) twins = twins || has_twin(triangles, next_on_edge, h);
    }
    link_by_sorting(left_over, next_on_edge);
    for (const LeftOver& l : left_over) twins = twins || has_twin(triangles, next_on_edge, l.half_edge);
    if (has_twins != nullptr) *has_twins = twins;
    return next_on_edge;
}

BorderIndex index_borders(const Mesh& mesh) {
    std::vector<BorderIndex::Segment> segments;
    for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
        if (mesh.next_on_edge[h] != h) continue;
        const auto& t = mesh.triangles[h / 3];
        segments.push_back(
            {h, mesh.polygon_of(h / 3), mesh.positions[t[h % 3]], mesh.positions[t[(h + 1) % 3]]});
    }
    return BorderIndex(std::move(segments));
}

}  // namespace burin
