#pragma once

#include <cstdint>
#include <vector>

#include "methods/polygon_outlines.h"
#include "render/frame.h"

// Methods that draw mesh edges ask here which edges are lines in a view, and of which classes.

namespace burin {

/// The classes that an edge of a mesh can have by itself. Where surfaces of different objects meet or
/// pass through each other there need not be an edge.
constexpr LineClassSet kEdgeClasses = LineClassSet(LineClass::mark) | LineClass::border | LineClass::silhouette |
                                      LineClass::material | LineClass::crease | LineClass::polygon;

/// FeatureEdges says which edges of the polygons of a frame are lines in this view, for methods that draw mesh edges.
///
/// mark, material, crease and polygon are those of edge_classes(); across a seam of two patches
/// that are not stitched they are those of the contact. border: one polygon, and no other patch goes
/// on there. silhouette: a contour edge, whose polygons face apart, one towards the eye and one away.
///
/// A polygon faces the eye if the volume of the pyramid from the eye to it says so, so contours of a
/// closed mesh are closed loops of edges also where polygons are not flat. A sliver, whose
/// facing is a matter of rounding, faces as its neighbour across its longest edge.
class FeatureEdges {
  public:
    FeatureEdges(const Frame& frame, int threads);

    /// The requested classes that the edge `half_edge` (0, 1, 2) of a triangle has. Empty for diagonals within a
    /// polygon.
    LineClassSet classes(SurfaceId s, HalfEdge half_edge) const {
        return classes_[s.instance][3 * std::size_t{s.triangle} + half_edge];
    }
    /// What the line along the edge is called, if it is one.
    std::optional<LineClass> drawn(SurfaceId s, HalfEdge half_edge) const { return classes(s, half_edge).first(); }
    const PolygonOutlines& outlines(std::uint32_t instance) const { return outlines_[outlines_of_instance_[instance]]; }

  private:
    std::vector<std::vector<LineClassSet>> classes_;  // per instance and half-edge
    std::vector<PolygonOutlines> outlines_;           // one per mesh that is used
    std::vector<std::size_t> outlines_of_instance_;
};

}  // namespace burin
