#pragma once

#include <deque>
#include <span>
#include <vector>

#include "lines/line_piece.h"
#include "lines/whole_line.h"
#include "view/pixel_tiles.h"

namespace burin {

/// A LineDrawing is the lines of a picture as data: found once, drawn as often as one likes. Pieces keep the order in
/// which tiles lie in the picture, whichever threads found them.
class LineDrawing {
  public:
    /// Pieces of lines, list after list.
    using Lists = std::vector<std::span<const LinePiece>>;

    /// Makes room for the visible lines of rows of tiles, which lie below those that there are.
    void begin_rows(const PixelTiles& tiles);
    /// Puts the visible lines of one of these tiles. Any thread may call it, once for each tile.
    void put_visible(std::size_t tile, std::span<const LinePiece> pieces);
    /// Adds visible lines that may lie anywhere.
    void add_visible(std::vector<LinePiece> pieces);
    /// Adds parts of lines that surfaces are in front of.
    void add_behind(std::vector<LinePiece> pieces);
    /// Adds edges and intersections as wholes, seen or not, where DrawingNeeds::whole_lines asks for them.
    void add_whole_lines(std::vector<WholeLine> lines);

    /// The visible lines of tiles that have rows in [from_y, to_y). Other threads may put what is further down.
    Lists visible_in_rows(double from_y, double to_y) const;
    Lists visible() const;
    Lists behind() const;
    std::span<const WholeLine> whole_lines() const { return whole_lines_; }

    /// Forgets the pieces that lie above a row of pixels: what keeps memory bounded.
    void forget_above(double y);
    /// Gives away the visible lines; it has none then.
    std::vector<std::vector<LinePiece>> take_visible();

  private:
    /// Lists of the tiles of some rows.
    struct Rows {
        double y0;
        double tile_px;
        std::size_t columns;
        std::vector<std::vector<LinePiece>> lists;
    };
    std::deque<Rows> visible_;
    std::vector<std::vector<LinePiece>> behind_;
    std::vector<WholeLine> whole_lines_;
};

}  // namespace burin
