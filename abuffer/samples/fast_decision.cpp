#include "abuffer/samples/fast_decision.h"

#include <algorithm>
#include <cmath>

namespace burin {

/// Whether snapping may decide which way a triangle faces that is as deep as what separates surfaces.
inline bool FastDecision::may_be_wall(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) const {
    const float highest = std::max(std::max(a.nearness, b.nearness), c.nearness),
                lowest = std::min(std::min(a.nearness, b.nearness), c.nearness);
    if (__builtin_expect(highest - lowest < lowest * level_per_nearness_ + level_, 1)) return false;
    constexpr double kSnappingSubpixels = to_subpixels(kSnappingPx);
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    return std::abs(ux * vy - uy * vx) <=
           kSnappingSubpixels * std::max({std::abs(ux), std::abs(uy), std::abs(vx), std::abs(vy)});
}

bool FastDecision::is_smooth(const NeighbourSamples& pair) const {
    const SurfaceId start = pair.surfaces[0];
    if (start.instance != pair.surfaces[1].instance || start.is_background()) return false;
    const ScreenMesh& mesh = screen_.mesh(start.instance);
    const std::uint32_t goal = pair.surfaces[1].triangle;
    const std::uint8_t facing = mesh.facing[start.triangle];
    if (mesh.sharp == nullptr || mesh.facing[goal] != facing || (facing != clockwise && facing != counterclockwise)) {
        return false;
    }
    const std::int32_t across = pair.down ? pair.x : pair.y;
    const bool from_side = exit_begins_beyond(facing, pair.down);
    std::uint32_t t = start.triangle;
    constexpr int kMaxTriangles = 6;
    for (int step = 0; step < kMaxTriangles; ++step) {
        // The last one need not be solid: it meets the one before at an edge that is not sharp.
        if (t == goal) return true;
        if (step > 0 && !FastWalker::is_surely_solid(mesh, t)) return false;
        const std::uint32_t* const corners = mesh.corners + 3 * static_cast<std::size_t>(t);
        bool side[3];
        const ScreenVertex* p[3];
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = &mesh.vertices[corners[k]];
            side[k] = (pair.down ? p[k]->x : p[k]->y) > across;
        }
        if (step > 0 && may_be_wall(*p[0], *p[1], *p[2])) return false;
        const std::uint32_t k = exit_edge(side, from_side);
        // An edge that is not sharp has one partner.
        if (k > 2 || (mesh.sharp[t] >> k & 1) != 0) return false;
        t = mesh.partners[3 * static_cast<std::size_t>(t) + k] / 3;
        if (mesh.facing[t] != facing) return false;
    }
    return false;
}

double FastDecision::nearness_at(SurfaceId s, glm::dvec2 subpixel) const {
    const ScreenMesh& mesh = screen_.mesh(s.instance);
    const std::uint32_t* const corners = mesh.corners + 3 * static_cast<std::size_t>(s.triangle);
    const ScreenVertex &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]], &c = mesh.vertices[corners[2]];
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double area = ux * vy - uy * vx;
    const double qa = static_cast<double>(a.nearness), qb = static_cast<double>(b.nearness) - qa;
    const double qc = static_cast<double>(c.nearness) - qa;
    if (area == 0) return surfaces_.farthest_nearness + qa + std::max({0.0, qb, qc});
    const double px = subpixel.x - a.x, py = subpixel.y - a.y;
    const double q = ((px * vy - py * vx) * qb + (ux * py - uy * px) * qc) / area;
    return surfaces_.farthest_nearness + qa + std::clamp(q, std::min({0.0, qb, qc}), std::max({0.0, qb, qc}));
}

FastDecision::End FastDecision::look_behind(const NeighbourSamples& pair, int i) const {
    const FastWalk& w = *walks_[i];
    const auto place = [&](int from, double fraction) { return pair.place(from == 0 ? fraction : 1 - fraction); };
    const glm::dvec2 at = place(i, w.fraction);
    const FastWalk::Stop stop = walks_[1 - i]->stop_at(1 - w.fraction);
    const SurfaceId own{pair.surfaces[i].instance, w.triangle};
    const Projection& p = surfaces_.projection;
    End end;
    end.nearness = nearness_at(own, at);
    end.behind = {pair.surfaces[1 - i].instance, stop.triangle};
    const double here = distance_of(p, end.nearness);
    const DepthPlane behind = walker_.plane(end.behind);
    end.tolerance = depth_tolerance(surfaces_, here, behind);
    end.certainly_apart = depth_tolerance(surfaces_, here, behind, kCertainlyApartPx);
    if (stop.has_arrived) {
        end.gap = distance_of(p, behind.nearness(to_pixels(at))) - here;
        return end;
    }
    // It ends as well: extend the planes, and take the smaller gap.
    const glm::dvec2 other_end = place(1 - i, stop.fraction);
    const auto extended = [&](const DepthPlane& plane, glm::dvec2 subpixel) {
        return distance_of(p, plane.extended_to(to_pixels(subpixel)));
    };
    const double gap_here = extended(behind, at) - here;
    const double gap_there =
        distance_of(p, nearness_at(end.behind, other_end)) - extended(walker_.plane(own), other_end);
    end.gap = std::abs(gap_here) <= std::abs(gap_there) ? gap_here : gap_there;
    return end;
}

/// `touched`: what the surface that ends is in contact with, else nullptr. `decision`: a new one, filled in where it
/// is, for copying would wait for what was just stored.
void FastDecision::end_of_surface(const NeighbourSamples& pair, int i, const FastWalk& walk, const End* touched,
                                  LineDecision& decision) {
    const std::uint32_t instance = pair.surfaces[i].instance;
    const HalfEdge h = walk.half_edge;
    const SurfaceId own{instance, walk.triangle};
    decision.edge = {{instance, h / 3}, h};
    decision.front = i;
    decision.fraction = i == 0 ? walk.fraction : 1 - walk.fraction;
    const auto add_contact = [&](SurfaceId other) {
        const glm::dvec2 at = to_pixels(pair.place(decision.fraction));
        decision.classes |= contact_classes(surfaces_, own, other, at, criteria_, &decision.crease_cosine);
    };
    const std::uint8_t* const sharp = screen_.sharp_edges(instance);
    if (sharp == nullptr || (sharp[h / 3] >> h % 3 & 1) != 0) {
        decision.classes = walker_.edge_classes(decision.edge, &decision.crease_cosine);
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
}

/// Whether an edge of one of two triangles lies between them on the screen. Then they have no place in common, so
/// burin::are_flush() is false.
bool FastDecision::are_beside(SurfaceId a, SurfaceId b) const {
    for (const SurfaceId s : {a, b}) {
        if (!surfaces_.mesh_of(s).triangle_polygon.empty()) return false;  // other triangles of their polygons may have
    }
    const ScreenTriangle triangles[2] = {screen_.triangle(a), screen_.triangle(b)};
    for (const ScreenTriangle& t : triangles) {
        for (const ScreenVertex& v : t.corners) {
            if (v.x == ScreenVertex::kOffScreen) return false;
        }
    }
    for (const int i : {0, 1}) {
        const auto& [p, q, r] = triangles[i].corners;
        const std::int64_t area = doubled_area(p, q, r);
        if (area == 0) continue;
        const auto is_beyond = [&](const ScreenVertex& from, const ScreenVertex& to) {
            const auto side = [&](const ScreenVertex& v) {
                return area > 0 ? doubled_area(from, to, v) : -doubled_area(from, to, v);
            };
            const auto& [u, v, w] = triangles[1 - i].corners;
            return side(u) < 0 && side(v) < 0 && side(w) < 0;
        };
        if (is_beyond(p, q) || is_beyond(q, r) || is_beyond(r, p)) return true;
    }
    return false;
}

/// Whether what is seen lies in one plane, or the surface that goes on does so under the one that ends.
bool FastDecision::may_be_flush(const NeighbourSamples& pair, int ends) const {
    const glm::dvec2 at = to_pixels(pair.place(0.5));
    const FastWalk& other = *walks_[1 - ends];
    const auto are_flush = [&](SurfaceId a, SurfaceId b) {
        return !are_beside(a, b) && burin::are_flush(surfaces_, a, b, at, criteria_);
    };
    const SurfaceId beneath{pair.surfaces[1 - ends].instance, other.triangle};
    if (other.end == FastWalk::arrived && are_flush(beneath, pair.surfaces[ends])) return true;
    return are_flush(pair.surfaces[0], pair.surfaces[1]);
}

/// Where the surface of the first sample ends exactly at the second one, which lies a trifle further and sees something
/// else, as outlines do all along where a part is seen along an axis: its walk becomes one that ends at the edge
/// itself.
void FastDecision::end_at_sample(const NeighbourSamples& pair) {
    constexpr bool kBackwards = false, kPassesGoal = true;
    FastWalk& beyond = made_beyond_;
    walker_.walk(pair, kBackwards, beyond, kPassesGoal);
    if (!beyond.is_end_of_surface()) return;
    const double trifle = to_subpixels(pair.down ? kSampleTrifleY : kSampleTrifleX) / pair.pitch;
    beyond.fraction = std::max(beyond.fraction - trifle, 0.0);
    walks_[0] = &beyond;
}

bool FastDecision::decide(const NeighbourSamples& pair, LineDecision& decision, double& nearness,
                          const KnownWalks& known) {
    decision = LineDecision{};
    const auto nearness_of = [&](int i, const FastWalk& w) {
        return nearness_at({pair.surfaces[i].instance, w.triangle}, pair.place(decision.fraction));
    };
    for (const int i : {0, 1}) {
        if (pair.surfaces[i].is_background()) continue;
        const SurfaceId other = pair.surfaces[1 - i];
        const auto from = static_cast<std::size_t>(i);
        walks_[i] = known[from];
        if (walks_[i] == nullptr) {
            walker_.walk(pair, i == 1, made_[i]);
            walks_[i] = &made_[i];
        }
        if (walks_[i]->end == FastWalk::unsure) return false;
        const bool is_through =
            walks_[i]->end == FastWalk::arrived && SurfaceId{pair.surfaces[i].instance, walks_[i]->triangle} == other;
        const bool may_end = i == 0 && walks_[0]->end == FastWalk::arrived && walks_[0]->fraction == 1 && !is_through;
        if (may_end) end_at_sample(pair);
        const FastWalk& w = *walks_[i];
        if (w.end == FastWalk::arrived) {
            if (other.is_background()) return false;
            if (!is_through) continue;
            decision.classes = w.crossed;
            decision.crease_cosine = w.crease_cosine;
            decision.reason = w.crossed.empty() ? LineReason::smooth : LineReason::feature_edge;
            if (w.crossed.empty()) return true;
            decision.edge = w.crossed_edge;
            decision.front = i;
            decision.fraction = i == 0 ? w.crossed_fraction : 1 - w.crossed_fraction;
            nearness = nearness_of(i, w);
            return true;
        }
        if (other.is_background()) {
            end_of_surface(pair, i, w, nullptr, decision);
            nearness = nearness_of(i, w);
            return true;
        }
    }
    End ends[2];
    bool in_front[2] = {false, false};
    for (const int i : {0, 1}) {
        if (!walks_[i]->is_end_of_surface()) continue;
        ends[i] = look_behind(pair, i);
        in_front[i] = ends[i].gap >= -ends[i].tolerance;
    }
    if (!in_front[0] && !in_front[1]) return false;  // the surfaces pass through each other
    // An end that is behind the other surface for certain is not seen.
    const auto is_behind = [&](int end) { return ends[end].gap < -ends[end].certainly_apart; };
    int i = in_front[0] ? 0 : 1;
    if (in_front[0] && in_front[1]) {
        const bool has_hidden_end = is_behind(0) != is_behind(1);
        const bool takes_first = has_hidden_end ? !is_behind(0) : std::abs(ends[0].gap) <= std::abs(ends[1].gap);
        i = takes_first ? 0 : 1;
    }
    if (is_behind(i)) return false;  // they may pass through each other before it
    const bool touches = ends[i].gap <= ends[i].tolerance;
    if (touches && may_be_flush(pair, i)) return false;
    end_of_surface(pair, i, *walks_[i], touches ? &ends[i] : nullptr, decision);
    nearness = ends[i].nearness;
    return true;
}

}  // namespace burin
