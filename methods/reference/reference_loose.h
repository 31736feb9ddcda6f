#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/reference/boundary_curves.h"
#include "methods/reference/embree_scene.h"

// The truth about edges that no polygon has is found by rays along them.

namespace burin {

/// Lines that no polygon has, for method `reference`: where no ray meets a surface in front of them. Independent of the
/// rasterizers, nothing is snapped.
class ReferenceLooseEdges {
  public:
    /// `wanted`: the classes asked for.
    ReferenceLooseEdges(const RayGeometry& geometry, const EmbreeScene& rays, LineClassSet wanted);

    /// Adds the visible parts within a rectangle of pixels. A ray is cast every `step_px`; where what it sees changes,
    /// the place is narrowed down to 1/4096 pixel.
    void add_visible(glm::dvec2 low, glm::dvec2 high, double step_px, std::vector<BoundarySegment>& segments) const;

  private:
    /// In pixels; nearness is affine along it.
    struct Line {
        glm::dvec2 a, b;
        double nearness_a, nearness_b;
    };
    double distance_at(const Line& line, double share) const;
    bool is_visible(const Line& line, double share) const;

    const RayGeometry& geometry_;
    const EmbreeScene& rays_;
    std::vector<Line> lines_;
};

}  // namespace burin
