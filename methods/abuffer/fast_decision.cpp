#include "methods/abuffer/fast_decision.h"

#include <algorithm>
#include <cmath>

namespace burin {

bool FastDecision::is_smooth(const NeighbourSamples& pair) const {
    if (pair.first == kNoSurface || pair.second == kNoSurface) return false;
    const SurfaceId start = screen_.surface_of(pair.first);
    const ScreenMesh& mesh = screen_.mesh(start.instance);
    const std::uint32_t goal = pair.second - mesh.first_number;  // wraps where it lies in another instance
    if (mesh.sharp == nullptr || goal >= screen_.triangle_count(start.instance)) return false;
    const std::uint8_t facing = mesh.facing[start.triangle];
    if (mesh.facing[goal] != facing || (facing != clockwise && facing != counterclockwise)) return false;
    const std::int32_t across = pair.down ? pair.x : pair.y;
    // Where corners run clockwise, a walk to the right leaves across the edge that goes down; a walk
    // down, across the one that goes left.
    const bool from_side = (facing == clockwise) == pair.down;
    std::uint32_t t = start.triangle;
    constexpr int kMaxTriangles = 6;
    for (int step = 0; step < kMaxTriangles; ++step) {
        // The last one need not be solid: it meets the one before at an edge that is not sharp.
        if (t == goal) return true;
        if (step > 0 && !FastWalker::is_surely_solid(mesh, t)) return false;
        const std::uint32_t* const corners = mesh.corners + 3 * static_cast<std::size_t>(t);
        bool side[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const ScreenVertex& p = mesh.vertices[corners[k]];
            side[k] = (pair.down ? p.x : p.y) > across;
        }
        const std::uint32_t k = side[0] == from_side && side[1] != from_side   ? 0
                                : side[1] == from_side && side[2] != from_side ? 1
                                                                               : 2;
        const std::uint32_t n = k == 2 ? 0 : k + 1;
        // An edge that is not sharp has one partner.
        if (side[k] != from_side || side[n] == from_side || (mesh.sharp[t] >> k & 1) != 0) return false;
        t = mesh.partners[3 * static_cast<std::size_t>(t) + k] / 3;
        if (mesh.facing[t] != facing) return false;
    }
    return false;
}

double FastDecision::nearness_at(SurfaceId s, glm::dvec2 subpixel) const {
    const ScreenTriangle t = screen_.triangle(s);
    const ScreenVertex &a = t.corners[0], &b = t.corners[1], &c = t.corners[2];
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double area = ux * vy - uy * vx;
    const double qa = static_cast<double>(a.nearness), qb = static_cast<double>(b.nearness) - qa;
    const double qc = static_cast<double>(c.nearness) - qa;
    if (area == 0) return surfaces_.farthest_nearness + qa + std::max({0.0, qb, qc});
    const double px = subpixel.x - a.x, py = subpixel.y - a.y;
    const double q = ((px * vy - py * vx) * qb + (ux * py - uy * px) * qc) / area;
    return surfaces_.farthest_nearness + qa + std::clamp(q, std::min({0.0, qb, qc}), std::max({0.0, qb, qc}));
}

double FastDecision::distance(SurfaceId s, glm::dvec2 subpixel) const {
    return distance_of(surfaces_.projection, nearness_at(s, subpixel));
}

bool FastDecision::look_behind(const NeighbourSamples& pair, int i, const FastWalk (&walks)[2], End& end) {
    const FastWalk& w = walks[i];
    const auto place = [&](int from, double fraction) { return pair.place(from == 0 ? fraction : 1 - fraction); };
    const glm::dvec2 at = place(i, w.fraction);
    const std::uint32_t numbers[2] = {pair.first, pair.second};
    const SurfaceId own{screen_.surface_of(numbers[i]).instance, w.triangle};
    const SurfaceId other = screen_.surface_of(numbers[1 - i]);
    const FastWalk& whole = walks[1 - i];
    // What goes on to the other sample in one triangle goes on to the end as well.
    const bool is_one = whole.end == FastWalk::arrived && whole.triangle == other.triangle;
    const FastWalk to_end = is_one ? whole : walker_.walk(pair, i == 0, 1 - w.fraction);
    if (to_end.end == FastWalk::unsure) return false;
    end.behind = {other.instance, to_end.triangle};
    const double here = distance(own, at);
    const DepthPlane behind = walker_.plane(end.behind);
    end.tolerance = depth_tolerance(surfaces_, here, behind);
    if (to_end.end == FastWalk::arrived) {
        end.gap = distance(end.behind, at) - here;
        return true;
    }
    // It ends as well: extend the planes, and take the smaller gap.
    const Projection& p = surfaces_.projection;
    const glm::dvec2 other_end = place(1 - i, to_end.fraction);
    const auto extended = [&](const DepthPlane& plane, glm::dvec2 subpixel) {
        return distance_of(p, plane.extended_to(subpixel / double{kSubpixelsPerPixel}));
    };
    const double gap_here = extended(behind, at) - here;
    const double gap_there = distance(end.behind, other_end) - extended(walker_.plane(own), other_end);
    end.gap = std::abs(gap_here) <= std::abs(gap_there) ? gap_here : gap_there;
    return true;
}

/// `touched`: what it is in contact with, else nullptr.
LineDecision FastDecision::end_of_surface(const NeighbourSamples& pair, int i, const FastWalk& walk,
                                          const End* touched) const {
    LineDecision decision;
    const std::uint32_t instance = screen_.surface_of(i == 0 ? pair.first : pair.second).instance;
    const HalfEdge h = walk.half_edge;
    const SurfaceId own{instance, walk.triangle};
    decision.edge = {{instance, h / 3}, h};
    decision.front = i;
    decision.fraction = i == 0 ? walk.fraction : 1 - walk.fraction;
    const auto add_contact = [&](SurfaceId other) {
        const glm::dvec2 at = pair.place(decision.fraction) / double{kSubpixelsPerPixel};
        decision.classes |= contact_classes(surfaces_, own, other, at, criteria_, &decision.crease_cosine);
    };
    const std::uint8_t* const sharp = screen_.sharp_edges(instance);
    if (sharp == nullptr || (sharp[h / 3] >> h % 3 & 1) != 0) {
        decision.classes = edge_classes(surfaces_, decision.edge, criteria_, &decision.crease_cosine);
    }
    if (touched != nullptr) add_contact(touched->behind);
    if (walk.end == FastWalk::fold) {
        decision.classes |= LineClass::silhouette;
        decision.reason = LineReason::turns_away;
    } else if (walk.end == FastWalk::crack) {
        add_contact({instance, walk.beyond});
        decision.reason = LineReason::crack;
    } else if (touched != nullptr) {
        decision.reason = decision.classes.empty() ? LineReason::touches_smoothly : LineReason::touches;
    } else {
        decision.classes |= LineClass::border;
        decision.reason = LineReason::ends_at_border;
    }
    return decision;
}

bool FastDecision::decide(const NeighbourSamples& pair, LineDecision& decision, double& nearness) {
    decision = LineDecision{};
    const std::uint32_t numbers[2] = {pair.first, pair.second};
    const auto take_nearness = [&](int i, const FastWalk& w) {
        const SurfaceId s{screen_.surface_of(numbers[i]).instance, w.triangle};
        nearness = nearness_at(s, pair.place(decision.fraction));
    };
    FastWalk walks[2];
    for (const int i : {0, 1}) {
        if (numbers[i] == kNoSurface) continue;
        const std::uint32_t other = numbers[1 - i];
        FastWalk& w = walks[i] = walker_.walk(pair, i == 1, 1.0);
        if (w.end == FastWalk::unsure) return false;
        if (w.end == FastWalk::arrived) {
            if (other == kNoSurface) return false;
            if (screen_.number_of({screen_.surface_of(numbers[i]).instance, w.triangle}) != other) continue;
            decision.classes = w.crossed;
            decision.crease_cosine = w.crease_cosine;
            decision.reason = w.crossed.empty() ? LineReason::smooth : LineReason::feature_edge;
            if (w.crossed.empty()) return true;
            decision.edge = w.crossed_edge;
            decision.front = i;
            decision.fraction = i == 0 ? w.crossed_fraction : 1 - w.crossed_fraction;
            take_nearness(i, w);
            return true;
        }
        if (other == kNoSurface) {
            decision = end_of_surface(pair, i, w, nullptr);
            take_nearness(i, w);
            return true;
        }
    }
    End ends[2];
    bool in_front[2] = {false, false};
    for (const int i : {0, 1}) {
        if (!walks[i].is_end_of_surface()) continue;
        if (!look_behind(pair, i, walks, ends[i])) return false;
        in_front[i] = ends[i].gap >= -ends[i].tolerance;
    }
    if (!in_front[0] && !in_front[1]) return false;  // the surfaces pass through each other
    const bool both = in_front[0] && in_front[1];
    const int i = (both ? std::abs(ends[0].gap) <= std::abs(ends[1].gap) : in_front[0]) ? 0 : 1;
    decision = end_of_surface(pair, i, walks[i], ends[i].gap <= ends[i].tolerance ? &ends[i] : nullptr);
    take_nearness(i, walks[i]);
    return true;
}

}  // namespace burin
