#pragma once

#include <array>
#include <optional>
#include <vector>

#include "lines/corner_normals.h"
#include "lines/line_segment.h"
#include "lines/surface_set.h"

namespace burin {

/// Contours of smooth surfaces: where normals, interpolated between vertices, are across the line of
/// sight (Hertzmann and Zorin 2000), instead of along the edges at which triangles turn away, which is a
/// zigzag with hooks.
///
/// The mesh still decides which parts are visible: every visible piece of an edge where a smooth surface
/// folds is moved to the nearest points of the smooth contour on the triangles around it. So what is
/// hidden stays hidden, a hook falls onto the contour that it hangs on, and no line is drawn
/// twice. Edges with another reason to be a line stay where they are, and so do folds without a
/// smooth contour beside them: where it ends at a crease, and the outline goes on along the mesh.
class SmoothContours {
  public:
    SmoothContours(const SurfaceSet& surfaces, double cos_crease_angle, int threads);

    /// Moves the folds among the pieces.
    void move(std::vector<LineSegment>& segments) const;

  private:
    struct Piece {
        glm::dvec2 ends[2];
        bool goes_on[2] = {false, false};  // another piece has that end in common
    };
    struct Foot {  // the nearest point of a contour
        glm::dvec2 pixel{0.0};
        std::size_t piece = kNoPiece;  // none: the place itself, there is no contour beside it
    };
    static constexpr std::size_t kNoPiece = ~std::size_t{0};

    std::optional<SurfaceEdge> fold_of(const LineSegment& segment) const;
    std::optional<Piece> piece_in(SurfaceId triangle) const;
    void find_pieces(SurfaceEdge fold, std::vector<Piece>& pieces) const;
    static Foot nearest(const std::vector<Piece>& pieces, glm::dvec2 pixel);
    static std::optional<glm::dvec2> common_end(const std::vector<Piece>& pieces, std::size_t a, std::size_t b);
    static void add_moved(const LineSegment& fold, const std::vector<Piece>& pieces, std::vector<LineSegment>& moved);

    const SurfaceSet& surfaces_;
    std::vector<SmoothMesh> meshes_;
    std::vector<const SmoothMesh*> smooth_of_;  // per instance
};

}  // namespace burin
