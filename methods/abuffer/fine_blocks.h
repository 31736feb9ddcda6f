#pragma once

#include <span>
#include <vector>

#include "abuffer/tile_kernels.h"
#include "image/image.h"
#include "methods/abuffer/fine_parts.h"
#include "methods/abuffer/layer_line.h"
#include "methods/abuffer/tile_lists.h"

namespace burin {

/// A part of an edge that is a line if it is visible.
struct FineCandidate {
    FinePart part;
    LayerLine line;
};

/// A triangle that may hide candidates, by its box on the screen in 1/256 pixel.
struct HidingTriangle {
    std::uint32_t number;
    bool is_clipped;  ///< by the near plane or the guard band
    std::int32_t x0, y0, x1, y1;
    float nearest;
};

/// The blocks of a region that have candidates, and the triangles that may hide them there: all that touch
/// a block and are nearer, be they seen at a sample or not.
class FineBlocks {
  public:
    FineBlocks(const ScreenSurfaces& screen, const TileKernels& kernels, int samples_per_pixel,
               PixelRect region, const std::vector<FineCandidate>& candidates, int threads);

    std::size_t count() const { return count_; }
    /// Numbers of candidates.
    std::span<const std::uint32_t> candidates(std::size_t block) const { return candidates_.of(block); }
    std::span<const HidingTriangle> triangles(std::size_t block) const { return triangles_.of(block); }

  private:
    using Records = std::vector<TileLists<HidingTriangle>::Record>;

    /// A block is cut into so many cells along each side, for a triangle beside all candidates to be left out.
    static constexpr int kCells = 2;
    static constexpr int kCellShift = SampleBlocks::kShift - 1;

    std::size_t block_at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }
    std::size_t cell_at(int x, int y) const {  // with the border of a BlockMap
        return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(kCells * columns_ + 2) +
               static_cast<std::size_t>(x + 1);
    }
    int cell_of(std::int32_t subpixel) const { return (subpixel - grid_.half_pitch) >> kCellShift; }
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    void sort_candidates(const std::vector<FineCandidate>& candidates);
    void sort_triangles(const TriangleChunk& chunk, std::vector<std::uint32_t>& found,
                        Records& records) const;
    HidingTriangle triangle(SurfaceId s) const;

    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    SampleBlocks grid_;
    int first_x_, first_y_, columns_, rows_;
    std::size_t count_ = 0;
    std::vector<std::uint32_t> index_;  // per block: its number, or kNone without candidates
    std::vector<float> farthest_;       // per cell: see BlockMap
    TileLists<std::uint32_t> candidates_;
    TileLists<HidingTriangle> triangles_;
};

}  // namespace burin
