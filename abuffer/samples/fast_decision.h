#pragma once

#include "abuffer/samples/fast_walk.h"
#include "lines/line_decision.h"

// Pairs of samples are decided on snapped vertices, which answers nearly all of them.

namespace burin {

/// decide_line() for all but rare cases, ten times as fast: surfaces on the screen, edges of two triangles or of
/// one, where at least one surface ends or both are one.
class FastDecision {
  public:
    FastDecision(const ScreenSurfaces& screen, const LineCriteria& criteria)
        : screen_(screen), surfaces_(screen.surfaces()), criteria_(criteria), walker_(screen, criteria) {
        const Projection& p = surfaces_.projection;
        const double deep = kDepthTolerancePx / p.focal_px;
        level_ = static_cast<float>(deep * (p.orthographic ? 1.0 : surfaces_.farthest_nearness));
        level_per_nearness_ = p.orthographic ? 0.0f : static_cast<float>(deep);
    }

    /// Whether only triangles that face as the first one, and edges that are no lines, lie between. This
    /// settles most pairs.
    bool is_smooth(const NeighbourSamples& pair) const;

    /// The limits for many pairs at once, TileKernels::Walk::find_smooth().
    SmoothLimits smooth_limits() const { return {level_, level_per_nearness_, to_subpixels(kSnappingPx)}; }

    /// Decides a pair that is not known to be smooth. Returns false where the case is not ordinary; then `decision`
    /// means nothing. Otherwise `decision` is what decide_line() says, as far as classes asked for go, and `nearness`
    /// that of the line.
    bool decide(const NeighbourSamples& pair, LineDecision& decision, double& nearness, const KnownWalks& known = {});

    FastWalker& walker() { return walker_; }

  private:
    /// How the surface that ends lies to the other one.
    struct End {
        double gap;                         // how much farther the other one is there
        double tolerance, certainly_apart;  // depth_tolerance()
        double nearness;                    // of the surface that ends
        SurfaceId behind;                   // the other one's triangle
    };
    End look_behind(const NeighbourSamples& pair, int i) const;
    void end_of_surface(const NeighbourSamples& pair, int i, const FastWalk& walk, const End* touched,
                        LineDecision& decision);
    void end_at_sample(const NeighbourSamples& pair);
    double nearness_at(SurfaceId s, glm::dvec2 subpixel) const;
    bool may_be_wall(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) const;
    bool are_beside(SurfaceId a, SurfaceId b) const;
    bool may_be_flush(const NeighbourSamples& pair, int ends) const;

    const ScreenSurfaces& screen_;
    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    FastWalker walker_;
    FastWalk made_[2], made_beyond_;
    const FastWalk* walks_[2];          // from either sample
    float level_, level_per_nearness_;  // nearness changes by this where distance does by kDepthTolerancePx
};

}  // namespace burin
