#include "abuffer/edges/level_walk.h"

#include <algorithm>
#include <cmath>

#include "lines/surface_walk.h"

namespace burin {
namespace {

/// What is nearer to a limit than this may be on its other side by rounding, as long as places are within
/// kFarthestPlace of the origin and edges are at most kMostAlongPerSide times as long along the way as across it. 1/256
/// pixel.
constexpr double kMargin = 1.0 / 16;
constexpr double kFarthestPlace = to_subpixels(8192.0);
constexpr double kMostAlongPerSide = 256;
/// Depths are compared where it gets no farther than by kSnappingPx.
constexpr double kSnappingSubpixels = to_subpixels(kSnappingPx);
/// Surely less than depth_tolerance(), which is kDepthTolerancePx or more.
constexpr double kSurelyLevelPx = 0.75 * kDepthTolerancePx;
/// What rounding may do to nearness, and to the share of an edge where the way crosses it.
constexpr double kNearnessRounding = 0x1p-22, kShareRounding = 0x1p-10;
constexpr int kMostSteps = 24;

/// Steps from triangle to triangle, each with one new corner.
class LevelWalk {
  public:
    LevelWalk(const ScreenMesh& mesh, glm::dvec2 from, glm::dvec2 out) : mesh_(mesh), from_(from), out_(out) {}

    struct Corner {
        std::uint32_t vertex;
        double nearness, side, along;  ///< to the left or right of the way, and along it
    };
    /// An edge where the way leaves a triangle; kNoHalfEdge where that is not told.
    struct Exit {
        HalfEdge half_edge = kNoHalfEdge;
        Corner ends[2];
        double reached = 0, lowest = 0, highest = 0;  ///< nearness there
    };

    Exit at_edge(HalfEdge h) const { return exit_at(h, corner(mesh_.corners[h]), corner(mesh_.corners[next(h)])); }

    /// Goes through the triangle of a half-edge, from an edge with the same ends.
    Exit through(HalfEdge entry, const Exit& from) const {
        const HalfEdge second = next(entry), third = next(second);
        const std::size_t first = mesh_.corners[entry] == from.ends[0].vertex ? 0 : 1;
        const Corner &start = from.ends[first], &end = from.ends[1 - first];
        if (mesh_.corners[entry] != start.vertex || mesh_.corners[second] != end.vertex) return {};
        const std::uint32_t vertex = mesh_.corners[third];
        if (mesh_.vertices[vertex].x == ScreenVertex::kOffScreen) return {};
        const Corner apex = corner(vertex);
        const bool leaves_by_second = (apex.side < 0) == (start.side < 0);
        const Corner& kept = leaves_by_second ? end : start;
        if (std::abs(apex.side) < kMargin) return {};
        return exit_at(leaves_by_second ? second : third, kept, apex);
    }

  private:
    static HalfEdge next(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }

    static Exit exit_at(HalfEdge h, const Corner& a, const Corner& b) {
        const double across = b.side - a.side, along = b.along - a.along, share = -a.side / across;
        if (std::abs(along) > kMostAlongPerSide * std::abs(across)) return {};
        const double step = b.nearness - a.nearness, nearness = a.nearness + share * step,
                     rounding = kShareRounding * std::abs(step);
        return {h, {a, b}, a.along + share * along, nearness - rounding, nearness + rounding};
    }

    Corner corner(std::uint32_t vertex) const {
        const ScreenVertex& v = mesh_.vertices[vertex];
        const glm::dvec2 way = glm::dvec2(v.x, v.y) - from_;
        return {vertex, static_cast<double>(v.nearness), out_.x * way.y - out_.y * way.x, glm::dot(out_, way)};
    }

    const ScreenMesh& mesh_;
    glm::dvec2 from_, out_;
};

}  // namespace

bool surely_goes_on(const ScreenSurfaces& screen, std::uint32_t instance, HalfEdge h, glm::dvec2 from, glm::dvec2 out,
                    double distance) {
    if (std::abs(from.x) > kFarthestPlace || std::abs(from.y) > kFarthestPlace) return false;
    const ScreenMesh& mesh = screen.mesh(instance);
    const LevelWalk walk(mesh, from, out);
    LevelWalk::Exit exit = walk.at_edge(h);
    if (exit.half_edge == kNoHalfEdge || std::abs(exit.ends[0].side) < kMargin) return false;
    // The walk comes from the triangle itself.
    const LevelWalk::Exit own = walk.through(h, exit);
    if (own.half_edge == kNoHalfEdge || own.reached > -kMargin) return false;
    const SurfaceSet& surfaces = screen.surfaces();
    const auto are_level = [&](double low, double high) {
        const double scale = surfaces.projection.orthographic ? 1 : surfaces.farthest_nearness + low;
        return high - low <= kSurelyLevelPx / surfaces.projection.focal_px * scale -
                                 kNearnessRounding * (std::abs(low) + std::abs(high));
    };
    // The range of nearness since the walk last surely got farther: only what lies within it is compared in depth.
    double lowest = exit.lowest, highest = exit.highest, farthest = 0;
    bool is_one = true;
    for (int step = 0; step < kMostSteps; ++step) {
        const HalfEdge entry = mesh.partners[exit.half_edge];
        if (entry == exit.half_edge || mesh.partners[entry] != exit.half_edge) return false;
        const LevelWalk::Exit before = exit;
        exit = walk.through(entry, before);
        if (exit.half_edge == kNoHalfEdge || exit.reached < farthest - kNegligibleFoldSubpixels + kMargin) return false;
        const bool is_clear = exit.reached > farthest + kSnappingSubpixels + kMargin;
        const double share = is_clear ? (farthest + kMargin - before.reached) / (exit.reached - before.reached) : 1;
        lowest = std::min(lowest, glm::mix(before.lowest, exit.lowest, share));
        highest = std::max(highest, glm::mix(before.highest, exit.highest, share));
        if (!(is_one && is_clear) && !are_level(lowest, highest)) return false;
        if (exit.reached > distance - kMargin) return exit.reached > distance + kMargin;
        is_one = exit.reached > farthest + kMargin;
        if (is_one) {
            lowest = exit.lowest;
            highest = exit.highest;
        }
        farthest = std::max(farthest, exit.reached);
    }
    return false;
}

}  // namespace burin
