#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "abuffer/fine/fine_edges.h"
#include "abuffer/screen/screen_surfaces.h"
#include "kernels/screen_triangles.h"

// In a block of many triangles each line is compared with those near it only.

namespace burin {

/// The triangles that may hide lines in a block, as kernels want them: where there are many for many lines, cell by
/// cell. Buffers are used again.
class FineCells {
  public:
    FineCells(const ScreenSurfaces& screen, const TileKernels& kernels) : screen_(screen), kernels_(kernels) {}

    /// A block is cut into at most this many cells along each side.
    static constexpr int kMostCells = 32;

    /// `triangles` must stay. `corner`: of the block, in 1/256 pixel. `line_count`: how many lines will be looked at
    /// there.
    void set(const std::vector<CrossedTriangle>& triangles, glm::ivec2 corner, std::size_t line_count);
    /// What triangles_per_cell() will not be below for so many triangles, however small they are.
    static std::size_t least_per_cell(std::size_t triangles) { return triangles / (kMostCells * kMostCells); }
    /// How many triangles are in a cell, on average. Cells are as small as they can be where there are very many pairs
    /// of a line and a triangle.
    std::size_t triangles_per_cell() const {
        return cells_ == 1 ? given_->size() : in_cells_.size() / count_of_cells();
    }

    /// Calls use(number) for those in the cells from a to b that may hide a line between them, until it says false.
    /// Some come from several cells.
    template <typename Use>
    void for_hiding(const ScreenLine& line, glm::dvec2 a, glm::dvec2 b, const Use& use) {
        const ScreenBox box = box_around(a, b, line.low);
        if (cells_ == 1) {
            const std::size_t count = find_hiding(own_boxes_.view(), 0, given_->size(), line, box);
            for (std::size_t i = 0; i < count && use(found_[i]);) ++i;
            return;
        }
        bool goes_on = true;
        for_cells({glm::ivec2(glm::floor(glm::min(a, b))), glm::ivec2(glm::ceil(glm::max(a, b)))},
                  [&](std::size_t cell) {
                      if (!goes_on) return;
                      const std::size_t count =
                          find_hiding(listed_boxes_.view(), cell_end_[cell], cell_end_[cell + 1], line, box);
                      for (std::size_t i = 0; i < count && goes_on; ++i) goes_on = use(found_[i]);
                  });
    }

  private:
    struct Box {
        glm::ivec2 low, high;  // in 1/256 pixel
    };
    std::size_t count_of_cells() const { return static_cast<std::size_t>(cells_ * cells_); }
    void sort_to_cells();
    Box box_of(const CrossedTriangle& t) const;
    /// Lists in found_ which of the triangles given may hide a line, of those that have the boxes [begin, end).
    std::size_t find_hiding(const FrontBoxes& boxes, std::size_t begin, std::size_t end, const ScreenLine& line,
                            const ScreenBox& box);
    static ScreenBox box_around(glm::dvec2 a, glm::dvec2 b, float low);

    /// First and last column and row of cells.
    struct Range {
        int x0, x1, y0, y1;
    };
    int cell_along(int subpixel, int first) const {
        // The box of a triangle that is nowhere on the screen has the least and the greatest int as its corners.
        const std::int64_t cell = (std::int64_t{subpixel} - first) >> cell_shift_;
        return static_cast<int>(std::clamp<std::int64_t>(cell, 0, cells_ - 1));
    }
    Range range_of(const Box& box) const {
        return {cell_along(box.low.x, corner_.x), cell_along(box.high.x, corner_.x), cell_along(box.low.y, corner_.y),
                cell_along(box.high.y, corner_.y)};
    }
    /// Calls visit(cell) for those that a box touches.
    template <typename Visit>
    void for_cells(const Box& box, const Visit& visit) const {
        const Range cells = range_of(box);
        for (int y = cells.y0; y <= cells.y1; ++y) {
            for (int x = cells.x0; x <= cells.x1; ++x) visit(static_cast<std::size_t>(y * cells_ + x));
        }
    }
    template <typename Visit>
    void for_cells_of(const CrossedTriangle& t, const Box& box, const Visit& visit) const;

    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    const std::vector<CrossedTriangle>* given_ = nullptr;
    glm::ivec2 corner_{0};
    int cells_ = 1, cell_shift_ = SampleBlocks::kShift;  // along each side, and log2 of a cell's width in 1/256 pixel
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> cell_end_, in_cells_;  // lists of given triangles, one per cell of several
    TriangleBoxes own_boxes_, listed_boxes_;          // of those given, and of all lists
    std::vector<std::uint32_t> found_;
};

}  // namespace burin
