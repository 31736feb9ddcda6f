#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

// The pieces near a place are looked up by cells of the screen, from the nearest ring outwards.

namespace burin {

/// The ends of a straight piece on the screen, in pixels.
struct PieceEnds {
    glm::dvec2 from{0.0}, to{0.0};
};

/// BoundaryCells sorts straight pieces into square cells of the screen, to be looked at ring by ring around another
/// piece. Buffers are used again.
class BoundaryCells {
  public:
    /// Some cells: columns [x0, x1) and rows [y0, y1).
    struct Box {
        int x0, y0, x1, y1;
    };

    /// Sorts the pieces, which are numbered as they come. Few are in one cell. Pieces farther than 1200 pixels from
    /// `place` are in the outermost cells.
    void set(std::span<const PieceEnds> pieces, glm::dvec2 place);

    bool is_one() const { return columns_ == 1 && rows_ == 1; }
    /// The cells that a piece lies in; the outermost ones if it lies beyond all.
    Box cells_of(const PieceEnds& piece) const;
    /// Whether there are no cells `ring` steps away, or farther.
    bool is_beyond(const Box& middle, int ring) const {
        return ring > middle.x0 && ring > middle.y0 && middle.x1 + ring > columns_ && middle.y1 + ring > rows_;
    }
    /// All pieces that are not in this ring or in one before it are as far away from what is in the middle, or farther.
    static double distance_px(int ring) { return kCellPx * ring; }
    /// Calls visit(number) for the pieces in the cells `ring` steps from those in the middle. A piece may lie in
    /// several.
    template <typename Visit>
    void for_ring(const Box& middle, int ring, const Visit& visit) const {
        const int x0 = middle.x0 - ring, x1 = middle.x1 + ring, y0 = middle.y0 - ring, y1 = middle.y1 + ring;
        for (int y = y0 < 0 ? 0 : y0; y < y1 && y < rows_; ++y) {
            const bool is_whole = ring == 0 || y == y0 || y == y1 - 1;
            for (int x = x0 < 0 ? 0 : x0; x < x1 && x < columns_; ++x) {
                if (!is_whole && x != x0 && x < x1 - 1) x = x1 - 1;  // on to the last one
                if (x >= columns_) break;
                const auto cell =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
                for (std::uint32_t i = end_[cell]; i < end_[cell + 1]; ++i) visit(numbers_[i]);
            }
        }
    }

  private:
    static constexpr double kCellPx = 16;

    glm::dvec2 from_{0.0};
    int columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> end_{0, 0}, next_, numbers_;  // cell by cell
};

}  // namespace burin
