#include "output/paths/part_grid.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

constexpr double kSmallestCellPx = 2, kMostCells = 1 << 22;

}  // namespace

PartGrid::PartGrid(PixelRect area, double reach_px) : area_(area) {
    const double width = std::max(area.width(), 1), height = std::max(area.height(), 1);
    cell_px_ = std::max({kSmallestCellPx, reach_px, std::sqrt(width * height / kMostCells)});
    cells_per_px_ = 1 / cell_px_;
    columns_ = static_cast<int>(width / cell_px_) + 1;
    rows_ = static_cast<int>(height / cell_px_) + 1;
    first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNone);
}

void PartGrid::add(glm::dvec2 from, glm::dvec2 to, std::uint32_t line) {
    const auto number = static_cast<std::uint32_t>(parts_.size());
    parts_.push_back({from, to - from, glm::dot(to - from, to - from), line});
    const auto put = [&](int x, int y) {
        std::uint32_t& first = first_[cell(x, y)];
        entries_.push_back({number, first});
        first = static_cast<std::uint32_t>(entries_.size() - 1);
    };
    // Row by row, the columns that the part passes there.
    const glm::dvec2 &low = from.y <= to.y ? from : to, &high = from.y <= to.y ? to : from;
    const int y0 = row(low.y), y1 = row(high.y);
    const double slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0;
    for (int y = y0; y <= y1; ++y) {
        const double top = area_.y0 + y * cell_px_, bottom = top + cell_px_;
        const double begin = y == y0 ? low.x : low.x + slope * (top - low.y);
        const double end = y == y1 ? high.x : low.x + slope * (bottom - low.y);
        const int x0 = column(std::min(begin, end)), x1 = column(std::max(begin, end));
        for (int x = x0; x <= x1; ++x) put(x, y);
    }
}

}  // namespace burin
