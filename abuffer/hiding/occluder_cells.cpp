#include "abuffer/hiding/occluder_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burin {
namespace {

/// Lines are looked up in a cell by parts no longer than an eighth of it. 1/256 pixel for each of its pixels.
constexpr double kPartOfCell = double{kSubpixelsPerPixel} / 8;
/// A margin greater than what rounding does to places. 1/256 pixel.
constexpr float kRoundingOfPlaces = 4;
constexpr float kFarPlace = 1e30f;

}  // namespace

void OccluderCells::clear(PixelRect rect) {
    rect_ = rect;
    corner_ = glm::ivec2(rect.x0, rect.y0) * kSubpixelsPerPixel;
    count_ = 0;
}

ScreenBox OccluderCells::box_of(const CrossedTriangle& t) {
    const auto low = [](const float(&v)[3]) { return std::min(std::min(v[0], v[1]), v[2]); };
    const auto high = [](const float(&v)[3]) { return std::max(std::max(v[0], v[1]), v[2]); };
    return {low(t.x), low(t.y), high(t.x), high(t.y), -kFarPlace, t.highest};
}

int OccluderCells::cell_along(float offset, int count) const {
    return static_cast<int>(std::clamp(offset * cells_per_subpixel_, 0.0f, static_cast<float>(count - 1)));
}

OccluderCells::Range OccluderCells::range_of(glm::vec2 low, glm::vec2 high) const {
    return {cell_along(low.x, columns_), cell_along(high.x, columns_), cell_along(low.y, rows_),
            cell_along(high.y, rows_)};
}

void OccluderCells::sort(double per_cell) {
    const int largest = std::max(rect_.width(), rect_.height());
    const double area = static_cast<double>(rect_.width()) * rect_.height();
    const double wanted = std::sqrt(area * per_cell / std::max(1.0, static_cast<double>(count_)));
    cell_px_ = 1;
    while (cell_px_ < largest && 2 * cell_px_ <= wanted) cell_px_ *= 2;
    cells_per_subpixel_ = 1 / static_cast<float>(cell_px_ * kSubpixelsPerPixel);
    columns_ = (rect_.width() + cell_px_ - 1) / cell_px_;
    rows_ = (rect_.height() + cell_px_ - 1) / cell_px_;
    if (columns_ * rows_ == 1) {
        cell_end_ = {0, static_cast<std::uint32_t>(count_)};
        places_.resize(count_);
        std::iota(places_.begin(), places_.end(), 0u);
    } else {
        fill();
    }
}

void OccluderCells::fill() {
    const auto for_cells = [&](const CrossedTriangle& t, const auto& visit) {
        const ScreenBox box = box_of(t);
        const Range range = range_of({box.x0, box.y0}, {box.x1, box.y1});
        for (int row = range.first_row; row <= range.last_row; ++row) {
            for (int column = range.first_column; column <= range.last_column; ++column)
                visit(static_cast<std::size_t>(row * columns_ + column));
        }
    };
    // Counts are kept one place further, so that filling moves each list's end to its place.
    cell_end_.assign(static_cast<std::size_t>(columns_ * rows_) + 2, 0);
    for (std::size_t i = 0; i < count_; ++i) for_cells(triangles_[i], [&](std::size_t c) { ++cell_end_[c + 2]; });
    for (std::size_t i = 2; i < cell_end_.size(); ++i) cell_end_[i] += cell_end_[i - 1];
    places_.resize(cell_end_.back());
    for (std::uint32_t i = 0; i < count_; ++i) {
        for_cells(triangles_[i], [&](std::size_t c) { places_[cell_end_[c + 1]++] = i; });
    }
}

void OccluderCells::make_indices() {
    ScreenBox bounds{0, 0, 0, 0, kFarPlace, -kFarPlace};
    for (std::size_t i = 0; i < count_; ++i) {
        bounds.low = std::min(bounds.low, triangles_[i].highest);
        bounds.high = std::max(bounds.high, triangles_[i].highest);
    }
    const auto count = static_cast<std::size_t>(columns_ * rows_);
    if (indices_.size() < count) indices_.resize(count);
    std::size_t largest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Cell c = cell_at(i);
        bounds.x0 = pitch() * static_cast<float>(static_cast<int>(i) % columns_);
        bounds.y0 = pitch() * static_cast<float>(static_cast<int>(i) / columns_);
        bounds.x1 = bounds.x0 + pitch();
        bounds.y1 = bounds.y0 + pitch();
        indices_[i].make(kernels_, triangles_.data(), places_.data() + c.begin, c.end - c.begin, bounds);
        largest = std::max(largest, c.end - c.begin);
    }
    if (count > 1) looked_at_by_.assign(count_, 0);
    lines_looked_at_ = 0;
    constexpr std::size_t kMore = 15;  // that kernels read and write
    if (found_.size() < largest + kMore) {
        found_.resize(largest + kMore);
        listed_.resize(largest + kMore);
    }
}

/// Finds the cell's triangles that may hide the part of a line in it. Returns how many are in found_.
std::size_t OccluderCells::find_crossed(std::size_t cell, const WholeLine& line, double from, double to, double slack,
                                        float reach) {
    const glm::dvec2 corner(corner_), along = line.to - line.from;
    const auto low = static_cast<float>(line.lowest_in(from, to) - slack);
    const TriangleIndex& index = indices_[cell];
    const double length = (to - from) * std::max(std::abs(along.x), std::abs(along.y));
    const int parts = std::max(1, static_cast<int>(std::ceil(length / (cell_px_ * kPartOfCell))));
    const auto around = [&](glm::vec2 a, glm::vec2 b) {
        const glm::vec2 first = glm::min(a, b) - (kRoundingOfPlaces + reach),
                        last = glm::max(a, b) + (kRoundingOfPlaces + reach);
        return ScreenBox{first.x, first.y, last.x, last.y, low, kFarPlace};
    };
    const auto place = [&](int i) { return glm::vec2(line.from + along * (from + (to - from) * i / parts) - corner); };
    boxes_.clear();
    for (int i = 1; i <= parts; ++i) boxes_.push_back(index.in_steps(around(place(i - 1), place(i))));
    const std::size_t count =
        index.find(boxes_.data(), boxes_.size(), places_.data() + cell_at(cell).begin, listed_.data());
    // A short line is taken as a whole, since its ends are whole numbers.
    const bool is_exact = reach == 0 && line.is_exact();
    const glm::vec2 p(line.from + along * (is_exact ? 0 : from) - corner),
        q(line.from + along * (is_exact ? 1 : to) - corner);
    return kernels_.hide.find_crossed(triangles_.data(), listed_.data(), count,
                                      {p.x, p.y, q.x, q.y, low, is_exact, reach}, found_.data());
}

}  // namespace burin
