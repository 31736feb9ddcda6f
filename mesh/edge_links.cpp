#include "mesh/edge_links.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <memory>
#include <new>
#include <numeric>
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

    /// The vertex in whose bucket the edge is if there is place. The choice is even, however
    /// vertices are numbered: a vertex of a closed surface has six edges on average, so three are
    /// in its bucket.
    static std::uint32_t owner_of(std::uint32_t u, std::uint32_t v) {
        const std::uint32_t u_owns = 0u - ((u < v ? 1u : 0u) ^ ((u ^ v) & 1));
        return v ^ ((u ^ v) & u_owns);
    }
    void prefetch(std::uint32_t owner) const { __builtin_prefetch(&buckets_.get()[owner], 1); }

    /// Notes half-edge h as the newest one on the edge between `owner` (which owner_of() tells) and another vertex.
    /// Returns the newest before, h itself if there was none, kFull if there is no place: then there is none for any
    /// half-edge of this edge.
    HalfEdge exchange(std::uint32_t owner, std::uint32_t other, HalfEdge h) {
        const HalfEdge before = exchange_in(owner, other, h);
        // A bucket that is full stays full, so that the next half-edge will come here too.
        return before == kFull ? exchange_in(other, owner, h) : before;
    }

  private:
    static constexpr std::uint32_t kSlots = 4;
    struct alignas(16) Bucket {
        std::uint32_t keys[kSlots];              // the other vertex + 1; 0 = free, and so are all behind
        std::uint32_t newest_half_edge[kSlots];  // + 1; 0 = none
    };

    /// Without branches, which would guess wrong half of the time.
    HalfEdge exchange_in(std::uint32_t owner, std::uint32_t other, HalfEdge h) {
        const std::uint32_t key = other + 1;
        Bucket& bucket = buckets_.get()[owner];
        const std::uint32_t slots = slots_for(bucket.keys, key);
        if (slots == 0) return kFull;
        const auto slot = static_cast<std::uint32_t>(std::countr_zero(slots));
        const std::uint32_t newest = bucket.newest_half_edge[slot];
        put_key(bucket.keys, slot, key);
        bucket.newest_half_edge[slot] = h + 1;
        const std::uint32_t is_known = 0u - (newest != 0 ? 1u : 0u);  // a condition would become a branch
        return h ^ ((h ^ (newest - 1)) & is_known);
    }
    /// Bit i: keys[i] is `key` or free. The first of them is the place of the key.
    static std::uint32_t slots_for(const std::uint32_t (&keys)[kSlots], std::uint32_t key) {
#ifdef __SSE2__
        const __m128i all = _mm_load_si128(reinterpret_cast<const __m128i*>(keys));
        const __m128i is_free = _mm_cmpeq_epi32(all, _mm_setzero_si128());
        const __m128i is_key = _mm_cmpeq_epi32(all, _mm_set1_epi32(static_cast<int>(key)));
        return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(_mm_or_si128(is_free, is_key))));
#else
        std::uint32_t slots = 0;
        for (std::uint32_t i = 0; i < kSlots; ++i) slots |= (keys[i] == key || keys[i] == 0 ? 1u : 0u) << i;
        return slots;
#endif
    }
    /// keys[slot] = key where there is 0 or the same. All are written, for what is soon read at once would
    /// wait for one that was written alone.
    static void put_key(std::uint32_t (&keys)[kSlots], std::uint32_t slot, std::uint32_t key) {
#ifdef __SSE2__
        auto* const all = reinterpret_cast<__m128i*>(keys);
        const __m128i at = _mm_cmpeq_epi32(_mm_setr_epi32(0, 1, 2, 3), _mm_set1_epi32(static_cast<int>(slot)));
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

/// Equal for two triangles on one edge if and only if they have the same third vertex.
std::uint32_t vertices_xor(const std::array<std::uint32_t, 3>& triangle) { return triangle[0] ^ triangle[1] ^ triangle[2]; }

/// Whether a triangle has the vertices of an earlier one in the ring of its half-edge h; true also for
/// long rings. Triangles on one edge are twins if their third vertices are one.
bool has_twin(std::span<const std::array<std::uint32_t, 3>> triangles,
              const std::vector<HalfEdge>& next_on_edge, HalfEdge h) {
    const std::uint32_t own = vertices_xor(triangles[h / 3]);
    int length = 0;
    for (HalfEdge g = next_on_edge[h]; g != h; g = next_on_edge[g]) {
        if (vertices_xor(triangles[g / 3]) == own || ++length > 32) return true;
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
    bool twins = false;
    // Notes half-edge h; whether its edge was known.
    const auto link = [&](HalfEdge* next, std::uint32_t owner, std::uint32_t other, HalfEdge h) {
        const HalfEdge before = table.exchange(owner, other, h);
        if (before == EdgeTable::kFull) {
            left_over.push_back({std::min(owner, other), std::max(owner, other), h});
            return true;
        }
        // The newest one of a ring leads back to the oldest.
        next[h] = next[before];
        next[before] = h;
        return before != h;
    };
    // The table is far larger than the nearest caches: the buckets of a triangle are asked for some triangles before.
    constexpr std::size_t kAhead = 16;
    std::array<std::array<std::uint32_t, 3>, 2 * kAhead> owners;
    const auto look_ahead = [&](std::size_t t) {
        const auto& [a, b, c] = triangles[t];
        auto& own = owners[t % owners.size()];
        own = {EdgeTable::owner_of(a, b), EdgeTable::owner_of(b, c), EdgeTable::owner_of(c, a)};
        for (const std::uint32_t owner : own) table.prefetch(owner);
    };
    for (std::size_t t = 0; t < std::min(kAhead, triangles.size()); ++t) look_ahead(t);
    constexpr std::size_t kBlock = 1024;
    for (std::size_t first = 0; first < triangles.size(); first += kBlock) {
        if (first % (64 * kBlock) == 0) throw_if_interrupted();
        const std::size_t end = std::min(triangles.size(), first + kBlock);
        next_on_edge.resize(3 * end);
        HalfEdge* const next = next_on_edge.data();
        std::iota(next + 3 * first, next + 3 * end, static_cast<HalfEdge>(3 * first));
        for (std::size_t t = first; t < end; ++t) {
            if (t + kAhead < triangles.size()) look_ahead(t + kAhead);
            const auto& [a, b, c] = triangles[t];
            const auto& [o_ab, o_bc, o_ca] = owners[t % owners.size()];
            const auto h = static_cast<HalfEdge>(3 * t);
            const bool ab = link(next, o_ab, a ^ b ^ o_ab, h), bc = link(next, o_bc, b ^ c ^ o_bc, h + 1),
                       ca = link(next, o_ca, c ^ a ^ o_ca, h + 2);
            // Twins share all three edges. What most triangles can be told by is asked of all, for no guess at
            // which of them have three known edges is right.
            const HalfEdge g = next[h];
            const bool may_be_twin = (next[g] != h) | (vertices_xor(triangles[g / 3]) == (a ^ b ^ c));
            if (ab & bc & ca & (g != h) & may_be_twin) twins = twins || has_twin(triangles, next_on_edge, h);
        }
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
