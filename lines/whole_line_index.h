#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lines/line_piece.h"
#include "lines/whole_line.h"

namespace burin {

/// Finds the whole line that a piece lies on, among some.
class WholeLineIndex {
  public:
    /// `lines` must outlive it.
    explicit WholeLineIndex(std::span<const WholeLine> lines);

    /// The number of the line that a piece is part of, if there is one. Of an edge that is several lines, the one at
    /// the piece.
    std::optional<std::uint32_t> find(const LinePiece& piece) const;
    /// Where along a line a place is, in pixels: as a share of the way from its first end to the other.
    static double share_of(const WholeLine& line, glm::dvec2 place);

  private:
    std::span<const WholeLine> lines_;
    std::vector<std::pair<LineId, std::uint32_t>> numbers_;  // sorted
};

}  // namespace burin
