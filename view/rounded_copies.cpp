#include "view/rounded_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "view/order_memory.h"

namespace burin {
namespace {

/// A search looks at no more pairs of triangles than this. One that climbs to where surfaces are farthest apart finds
/// in some steps whether they drift apart.
constexpr std::size_t kMostPairs = 48;
/// Planes at a greater angle have no more than a strip in common where surfaces run along each other: at an edge, where
/// one of two copies has gone on to the next facet. The cosine of 6 degrees.
constexpr double kCosAlong = 0.9945;
/// How far two copies may be apart there, in pixels.
constexpr double kMostAtEdgePx = 2 * kCopiesApartPx;

/// The pairs that a search has come to, each once.
class PairSet {
  public:
    using Pair = std::pair<SurfaceId, SurfaceId>;

    /// Returns false for one that is there already.
    bool add(const Pair& pair) {
        std::size_t slot = first_slot(pair);
        for (; slots_[slot] != 0; slot = (slot + 1) % slots_.size()) {
            if (pairs_[slots_[slot] - 1u] == pair) return false;
        }
        pairs_.push_back(pair);
        slots_[slot] = static_cast<std::uint16_t>(pairs_.size());
        last_slot_ = slot;
        return true;
    }
    /// Forgets the pair that was added last, once.
    void take_back() {
        pairs_.pop_back();
        slots_[last_slot_] = 0;
    }
    void clear() {
        pairs_.clear();
        slots_.fill(0);
    }

  private:
    static constexpr std::size_t kMostNeighbours = 3 + 3 + 3 * 3;
    static constexpr std::size_t kSlots = 2048;
    static_assert(2 * (kMostPairs * kMostNeighbours + 1) < kSlots);

    static std::size_t first_slot(const Pair& pair) { return hash_of_pair(pair.first, pair.second) % kSlots; }

    std::vector<Pair> pairs_;
    std::array<std::uint16_t, kSlots> slots_{};  ///< places in pairs_, counted from 1
    std::size_t last_slot_ = 0;
};

/// Searches pairs of triangles, one of either surface, that overlap on the screen, from neighbour to neighbour.
class PairSearch {
  public:
    PairSearch(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, OrderMemory* memory)
        : surfaces_(surfaces), start_{std::min(a, b), std::max(a, b)}, memory_(memory) {}

    /// Whether the surfaces are near each other all over: the search goes where they are farthest apart. `place`: on
    /// both, if that is known.
    bool are_near(const glm::dvec2* place = nullptr) {
        begin();
        if (place != nullptr && !has_left_ && open_.empty()) add_at(*place);
        has_left_ = has_left_ || open_.empty();
        return !has_left_ &&
               search([](const Pair& p) { return std::max(std::abs(p.least_gap_px), std::abs(p.greatest_gap_px)); },
                      [](const PairSearch&) { return false; });
    }
    /// Whether the first is in front here and behind there: the search goes where the one is in front that was not yet.
    bool pass_through() {
        begin();
        const double sign = has_front_ ? -1 : 1;
        const auto lead = [sign](const Pair& p) { return sign > 0 ? p.greatest_gap_px : -p.least_gap_px; };
        const auto is_done = [](const PairSearch& s) { return s.has_front_ && s.has_behind_; };
        return !has_left_ && !open_.empty() && search(lead, is_done) && is_done(*this);
    }

  private:
    struct Pair {
        SurfaceId a, b;
        double least_gap_px, greatest_gap_px;
    };
    struct AreaOfSurface {
        SurfaceId surface;
        glm::dvec3 area;
    };
    struct Neighbours {
        std::array<AreaOfSurface, 3> areas;
        std::size_t count = 0;
        std::span<const AreaOfSurface> all() const { return {areas.data(), count}; }
    };

    void begin() {
        known_.clear();
        open_.clear();
        has_front_ = has_behind_ = false;
        has_left_ = !add(start_[0], start_[1]);
    }
    /// Adds the pair in question at a place, where the two have no more than a sliver in common.
    void add_at(glm::dvec2 place) {
        const SurfaceOrder order = surfaces_.order_at(start_[0], start_[1], place);
        const double gap_px = order.least_gap_px;
        if (order.have_common_place && std::abs(gap_px) <= kMostAtEdgePx)
            open_.push_back({start_[0], start_[1], gap_px, gap_px});
    }

    /// Goes from the best pair to its neighbours; returns false where the two surfaces are too far apart.
    template <typename Rank, typename IsDone>
    bool search(const Rank& rank, const IsDone& is_done) {
        for (std::size_t count = 0; count < kMostPairs && !open_.empty() && !is_done(*this); ++count) {
            const auto best = std::max_element(open_.begin(), open_.end(),
                                               [&](const Pair& p, const Pair& q) { return rank(p) < rank(q); });
            const Pair pair = *best;
            open_.erase(best);
            const Neighbours of_a = neighbours(pair.a), of_b = neighbours(pair.b);
            const std::span<const AreaOfSurface> beside_a = of_a.all(), beside_b = of_b.all();
            for (const AreaOfSurface& a : beside_a) {
                if (!add(a.surface, pair.b)) return false;
            }
            for (const AreaOfSurface& b : beside_b) {
                if (!add(pair.a, b.surface)) return false;
            }
            // Where both go on over an edge at one place, not even a sliver of a neighbour may lie before the other
            // one.
            for (const AreaOfSurface& a : beside_a) {
                for (const AreaOfSurface& b : beside_b) {
                    if (are_parallel(a.area, b.area) && !add(a.surface, b.surface))
                        known_.take_back();  // it is no neighbour yet
                }
            }
        }
        return true;
    }

    /// Adds a pair that is looked at later, if it is one of this place. Returns false if it is too far apart.
    bool add(SurfaceId a, SurfaceId b) {
        if (!known_.add({a, b})) return true;
        const KnownOrder own = memory_ == nullptr ? order_of(a, b) : KnownOrder{};
        const KnownOrder& known = memory_ == nullptr ? own : memory_->get(a, b, [&] { return order_of(a, b); });
        const SurfaceOrder& order = known.order;
        if (!order.have_common_place) return true;
        if (known.are_parallel) {
            if (order.is_far) return false;
            has_front_ = has_front_ || order.has_nearer;
            has_behind_ = has_behind_ || order.has_farther;
        } else if (!(std::max(std::abs(order.least_gap_px), std::abs(order.greatest_gap_px)) <= kMostAtEdgePx)) {
            return false;
        }
        open_.push_back({a, b, order.least_gap_px, order.greatest_gap_px});
        return true;
    }

    /// The neighbours of a triangle beyond edges of two triangles at which the surface does not turn away from the eye.
    Neighbours neighbours(SurfaceId s) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        Neighbours found;
        for (HalfEdge h = 3 * s.triangle; h < 3 * s.triangle + 3; ++h) {
            const HalfEdge g = mesh.next_on_edge[h];
            if (g == h || mesh.next_on_edge[g] != h) continue;
            const auto corner = [&](HalfEdge of, HalfEdge k) {
                return surfaces_.view_position(s.instance, mesh.triangles[of / 3][(of + k) % 3]);
            };
            const glm::dvec3 from = corner(h, 0), to = corner(h, 1),
                             to_eye = surfaces_.projection.orthographic ? glm::dvec3(0, 0, 1) : -from;
            const glm::dvec3 across = glm::cross(to - from, to_eye);
            if (!(glm::dot(across, corner(h, 2) - from) * glm::dot(across, corner(g, 2) - from) < 0)) continue;
            const SurfaceId beyond{s.instance, g / 3};
            found.areas[found.count++] = {beyond, area_of(beyond)};
        }
        return found;
    }

    KnownOrder order_of(SurfaceId a, SurfaceId b) const {
        return {surfaces_.order_of_triangles(a, b), are_parallel(area_of(a), area_of(b))};
    }
    glm::dvec3 area_of(SurfaceId s) const {
        glm::dvec3 c[3];
        surfaces_.view_corners(s, c);
        return glm::cross(c[1] - c[0], c[2] - c[0]);
    }
    static bool are_parallel(const glm::dvec3& p, const glm::dvec3& q) {
        return std::abs(glm::dot(p, q)) >= kCosAlong * glm::length(p) * glm::length(q);
    }

    const SurfaceSet& surfaces_;
    std::array<SurfaceId, 2> start_;  // in one order, so that it does not matter which is asked about which
    OrderMemory* memory_;             // nullptr: nothing is remembered
    PairSet known_;
    std::vector<Pair> open_;
    bool has_front_ = false, has_behind_ = false, has_left_ = false;
};

}  // namespace

bool run_along(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 place, OrderMemory* memory) {
    return !a.is_background() && !b.is_background() && PairSearch(surfaces, a, b, memory).are_near(&place);
}

bool are_rounded_copies(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, OrderMemory* memory) {
    PairSearch search(surfaces, a, b, memory);
    return search.pass_through() && search.are_near();
}

}  // namespace burin
