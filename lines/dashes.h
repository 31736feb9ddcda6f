#pragma once

#include <array>
#include <span>
#include <vector>

#include "image/image.h"
#include "lines/course_index.h"
#include "lines/line_piece.h"
#include "lines/whole_line.h"
#include "view/surface_set.h"

namespace burin {

/// Cuts visible lines into dashes of [on, off] pixels, in a picture of this size. `on` includes the round ends of a pen
/// of this width.
///
/// `features` are edges of the mesh that are lines in every view, such as creases, whole, be they seen or not: dashes
/// along them depend on them alone (chains_of()), so they stay where they are when a camera moves or something passes
/// in front.
///
/// All other lines, contours above all, are chained piece by piece: pieces that meet follow each other, over tiles and
/// over edges of the mesh. Where more than two meet, those of one edge belong together, else those of one class if they
/// are two; the others end there. A chain's first dash begins at the end that is higher on the screen (of two level
/// ones, the left one). A closed chain begins at its highest point and runs clockwise, and its dashes are stretched or
/// squeezed so that a whole number of them fits: there is no seam. Open chains shorter than a pixel or than the pen is
/// wide, and loops shorter than 1/16 pixel, are left out: hooks of facets would dot the gaps of the lines at whose ends
/// they are.
///
/// Lines that lie on each other share their dashes (SharedDashes): features first.
///
/// The dashes depend on nothing but where the lines are, if all lines of the picture are given.
std::vector<std::vector<LinePiece>> dashed(const std::vector<std::vector<LinePiece>>& lists,
                                           std::array<double, 2> dash_px, double width_px, PixelRect picture,
                                           std::span<const WholeLine> features, const SurfaceSet& surfaces);

/// Keeps by place where visible lines are, in a picture of this size: hidden lines have no dashes there, or these would
/// fill the gaps of the visible ones.
CourseIndex courses_of(const std::vector<std::vector<LinePiece>>& lists, PixelRect picture, double reach_px);

}  // namespace burin
