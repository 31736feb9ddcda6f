#include "methods/abuffer/layers/fold_width.h"

#include <cmath>

namespace burin {
namespace {

/// Folds that turn back by less are no contours (docs/conventions.md). 1/64 pixel.
constexpr double kNegligibleFoldSubpixels = 4;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// A place on an edge, in 1/256 pixel. Nearness that differs by at most `level` is one.
struct PlaceOnEdge {
    glm::dvec2 at;
    double nearness, level;
};

enum class Reach { narrow, comes_back, goes_on };

class FoldWalk {
  public:
    explicit FoldWalk(const ScreenMesh& mesh) : mesh_(mesh) {}

    HalfEdge partner(HalfEdge h) const { return mesh_.partners[h]; }
    bool is_cut(HalfEdge h) const { return mesh_.facing[h / 3] == off_screen; }

    /// On which side of its edge a triangle lies, with the edge taken as it runs in the triangle of `as_in`: < 0, > 0, or 0.
    double side_of(HalfEdge h, HalfEdge as_in) const {
        const glm::dvec2 a = corner(as_in, 0);
        return cross(corner(as_in, 1) - a, corner(h, 2) - a);
    }
    /// The way or its opposite, whichever leads to a side of an edge.
    glm::dvec2 towards(HalfEdge h, double side, glm::dvec2 way) const {
        return (cross(corner(h, 1) - corner(h, 0), way) < 0) != (side < 0) ? -way : way;
    }

    /// How far the surface goes on into the triangle of an edge: comes_back is to the edge, at another nearness. `is_level`: and
    /// stays at its nearness.
    Reach go(HalfEdge entry, const PlaceOnEdge& from, glm::dvec2 way, double least, bool is_level = false) const {
        constexpr int kMaxTriangles = 64;
        const auto differs = [&](double nearness) { return std::abs(nearness - from.nearness) > from.level; };
        double entered = 0, nearness_there = from.nearness;
        for (int step = 0; step < kMaxTriangles; ++step) {
            if (is_cut(entry)) return Reach::goes_on;  // it has no corners to go by
            // Out by one of the two other edges: the one whose ends lie on either side of the way.
            const bool is_first = (cross(way, corner(entry, 2) - from.at) < 0) == (cross(way, corner(entry, 0) - from.at) < 0);
            const std::uint32_t k = is_first ? 1 : 2;
            const glm::dvec2 a = corner(entry, k), edge = corner(entry, (k + 1) % 3) - a;
            const double area = cross(way, edge);
            if (area == 0) return Reach::narrow;
            const double reached = cross(a - from.at, edge) / area;
            if (reached >= least && !is_level) return Reach::goes_on;
            const double on_edge = cross(from.at - a, way) / cross(edge, way);
            const double nearness_reached = glm::mix(static_cast<double>(vertex(entry, k).nearness),
                                                     static_cast<double>(vertex(entry, (k + 1) % 3).nearness), on_edge);
            const auto nearness_after = [&](double distance) {
                return glm::mix(nearness_there, nearness_reached, (distance - entered) / (reached - entered));
            };
            if (reached >= least) return differs(nearness_after(least)) ? Reach::narrow : Reach::goes_on;
            if (reached < 0) {  // back again: between two edges, for the plane of a thin triangle says nothing
                return differs(nearness_after(0)) ? Reach::comes_back : Reach::narrow;
            }
            if (is_level && differs(nearness_reached)) return Reach::narrow;
            const HalfEdge exit = entry - entry % 3 + (entry + k) % 3;
            if (partner(exit) == exit || partner(partner(exit)) != exit) return Reach::narrow;
            entry = partner(exit);
            entered = reached;
            nearness_there = nearness_reached;
        }
        return Reach::narrow;
    }

  private:
    const ScreenVertex& vertex(HalfEdge h, std::uint32_t k) const { return mesh_.vertices[mesh_.corners[h - h % 3 + (h + k) % 3]]; }
    glm::dvec2 corner(HalfEdge h, std::uint32_t k) const { return {vertex(h, k).x, vertex(h, k).y}; }

    const ScreenMesh& mesh_;
};

/// Whether there is no fold at an edge: the surface goes on at its depth for a distance on both sides, along `way` and against it.
bool goes_over_edge(const FoldWalk& walk, HalfEdge h, const PlaceOnEdge& from, glm::dvec2 way, double distance) {
    const HalfEdge partner = walk.partner(h);
    if (partner == h || walk.is_cut(h) || walk.is_cut(partner)) return false;
    const double own = walk.side_of(h, h), other = walk.side_of(partner, h);
    if (own * other > 0 || (own == 0 && other == 0)) return false;
    const glm::dvec2 out = walk.towards(h, own != 0 ? own : -other, way);
    return walk.go(h, from, out, distance, true) == Reach::goes_on && walk.go(partner, from, -out, distance, true) == Reach::goes_on;
}

}  // namespace

bool is_fold_wide(const ScreenMesh& mesh, HalfEdge half_edge, glm::dvec2 at, double nearness, double level) {
    const FoldWalk walk(mesh);
    const PlaceOnEdge from{at, nearness, level};
    const HalfEdge partner = walk.partner(half_edge);
    for (const glm::dvec2 way : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
        const auto is_wide = [&](HalfEdge h) {
            return walk.go(h, from, walk.towards(h, walk.side_of(h, h), way), kNegligibleFoldSubpixels) != Reach::narrow;
        };
        if (!is_wide(half_edge) || (partner != half_edge && !is_wide(partner))) continue;
        // At a sliver that rounding turned over there is no fold, if the surface goes on past it: rows or columns cross it within
        // its height times the root of two.
        if (!goes_over_edge(walk, half_edge, from, way, 2 * kNegligibleFoldSubpixels)) return true;
    }
    return false;
}

}  // namespace burin
