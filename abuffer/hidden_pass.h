#pragma once

#include <vector>

#include "abuffer/edges/edge_lines.h"
#include "abuffer/edges/intersecting_pairs.h"
#include "abuffer/edges/intersection_lines.h"
#include "abuffer/hiding/hiding_tile.h"
#include "abuffer/hiding/occluder_bins.h"
#include "lines/course_index.h"
#include "lines/smooth_contours.h"
#include "strokes/hidden_strokes.h"

namespace burin {

/// What one tile has found.
struct HidingTileResult {
    std::vector<WholeLine> intersections;
    std::vector<LinePart> pieces;
};

/// What is behind the first surface: keeps all layers of all tiles in turn, composites transparent
/// surfaces, and finds hidden lines and lines seen through transparent surfaces.
///
/// A picture is made in one or more pieces, each some rows of tiles: find_lines(), sort(), composite()
/// and find_pieces() for one, with what touches it shown; then its lines are drawn (HiddenStrokes).
/// Intersections are found from the scene's pairs of triangles if it has them and all instances are shown, else tile by
/// tile; they are the same.
class HiddenPass {
  public:
    /// Whether a picture of a scene shows anything of it.
    static bool is_needed(const Scene& scene);
    /// The pixels in which lines are looked for, as tiles: the frame's crop and what strokes from beside it reach, or
    /// the whole picture.
    static PixelTiles tiles_of(const Frame& frame);
    /// Whether all lines are needed before the first one can be drawn: dashes run on from line to line.
    static bool needs_all_lines(const Frame& frame);

    /// The facing of all triangles must be known to `screen`.
    /// `contours`: nullptr where they follow the mesh.
    HiddenPass(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels, int threads,
               const SmoothContours* contours = nullptr);

    /// All lines of a picture in one piece. The facing of all triangles must be known to `screen`.
    void find();
    /// After find().
    const std::vector<WholeLine>& lines() const { return lines_; }
    const std::vector<LinePart>& pieces() const { return pieces_; }

    /// Adds the edges that are lines, of the instances shown, as far as they touch these rows; and intersections.
    /// `possible`: of these instances, where they are known already.
    void find_lines(TileRows rows, const PossibleLines* possible = nullptr);
    /// Sorts the instances shown to the tiles of these rows, for the lines found.
    void sort(TileRows rows);
    /// Replaces the surfaces of pixels behind transparent ones, in the rows sorted.
    void composite(Film& film) const;
    /// Finds what is in front of lines in the rows sorted, and intersections that are missing.
    void find_pieces();
    /// Hidden lines are not dashed where they lie on these: the dashes of either would fill the gaps of the other.
    /// `visible` must outlive it.
    void leave_out_dashes_along(CourseIndex& visible);
    /// Of all that was found since the last call; it is forgotten.
    std::vector<LayerSegment> take_segments();

    std::uint64_t fragment_count() const { return fragment_count_; }

  private:
    class Dashes;
    std::vector<LayerSegment> make_segments() const;
    void join_results();
    /// Whether intersections are found from the scene's pairs.
    bool knows_pairs() const;
    void add(const WholeLine& line, LayerSegment segment, std::vector<LayerSegment>& segments) const;
    void add_dashes(const LinePart& piece, const Dashes& dashes, std::vector<LayerSegment>& segments) const;

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    const SmoothContours* contours_;
    int threads_;
    PixelTiles all_tiles_, tiles_;
    IntersectionLines intersections_;
    std::optional<IntersectionTest> may_intersect_;  // where tiles look for intersections
    OccluderBins bins_;
    std::vector<WholeLine> lines_;
    std::vector<HidingTileResult> results_;  // tile by tile, not joined yet
    std::vector<LinePart> pieces_;
    CourseIndex* visible_courses_ = nullptr;
    std::uint64_t fragment_count_ = 0;
};

}  // namespace burin
