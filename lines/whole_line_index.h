#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lines/line_piece.h"
#include "lines/whole_line.h"

namespace burin {

/// WholeLineIndex finds, among some whole lines, the one that a piece lies on.
class WholeLineIndex {
  public:
    /// `lines` must outlive it.
    explicit WholeLineIndex(std::span<const WholeLine> lines);

    /// The number of the line that a piece is part of, if there is one. Of an edge that is several lines, the one at
    /// the piece.
    std::optional<std::uint32_t> find(const LinePiece& piece) const;
    /// How far along a line a place is, given in pixels: a share of the way from the first end to the other.
    static double share_of(const WholeLine& line, glm::dvec2 place);

  private:
    std::span<const WholeLine> lines_;
    std::vector<std::pair<LineId, std::uint32_t>> numbers_;  // sorted
};

}  // namespace burin
