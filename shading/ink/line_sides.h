#pragma once

#include <glm/glm.hpp>
#include <span>

#include "lines/line_piece.h"
#include "view/surface_numbers.h"
#include "view/surface_set.h"

namespace burin {

/// What is on the two sides of a piece of a line. The front side is the surface that ends there: of the two faces of a
/// fold, the one that is seen. Where the line lies on surfaces, it is the face that turns to the eye more (of equal
/// ones, the first by object, then polygon).
/// docs/shading/variables.md says for each class what the sides are. No mesh is needed to read it.
struct LineSides {
    std::uint32_t front_object = 0, other_object = 0;      ///< from 1; 0: background. A loose edge has one, too.
    std::uint32_t front_material = 0, other_material = 0;  ///< from 1; 0: none
    bool is_beyond = false;  ///< the other side is seen behind the line; else it touches the line
    std::int8_t convex = 0;  ///< 1: the edge sticks out, -1: it goes inwards, 0: neither, or no edge of two polygons
    float dihedral_deg = 0;  ///< between the normals of the two polygons of an edge, 0 = flat
    /// Unit normals of both sides at the ends of the piece, in view space, towards the eye; 0: none, or not asked for.
    glm::vec3 front_normals[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    glm::vec3 other_normals[2] = {glm::vec3(0.0f), glm::vec3(0.0f)};
    DepthPlane front_plane, beyond_plane;  ///< of the surfaces; of what is not there, all is 0
};

/// Where the front side of a piece is on the mesh.
struct FrontFace {
    SurfaceId surface;                 ///< background: nothing is there
    HalfEdge half_edge = kNoHalfEdge;  ///< of that triangle, which the line is; none: it lies on the triangle
};

/// LineSidesFinder says what is on the two sides of pieces, from the meshes. It may be used by several threads.
class LineSidesFinder {
  public:
    /// `cos_crease_angle`: surfaces are smooth over edges that turn by less.
    LineSidesFinder(const SurfaceSet& surfaces, double cos_crease_angle)
        : surfaces_(surfaces), numbers_(surfaces), cos_crease_angle_(cos_crease_angle) {}

    /// `has_normals`: whether normals are asked for; else they stay 0.
    /// `front`: gets where the front side is, unless it is nullptr.
    LineSides sides_of(const LinePiece& piece, bool has_normals, FrontFace* front = nullptr) const;

  private:
    /// A face at an edge: a half-edge of it.
    struct Face {
        HalfEdge half_edge = kNoHalfEdge;
        SurfaceId surface;
        double facing = -1;
    };
    /// The surfaces at both sides; kBackground: nothing.
    struct Surfaces {
        SurfaceId front, other;
        HalfEdge front_edge = kNoHalfEdge;
    };
    Surfaces at_edge(const LinePiece& piece, LineSides& sides, bool has_normals) const;
    Surfaces at_meeting(const LinePiece& piece) const;
    bool covers(const LinePiece& piece, const Face& a, const Face& b) const;
    void add_fold(const LinePiece& piece, const Face& a, const Face& b, LineSides& sides) const;
    void add_smooth_normals(const LinePiece& piece, HalfEdge h, SurfaceId front, bool is_contour,
                            LineSides& sides) const;
    void set_flat_normals(const LinePiece& piece, const Surfaces& surfaces, LineSides& sides) const;
    double facing(SurfaceId s, glm::dvec2 place) const;
    glm::dvec3 to_eye(const LinePiece& piece, int end) const;

    const SurfaceSet& surfaces_;
    SurfaceNumbers numbers_;
    double cos_crease_angle_;
};

}  // namespace burin
