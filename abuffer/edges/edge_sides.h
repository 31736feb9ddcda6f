#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "abuffer/screen/screen_surfaces.h"
#include "lines/line_decision.h"

// Whether an edge is a contour depends on which side of it its triangles lie, as the eye sees them.

namespace burin {

/// Vertices of a half-edge, and of its triangle the third one.
inline std::uint32_t start_of(const Mesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][h % 3]; }
inline std::uint32_t end_of(const Mesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][(h + 1) % 3]; }
inline std::uint32_t apex_of(const Mesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][(h + 2) % 3]; }

/// What the eye sees on either side of a mesh's edges: which triangle counts there where some are so thin that their
/// normals say nothing, and which way it lies.
class EdgeSides {
  public:
    EdgeSides(const ScreenSurfaces& screen, const LineCriteria& criteria)
        : surfaces_(screen.surfaces()), screen_(screen), criteria_(criteria) {}

    /// The sides of the two triangles of most edges, as side_at() tells them: where neither is thin or off the screen,
    /// each counts on its side, and neither is a wall to the other.
    struct PlainPair {
        bool is_plain = false;
        int side_h = 0, side_g = 0;  ///< from the start of `h` to its end
    };
    PlainPair plain_pair(std::uint32_t instance, HalfEdge h, HalfEdge g) const;
    /// The triangle that counts at an edge: behind thin triangles the next one. kNoHalfEdge at a thin
    /// triangle's longest edge, if the two others stand for it: they do not where what lies behind faces alike.
    HalfEdge solid_behind(std::uint32_t instance, HalfEdge h) const;
    /// The side of the triangle at `h`, with its edge taken in the direction of a to b.
    int side_at(std::uint32_t instance, HalfEdge h, std::uint32_t a, std::uint32_t b) const;
    /// Whether the surface ends for the eye at half-edge h, with a wall beyond it that is seen edge-on: where it goes
    /// on behind the wall, that lies deeper, or turns back.
    bool ends_at_wall(std::uint32_t instance, HalfEdge h, HalfEdge beyond) const;
    /// Whether an edge, so short that its middle stands for all of it, is the rim of a fold too narrow for a contour.
    bool is_negligible_fold(std::uint32_t instance, HalfEdge h) const;
    /// Whether an edge of two triangles is the one in front of a wire (ring_around()).
    bool is_front_of_wire(std::uint32_t instance, HalfEdge h) const;
    /// The half-edge that counts at a border: itself, or that of the triangle behind its sliver, whose normal says
    /// nothing. There is none at a needle that stands by itself or on an edge of others, which is no surface.
    std::optional<HalfEdge> past_sliver(std::uint32_t instance, HalfEdge h) const;
    /// Whether two half-edges' triangles are one, or meet at an edge.
    bool are_neighbours(std::uint32_t instance, HalfEdge h, HalfEdge g) const;
    /// A sliver on an edge where two surfaces or more meet without it: nothing ends at its borders.
    bool is_needle_on_edge(SurfaceId s, HalfEdge h) const;
    /// Whether the triangle of a half-edge is a sliver. Most are none in any view, which is told at once.
    bool is_sliver_at(SurfaceId s, HalfEdge h) const;
    /// The unit vector from an edge into its triangle, in view space.
    glm::dvec3 across_edge(std::uint32_t instance, HalfEdge h) const;
    /// The cosine of the angle at an edge between its triangle and the way to the eye: of several triangles on one
    /// side, the one with the greatest is in front.
    double cosine_to_eye(std::uint32_t instance, HalfEdge h) const;

  private:
    /// The longest edge of a triangle that is lower than a negligible fold; of others, kNoHalfEdge: an optional would
    /// be returned through memory, in parts that its reader waits for.
    HalfEdge base_of_thin(SurfaceId s) const;
    bool is_thin_at(std::uint32_t instance, HalfEdge h) const { return base_of_thin({instance, h / 3}) != kNoHalfEdge; }
    /// Whether a vertex is nearer to a long edge than a negligible fold is wide.
    bool is_beside(std::uint32_t instance, HalfEdge edge, std::uint32_t vertex) const;
    /// Whether a thin triangle is on the other side of its edge than the surface behind it, as of a wall that leans
    /// back.
    bool is_turned_over(std::uint32_t instance, HalfEdge h) const;
    HalfEdge longer_of_others(std::uint32_t instance, HalfEdge h) const;
    /// Whether the triangles of two half-edges of one edge face the eye alike, whichever way they are wound.
    bool face_alike(std::uint32_t instance, HalfEdge h, HalfEdge g) const;

    const SurfaceSet& surfaces_;
    const ScreenSurfaces& screen_;
    const LineCriteria& criteria_;
};

}  // namespace burin
