#pragma once

#include <span>
#include <vector>

#include "abuffer/fine/fine_parts.h"
#include "abuffer/screen/triangle_bins.h"
#include "kernels/tile_kernels.h"
#include "lines/whole_line.h"
#include "view/polygon_rows.h"

// Triangles that may hide the lines of a tile that samples miss are sorted to its blocks.

namespace burin {

/// A surface that covers a place this far beyond a border is in contact with it. 1/64 pixel.
constexpr int kBeyondSubpixels = 4;

/// A part of an edge that is a line if it is visible. The part's begin and end are shares of `line`, which may be a
/// part of the edge itself.
struct FineCandidate {
    FineCandidate() = default;
    FineCandidate(const FinePart& on_line, const WholeLine& whole) : part(on_line), line(whole) {}

    FinePart part;
    WholeLine line;
};

/// The blocks of a tile that have candidates, and the triangles that may hide them there, or that borders may be in
/// contact with: all that come within kBeyondSubpixels of a block and are nearer, be they seen at a sample or not.
/// Buffers are used again from tile to tile.
class FineBlocks {
  public:
    /// `bins` must have kept thin triangles.
    FineBlocks(const ScreenSurfaces& screen, const TriangleBins& bins, const TileKernels& kernels,
               int samples_per_pixel)
        : screen_(screen), bins_(bins), kernels_(kernels), grid_(samples_per_pixel) {
        found_.resize(4 * kAtOnce);
        others_.resize(kAtOnce);
    }

    void fill(std::size_t tile, std::span<const FineCandidate> candidates);

    std::size_t count() const { return count_; }
    /// Numbers of candidates.
    std::span<const std::uint32_t> candidates(std::size_t block) const { return candidates_[block]; }
    /// The triangles of a block, in no particular order. Some small ones from beyond the tile may be listed twice.
    /// Triangles that are clipped by the near plane or the guard band cover the whole screen.
    const std::vector<CrossedTriangle>& triangles(std::size_t block) const { return triangles_[block]; }

  private:
    /// A block is cut into this many cells along each side, for a triangle beside all candidates to be left out.
    static constexpr int kCells = SampleBlocks::kShift - HidingGrid::kCellShift + 1;
    static_assert(SampleBlocks::kShift == HidingGrid::kShift && kCells == 2);
    /// This many triangles are sorted at once.
    static constexpr std::size_t kAtOnce = 256;

    struct Box {
        std::int32_t x0, y0, x1, y1;  // in 1/256 pixel
    };
    std::size_t block_at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }
    int cell_of(std::int32_t subpixel) const { return (subpixel - grid_.half_pitch) >> HidingGrid::kCellShift; }
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    void sort_candidates(std::span<const FineCandidate> candidates);
    void combine_cells();
    void note_least(glm::ivec2 low, glm::ivec2 high, float lowest);
    void add_small(const TriangleRun& run);
    void sort_listed();
    void add_beyond(std::size_t tile);
    void add_large_of(std::size_t tile);
    void add_large(const LargePolygon& large);
    void sort_triangles(const ScreenMesh& mesh, const std::uint32_t* listed, std::size_t count);
    void add(const CrossedTriangle& triangle, const Box& box, std::span<const PolygonRows::Corner> corners);
    bool hides_something(const Box& box, float highest, int block_x, int block_y) const;

    const ScreenSurfaces& screen_;
    const TriangleBins& bins_;
    const TileKernels& kernels_;
    SampleBlocks grid_;
    PixelRect rect_;
    int first_x_ = 0, first_y_ = 0, columns_ = 0, rows_ = 0;
    std::size_t count_ = 0;
    std::vector<std::uint32_t> index_;  // per block: its number, or kNone without candidates
    std::vector<float> farthest_;       // as in a HidingGrid: the least nearness of candidates there
    HidingGrid hiding_grid_;
    std::vector<float> least_;                   // the same as a BlockTable
    int sample_blocks_ = 0;                      // along each side
    glm::ivec2 beyond_low_{0}, beyond_high_{0};  // where borders may be in contact
    std::vector<std::uint32_t> nearer_;  // of one instance's triangles, the `listed_` ones that are still to be sorted
    std::size_t listed_ = 0;
    std::uint32_t listed_instance_ = 0;
    std::vector<std::vector<std::uint32_t>> candidates_;  // per block
    std::vector<std::vector<CrossedTriangle>> triangles_;
    std::vector<bool> large_known_;  // of each large triangle: whether it was added already
    std::vector<HidingInBlock> found_;
    std::vector<std::uint32_t> others_;
    std::vector<glm::ivec2> places_;  // of those with candidates
};

}  // namespace burin
