#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "abuffer/edges/occluder.h"
#include "image/image.h"
#include "kernels/tile_kernels.h"
#include "kernels/triangle_index.h"
#include "lines/whole_line.h"

// Triangles near a part of a line are found by place.

namespace burin {

/// The triangles of a square on the screen by place: where there are very many it is cut into square cells, and each
/// has an index of the triangles that touch it. Buffers are used again.
class OccluderCells {
  public:
    /// A cell's list: [begin, end) of places().
    struct Cell {
        std::size_t begin, end;
    };

    explicit OccluderCells(const TileKernels& kernels) : kernels_(kernels) {}

    void clear(PixelRect rect);
    /// Where triangles are measured from, in 1/256 pixel.
    glm::ivec2 corner() const { return corner_; }
    /// Adds `count` triangles, which the caller sets where they stay, before the next ones come. Kernels may write
    /// kRoom beyond them.
    CrossedTriangle* add(std::size_t count) {
        count_ += count;
        if (triangles_.size() < count_ + kRoom) triangles_.resize(2 * count_ + kRoom);
        return triangles_.data() + (count_ - count);
    }
    /// Sorts the triangles into cells after all were added. Cells are made so small that about `per_cell` triangles
    /// begin in one.
    void sort(double per_cell);
    /// Makes what for_crossed() needs, after sort().
    void make_indices();
    const CrossedTriangle& operator[](std::size_t i) const { return triangles_[i]; }
    static ScreenBox box_of(const CrossedTriangle& triangle);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    float pitch() const { return static_cast<float>(cell_px_ * kSubpixelsPerPixel); }
    Cell cell(int column, int row) const { return cell_at(static_cast<std::size_t>(row * columns_ + column)); }
    /// Numbers of triangles, cell by cell.
    std::span<const std::uint32_t> places() const { return places_; }

    /// Calls use(number) once for each triangle that is near the part [begin, end] of a line within the square, with a
    /// corner in front of it, or behind it by no more than `slack`. `reach`: how far beside the line a triangle may
    /// lie. 1/256 pixel.
    template <typename Use>
    void for_crossed(const WholeLine& line, double begin, double end, double slack, float reach, const Use& use) {
        if (columns_ * rows_ == 1) {
            const std::size_t count = find_crossed(0, line, begin, end, slack, reach);
            for (std::size_t i = 0; i < count; ++i) use(found_[i]);
            return;
        }
        ++lines_looked_at_;
        const glm::dvec2 corner(corner_), a = line.at(begin) - corner, b = line.at(end) - corner;
        const Range range = range_of(glm::vec2(glm::min(a, b)) - reach, glm::vec2(glm::max(a, b)) + reach);
        const double size = cell_px_ * kSubpixelsPerPixel;
        for (int row = range.first_row; row <= range.last_row; ++row) {
            for (int column = range.first_column; column <= range.last_column; ++column) {
                double from = begin, to = end;
                const glm::dvec2 low = corner + glm::dvec2(column, row) * size;
                if (!clip_to_rect(line, low - double{reach}, low + (size + double{reach}), from, to)) continue;
                const std::size_t count =
                    find_crossed(static_cast<std::size_t>(row * columns_ + column), line, from, to, slack, reach);
                for (std::size_t i = 0; i < count; ++i) {
                    if (std::exchange(looked_at_by_[found_[i]], lines_looked_at_) != lines_looked_at_) use(found_[i]);
                }
            }
        }
    }

  private:
    static constexpr std::size_t kRoom = 7;
    struct Range {
        int first_column, last_column, first_row, last_row;
    };

    Cell cell_at(std::size_t i) const { return {cell_end_[i], cell_end_[i + 1]}; }
    Range range_of(glm::vec2 low, glm::vec2 high) const;
    int cell_along(float offset, int count) const;
    void fill();
    std::size_t find_crossed(std::size_t cell, const WholeLine& line, double from, double to, double slack,
                             float reach);

    const TileKernels& kernels_;
    PixelRect rect_;
    glm::ivec2 corner_{0};
    int cell_px_ = 1, columns_ = 0, rows_ = 0;
    float cells_per_subpixel_ = 0;
    std::size_t count_ = 0;
    std::vector<CrossedTriangle> triangles_;  // `count_` of them, and room for more
    std::vector<std::uint32_t> cell_end_, places_;
    std::vector<TriangleIndex> indices_;         // per cell
    std::vector<StepBox> boxes_;                 // around parts of a line
    std::vector<std::uint32_t> listed_, found_;  // of these, and by a kernel
    std::vector<std::uint32_t> looked_at_by_;    // the last line, so that none looks twice at what is in many cells
    std::uint32_t lines_looked_at_ = 0;
};

}  // namespace burin
