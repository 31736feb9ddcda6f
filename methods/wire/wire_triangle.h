#pragma once

#include <vector>

#include "methods/feature_edges.h"
#include "methods/wire/edge_distance.h"
#include "methods/wire/wire_edge.h"
#include "view/depth_plane.h"
#include "view/screen_polygon.h"

// A triangle knows the edges of its polygon that pixels measure their distances to.

namespace burin {

/// How distances to edges are found (see the enumerations).
struct EdgeRules {
    WirePath path = WirePath::linear;
    WireExclude exclude = WireExclude::polygon;
    double q_px = 100;
    bool dotted_diagonals = false;
};

/// The edges that a triangle measures its pixels' distances to.
class WireTriangle {
  public:
    struct Channel {
        WireEdge edge;
        EdgeChannel at_corners{0.0};  ///< signed distances of the corners, for interpolation
        int own_edge = -1;            ///< opposite of this corner of the triangle; -1: another's
        bool is_dotted = false;
    };

    WireTriangle(const Frame& frame, const FeatureEdges& features, const EdgeRules& rules)
        : frame_(frame), features_(features), rules_(rules) {}

    /// Edges that come nowhere nearer than `reach_px` to the rectangle are left out. Triangles of
    /// one polygon share its edges if they come one after the other, for the same rectangle.
    void load(SurfaceId surface, PixelRect rect, double reach_px);

    const ScreenPolygon& polygon() const { return polygon_; }
    const DepthPlane& plane() const { return plane_; }
    bool has_edges() const { return !channels_.empty(); }

    /// Calls visit(channel, distance) for each edge, `at` in the triangle.
    template <typename Visit>
    void for_each_distance(glm::dvec2 at, const Visit& visit) const;

  private:
    bool is_whole() const { return !(behind_[0] || behind_[1] || behind_[2]); }
    void load_own_edges();
    /// What a line is called that its edge does not have a class for: polygon, if asked for, else the last class asked
    /// for.
    LineClass stray_class() const;
    void load_polygon_edges(PixelRect rect, double reach_px);
    void add(const WireEdge& edge, int own_edge, bool is_dotted);

    const Frame& frame_;
    const FeatureEdges& features_;
    EdgeRules rules_;

    SurfaceId surface_;
    ScreenPolygon polygon_;
    DepthPlane plane_;
    glm::dvec2 p_[3];  // mirrored for corners behind the eye
    glm::dvec3 w_{1.0};
    bool behind_[3] = {};
    std::vector<Channel> channels_;

    // The edges of the last polygon that come near the rectangle.
    SurfaceId edges_of_;  // its instance and, as triangle, its polygon
    std::vector<WireEdge> polygon_edges_;
};

template <typename Visit>
void WireTriangle::for_each_distance(glm::dvec2 at, const Visit& visit) const {
    // Whatever cannot be interpolated over the triangle as it is takes the homogeneous form.
    const bool by_lines = rules_.path == WirePath::homogeneous || !is_whole();
    const bool by_cases = rules_.path == WirePath::cases && !is_whole();
    const glm::dvec3 lambda = by_lines ? glm::dvec3(0.0) : barycentric(p_, at);
    const glm::dvec3 by_case = by_cases ? solid_wireframe_distances(p_, behind_, at) : glm::dvec3(0.0);
    for (const Channel& c : channels_) {
        double distance;
        if (by_cases && c.own_edge >= 0) {
            distance = by_case[c.own_edge];
        } else if (by_lines) {
            distance = signed_distance(c.edge.line, at);
        } else if (rules_.path == WirePath::premultiplied) {
            distance = premultiplied_distance(c.at_corners, w_, lambda);
        } else {
            distance = linear_distance(c.at_corners, lambda);
        }
        visit(c, std::abs(distance));
    }
}

}  // namespace burin
