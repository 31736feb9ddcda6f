#include "lines/line_decision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/infinity.h"
#include "lines/narrow_lap.h"
#include "view/rounded_copies.h"

namespace burin {
namespace {

/// The two points with the ways over their surfaces towards each other.
class Decider {
  public:
    Decider(const SurfaceSet& surfaces, const VisiblePoint& a, const VisiblePoint& b, const LineCriteria& criteria)
        : surfaces_(surfaces), criteria_(criteria), points_{a, b} {}

    LineDecision decide() {
        for (const int i : {0, 1}) {
            if (other(i).surface.is_background()) {
                walks_[i] = walk(i);
                return ended(walks_[i]) || ends_at_point(i) ? end_of_surface(i, kInfinity, false)
                                                            : unexplained(i, kInfinity);
            }
        }
        for (const int i : {0, 1}) {
            walks_[i] = walk(i);
            if (walks_[i].end == WalkEnd::arrived && walks_[i].surface == other(i).surface) {
                return connected(i);
            }
        }
        const bool ends[2] = {ended(walks_[0]), ended(walks_[1])};
        if (!ends[0] && !ends[1]) return overlap();
        double gap[2] = {0, 0};
        bool in_front[2] = {false, false};
        for (const int i : {0, 1}) {
            if (!ends[i]) continue;
            gap[i] = gap_behind_end(i);
            in_front[i] = gap[i] >= -tolerance_at_end(i);
        }
        if (in_front[0] && in_front[1]) {
            // The surfaces are in contact, or nearly: an end that is behind the other surface for certain is not seen.
            const bool is_behind[2] = {is_certainly_behind(0, gap[0]), is_certainly_behind(1, gap[1])};
            if (is_behind[0] != is_behind[1]) return end_at(is_behind[0] ? 1 : 0, gap);
            return end_at(std::abs(gap[0]) <= std::abs(gap[1]) ? 0 : 1, gap);
        }
        for (const int i : {0, 1}) {
            if (in_front[i]) return passes_through_before_end(i, gap[i]) ? overlap() : end_at(i, gap);
        }
        // One surface ends behind the other: they change places before that.
        return overlap();
    }

  private:
    static bool ended(const SurfaceWalk& w) {
        return w.end == WalkEnd::fold || w.end == WalkEnd::border || w.end == WalkEnd::crack;
    }
    const VisiblePoint& other(int i) const { return points_[1 - i]; }
    glm::dvec2 place(int i, double fraction) const { return glm::mix(points_[i].pixel, other(i).pixel, fraction); }
    SurfaceWalk walk(int i) const {
        return walk_surface(surfaces_, points_[i].surface, points_[i].pixel, other(i).pixel, criteria_);
    }
    double distance(SurfaceId s, glm::dvec2 at) const {
        return distance_of(surfaces_.projection, surfaces_.plane(s).nearness(at));
    }
    double extended_distance(SurfaceId s, glm::dvec2 at) const {
        return distance_of(surfaces_.projection, surfaces_.plane(s).extended_to(at));
    }

    /// How much farther the other surface is where point i's surface ends.
    double gap_behind_end(int i) {
        const glm::dvec2 end = place(i, walks_[i].fraction);
        const double own = distance(walks_[i].surface, end);
        const SurfaceWalk to_end = walk_surface(surfaces_, other(i).surface, other(i).pixel, end, criteria_);
        behind_[i] = to_end.surface;
        if (to_end.end == WalkEnd::arrived) return distance(to_end.surface, end) - own;
        // It ends as well, or is not understood: extend the planes, and take the smaller gap.
        const glm::dvec2 other_end = glm::mix(other(i).pixel, end, to_end.fraction);
        const double gap_here = extended_distance(to_end.surface, end) - own;
        const double gap_there = distance(to_end.surface, other_end) - extended_distance(walks_[i].surface, other_end);
        return std::abs(gap_here) <= std::abs(gap_there) ? gap_here : gap_there;
    }
    double tolerance_at_end(int i, double pixels = 2) const {
        const glm::dvec2 end = place(i, walks_[i].fraction);
        return depth_tolerance(surfaces_, distance(walks_[i].surface, end), surfaces_.plane(behind_[i]), pixels);
    }

    /// Whether point i's surface ends behind the other for certain, though within the tolerance.
    bool is_certainly_behind(int i, double gap) const { return gap < -tolerance_at_end(i, kCertainlyApartPx); }
    /// Whether point i's surface, which begins in front of the other, ends behind it for certain.
    bool passes_through_before_end(int i, double gap) const {
        if (!is_certainly_behind(i, gap)) return false;
        const glm::dvec2 at = points_[i].pixel;
        return extended_distance(walks_[1 - i].surface, at) > distance(points_[i].surface, at);
    }

    double tolerance_at_point(int i, double pixels) const {
        const glm::dvec2 at = points_[i].pixel;
        return depth_tolerance(surfaces_, distance(points_[i].surface, at), surfaces_.plane(walks_[1 - i].surface),
                               pixels);
    }
    /// Whether point i's surface, that was followed to the other point, ends there, but for rounding: its walk
    /// becomes the one that ends.
    bool ends_at_point(int i) {
        constexpr double kRoundingPx = 1.0 / 64;
        const double farther = 1 + kRoundingPx / glm::distance(points_[0].pixel, points_[1].pixel);
        SurfaceWalk beyond =
            walk_surface(surfaces_, points_[i].surface, points_[i].pixel, place(i, farther), criteria_);
        if (!ended(beyond)) return false;
        beyond.fraction = std::min(beyond.fraction * farther, 1.0);
        walks_[i] = beyond;
        behind_[i] = points_[1 - i].surface;
        return true;
    }

    LineDecision with_fraction(LineDecision decision, int i, double fraction) const {
        decision.front = i;
        decision.fraction = i == 0 ? fraction : 1 - fraction;
        return decision;
    }

    LineDecision connected(int i) const {
        const SurfaceWalk& w = walks_[i];
        LineDecision decision;
        decision.classes = w.crossed;
        decision.reason = w.crossed.empty() ? LineReason::smooth : LineReason::feature_edge;
        decision.edge = w.crossed_edge;
        decision.crease_cosine = w.crease_cosine;
        return with_fraction(decision, i, w.crossed.empty() ? 0.5 : w.crossed_fraction);
    }

    LineDecision end_at(int i, const double (&gap)[2]) const {
        const bool touching = gap[i] <= tolerance_at_end(i);
        // Whether the surface ends in the plane of the other, or has left it before and ends behind it.
        const auto ends_in_plane = [&] {
            const SurfaceId own = walks_[i].surface;
            return gap[i] <= 0 || surfaces_.coincide(own, behind_[i]) || surfaces_.coincide(own, other(i).surface) ||
                   surfaces_.coincide(own, walks_[1 - i].surface);
        };
        if (touching && !is_mark(walks_[i]) && ends_in_plane()) {
            if (goes_on_beneath(1 - i) && !laps_narrowly(i)) return connected(1 - i);
            if (!goes_on_beneath(1 - i) && are_flush(points_[0].surface, points_[1].surface)) return smooth();
            const bool left_before = is_certainly_behind(i, gap[i]) && walks_[1 - i].end == WalkEnd::arrived &&
                                     surfaces_.coincide(walks_[1 - i].surface, points_[i].surface);
            if (left_before) {
                if (const auto decision = leaves_plane(i)) return *decision;
            }
        }
        return end_of_surface(i, gap[i], touching);
    }

    bool are_flush(SurfaceId a, SurfaceId b) const {
        return burin::are_flush(surfaces_, a, b, glm::mix(points_[0].pixel, points_[1].pixel, 0.5), criteria_);
    }
    /// Whether point i's surface reaches the other point in the plane of what is seen there: as if it were seen at
    /// both.
    bool goes_on_beneath(int i) const {
        return walks_[i].end == WalkEnd::arrived && are_flush(walks_[i].surface, other(i).surface);
    }
    /// Whether it does so for a narrow strip beyond the end of point i's surface alone.
    bool laps_narrowly(int i) const {
        const SurfaceWalk& w = walks_[i];
        return burin::laps_narrowly(surfaces_, w.surface, w.half_edge, {walks_[1 - i].surface, points_[i].pixel},
                                    place(i, w.fraction));
    }
    /// Decides where both points lie in one plane, that of the other's surface, and point i's surface leaves it on the
    /// way, at an edge.
    std::optional<LineDecision> leaves_plane(int i) const {
        const SurfaceWalk& w = walks_[i];
        LineDecision decision;
        const LineClassSet contact = contact_classes(surfaces_, points_[i].surface, walks_[1 - i].surface,
                                                     points_[i].pixel, criteria_, &decision.crease_cosine);
        decision.classes = contact | (w.crossed & LineClass::mark);
        if ((decision.classes & criteria_.classes).empty()) return connected(1 - i);
        if (w.crossed_edge.half_edge == kNoHalfEdge) return std::nullopt;
        decision.reason = LineReason::touches;
        decision.edge = w.crossed_edge;
        return with_fraction(decision, i, w.crossed_fraction);
    }
    static LineDecision smooth() {
        LineDecision decision;
        decision.reason = LineReason::touches_smoothly;
        return decision;
    }
    bool is_mark(const SurfaceWalk& w) const {
        return criteria_.classes.has(LineClass::mark) && surfaces_.mesh_of(w.surface).is_marked(w.half_edge);
    }

    /// Decides where point i's surface ends, in front of the other or (`touching`) in contact with it.
    LineDecision end_of_surface(int i, double gap, bool touching) const {
        const SurfaceWalk& w = walks_[i];
        const SurfaceEdge edge{w.surface, w.half_edge};
        LineDecision decision;
        decision.edge = edge;
        decision.classes = edge_classes(surfaces_, edge, criteria_, &decision.crease_cosine);
        decision.gap_px = in_pixels(gap, i);
        if (touching) {
            decision.classes |= contact_classes(surfaces_, w.surface, behind_[i], place(i, w.fraction), criteria_,
                                                &decision.crease_cosine);
        }
        if (w.end == WalkEnd::fold) {
            decision.classes |= LineClass::silhouette;
            decision.reason = LineReason::turns_away;
        } else if (w.end == WalkEnd::crack) {
            decision.classes |= contact_classes(surfaces_, w.surface, w.beyond, place(i, w.fraction), criteria_,
                                                &decision.crease_cosine);
            decision.reason = LineReason::crack;
        } else if (touching) {
            decision.reason = decision.classes.empty() ? LineReason::touches_smoothly : LineReason::touches;
        } else {
            decision.classes |= LineClass::border;
            decision.reason = LineReason::ends_at_border;
        }
        return with_fraction(decision, i, w.fraction);
    }

    double in_pixels(double gap, int i) const {
        const double at = distance(walks_[i].surface, place(i, walks_[i].fraction));
        return gap / surfaces_.projection.pixel_size(at);
    }

    /// Decides where both surfaces go on behind each other (or could not be followed).
    LineDecision overlap() {
        double gap[2];
        double tolerance[2];
        bool coincident = true;
        bool followed = true;
        for (const int i : {0, 1}) {
            // Distance of the other's surface at point i.
            const SurfaceWalk& w = walks_[1 - i];
            const DepthPlane plane = surfaces_.plane(w.surface);
            const glm::dvec2 at = points_[i].pixel;
            const double own_nearness = surfaces_.plane(points_[i].surface).nearness(at);
            const double own = distance_of(surfaces_.projection, own_nearness);
            gap[i] = distance_of(surfaces_.projection, plane.extended_to(at)) - own;
            tolerance[i] = depth_tolerance(surfaces_, own, plane);
            coincident = coincident && surfaces_.coincide(w.surface, points_[i].surface);
            followed = followed && w.end != WalkEnd::lost;
        }
        const double smaller_gap = std::min(std::abs(gap[0]), std::abs(gap[1]));
        for (const int i : {0, 1}) {
            if (coincident || walks_[i].end != WalkEnd::arrived ||
                !surfaces_.coincide(walks_[i].surface, other(i).surface))
                continue;
            if (const auto decision = leaves_plane(1 - i)) return *decision;
        }
        const auto run_along_at = [&](int i) {
            return run_along(surfaces_, walks_[1 - i].surface, points_[i].surface, points_[i].pixel);
        };
        if (!coincident && followed && run_along_at(0) && run_along_at(1)) return smooth();
        LineDecision decision;
        decision.front = gap[0] >= gap[1] ? 0 : 1;
        const glm::dvec2 middle = glm::mix(points_[0].pixel, points_[1].pixel, 0.5);
        const LineClassSet contact = contact_classes(surfaces_, points_[0].surface, points_[1].surface, middle,
                                                     criteria_, &decision.crease_cosine);
        const double apart = std::max(tolerance[0], tolerance[1]);
        for (const int i : {0, 1}) {
            // The other's surface reaches this point in front of what is visible there: it ends
            // within a rounding error before it.
            if (gap[i] >= -apart || ended(walks_[1 - i])) continue;
            if (ends_at_point(1 - i)) return end_of_surface(1 - i, -gap[i], false);
            LineDecision ends_here = unexplained(1 - i, -gap[i]);
            ends_here.fraction = i;
            return ends_here;
        }
        if (!followed && smaller_gap > apart) return unexplained(decision.front, gap[decision.front]);
        if (coincident || !followed) {
            // A walk is lost in a crowd of tiny triangles: nothing can be said about creases there.
            const bool one_object = surfaces_.object_id(points_[0].surface) == surfaces_.object_id(points_[1].surface);
            if (followed || !one_object) decision.classes = contact;
            decision.reason = decision.classes.empty() ? LineReason::touches_smoothly : LineReason::touches;
            return decision;
        }
        for (const int i : {0, 1}) {
            if (std::abs(gap[i]) <= tolerance_at_point(i, kCertainlyApartPx) && ends_at_point(1 - i)) {
                return end_of_surface(1 - i, gap[i], true);
            }
        }
        decision.classes = LineClass::intersection | (contact & kClassesBesideIntersection);
        decision.reason = LineReason::passes_through;
        const double total = std::abs(gap[0]) + std::abs(gap[1]);
        if (std::isfinite(total) && total > 0) decision.fraction = crossing_near(std::abs(gap[0]) / total);
        return decision;
    }

    /// Where the two surfaces pass through each other: on the facets that meet there, not on those seen at the
    /// points.
    double crossing_near(double fraction) const {
        constexpr int kMostSteps = 8;
        constexpr double kNear = 1.0 / 1024;
        if (walks_[0].surface == points_[0].surface && walks_[1].surface == points_[1].surface) return fraction;
        const double first_guess = fraction;
        bool has_met = false;
        double low = 0, high = 1;
        for (int step = 0; step < kMostSteps; ++step) {
            const glm::dvec2 at = place(0, fraction);
            const SurfaceWalk a = walk_surface(surfaces_, points_[0].surface, points_[0].pixel, at, criteria_);
            const SurfaceWalk b = walk_surface(surfaces_, points_[1].surface, points_[1].pixel, at, criteria_);
            const bool has_a = a.end == WalkEnd::arrived, has_b = b.end == WalkEnd::arrived;
            if (!has_a && !has_b) break;
            if (!has_a || !has_b) {  // beyond the end of one
                (has_a ? low : high) = fraction;
                fraction = 0.5 * (low + high);
                continue;
            }
            has_met = true;
            const DepthPlane plane_a = surfaces_.plane(a.surface), plane_b = surfaces_.plane(b.surface);
            const auto lead = [&](glm::dvec2 p) { return plane_a.extended_to(p) - plane_b.extended_to(p); };
            (lead(at) > 0 ? low : high) = fraction;
            const double first = lead(points_[0].pixel), last = lead(points_[1].pixel);
            const double met = first > 0 && last < 0 ? first / (first - last) : -1;
            if (std::abs(met - fraction) < kNear) return met;
            fraction = met > low && met < high ? met : 0.5 * (low + high);
        }
        return has_met ? fraction : first_guess;
    }

    LineDecision unexplained(int front, double gap) const {
        LineDecision decision;
        decision.classes = LineClass::silhouette;
        decision.reason = LineReason::unexplained;
        decision.front = front;
        decision.gap_px = in_pixels(gap, front);
        return decision;
    }

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    VisiblePoint points_[2];
    SurfaceWalk walks_[2];
    SurfaceId behind_[2];
};

}  // namespace

std::string_view describe(LineReason reason) {
    switch (reason) {
        case LineReason::same_surface:
            return "no line: one surface";
        case LineReason::smooth:
            return "no line: the surface goes on without a feature";
        case LineReason::feature_edge:
            return "line: a feature edge of the surface";
        case LineReason::turns_away:
            return "line: the front surface turns away";
        case LineReason::ends_at_border:
            return "line: the front surface ends at a border";
        case LineReason::crack:
            return "the front surface goes on behind a crack in its mesh";
        case LineReason::touches:
            return "line: the surfaces touch and differ";
        case LineReason::touches_smoothly:
            return "no line: the surfaces touch and do not differ";
        case LineReason::passes_through:
            return "line: the surfaces pass through each other";
        case LineReason::unexplained:
            return "line: the surfaces are apart";
    }
    return "";
}

LineDecision decide_line(const SurfaceSet& surfaces, const VisiblePoint& a, const VisiblePoint& b,
                         const LineCriteria& criteria) {
    if (a.surface == b.surface) return LineDecision{};
    const bool in_order = a.pixel.x != b.pixel.x ? a.pixel.x < b.pixel.x : a.pixel.y < b.pixel.y;
    if (in_order) return Decider(surfaces, a, b, criteria).decide();
    // The two points are taken in one order, so that swapping them cannot change the answer. It is the screen's, so
    // that neither can the order of triangles.
    LineDecision decision = Decider(surfaces, b, a, criteria).decide();
    decision.front = 1 - decision.front;
    decision.fraction = 1 - decision.fraction;
    return decision;
}

}  // namespace burin
