#include "view/rounded_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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

/// Searches pairs of triangles, one of either surface, that overlap on the screen, from neighbour to neighbour.
class PairSearch {
  public:
    PairSearch(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b)
        : surfaces_(surfaces), start_{std::min(a, b), std::max(a, b)} {}

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
            const std::vector<SurfaceId> beside_a = neighbours(pair.a), beside_b = neighbours(pair.b);
            for (const SurfaceId a : beside_a) {
                if (!add(a, pair.b)) return false;
            }
            for (const SurfaceId b : beside_b) {
                if (!add(pair.a, b)) return false;
            }
            // Where both go on over an edge at one place, not even a sliver of a neighbour may lie before the other
            // one.
            for (const SurfaceId a : beside_a) {
                for (const SurfaceId b : beside_b) {
                    if (are_parallel(a, b) && !add(a, b)) known_.pop_back();  // it is no neighbour yet
                }
            }
        }
        return true;
    }

    /// Adds a pair that is looked at later, if it is one of this place. Returns false if it is too far apart.
    bool add(SurfaceId a, SurfaceId b) {
        if (std::find(known_.begin(), known_.end(), std::pair(a, b)) != known_.end()) return true;
        known_.emplace_back(a, b);
        const SurfaceOrder order = surfaces_.order_of_triangles(a, b);
        if (!order.have_common_place) return true;
        if (are_parallel(a, b)) {
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
    std::vector<SurfaceId> neighbours(SurfaceId s) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        std::vector<SurfaceId> found;
        for (HalfEdge h = 3 * s.triangle; h < 3 * s.triangle + 3; ++h) {
            const HalfEdge g = mesh.next_on_edge[h];
            if (g == h || mesh.next_on_edge[g] != h) continue;
            const auto corner = [&](HalfEdge of, HalfEdge k) {
                return surfaces_.view_position(s.instance, mesh.triangles[of / 3][(of + k) % 3]);
            };
            const glm::dvec3 from = corner(h, 0), to = corner(h, 1),
                             to_eye = surfaces_.projection.orthographic ? glm::dvec3(0, 0, 1) : -from;
            const glm::dvec3 across = glm::cross(to - from, to_eye);
            if (glm::dot(across, corner(h, 2) - from) * glm::dot(across, corner(g, 2) - from) < 0)
                found.push_back({s.instance, g / 3});
        }
        return found;
    }

    bool are_parallel(SurfaceId a, SurfaceId b) const {
        const auto area_of = [this](SurfaceId s) {
            glm::dvec3 c[3];
            surfaces_.view_corners(s, c);
            return glm::cross(c[1] - c[0], c[2] - c[0]);
        };
        const glm::dvec3 p = area_of(a), q = area_of(b);
        return std::abs(glm::dot(p, q)) >= kCosAlong * glm::length(p) * glm::length(q);
    }

    const SurfaceSet& surfaces_;
    std::array<SurfaceId, 2> start_;  // in one order, so that it does not matter which is asked about which
    std::vector<std::pair<SurfaceId, SurfaceId>> known_;
    std::vector<Pair> open_;
    bool has_front_ = false, has_behind_ = false, has_left_ = false;
};

}  // namespace

bool run_along(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 place) {
    return !a.is_background() && !b.is_background() && PairSearch(surfaces, a, b).are_near(&place);
}

bool are_rounded_copies(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b) {
    PairSearch search(surfaces, a, b);
    return search.pass_through() && search.are_near();
}

}  // namespace burin
