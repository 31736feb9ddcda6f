#pragma once

#include "lines/line_decision.h"
#include "methods/abuffer/screen_surfaces.h"

namespace burin {

/// Two samples next to each other, in 1/256 pixel, and the numbers of their surfaces.
struct NeighbourSamples {
    std::int32_t x, y;  ///< the left or upper one
    std::int32_t pitch;
    bool down;          ///< the second one lies below, else to the right
    std::uint32_t first, second;
};

/// decide_line() for the ordinary case, ten times as fast: surfaces on the screen, edges of two
/// triangles or of one, no slivers, no contact. Walks are along a row or a column of samples, over vertices
/// that are snapped already, so that sides are integer comparisons.
class FastDecision {
  public:
    FastDecision(const ScreenSurfaces& screen, const LineCriteria& criteria)
        : screen_(screen), surfaces_(screen.surfaces()), criteria_(criteria) {}

    static constexpr std::uint32_t kNoSurface = 0xFFFFFFFFu;

    /// False where the case is not ordinary; then `decision` means nothing. Otherwise `decision` is
    /// what decide_line() says, as far as classes asked for go, and `nearness` that of the line.
    bool decide(const NeighbourSamples& pair, LineDecision& decision, double& nearness) const;

  private:
    struct Walk {
        enum End { arrived, fold, border, unsure } end = unsure;
        std::uint32_t triangle = 0;      // of the instance
        HalfEdge half_edge = kNoHalfEdge;  // of the fold or border
        double fraction = 1;
        LineClassSet crossed;
        HalfEdge crossed_edge = kNoHalfEdge;
        double crossed_fraction = 0.5;
        double crease_cosine = 1;
    };
    /// Whether only triangles that face as the first one, and edges that are no lines, lie between.
    bool is_smooth(const NeighbourSamples& pair) const;
    Walk walk(const NeighbourSamples& pair, bool backwards, double goal) const;
    LineClassSet classes_at_end(const Walk& walk, std::uint32_t instance, double& crease_cosine) const;
    bool is_level(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const;
    bool has_seam(std::uint32_t instance, HalfEdge border, double along) const;
    double nearness_at(SurfaceId s, double x, double y) const;

    const ScreenSurfaces& screen_;
    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
};

}  // namespace burin
