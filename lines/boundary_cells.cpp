#include "lines/boundary_cells.h"

#include <algorithm>
#include <numeric>

namespace burin {
namespace {

constexpr std::size_t kFew = 48;
/// Pieces farther away are in the outermost cells: this is more than strokes reach.
constexpr double kFarPx = 1200;

}  // namespace

void BoundaryCells::set(std::span<const PieceEnds> pieces, glm::dvec2 place) {
    columns_ = rows_ = 1;
    from_ = place - kFarPx;
    if (pieces.size() > kFew) {
        glm::dvec2 low = place + kFarPx, high = place - kFarPx;
        for (const PieceEnds& p : pieces) {
            low = glm::min(low, glm::min(p.from, p.to));
            high = glm::max(high, glm::max(p.from, p.to));
        }
        from_ = glm::max(low, place - kFarPx);
        const glm::dvec2 size = glm::max(glm::min(high, place + kFarPx) - from_, 0.0);
        columns_ = static_cast<int>(size.x / kCellPx) + 1;
        rows_ = static_cast<int>(size.y / kCellPx) + 1;
    }
    end_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    if (is_one()) {
        end_[1] = static_cast<std::uint32_t>(pieces.size());
        numbers_.resize(pieces.size());
        std::iota(numbers_.begin(), numbers_.end(), 0u);
        return;
    }
    const auto for_cells = [&](const PieceEnds& p, const auto& visit) {
        const Box box = cells_of(p);
        for (int y = box.y0; y < box.y1; ++y) {
            for (int x = box.x0; x < box.x1; ++x)
                visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x));
        }
    };
    for (const PieceEnds& p : pieces) for_cells(p, [&](std::size_t cell) { ++end_[cell + 1]; });
    for (std::size_t i = 1; i < end_.size(); ++i) end_[i] += end_[i - 1];
    numbers_.resize(end_.back());
    next_.assign(end_.begin(), end_.end() - 1);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
        for_cells(pieces[i], [&](std::size_t cell) { numbers_[next_[cell]++] = i; });
    }
}

BoundaryCells::Box BoundaryCells::cells_of(const PieceEnds& piece) const {
    const glm::dvec2 low = (glm::min(piece.from, piece.to) - from_) / kCellPx,
                     high = (glm::max(piece.from, piece.to) - from_) / kCellPx;
    const auto cell = [](double v, int count) { return static_cast<int>(std::clamp(v, 0.0, count - 1.0)); };
    return {cell(low.x, columns_), cell(low.y, rows_), cell(high.x, columns_) + 1, cell(high.y, rows_) + 1};
}

}  // namespace burin
