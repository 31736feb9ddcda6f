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
    static constexpr std::uint32_t kSlots = 4;
    struct alignas(16) Bucket {
        std::uint32_t keys[kSlots];              // the other vertex + 1; 0 = free, and so are all behind
        std::uint32_t newest_half_edge[kSlots];  // + 1; 0 = none
    };

  public:
    explicit EdgeTable(std::size_t vertex_count)
        : buckets_(static_cast<Bucket*>(
              std::calloc(std::max<std::size_t>(1, vertex_count), sizeof(Bucket)))) {
        if (buckets_ == nullptr) throw std::bad_alloc();
        advise_huge_pages(buckets_.get(), vertex_count * sizeof(Bucket));
    }

    /// Where the edge between two vertices is if there is place.
    struct Home {
        Bucket* bucket;
        std::uint32_t key;
    };
    /// The choice is even, however vertices are numbered: a vertex of a closed surface has six edges on average, so
    /// three are in its bucket. Asks for the bucket, too.
    Home home_of(std::uint32_t u, std::uint32_t v) const {
        const std::uint32_t v_owns = (u < v ? 1u : 0u) ^ ((u ^ v) & 1), differing = u ^ v;
        const std::uint32_t owner = u ^ (differing & (0u - v_owns));
        Bucket* const bucket = buckets_.get() + owner;
        __builtin_prefetch(bucket, 1);
        return {bucket, (owner ^ differing) + 1};
    }

    /// The newest half-edge so far + 1, or 0, of an edge. nullptr if there is no place: then there is none for any
    /// half-edge of this edge.
    std::uint32_t* newest(const Home& home) const {
        std::uint32_t* const place = newest_in(*home.bucket, home.key);
        // A bucket that is full stays full, so that the next half-edge will come to the other one, too.
        return __builtin_expect(place == nullptr, 0) ? newest_in_other(home) : place;
    }
    /// The two vertices of an edge, the smaller one first.
    std::pair<std::uint32_t, std::uint32_t> vertices_of(const Home& home) const {
        return std::minmax({static_cast<std::uint32_t>(home.bucket - buckets_.get()), home.key - 1});
    }

  private:
    [[gnu::noinline]] std::uint32_t* newest_in_other(const Home& home) const {
        return newest_in(buckets_.get()[home.key - 1], static_cast<std::uint32_t>(home.bucket - buckets_.get()) + 1);
    }
    /// Without branches, which would guess wrong half of the time.
    static std::uint32_t* newest_in(Bucket& bucket, std::uint32_t key) {
        const std::uint32_t slots = slots_for(bucket.keys, key);
        if (slots == 0) return nullptr;
        const auto slot = static_cast<std::size_t>(std::countr_zero(slots));
        put_key(bucket.keys, slot, key);
        return &bucket.newest_half_edge[slot];
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
    static void put_key(std::uint32_t (&keys)[kSlots], std::size_t slot, std::uint32_t key) {
#ifdef __SSE2__
        auto* const all = reinterpret_cast<__m128i*>(keys);
        alignas(16) static constexpr std::uint32_t kAt[kSlots][4] = {{~0u}, {0, ~0u}, {0, 0, ~0u}, {0, 0, 0, ~0u}};
        const __m128i at = _mm_load_si128(reinterpret_cast<const __m128i*>(kAt[slot]));
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
    // Table and links are far larger than the nearest caches: three steps over some triangles at a time, each of which
    // asks for what the next one needs.
    constexpr std::size_t kBlock = 64;
    std::array<EdgeTable::Home, 3 * kBlock> homes;
    std::array<HalfEdge, 3 * kBlock> before;
    for (std::size_t first = 0; first < triangles.size(); first += kBlock) {
        if (first % (1024 * kBlock) == 0) throw_if_interrupted();
        const std::size_t end = std::min(triangles.size(), first + kBlock), count = 3 * (end - first);
        const auto first_half_edge = static_cast<HalfEdge>(3 * first);
        next_on_edge.resize(3 * end);
        HalfEdge* const next = next_on_edge.data();
        std::iota(next + 3 * first, next + 3 * end, first_half_edge);
        for (std::size_t t = first, i = 0; t < end; ++t, i += 3) {
            const auto& [a, b, c] = triangles[t];
            homes[i] = table.home_of(a, b);
            homes[i + 1] = table.home_of(b, c);
            homes[i + 2] = table.home_of(c, a);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const HalfEdge h = first_half_edge + static_cast<HalfEdge>(i);
            std::uint32_t* const newest = table.newest(homes[i]);
            if (newest == nullptr) {
                const auto [smaller, larger] = table.vertices_of(homes[i]);
                left_over.push_back({smaller, larger, h});
                before[i] = h;
                continue;
            }
            before[i] = std::min(*newest - 1, h);  // none becomes the greatest number, and others are smaller than h
            *newest = h + 1;
            __builtin_prefetch(next + before[i], 1);
        }
        for (std::size_t i = 0; i < count; i += 3) {
            const auto h = first_half_edge + static_cast<HalfEdge>(i);
            HalfEdge is_long = 0;
            for (std::uint32_t k = 0; k < 3; ++k) {
                // The newest one of a ring leads back to the oldest.
                const HalfEdge oldest = next[before[i + k]];
                next[h + k] = oldest;
                next[before[i + k]] = h + k;
                is_long |= before[i + k] ^ oldest;
            }
            // Twins share all three edges: where no more than two triangles meet, the next one on two edges is the same.
            const bool is_twin = (next[h] != h) & (next[h] / 3 == next[h + 1] / 3);
            if (is_twin) twins = true;
            if (is_long != 0) {
                const bool knows_all = next[h] != h && next[h + 1] != h + 1 && next[h + 2] != h + 2;
                if (knows_all) twins = twins || has_twin(triangles, next_on_edge, h);
            }
        }
    }
    link_by_sorting(left_over, next_on_edge);
    for (const LeftOver& l : left_over) twins = twins || has_twin(triangles, next_on_edge, l.half_edge);
    if (has_twins != nullptr) *has_twins = twins;
    return next_on_edge;
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
            segments.push_back({h, mesh.polygon_of(h / 3), mesh.positions[t[h % 3]], mesh.positions[t[(h + 1) % 3]]});
        }
    }
    return BorderIndex(std::move(segments));
}

}  // namespace burin
