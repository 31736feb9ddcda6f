#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "lines/line_class.h"

// Crossings on the sides of cells between samples become boundary segments.

namespace burin {

/// No class asked for: a boundary that is not drawn, but may hide strokes.
constexpr std::uint8_t kUndrawn = kLineClassCount;

/// A piece of a visible boundary, in pixels.
struct BoundarySegment {
    glm::dvec2 a{0.0}, b{0.0};
    double depth_a = 0, depth_b = 0;  ///< in pixel widths, see RayGeometry::depth_px
    std::uint8_t line_class = kUndrawn;
    /// Where the surface in front is: on the side of cross(b - a, p - a) > 0 (1) or < 0 (-1);
    /// 0: the line lies on a surface, or between surfaces in contact.
    std::int8_t front_side = 0;
};

/// Where a line crosses a side of a cell between samples.
struct SideCrossing {
    glm::dvec2 at{0.0};
    glm::dvec2 front{0.0};  ///< the sample on the surface in front
    double depth_px = 0;
    std::uint8_t line_class = kUndrawn;
    bool occludes = false;
};

/// Collects boundary curves from cells of four samples, by marching squares with exact crossings
/// (Lorensen and Cline 1987, in two dimensions).
class BoundaryCurves {
  public:
    using Node = std::uint32_t;
    static constexpr Node kNone = 0xFFFFFFFFu;

    Node add_crossing(const SideCrossing& crossing);
    /// The crossings on the sides of a cell, clockwise from the top (kNone: none), and whether its
    /// samples at the top left and bottom right, or at the top right and bottom left, see one surface.
    void add_cell(const std::array<Node, 4>& sides, glm::dvec2 middle, bool falling_joined, bool rising_joined);
    /// All curves, with pieces joined while they are straight within `tolerance_px`, and with the corners
    /// that lie inside of cells of side `cell_px`.
    std::vector<BoundarySegment> segments(double tolerance_px, double cell_px) const;

  private:
    struct Edge {
        Node from = 0, to = 0;
        double depth_from = 0, depth_to = 0;
        std::uint8_t line_class = kUndrawn;
        std::int8_t front_side = 0;
    };
    struct NodeData {
        SideCrossing crossing;
        std::array<std::uint32_t, 2> edges{kNone, kNone};
        std::uint32_t degree = 0;
        bool is_junction = false;
    };
    Node add_junction(glm::dvec2 at, double depth_px);
    void add_edge(Node from, Node to, Node like);
    void connect(Node a, Node b);
    void add_tee(const std::array<Node, 3>& nodes, glm::dvec2 middle);
    bool can_pass(Node node) const;

    std::vector<NodeData> nodes_;
    std::vector<Edge> edges_;
};

}  // namespace burin
