#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lines/line_piece.h"

// Lines that met before some of them were moved are joined again.

namespace burin {

/// A visible piece where a surface ends, and where it was moved to: two points or more.
struct MovedLine {
    const LinePiece* given;
    std::vector<glm::dvec2> points;
    bool is_moved = false;
};

/// An end of a moved line that is joined to one that stayed: the line's number, and where it was.
struct LeadIn {
    std::uint32_t line;
    glm::dvec2 place;
};

/// What joins lines again that met before they were moved, at their ends or where one ends beside another, so that
/// outlines stay closed. The order of the lines does not matter.
struct Joints {
    std::vector<LinePiece> pieces;
    std::vector<LeadIn> to_lines_that_stay;
};
Joints find_joints(std::span<const MovedLine> lines);

}  // namespace burin
