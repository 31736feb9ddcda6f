#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "methods/feature_edges.h"

// A polygon of the scene becomes a polygon on the screen with its edges and depths, for methods that stand for graphics
// hardware.

namespace burin {

/// The depth of z-buffers: 0 at `near_distance` from the eye, 1 at `far_distance`, and affine on the
/// screen over a plane, as projection matrices make it: z = a + b / distance in perspective,
/// a + b * distance in an orthographic view.
struct DepthRange {
    bool orthographic = false;
    double a = 0;
    double b = 1;

    static DepthRange between(double near_distance, double far_distance, bool orthographic);
    /// Fitted to all vertices of the frame that lie in front of its near plane, a little wider.
    static DepthRange fitted(const Frame& frame);

    double z(double distance) const { return orthographic ? a + b * distance : a + b / distance; }
    double distance(double z_value) const { return orthographic ? (z_value - a) / b : b / (z_value - a); }
};

/// A corner on the screen. Nothing is snapped.
struct ProjectedCorner {
    glm::dvec2 pixel{0.0};
    double z = 0;         ///< see DepthRange
    double distance = 0;  ///< from the eye along the view axis
};

/// An edge of a polygon's outline, or what the near plane leaves of it. It runs from the vertex
/// with the smaller number to the larger one, whatever polygon it is seen from, and its ends are the
/// same to the bit from both sides.
struct ProjectedEdge {
    ProjectedCorner from, to;
    HalfEdge half_edge = kNoHalfEdge;  ///< of the mesh
    bool runs_with_outline = true;     ///< false: the polygon's outline runs from `to` to `from`
    LineClassSet classes;              ///< requested classes that it has
};

/// A part of a triangle of a polygon: the near plane makes up to two of a triangle.
struct ProjectedTriangle {
    std::array<ProjectedCorner, 3> corners;
    SurfaceId surface;
};

/// A polygon as it falls on the screen, cut off at the near plane.
struct ProjectedPolygon {
    std::uint32_t instance = 0;
    std::uint32_t polygon = 0;
    /// In the order of the outline. An edge wholly behind the near plane is missing; that the polygon
    /// is cut off there makes no edge.
    std::vector<ProjectedEdge> edges;
    std::vector<ProjectedTriangle> triangles;

    bool is_empty() const { return triangles.empty(); }
};

/// Projects polygon `polygon` of an instance into `result`, whose memory is used again.
void project_polygon(const Frame& frame, const FeatureEdges& features, const DepthRange& depth, std::uint32_t instance,
                     std::uint32_t polygon, ProjectedPolygon& result);

}  // namespace burin
