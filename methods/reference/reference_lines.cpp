#include "methods/reference/reference_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/infinity.h"

namespace burin {
namespace {

constexpr double kFarApartPx = 2;  // conventions: a farther surface
constexpr double kWidestCrackPx = 1;
constexpr int kMaxRays = 96;    // between two samples
constexpr int kMaxFacets = 48;  // on the way over a surface

}  // namespace

/// The straight way between two samples, parametrised from 0 to 1.
struct ReferenceLines::Way {
    Way(glm::dvec2 start, glm::dvec2 goal)
        : from(start),
          along(goal - start),
          length(glm::length(along)),
          line(glm::cross(glm::dvec3(start, 1.0), glm::dvec3(goal, 1.0))) {}
    glm::dvec2 at(double t) const { return from + along * t; }
    Way reversed() const { return {from + along, from}; }

    glm::dvec2 from, along;
    double length;
    glm::dvec3 line;  // dot(line, homogeneous position) tells on which side it is
};

/// Two facets that are seen next to each other, at t.
struct ReferenceLines::Transition {
    double t = 0;
    Facet a, b;
    bool is_edge = false;  // they share the edge that is crossed
    HalfEdge edge_a = kNoHalfEdge, edge_b = kNoHalfEdge;
};

struct ReferenceLines::Search {
    const Way& way;
    std::vector<Transition> found;
    int rays = 0;
};

/// Where a way enters and leaves a triangle.
struct ReferenceLines::Slice {
    bool is_cut = false;
    double t[2] = {0, 0};
    HalfEdge edge[2] = {kNoHalfEdge, kNoHalfEdge};
    double along_edge[2] = {0, 0};
    int exit() const { return t[0] > t[1] ? 0 : 1; }
    int other_than(HalfEdge h) const { return edge[0] == h ? 1 : 0; }
};

/// How a surface goes on beyond a point of it.
struct ReferenceLines::Follow {
    enum class End : std::uint8_t {
        goes_on,  // it does
        reaches,  // and the next facet is the goal
        fold,     // it turns away from the eye
        border,   // it ends
        crack,    // it ends, and goes on as another patch of the object
        lost,
    };
    End end = End::lost;
    Facet facet;                  // where it ended
    HalfEdge edge = kNoHalfEdge;  // at which edge of that
    Facet partner;                // crack: the other patch
    LineClassSet crossed;         // classes of the edges on the way
    bool ended() const { return end == End::fold || end == End::border || end == End::crack; }
};

ReferenceLines::ReferenceLines(const RayGeometry& geometry, const EmbreeScene& rays, LineClassSet wanted,
                               double cos_crease_angle, double largest_side_px)
    : geometry_(geometry),
      rays_(rays),
      wanted_(wanted),
      cos_crease_angle_(cos_crease_angle),
      resolution_px_(std::max(1.0 / 4096, 0x1p-21 * largest_side_px)) {}

ReferenceLines::Slice ReferenceLines::slice_of(const Way& way, Facet f) const {
    glm::dvec3 c[3], h[3];
    double side[3];
    geometry_.corners(f, c);
    const Projection& p = geometry_.projection();
    for (int k = 0; k < 3; ++k) {
        h[k] = p.homogeneous(c[k]);
        side[k] = glm::dot(way.line, h[k]);
    }
    Slice slice;
    glm::dvec3 points[2];
    int found = 0;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        if ((side[k] >= 0) == (side[next] >= 0)) continue;
        points[found] = (h[k] * side[next] - h[next] * side[k]) / (side[next] - side[k]);
        slice.edge[found] = 3 * f.triangle + static_cast<HalfEdge>(k);
        slice.along_edge[found] = side[k] / (side[k] - side[next]);
        ++found;
    }
    slice.is_cut = found == 2;
    for (int i = 0; i < found; ++i) slice.t[i] = place_on(way, points[i], points[1 - i]);
    return slice;
}

/// Where on a way a point of it is seen, both homogeneous. For a point behind the eye it is the end of the way to which
/// the surface between it and `other`, in front of the eye, goes on.
double ReferenceLines::place_on(const Way& way, const glm::dvec3& point, const glm::dvec3& other) {
    const auto ahead = [&](const glm::dvec3& p) { return glm::dot(glm::dvec2(p) - way.from * p.z, way.along); };
    if (point.z > 0) return ahead(point) / point.z / (way.length * way.length);
    return ahead(point) * other.z - ahead(other) * point.z < 0 && other.z > 0 ? -kInfinity : kInfinity;
}

std::optional<ReferenceLines::Transition> ReferenceLines::shared_edge(const Way& way, Facet a, Facet b) const {
    if (a.object != b.object || a.is_background()) return std::nullopt;
    const Mesh& mesh = geometry_.mesh(a.object);
    for (HalfEdge h = 3 * a.triangle; h < 3 * a.triangle + 3; ++h) {
        for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) {
            if (g / 3 != b.triangle) continue;
            // The edge is the one only if the way leaves a and enters b there.
            const Slice slice_a = slice_of(way, a), slice_b = slice_of(way, b);
            if (!slice_a.is_cut || !slice_b.is_cut) return std::nullopt;
            const int out = slice_a.exit(), in = 1 - slice_b.exit();
            if (slice_a.edge[out] != h || slice_b.edge[in] != g) return std::nullopt;
            const double t = std::clamp(slice_a.t[out], 0.0, 1.0);
            if (std::abs(t - slice_a.t[out]) * way.length > resolution_px_) return std::nullopt;
            return Transition{t, a, b, true, h, g};
        }
    }
    return std::nullopt;
}

void ReferenceLines::search(Search& s, double ta, Facet a, double tb, Facet b) const {
    if (a == b) return;
    if (const auto edge = shared_edge(s.way, a, b)) {
        s.found.push_back(*edge);
        return;
    }
    const double step = resolution_px_ / s.way.length;
    if (tb - ta <= 4 * step || s.rays >= kMaxRays) {
        s.found.push_back({0.5 * (ta + tb), a, b, false, kNoHalfEdge, kNoHalfEdge});
        return;
    }
    const auto cast = [&](double t) {
        ++s.rays;
        return rays_.cast(s.way.at(t));
    };
    // The nearer one probably ends at its own edge: two rays confirm that.
    const auto ends_at = [&](Facet f, bool forward) {
        if (f.is_background()) return -1.0;
        const Slice slice = slice_of(s.way, f);
        return slice.is_cut ? slice.t[forward ? slice.exit() : 1 - slice.exit()] : -1.0;
    };
    const double end_a = ends_at(a, true), end_b = ends_at(b, false);
    const auto is_inside = [&](double t) { return t >= ta + 2 * step && t <= tb - 2 * step; };
    double guess = -1;
    if (is_inside(end_a) && is_inside(end_b)) {
        const bool a_is_nearer = geometry_.distance(a, s.way.at(end_a)) <= geometry_.distance(b, s.way.at(end_a));
        guess = a_is_nearer ? end_a : end_b;
    } else if (is_inside(end_a)) {
        guess = end_a;
    } else if (is_inside(end_b)) {
        guess = end_b;
    }
    if (guess < 0) {
        const double middle = 0.5 * (ta + tb);
        const Facet m = cast(middle);
        search(s, ta, a, middle, m);
        search(s, middle, m, tb, b);
        return;
    }
    const Facet before = cast(guess - step), after = cast(guess + step);
    search(s, ta, a, guess - step, before);
    search(s, guess - step, before, guess + step, after);
    search(s, guess + step, after, tb, b);
}

std::optional<SeenCrossing> ReferenceLines::between(const SeenPoint& a, const SeenPoint& b) const {
    if (a.facet == b.facet) return std::nullopt;
    const Way way(a.pixel, b.pixel);
    // Most neighbours meet at an edge without a class; those need no rays.
    if (const auto edge = shared_edge(way, a.facet, b.facet)) {
        const LineClassSet classes = edge_classes(a.facet, edge->edge_a, b.facet, edge->edge_b, way.at(edge->t));
        if ((classes & wanted_).empty()) return std::nullopt;
    }
    // The samples themselves come from packets, which do not know about coincident surfaces.
    Search s{way, {}, 0};
    search(s, 0, rays_.cast(a.pixel), 1, rays_.cast(b.pixel));
    std::optional<SeenCrossing> best;
    const auto rank = [&](const SeenCrossing& c) {
        const auto first = (c.classes & wanted_).first();
        return first ? static_cast<int>(*first) : kLineClassCount;
    };
    for (const Transition& t : s.found) {
        const SeenCrossing crossing = decide(way, t);
        if ((crossing.classes & wanted_).empty() && !crossing.occludes) continue;
        if (!best || rank(crossing) < rank(*best)) best = crossing;
    }
    return best;
}

SeenCrossing ReferenceLines::decide(const Way& way, const Transition& t) const {
    SeenCrossing crossing;
    crossing.fraction = t.t;
    const glm::dvec2 at = way.at(t.t);
    if (t.is_edge) {
        crossing.classes = edge_classes(t.a, t.edge_a, t.b, t.edge_b, at);
        crossing.depth_px = geometry_.depth_px(geometry_.distance(t.a, at));
        return crossing;
    }
    const double distance_a = t.a.is_background() ? kInfinity : geometry_.distance(t.a, at);
    const double distance_b = t.b.is_background() ? kInfinity : geometry_.distance(t.b, at);
    crossing.front = distance_a <= distance_b ? 0 : 1;
    const double own = std::min(distance_a, distance_b);
    crossing.depth_px = geometry_.depth_px(own);
    if (!t.a.is_background() && !t.b.is_background()) {
        const double slope = geometry_.slope_per_px(t.a, at) + geometry_.slope_per_px(t.b, at);
        const double tolerance = kFarApartPx * geometry_.projection().pixel_size(own) + slope * 4 * resolution_px_;
        if (std::abs(distance_a - distance_b) <= tolerance) return decide_touching(way, t, crossing);
    }

    // A surface ends in front of another.
    crossing.occludes = true;
    const Follow end = crossing.front == 0 ? follow(way, t.a, t.t, {}) : follow(way.reversed(), t.b, 1 - t.t, {});
    switch (end.end) {
        case Follow::End::fold:
            crossing.classes = classes_of_edge(end.facet, end.edge, at) | LineClass::silhouette;
            break;
        case Follow::End::border:
            crossing.classes = classes_of_edge(end.facet, end.edge, at) | LineClass::border;
            break;
        case Follow::End::crack:
            // One sees through the gap between two patches that belong together.
            crossing.classes = contact_classes(end.facet, end.partner, at);
            crossing.occludes = false;
            break;
        case Follow::End::goes_on:
        case Follow::End::reaches:
        case Follow::End::lost:
            crossing.classes = LineClass::silhouette;
            break;
    }
    return crossing;
}

SeenCrossing ReferenceLines::decide_touching(const Way& way, const Transition& t, SeenCrossing crossing) const {
    const glm::dvec2 at = way.at(t.t);
    const Follow ways[2] = {follow(way, t.a, t.t, t.b), follow(way.reversed(), t.b, 1 - t.t, t.a)};
    for (const Follow& f : ways) {
        if (f.end != Follow::End::reaches) continue;
        crossing.classes = f.crossed;
        return crossing;
    }
    const LineClassSet contact = contact_classes(t.a, t.b, at);
    double allowed = 0;
    for (const Facet f : {t.a, t.b}) {
        glm::dvec3 origin, ray;
        geometry_.projection().view_ray(at, origin, ray);
        const double across = std::abs(glm::dot(geometry_.normal_towards_eye(f, at), ray));
        allowed += geometry_.coordinate_error() / std::max(across, 1e-9);
    }
    const bool coincident = geometry_.are_one_around(t.a, t.b, at, 2 * allowed);
    // Flush faces: one turns away in the plane of the other, which goes on under it.
    const auto goes_on_beneath = [&](int i) {
        return coincident && (contact & wanted_).empty() && ways[i].end == Follow::End::goes_on &&
               geometry_.are_one_around(ways[i].facet, i == 0 ? t.b : t.a, at, 2 * allowed);
    };
    const int preferred = crossing.front;
    for (const int i : {preferred, 1 - preferred}) {
        if (ways[i].end == Follow::End::fold && goes_on_beneath(1 - i)) return crossing;
    }
    for (const int i : {preferred, 1 - preferred}) {
        if (ways[i].end != Follow::End::fold) continue;
        crossing.front = i;
        crossing.occludes = true;
        crossing.classes = classes_of_edge(ways[i].facet, ways[i].edge, at) | contact | LineClass::silhouette;
        return crossing;
    }
    for (const int i : {preferred, 1 - preferred}) {
        if (!ways[i].ended()) continue;
        crossing.classes = classes_of_edge(ways[i].facet, ways[i].edge, at) | contact;
        return crossing;
    }
    // Here both surfaces go on behind each other, or lie in one plane.
    const bool lost = ways[0].end == Follow::End::lost || ways[1].end == Follow::End::lost;
    if (!lost && run_along(t.a, t.b, at)) return crossing;
    if (coincident || lost) {
        if (!lost || t.a.object != t.b.object) crossing.classes = contact;
        return crossing;
    }
    crossing.classes = LineClass::intersection | (contact & (LineClass::object | LineClass::material));
    return crossing;
}

/// Whether two surfaces that pass through each other at a place stay within kCopiesApartPx of each other around it, as
/// far as both go on: then they are copies of one surface, rounded in different ways
/// (docs/decisions/0017-rounded-copies.md).
bool ReferenceLines::run_along(Facet a, Facet b, glm::dvec2 at) const {
    constexpr double kAtEdges = 2;  // there one copy has gone on to the next facet
    constexpr double kFarthestPx = 64;
    const auto gap_px = [this](Facet one, Facet other, glm::dvec2 place) {
        glm::dvec3 origin, ray;
        geometry_.projection().view_ray(place, origin, ray);
        const double first = geometry_.distance(one, place), second = geometry_.distance(other, place);
        const double slant = 1 / std::abs(glm::dot(geometry_.polygon_normal(one), ray)) +
                             1 / std::abs(glm::dot(geometry_.polygon_normal(other), ray));
        return std::abs(first - second) / (0.5 * slant * geometry_.projection().pixel_size(std::min(first, second)));
    };
    if (!(gap_px(a, b, at) <= kAtEdges * kCopiesApartPx)) return false;
    for (const glm::dvec2 direction :
         {glm::dvec2(1, 0), {0.7, 0.7}, {0, 1}, {-0.7, 0.7}, {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}}) {
        for (double far_px = 1; far_px <= kFarthestPx; far_px *= 2) {
            const Way way(at, at + far_px * direction);
            const Follow one = follow(way, a, 0, {}, way.length), other = follow(way, b, 0, {}, way.length);
            if (one.end != Follow::End::goes_on || other.end != Follow::End::goes_on) break;
            if (!(gap_px(one.facet, other.facet, way.at(1)) <= kAtEdges * kCopiesApartPx)) return false;
        }
    }
    return true;
}

ReferenceLines::Follow ReferenceLines::follow(const Way& way, Facet start, double from, Facet goal) const {
    return follow(way, start, from, goal, 6 * resolution_px_);
}

ReferenceLines::Follow ReferenceLines::follow(const Way& way, Facet start, double from, Facet goal,
                                              double reach_px) const {
    Follow result;
    result.facet = start;
    const Mesh& mesh = geometry_.mesh(start.object);
    Slice slice = slice_of(way, start);
    if (!slice.is_cut) return result;
    const double beyond = from + reach_px / way.length;
    const double negligible = kNegligibleFoldPx / way.length;
    Facet current = start;
    int exit = slice.exit();
    Facet farthest = current;
    HalfEdge farthest_edge = slice.edge[exit];
    double farthest_t = slice.t[exit];
    const auto ended = [&](Follow::End end, Facet facet, HalfEdge edge) {
        result.end = end;
        result.facet = facet;
        result.edge = edge;
        return result;
    };
    for (int step = 0; step < kMaxFacets; ++step) {
        const double t = slice.t[exit];
        const HalfEdge h = slice.edge[exit];
        if (t > beyond) return ended(Follow::End::goes_on, current, h);
        if (mesh.next_on_edge[h] == h) {
            Facet partner;
            const auto side = seam_goes_on(way, current, h, slice.along_edge[exit], partner);
            if (partner.is_background()) return ended(Follow::End::border, current, h);
            if (!side) return ended(Follow::End::fold, current, h);
            result.partner = partner;
            return ended(Follow::End::crack, current, h);
        }
        // Among several neighbours it is one that goes forward, and of those the nearest to the eye.
        Facet next;
        Slice next_slice;
        HalfEdge entry = kNoHalfEdge;
        double best_distance = kInfinity;
        bool best_forward = false;
        for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) {
            const Facet neighbour{current.object, g / 3};
            const Slice candidate = slice_of(way, neighbour);
            if (!candidate.is_cut) continue;
            const double other_t = candidate.t[candidate.other_than(g)];
            const bool forward = other_t > t;
            const double middle = 0.5 * (t + std::clamp(other_t, t - 1, t + 1));
            const double distance = geometry_.distance(neighbour, way.at(middle));
            if (entry != kNoHalfEdge &&
                (forward < best_forward || (forward == best_forward && distance >= best_distance)))
                continue;
            next = neighbour;
            next_slice = candidate;
            entry = g;
            best_forward = forward;
            best_distance = distance;
        }
        if (entry == kNoHalfEdge) return result;
        const int next_exit = next_slice.other_than(entry);
        if (next_slice.t[next_exit] < farthest_t - negligible) {
            return ended(Follow::End::fold, farthest, farthest_edge);
        }
        result.crossed |= edge_classes(current, h, next, entry, way.at(t));
        if (next == goal) return ended(Follow::End::reaches, next, entry);
        current = next;
        slice = next_slice;
        exit = next_exit;
        if (slice.t[exit] >= farthest_t) {
            farthest = current;
            farthest_edge = slice.edge[exit];
            farthest_t = slice.t[exit];
        }
    }
    return result;
}

/// Whether another patch of the object goes on beyond a border. `partner` stays background if there
/// is none; false with a partner means that it turns back.
bool ReferenceLines::seam_goes_on(const Way& way, Facet f, HalfEdge border, double along_edge, Facet& partner) const {
    const Mesh& mesh = geometry_.mesh(f.object);
    const auto& t = mesh.triangles[f.triangle];
    const std::uint32_t v = t[border % 3], w = t[(border + 1) % 3];
    const Projection& p = geometry_.projection();
    // The place is away from the edge's ends, where the next edge of the same border is as near as the other patch.
    const double length_px =
        glm::distance(p.to_pixel(geometry_.position(f.object, v)), p.to_pixel(geometry_.position(f.object, w)));
    const double margin = std::min(0.5, 0.5 * kWidestCrackPx / length_px);
    along_edge = std::clamp(along_edge, margin, 1 - margin);
    const auto seam =
        mesh.borders.seam_partner(border, glm::mix(mesh.local_position(v), mesh.local_position(w), along_edge));
    if (!seam) return false;
    const glm::dvec3 place = glm::mix(geometry_.position(f.object, v), geometry_.position(f.object, w), along_edge);
    const auto& u = mesh.triangles[*seam / 3];
    glm::dvec3 c[3];
    for (std::size_t k = 0; k < 3; ++k) c[k] = geometry_.position(f.object, u[(*seam % 3 + k) % 3]);
    // An edge that passes the near plane counts where it lies in front.
    const double before[2] = {-c[0].z - p.near_distance, -c[1].z - p.near_distance};
    if (before[0] <= 0 && before[1] <= 0) return false;
    if (before[0] <= 0 || before[1] <= 0) {
        c[before[0] <= 0 ? 0 : 1] = glm::mix(c[0], c[1], before[0] / (before[0] - before[1]));
    }
    const glm::dvec2 at = p.to_pixel(place), a = p.to_pixel(c[0]), b = p.to_pixel(c[1]);
    const glm::dvec2 d = b - a;
    const double s = std::clamp(glm::dot(at - a, d) / std::max(glm::dot(d, d), 1e-300), 0.0, 1.0);
    if (glm::distance(at, a + s * d) > kWidestCrackPx) return false;
    const double distance = -place.z, other = -glm::mix(c[0], c[1], s).z;
    const Facet candidate{f.object, *seam / 3};
    const double tolerance = kFarApartPx * p.pixel_size(distance) +
                             (geometry_.slope_per_px(candidate, at) + geometry_.slope_per_px(f, at)) / 256;
    // Seen at a small angle, the place nearest on the screen may lie far off in depth, though in the same plane.
    const double in_its_plane = geometry_.plane_distance(candidate, at);
    if (std::abs(distance - other) > tolerance && !(std::abs(distance - in_its_plane) <= tolerance)) return false;
    partner = candidate;
    const double third_side = glm::dot(glm::cross(glm::dvec3(a, 1), glm::dvec3(b, 1)), p.homogeneous(c[2]));
    return (third_side > 0) == (d.x * way.along.y - d.y * way.along.x > 0);
}

}  // namespace burin
