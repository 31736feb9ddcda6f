#include "abuffer/fine/fine_cells.h"

#include <array>
#include <cmath>
#include <limits>

#include "view/polygon_rows.h"

namespace burin {
namespace {

/// A block is cut into cells so that about kTrianglesPerCell triangles are in one, or kFewTrianglesPerCell where there
/// are more than kManyPairs pairs of a line and a triangle.
constexpr std::size_t kTrianglesPerCell = 512, kFewTrianglesPerCell = 128, kManyPairs = std::size_t{1} << 18;
/// For no more lines than kFewLines cells are not worth it, unless there are more than kMostForFewLines triangles.
constexpr std::size_t kFewLines = 12, kMostForFewLines = 1024;
/// A triangle may be in this many cells, on average.
constexpr std::size_t kMostPlaces = 4;
/// What single precision may do to places, 1/256 pixel: near the picture, and from some distance on.
struct Rounding {
    int margin, far_margin, near;
};
constexpr Rounding kCellRounding{1, 16, 1 << 20};

}  // namespace

void FineCells::set(const std::vector<CrossedTriangle>& triangles, glm::ivec2 corner, std::size_t line_count) {
    given_ = &triangles;
    corner_ = corner;
    cells_ = 1;
    cell_shift_ = SampleBlocks::kShift;
    const bool has_few = line_count <= kFewLines && triangles.size() <= kMostForFewLines;
    const std::size_t per_cell = line_count * triangles.size() > kManyPairs ? kFewTrianglesPerCell : kTrianglesPerCell;
    while (!has_few && cells_ < kMostCells && triangles.size() > per_cell * count_of_cells()) {
        cells_ *= 2;
        --cell_shift_;
    }
    if (cells_ > 1) sort_to_cells();
    own_boxes_.set_all(kernels_, triangles);
    if (cells_ > 1) listed_boxes_.set_listed(own_boxes_, in_cells_);
    const std::size_t count = cells_ == 1 ? triangles.size() : in_cells_.size();
    found_.resize(std::max(found_.size(), count + TriangleBoxes::kPadding));
}

/// Lists the triangles in each cell they touch.
void FineCells::sort_to_cells() {
    boxes_.resize(given_->size());
    for (std::size_t i = 0; i < given_->size(); ++i) boxes_[i] = box_of((*given_)[i]);
    // Counts are kept one place further, so that filling moves each list's end to its place.
    for (; cells_ > 1; cells_ /= 2, ++cell_shift_) {
        cell_end_.assign(count_of_cells() + 2, 0);
        const std::size_t most = kMostPlaces * given_->size();  // large ones would fill all cells
        std::size_t count = 0;
        for (std::size_t i = 0; i < boxes_.size() && count <= most; ++i) {
            for_cells_of((*given_)[i], boxes_[i], [&](std::size_t cell) {
                ++cell_end_[cell + 2];
                ++count;
            });
        }
        if (count <= most) break;
    }
    if (cells_ == 1) return;
    for (std::size_t i = 2; i < cell_end_.size(); ++i) cell_end_[i] += cell_end_[i - 1];
    in_cells_.resize(cell_end_.back());
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
        for_cells_of((*given_)[i], boxes_[i], [&](std::size_t cell) { in_cells_[cell_end_[cell + 1]++] = i; });
    }
}

/// Calls visit(cell) for the cells of its box that a triangle touches, but for rounding, without those that it passes
/// by.
template <typename Visit>
void FineCells::for_cells_of(const CrossedTriangle& t, const Box& box, const Visit& visit) const {
    const Range cells = range_of(box);
    if (cells.x0 == cells.x1 || cells.y0 == cells.y1 || screen_.facing(t.number) == off_screen)
        return for_cells(box, visit);
    const std::array<PolygonRows::Corner, 3> corners{{{t.x[0], t.y[0]}, {t.x[1], t.y[1]}, {t.x[2], t.y[2]}}};
    const PolygonRows rows(corners);
    const auto [margin, far_margin, near] = kCellRounding;
    const glm::ivec2 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
    const int around = std::max(farthest.x, farthest.y) < near ? margin : far_margin;
    for (int y = cells.y0; y <= cells.y1; ++y) {
        // Cells at the rim of the block stand for what is beyond it.
        const int top = y == 0 ? box.low.y : corner_.y + (y << cell_shift_),
                  bottom = y == cells_ - 1 ? box.high.y : corner_.y + ((y + 1) << cell_shift_);
        const PolygonRows::Range range = rows.between(top - around, bottom + around);
        if (range.is_empty()) continue;
        const int first = static_cast<int>(std::floor(range.low)) - around,
                  last = static_cast<int>(std::ceil(range.high)) + around;
        for (int x = cell_along(first, corner_.x); x <= cell_along(last, corner_.x); ++x)
            visit(static_cast<std::size_t>(y * cells_ + x));
    }
}

std::size_t FineCells::find_hiding(const FrontBoxes& boxes, std::size_t begin, std::size_t end, const ScreenLine& line,
                                   const ScreenBox& box) {
    const std::size_t count = kernels_.fine.find_in_front(boxes, begin, end, box, found_.data());
    if (cells_ > 1) {
        for (std::size_t i = 0; i < count; ++i) found_[i] = in_cells_[found_[i]];
    }
    return kernels_.fine.find_hiding(given_->data(), found_.data(), count, line, found_.data());
}

ScreenBox FineCells::box_around(glm::dvec2 a, glm::dvec2 b, float low) {
    const glm::vec2 begin(glm::min(a, b)), end(glm::max(a, b));
    const float farthest = std::max({std::abs(begin.x), std::abs(begin.y), std::abs(end.x), std::abs(end.y)});
    const auto margin = static_cast<float>(
        farthest < static_cast<float>(kCellRounding.near) ? kCellRounding.margin : kCellRounding.far_margin);
    return {begin.x - margin,
            begin.y - margin,
            end.x + margin,
            end.y + margin,
            low,
            std::numeric_limits<float>::infinity()};
}

FineCells::Box FineCells::box_of(const CrossedTriangle& t) const {
    if (screen_.facing(t.number) != off_screen) {
        return {{std::min({t.x[0], t.x[1], t.x[2]}), std::min({t.y[0], t.y[1], t.y[2]})},
                {std::max({t.x[0], t.x[1], t.x[2]}), std::max({t.y[0], t.y[1], t.y[2]})}};
    }
    const ScreenPolygon polygon = screen_.surfaces().screen_polygon(screen_.surface_of(t.number));
    Box box{glm::ivec2(std::numeric_limits<int>::max()), glm::ivec2(std::numeric_limits<int>::min())};
    for (int i = 0; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        box = {glm::min(box.low, glm::ivec2(p.x, p.y)), glm::max(box.high, glm::ivec2(p.x, p.y))};
    }
    return box;
}

}  // namespace burin
