#include "lines/line_drawing.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "base/infinity.h"

namespace burin {
namespace {

void forget_pieces_above(double y, std::vector<LinePiece>& list) {
    std::erase_if(list, [y](const LinePiece& piece) { return std::max(piece.from.y, piece.to.y) < y; });
    if (list.capacity() > 2 * list.size()) list.shrink_to_fit();
}

}  // namespace

void LineDrawing::begin_rows(const PixelTiles& tiles) {
    const auto columns = static_cast<std::size_t>(tiles.columns());
    visible_.push_back({static_cast<double>(tiles.rect().y0), static_cast<double>(tiles.tile_px()), columns, {}});
    visible_.back().lists.resize(tiles.count());
}

void LineDrawing::put_visible(std::size_t tile, std::span<const LinePiece> pieces) {
    visible_.back().lists[tile].assign(pieces.begin(), pieces.end());
}

void LineDrawing::add_visible(std::vector<LinePiece> pieces) {
    visible_.push_back({-kInfinity, kInfinity, 1, {}});
    visible_.back().lists.push_back(std::move(pieces));
}

void LineDrawing::add_behind(std::vector<LinePiece> pieces) { behind_.push_back(std::move(pieces)); }

void LineDrawing::add_whole_lines(std::vector<WholeLine> lines) {
    if (whole_lines_.empty()) {
        whole_lines_ = std::move(lines);
    } else {
        whole_lines_.insert(whole_lines_.end(), lines.begin(), lines.end());
    }
}

LineDrawing::Lists LineDrawing::visible_in_rows(double from_y, double to_y) const {
    Lists found;
    for (const Rows& rows : visible_) {
        for (std::size_t i = 0; i < rows.lists.size(); ++i) {
            if (rows.tile_px == kInfinity) {
                found.emplace_back(rows.lists[i]);
                continue;
            }
            const double y0 = rows.y0 + rows.tile_px * static_cast<double>(i / rows.columns);
            if (y0 < to_y && y0 + rows.tile_px > from_y) found.emplace_back(rows.lists[i]);
        }
    }
    return found;
}

LineDrawing::Lists LineDrawing::visible() const { return visible_in_rows(-kInfinity, kInfinity); }

LineDrawing::Lists LineDrawing::behind() const { return {behind_.begin(), behind_.end()}; }

void LineDrawing::forget_above(double y) {
    for (Rows& rows : visible_) {
        for (auto& list : rows.lists) forget_pieces_above(y, list);
    }
    std::erase_if(visible_, [](const Rows& rows) {
        return std::all_of(rows.lists.begin(), rows.lists.end(), [](const auto& list) { return list.empty(); });
    });
    for (auto& list : behind_) forget_pieces_above(y, list);
    std::erase_if(behind_, [](const auto& list) { return list.empty(); });
}

std::vector<std::vector<LinePiece>> LineDrawing::take_visible() {
    std::vector<std::vector<LinePiece>> taken;
    for (Rows& rows : visible_)
        taken.insert(taken.end(), std::make_move_iterator(rows.lists.begin()),
                     std::make_move_iterator(rows.lists.end()));
    visible_.clear();
    return taken;
}

}  // namespace burin
