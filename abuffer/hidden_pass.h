#pragma once

#include <vector>

#include "abuffer/edges/edge_lines.h"
#include "abuffer/edges/intersecting_pairs.h"
#include "abuffer/edges/intersection_lines.h"
#include "abuffer/hiding/hiding_tile.h"
#include "abuffer/hiding/occluder_bins.h"
#include "base/progress.h"
#include "render/film.h"

namespace burin {

class ShadedSurfaces;

/// What one tile has found.
struct HidingTileResult {
    std::vector<WholeLine> intersections;
    std::vector<LinePart> parts;
};

/// HiddenPass finds what is behind the first surface: it keeps all surfaces of one tile after the other, composites
/// transparent ones, and finds hidden lines and lines seen through transparent surfaces.
///
/// A picture is made in one or more slices, each some rows of tiles: find_lines(), sort(), composite() and find_parts()
/// for one, with what touches it shown; then join_results().
/// Intersections are found from the scene's pairs of triangles if it has them and all instances are shown, else tile by
/// tile; they are the same.
class HiddenPass {
  public:
    /// The pixels in which lines are looked for, as tiles: the frame's crop and what strokes from beside it reach, or
    /// the whole picture.
    static PixelTiles tiles_of(const Frame& frame);

    /// The facing of all triangles must be known to `screen`.
    /// `progress`: advances by a step for each tile of find_parts().
    HiddenPass(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels, int threads,
               Progress* progress = nullptr);

    /// Adds the edges of the instances shown that are lines, as far as they touch these rows; and intersections.
    /// `possible`: the possible lines of these instances, where they are known already.
    void find_lines(TileRows rows, const PossibleLines* possible = nullptr);
    /// Sorts the instances shown to the tiles of these rows, for the lines found.
    void sort(TileRows rows);
    /// Replaces the surfaces of pixels behind transparent ones, in the rows sorted. `shaded`: of a shading that varies
    /// over surfaces, else nullptr.
    void composite(Film& film, const ShadedSurfaces* shaded) const;
    /// Finds what is in front of lines in the rows sorted, and intersections that are missing.
    void find_parts();
    /// Puts what tiles found since the last call into lines() and parts(), in the order of tiles.
    void join_results();

    const std::vector<WholeLine>& lines() const { return lines_; }
    const std::vector<LinePart>& parts() const { return parts_; }
    /// The lines, which it has no more then.
    std::vector<WholeLine> take_lines();

    std::uint64_t fragment_count() const { return fragment_count_; }

  private:
    /// Whether intersections are found from the scene's pairs of triangles.
    bool knows_pairs() const;

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    int threads_;
    Progress* progress_;
    PixelTiles all_tiles_, tiles_;
    IntersectionLines intersections_;
    std::optional<IntersectionTest> may_intersect_;  // where tiles look for intersections
    OccluderBins bins_;
    std::vector<WholeLine> lines_;
    std::vector<HidingTileResult> results_;  // tile by tile, not joined yet
    std::vector<LinePart> parts_;
    std::uint64_t fragment_count_ = 0;
};

}  // namespace burin
