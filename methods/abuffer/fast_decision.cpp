#include "methods/abuffer/fast_decision.h"

#include <cmath>

namespace burin {
namespace {

constexpr int kMaxSteps = 24;
constexpr double kNegligibleFoldPx = 1.0 / 64;
/// A triangle that is at least this high on the screen is no sliver. In 1/256 pixel.
constexpr double kSurelySolid = 256.0 / 64 + 1;

/// Where an edge crosses the walking line, along it. `u` runs along the walk, `v` across.
double crossing(std::int32_t u0, std::int32_t v0, std::int32_t u1, std::int32_t v1, std::int32_t v) {
    return u0 + static_cast<double>(v - v0) * (u1 - u0) / (v1 - v0);
}

}  // namespace

bool FastDecision::is_smooth(const NeighbourSamples& pair) const {
    if (pair.first == kNoSurface || pair.second == kNoSurface) return false;
    const SurfaceId start = screen_.surface_of(pair.first);
    const std::uint8_t* const sharp = screen_.sharp_edges(start.instance);
    const std::uint32_t first_number = pair.first - start.triangle;
    const std::uint32_t goal = pair.second - first_number;  // wraps where it lies in another instance
    const Mesh& mesh = surfaces_.mesh_of(start);
    const Facing facing = screen_.facing(pair.first);
    if (sharp == nullptr || goal >= mesh.triangles.size() || screen_.facing(pair.second) != facing) return false;
    if (facing != clockwise && facing != counterclockwise) return false;
    const ScreenVertex* const vertices = screen_.vertices(start.instance);
    const std::int32_t across = pair.down ? pair.x : pair.y;
    // Where corners run clockwise, a walk to the right leaves across the edge that goes down; a walk
    // down, across the one that goes left.
    const bool from_side = (facing == clockwise) == pair.down;
    std::uint32_t t = start.triangle;
    constexpr int kMaxTriangles = 6;
    for (int step = 0; step < kMaxTriangles; ++step) {
        const auto& c = mesh.triangles[t];
        const ScreenVertex* const p[3] = {&vertices[c[0]], &vertices[c[1]], &vertices[c[2]]};
        if (step > 0) {
            const double ux = p[1]->x - p[0]->x, uy = p[1]->y - p[0]->y;
            const double vx = p[2]->x - p[0]->x, vy = p[2]->y - p[0]->y;
            const double longest = std::max({ux * ux + uy * uy, vx * vx + vy * vy,
                                             (ux - vx) * (ux - vx) + (uy - vy) * (uy - vy)});
            const double area = ux * vy - uy * vx;
            if (area * area < kSurelySolid * kSurelySolid * longest) return false;
            if (t == goal) return true;
        }
        bool side[3];
        for (std::size_t k = 0; k < 3; ++k) side[k] = (pair.down ? p[k]->x : p[k]->y) > across;
        const std::uint32_t k = side[0] == from_side && side[1] != from_side   ? 0
                                : side[1] == from_side && side[2] != from_side ? 1
                                                                               : 2;
        const std::uint32_t n = k == 2 ? 0 : k + 1;
        if (side[k] != from_side || side[n] == from_side || (sharp[t] >> k & 1) != 0) return false;
        const HalfEdge exit = 3 * t + k, partner = mesh.next_on_edge[exit];
        if (partner == exit || mesh.next_on_edge[partner] != exit) return false;
        t = partner / 3;
        if (screen_.facing(first_number + t) != facing) return false;
    }
    return false;
}

FastDecision::Walk FastDecision::walk(const NeighbourSamples& pair, bool backwards, double goal) const {
    Walk result;
    const SurfaceId start = screen_.surface_of(backwards ? pair.second : pair.first);
    const Mesh& mesh = surfaces_.mesh_of(start);
    const ScreenVertex* const vertices = screen_.vertices(start.instance);
    const std::uint8_t* const sharp = screen_.sharp_edges(start.instance);
    const std::int32_t across = pair.down ? pair.x : pair.y;
    const double origin = (pair.down ? pair.y : pair.x) + (backwards ? pair.pitch : 0);
    const double per_unit = (backwards ? -1.0 : 1.0) / pair.pitch;
    const double negligible = kNegligibleFoldPx * kSubpixelsPerPixel / pair.pitch;

    // The half-edge where the line leaves a triangle that it entered by `entry`, and where.
    std::uint32_t t = start.triangle;
    HalfEdge entry = kNoHalfEdge;
    // Where the walk is and where it got farthest: it may turn back by a trifle.
    double current = -1e300, farthest = -1e300;
    HalfEdge farthest_edge = kNoHalfEdge;
    for (int step = 0; step < kMaxSteps; ++step) {
        const auto& c = mesh.triangles[t];
        std::int32_t u[3], v[3];
        bool side[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const ScreenVertex& p = vertices[c[k]];
            if (p.x == ScreenVertex::kOffScreen) return result;
            u[k] = pair.down ? p.y : p.x;
            v[k] = pair.down ? p.x : p.y;
            side[k] = v[k] > across;  // samples on a vertex lie a trifle further right and down
        }
        // The edge opposite to the odd corner is not crossed.
        HalfEdge exit = kNoHalfEdge;
        double reached = -1e300;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t n = k == 2 ? 0 : k + 1;
            const HalfEdge h = 3 * t + k;
            if (side[k] == side[n] || h == entry) continue;
            const double at = (crossing(u[k], v[k], u[n], v[n], across) - origin) * per_unit;
            if (entry == kNoHalfEdge ? at > reached : true) {
                reached = at;
                exit = h;
            }
        }
        if (exit == kNoHalfEdge) return result;
        if (entry != kNoHalfEdge) {
            const auto squared = [&](int a, int b) {
                const double du = u[a] - u[b], dv = v[a] - v[b];
                return du * du + dv * dv;
            };
            const double longest = std::max({squared(0, 1), squared(1, 2), squared(2, 0)});
            const double area = static_cast<double>(std::int64_t{u[1] - u[0]} * (v[2] - v[0]) -
                                                    std::int64_t{v[1] - v[0]} * (u[2] - u[0]));
            if (area * area < kSurelySolid * kSurelySolid * longest && is_sliver(surfaces_, {start.instance, t})) {
                return result;
            }
            const auto unfolds_apart = [&] {
                if (!(current < farthest && reached >= farthest)) return false;
                const double along = origin + farthest / per_unit;
                const glm::dvec2 at = pair.down ? glm::dvec2(across, along) : glm::dvec2(along, across);
                return !is_level({start.instance, farthest_edge / 3}, {start.instance, t}, at);
            };
            if (reached < farthest - negligible || unfolds_apart()) {
                result.end = Walk::fold;
                result.triangle = farthest_edge / 3;
                result.half_edge = farthest_edge;
                result.fraction = farthest;
                return result;
            }
            if (sharp == nullptr || (sharp[entry / 3] >> entry % 3 & 1) != 0) {
                const HalfEdge own = mesh.next_on_edge[entry];
                const LineClassSet classes =
                    edge_classes(surfaces_, {{start.instance, own / 3}, own}, criteria_, &result.crease_cosine) &
                    criteria_.classes;
                if (!classes.empty() && result.crossed.empty()) {
                    result.crossed_edge = own;
                    result.crossed_fraction = current;
                }
                result.crossed |= classes;
            }
        }
        current = reached;
        if (reached >= farthest) {
            farthest = reached;
            farthest_edge = exit;
        }
        if (reached >= goal) {
            result.end = Walk::arrived;
            result.triangle = t;
            return result;
        }
        const HalfEdge partner = mesh.next_on_edge[exit];
        if (partner == exit) {
            const std::size_t k = exit % 3, n = k == 2 ? 0 : k + 1;
            const double along = static_cast<double>(across - v[k]) / (v[n] - v[k]);
            const double qk = surfaces_.farthest_nearness + static_cast<double>(vertices[c[k]].nearness);
            const double qn = surfaces_.farthest_nearness + static_cast<double>(vertices[c[n]].nearness);
            // Where that is on the edge in space.
            const double part = surfaces_.projection.orthographic ? along
                                                                  : along * qn / ((1 - along) * qk + along * qn);
            if (has_seam(start.instance, exit, part)) return result;
            result.end = Walk::border;
            result.triangle = t;
            result.half_edge = exit;
            result.fraction = reached;
            return result;
        }
        if (mesh.next_on_edge[partner] != exit) return result;
        t = partner / 3;
        entry = partner;
    }
    return result;
}

bool FastDecision::has_seam(std::uint32_t instance, HalfEdge border, double along) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const auto& t = mesh.triangles[border / 3];
    const glm::dvec3 a(mesh.positions[t[border % 3]]), b(mesh.positions[t[(border + 1) % 3]]);
    return mesh.borders.seam_partner(border, glm::mix(a, b, along)).has_value();
}

bool FastDecision::is_level(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const {
    const glm::dvec2 at = subpixel / double{kSubpixelsPerPixel};
    const DepthPlane plane = surfaces_.plane(b);
    const double distance = distance_of(surfaces_.projection, surfaces_.plane(a).nearness(at));
    const double other = distance_of(surfaces_.projection, plane.nearness(at));
    return std::abs(distance - other) <= depth_tolerance(surfaces_, distance, plane);
}

LineClassSet FastDecision::classes_at_end(const Walk& walk, std::uint32_t instance, double& crease_cosine) const {
    const LineClass own = walk.end == Walk::fold ? LineClass::silhouette : LineClass::border;
    const HalfEdge h = walk.half_edge;
    const std::uint8_t* const sharp = screen_.sharp_edges(instance);
    if (sharp != nullptr && (sharp[h / 3] >> h % 3 & 1) == 0) return own;  // it has no other class
    return own | edge_classes(surfaces_, {{instance, h / 3}, h}, criteria_, &crease_cosine);
}

double FastDecision::nearness_at(SurfaceId s, double x, double y) const {
    const ScreenTriangle t = screen_.triangle(s);
    const ScreenVertex &a = t.corners[0], &b = t.corners[1], &c = t.corners[2];
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double area = ux * vy - uy * vx;
    const double qa = static_cast<double>(a.nearness), qb = static_cast<double>(b.nearness) - qa;
    const double qc = static_cast<double>(c.nearness) - qa;
    if (area == 0) return surfaces_.farthest_nearness + qa + std::max({0.0, qb, qc});
    const double px = x - a.x, py = y - a.y;
    const double q = ((px * vy - py * vx) * qb + (ux * py - uy * px) * qc) / area;
    return surfaces_.farthest_nearness + qa + std::clamp(q, std::min({0.0, qb, qc}), std::max({0.0, qb, qc}));
}

bool FastDecision::decide(const NeighbourSamples& pair, LineDecision& decision, double& nearness) const {
    const auto place = [&](double fraction) {
        const double along = fraction * pair.pitch;
        return pair.down ? glm::dvec2(pair.x, pair.y + along) : glm::dvec2(pair.x + along, pair.y);
    };
    const auto take_edge = [&](const Walk& w, HalfEdge h, std::uint32_t instance, int i, double fraction) {
        decision.edge = {{instance, h / 3}, h};
        decision.front = i;
        decision.fraction = i == 0 ? fraction : 1 - fraction;
        const glm::dvec2 at = place(decision.fraction);
        nearness = nearness_at({instance, w.triangle}, at.x, at.y);
    };
    decision = LineDecision{};
    if (is_smooth(pair)) {
        decision.reason = LineReason::smooth;
        return true;
    }
    const std::uint32_t numbers[2] = {pair.first, pair.second};
    Walk walks[2];
    for (const int i : {0, 1}) {
        if (numbers[i] == kNoSurface) continue;
        const std::uint32_t other = numbers[1 - i];
        Walk& w = walks[i] = walk(pair, i == 1, 1.0);
        if (w.end == Walk::unsure) return false;
        const SurfaceId s = screen_.surface_of(numbers[i]);
        if (w.end == Walk::arrived) {
            if (other == kNoSurface) return false;
            if (screen_.number_of({s.instance, w.triangle}) != other) continue;
            decision.classes = w.crossed;
            decision.crease_cosine = w.crease_cosine;
            decision.reason = w.crossed.empty() ? LineReason::smooth : LineReason::feature_edge;
            if (!w.crossed.empty()) take_edge(w, w.crossed_edge, s.instance, i, w.crossed_fraction);
            return true;
        }
        if (other == kNoSurface) {
            take_edge(w, w.half_edge, s.instance, i, w.fraction);
            decision.reason = w.end == Walk::fold ? LineReason::turns_away : LineReason::ends_at_border;
            decision.classes = classes_at_end(w, s.instance, decision.crease_cosine);
            return true;
        }
    }
    // Exactly one ends, clearly in front of the other.
    if ((walks[0].end == Walk::arrived) == (walks[1].end == Walk::arrived)) return false;
    const int i = walks[0].end == Walk::arrived ? 1 : 0;
    const Walk& w = walks[i];
    const Walk to_end = walk(pair, i == 0, 1 - w.fraction);
    if (to_end.end != Walk::arrived) return false;
    const SurfaceId own = screen_.surface_of(numbers[i]), behind = screen_.surface_of(numbers[1 - i]);
    take_edge(w, w.half_edge, own.instance, i, w.fraction);
    const glm::dvec2 at = place(decision.fraction);
    const Projection& p = surfaces_.projection;
    const SurfaceId behind_triangle{behind.instance, to_end.triangle};
    const double other_nearness = nearness_at(behind_triangle, at.x, at.y);
    const double distance = distance_of(p, nearness);
    const double gap = distance_of(p, other_nearness) - distance;
    // The tolerance depends on the other's slope; where that matters, it is not an ordinary case.
    if (!(gap > depth_tolerance(surfaces_, distance, surfaces_.plane(behind_triangle)))) return false;
    decision.reason = w.end == Walk::fold ? LineReason::turns_away : LineReason::ends_at_border;
    decision.classes = classes_at_end(w, own.instance, decision.crease_cosine);
    return true;
}

}  // namespace burin
