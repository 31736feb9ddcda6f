#pragma once

#include <cstdint>
#include <vector>

#include "lines/corner_normals.h"
#include "lines/fold_map.h"
#include "lines/line_piece.h"
#include "view/surface_set.h"

// Outlines of smooth surfaces follow interpolated normals instead of a zigzag of edges.

namespace burin {

/// Contours of smooth surfaces: where normals, interpolated between vertices, are across the line of
/// sight (`contour_chains`), instead of along the edges at which triangles turn away, which is a
/// zigzag with hooks.
///
/// The mesh still decides which parts are visible: every visible piece of an edge where a smooth surface folds is moved
/// to the nearest points of the smooth contour on the triangles around it. So what is hidden stays hidden, a hook falls
/// onto the contour at whose end it is, and no line is drawn twice. Edges with another reason to be a line stay where
/// they are, and so do folds without a smooth contour beside them: where it ends at a crease, and the outline goes on
/// along the mesh.
///
/// An outline that is closed on the mesh stays closed: an edge is moved as a whole, without gaps (`fold_map`), and
/// lines that met are joined again (`contour_joints`).
class SmoothContours {
  public:
    SmoothContours(const SurfaceSet& surfaces, double cos_crease_angle, int threads);

    /// Moves the folds among all visible lines of a picture, and adds a list of what joins them.
    void move(std::vector<std::vector<LinePiece>>& lists, int threads) const;
    /// Moves the folds among some pieces, each by itself.
    void move(std::vector<LinePiece>& pieces) const;
    /// Ends of moved lines that meet may be so far apart, in pixels.
    static constexpr double kApartPx = 1.0 / 256;

  private:
    bool is_fold(const LinePiece& piece) const;
    FoldMap map_of(LineId edge) const;

    const SurfaceSet& surfaces_;
    std::vector<SmoothMesh> meshes_;
    std::vector<const SmoothMesh*> smooth_of_;  // per instance
};

}  // namespace burin
