#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lines/line_class.h"
#include "view/surface_set.h"

// Distances to an edge on the screen decide how dark a pixel is.

namespace burin {

/// An edge of a mesh on the screen, in pixels. Its corners are snapped where surfaces' are, so that
/// distances to it and the pixels of the surfaces beside it fit.
///
/// `from` is the vertex with the smaller number, whatever polygon the edge is seen from: patterns
/// run the same way on both sides. What lies behind the near plane is cut off.
struct WireEdge {
    glm::dvec2 from{0.0}, to{0.0};
    double from_nearness = 0, to_nearness = 0;  ///< see Projection
    double from_part = 0, to_part = 1;          ///< where on the whole edge the ends lie, in space
    glm::dvec3 line{0.0};                       ///< see line_through(); zero for an edge that is seen as a point
    LineClass line_class = LineClass::polygon;

    double length_px() const { return glm::distance(from, to); }
    /// Nearness `along` pixels from the start; that of the ends beyond them.
    double nearness(double along) const {
        const double length = length_px();
        const double part = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
        return from_nearness + (to_nearness - from_nearness) * part;
    }
};

/// A view position as (x w, y w, w), in pixels: snapped if that is possible.
glm::dvec3 homogeneous_position(const Projection& projection, const glm::dvec3& view);

/// Projects an edge of a mesh; nothing if it lies wholly behind the near plane.
std::optional<WireEdge> wire_edge(const SurfaceSet& surfaces, std::uint32_t instance, HalfEdge half_edge,
                                  LineClass line_class);

}  // namespace burin
