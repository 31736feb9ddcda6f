#include "abuffer/edges/fold_width.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lines/surface_walk.h"
#include "mesh/vectors.h"

namespace burin {
namespace {

/// A place on an edge, in 1/256 pixel. Nearness that differs by at most `level` is one.
struct PlaceOnEdge {
    glm::dvec2 at;
    double nearness, level;
};

/// A wire is no wider. 1/8 pixel.
constexpr double kWidestWireSubpixels = 32;
/// A wire has no more triangles around it.
constexpr int kMostAroundWire = 256;

enum class Reach { narrow, comes_back, goes_on };

glm::dvec2 place_of(const ScreenVertex* v) { return {v->x, v->y}; }
double nearness_of(const ScreenVertex* v) { return static_cast<double>(v->nearness); }

/// A triangle with its corners counted from the beginning of one of its edges on.
struct EnteredTriangle {
    HalfEdge second, third;  ///< its other edges
    const ScreenVertex *a, *b, *c;
    bool is_cut;  ///< it has no corners to go by

    /// On which side of its edge it lies: < 0, > 0, or 0.
    double side() const { return cross(place_of(b) - place_of(a), place_of(c) - place_of(a)); }
};

EnteredTriangle enter(const ScreenMesh& mesh, HalfEdge h) {
    const HalfEdge k = h % 3, second = k == 2 ? h - 2 : h + 1, third = k == 0 ? h + 2 : h - 1;
    const auto vertex = [&](HalfEdge e) { return mesh.vertices + mesh.corners[e]; };
    return {second, third, vertex(h), vertex(second), vertex(third), mesh.facing[h / 3] == off_screen};
}

constexpr int kMaxTriangles = 64;

/// Goes along rows of pixels (`along_x`) or columns, forwards or backwards: `sign` is 1 or -1.
template <bool along_x>
class FoldWalk {
  public:
    FoldWalk(const ScreenMesh& mesh, const PlaceOnEdge& from) : mesh_(mesh), from_(from) {}

    /// The sign that leads to a side of a triangle's edge.
    double towards(const EnteredTriangle& t, double side) const {
        return (-across(place_of(t.b) - place_of(t.a)) < 0) != (side < 0) ? -1 : 1;
    }

    /// How far the surface goes on into a triangle. comes_back: it comes back to the edge, at another nearness.
    /// `is_level`: it has to stay at the edge's nearness, too.
    Reach go(EnteredTriangle t, double sign, double least, bool is_level = false) const {
        const auto differs = [&](double nearness) { return std::abs(nearness - from_.nearness) > from_.level; };
        double entered = 0, nearness_there = from_.nearness;
        for (int step = 0; step < kMaxTriangles; ++step) {
            if (t.is_cut) return Reach::goes_on;
            // The way leaves by one of the two other edges: the one whose ends lie on either side of it.
            const bool is_first =
                (sign * across(place_of(t.c) - from_.at) < 0) == (sign * across(place_of(t.a) - from_.at) < 0);
            const ScreenVertex *const begin = is_first ? t.b : t.c, *const end = is_first ? t.c : t.a;
            const glm::dvec2 to_begin = place_of(begin) - from_.at, edge = place_of(end) - place_of(begin);
            const double area = sign * across(edge);
            if (area == 0) return Reach::narrow;
            const double reached = cross(to_begin, edge) / area;
            if (reached >= least && !is_level) return Reach::goes_on;
            const double on_edge = sign * across(to_begin) / -area;
            const double nearness_reached = glm::mix(nearness_of(begin), nearness_of(end), on_edge);
            const auto nearness_after = [&](double distance) {
                return glm::mix(nearness_there, nearness_reached, (distance - entered) / (reached - entered));
            };
            if (reached >= least) return differs(nearness_after(least)) ? Reach::narrow : Reach::goes_on;
            if (reached < 0) {  // back again: between two edges, for the plane of a thin triangle says nothing
                return differs(nearness_after(0)) ? Reach::comes_back : Reach::narrow;
            }
            if (is_level && differs(nearness_reached)) return Reach::narrow;
            const HalfEdge exit = is_first ? t.second : t.third, beyond = mesh_.partners[exit];
            if (beyond == exit || mesh_.partners[beyond] != exit) return Reach::narrow;
            t = enter(mesh_, beyond);
            entered = reached;
            nearness_there = nearness_reached;
        }
        return Reach::narrow;
    }

    /// Whether there is no fold at an edge of two triangles: the surface goes on at its depth for a distance on both
    /// sides.
    bool goes_over_edge(const EnteredTriangle& one, const EnteredTriangle& two, double distance) const {
        if (one.is_cut || two.is_cut) return false;
        const double own = one.side(),
                     other = cross(place_of(one.b) - place_of(one.a), place_of(two.c) - place_of(one.a));
        if (own * other > 0 || (own == 0 && other == 0)) return false;
        const double out = towards(one, own != 0 ? own : -other);
        return go(one, out, distance, true) == Reach::goes_on && go(two, -out, distance, true) == Reach::goes_on;
    }

    bool is_wide(const EnteredTriangle& t) const {
        return go(t, towards(t, t.side()), kNegligibleFoldSubpixels) != Reach::narrow;
    }

    /// Whether both triangles of an edge, or the only one, go on.
    bool is_fold_wide(const EnteredTriangle& one, const EnteredTriangle* two) const {
        if (!is_wide(one)) return false;
        if (two == nullptr) return true;
        // At a sliver that rounding turned over there is no fold, if the surface goes on past it: rows or columns cross
        // it within its height times the root of two.
        return is_wide(*two) && !goes_over_edge(one, *two, 2 * kNegligibleFoldSubpixels);
    }

  private:
    /// The cross product of the way forwards and another way.
    static double across(glm::dvec2 v) { return along_x ? v.y : -v.x; }

    const ScreenMesh& mesh_;
    const PlaceOnEdge& from_;
};

/// ring_around() along rows or columns. `border`: gets the one at which the cut ends instead, if it is no wider.
template <bool along_x>
Ring ring_along(const ScreenMesh& mesh, HalfEdge half_edge, const PlaceOnEdge& from, HalfEdge& border) {
    const double row = along_x ? from.at.y : from.at.x, place = along_x ? from.at.x : from.at.y;
    const auto vertex = [&](HalfEdge h) { return mesh.vertices + mesh.corners[h]; };
    const auto next_of = [](HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; };
    const auto row_of = [](const ScreenVertex* v) { return static_cast<double>(along_x ? v->y : v->x); };
    const auto place_in_row = [](const ScreenVertex* v) { return static_cast<double>(along_x ? v->x : v->y); };
    // A row crosses two edges of a triangle or none: which ones is told without rounding.
    if ((row_of(vertex(half_edge)) < row) == (row_of(vertex(next_of(half_edge))) < row)) return Ring::none;
    Ring ring = Ring::in_front;
    HalfEdge entry = half_edge;
    for (int step = 0; step < kMostAroundWire; ++step) {
        if (mesh.facing[entry / 3] == off_screen) return Ring::none;
        const HalfEdge second = next_of(entry), third = next_of(second);
        const bool is_second = (row_of(vertex(third)) < row) != (row_of(vertex(second)) < row);
        const HalfEdge exit = is_second ? second : third, beyond = mesh.partners[exit];
        if (beyond != exit && mesh.partners[beyond] != exit) return Ring::none;
        if (beyond == half_edge) return ring;
        const ScreenVertex *const p = vertex(exit), *const q = vertex(next_of(exit));
        const double share = (row - row_of(p)) / (row_of(q) - row_of(p));
        if (std::abs(glm::mix(place_in_row(p), place_in_row(q), share) - place) > kWidestWireSubpixels)
            return Ring::none;
        if (beyond == exit) {
            border = exit;
            return Ring::none;
        }
        const bool may_be_line = (mesh.line_edges[exit / 3] >> exit % 3 & 1) != 0;
        if (may_be_line && glm::mix(nearness_of(p), nearness_of(q), share) > from.nearness + from.level)
            ring = Ring::behind;
        entry = beyond;
    }
    return Ring::none;
}

/// The way goes along rows where the edge is steep, else along columns.
Ring cut_from(const ScreenMesh& mesh, HalfEdge half_edge, const PlaceOnEdge& place, HalfEdge& border) {
    const ScreenVertex &from = mesh.vertices[mesh.corners[half_edge]],
                       &to = mesh.vertices[mesh.corners[half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1]];
    const bool is_steep = std::abs(std::int64_t{to.x} - from.x) < std::abs(std::int64_t{to.y} - from.y);
    return is_steep ? ring_along<true>(mesh, half_edge, place, border)
                    : ring_along<false>(mesh, half_edge, place, border);
}

/// The way of FoldWalk::go() at a right angle to an edge that runs along a row or a column, where it gets nowhere:
/// through triangles that are seen as parts of the edge. The range in which the way is the same, or an empty one.
/// `axis`: 0 if the edge runs along x.
OpenRange range_of_way(const ScreenMesh& mesh, EnteredTriangle t, glm::dvec2 at, int axis) {
    constexpr double kFar = 1e300;
    const double place = at[axis], beside = at[1 - axis];
    OpenRange range{-kFar, kFar};
    for (int step = 0; step < kMaxTriangles; ++step) {
        if (t.is_cut) return {};
        for (const ScreenVertex* const v : {t.a, t.b, t.c}) {
            const glm::dvec2 p = place_of(v);
            if (p[1 - axis] != beside || p[axis] == place) return {};
            (p[axis] < place ? range.low : range.high) =
                p[axis] < place ? std::max(range.low, p[axis]) : std::min(range.high, p[axis]);
        }
        // The way leaves by the edge whose ends lie on either side of it.
        const bool is_first = (place_of(t.c)[axis] < place) == (place_of(t.a)[axis] < place);
        const ScreenVertex *const begin = is_first ? t.b : t.c, *const end = is_first ? t.c : t.a;
        if ((place_of(begin)[axis] < place) == (place_of(end)[axis] < place)) return {};
        const HalfEdge exit = is_first ? t.second : t.third, beyond = mesh.partners[exit];
        if (beyond == exit || mesh.partners[beyond] != exit) return range;
        t = enter(mesh, beyond);
    }
    return range;
}

}  // namespace

Ring ring_around(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness, double level) {
    HalfEdge border = kNoHalfEdge;
    return cut_from(mesh, half_edge, {at, nearness, level}, border);
}

HalfEdge other_side_of_strip(const ScreenMesh& mesh, HalfEdge border, glm::dvec2 at) {
    HalfEdge other = kNoHalfEdge;
    cut_from(mesh, border, {at, 0, 0}, other);
    return other;
}

bool is_fold_wide(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness, double level) {
    const PlaceOnEdge from{at, nearness, level};
    const HalfEdge partner = mesh.partners[half_edge];
    const EnteredTriangle one = enter(mesh, half_edge), other = enter(mesh, partner);
    const EnteredTriangle* const two = partner != half_edge ? &other : nullptr;
    return FoldWalk<true>(mesh, from).is_fold_wide(one, two) || FoldWalk<false>(mesh, from).is_fold_wide(one, two);
}

OpenRange narrow_range(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at) {
    const EnteredTriangle one = enter(mesh, half_edge), other = enter(mesh, mesh.partners[half_edge]);
    const glm::dvec2 along = place_of(one.b) - place_of(one.a);
    if (along.x != 0 && along.y != 0) return {};
    const int axis = along.x != 0 ? 0 : 1;
    // Ways along the edge end at once: the first triangle has no height for them.
    const OpenRange range = range_of_way(mesh, one, at, axis);
    return range.low < range.high ? range : range_of_way(mesh, other, at, axis);
}

}  // namespace burin
