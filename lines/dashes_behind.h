#pragma once

#include <array>
#include <span>
#include <vector>

#include "lines/course_index.h"
#include "lines/dash_pen.h"
#include "lines/line_dashes.h"
#include "lines/line_piece.h"
#include "lines/whole_line_index.h"

namespace burin {

/// DashesBehind cuts lines behind surfaces into dashes. They run along whole lines, seen or not; features are laid out
/// first, so that their dashes are where those of the visible parts are.
class DashesBehind {
  public:
    /// `lines`: all whole lines of a picture of this size, which must outlive it. `dash_px`, `width_px`: see DashPen.
    DashesBehind(std::span<const WholeLine> lines, const SurfaceSet& surfaces, PixelRect picture,
                 std::array<double, 2> dash_px, double width_px);

    /// Adds the dashes of a piece. `visible`: nullptr, or where dashed visible lines are: the piece has no dashes
    /// there, or those of either would fill the gaps of the other.
    void add(const LinePiece& piece, CourseIndex* visible, std::vector<LinePiece>& dashes) const;

  private:
    void add_between(const LinePiece& piece, std::uint32_t line, double begin, double end,
                     std::vector<LinePiece>& dashes) const;

    std::span<const WholeLine> lines_;
    WholeLineIndex index_;
    DashPen pen_;
    std::vector<LineDashes> groups_;
    std::vector<std::uint8_t> group_;    // of each line
    std::vector<std::uint32_t> number_;  // in its group
};

}  // namespace burin
