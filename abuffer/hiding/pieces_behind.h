#pragma once

#include <span>
#include <vector>

#include "lines/drawing_needs.h"
#include "lines/line_piece.h"
#include "lines/whole_line.h"

namespace burin {

/// Prefetches a line, which lies anywhere in memory.
inline void prefetch(const WholeLine& line) {
    const char* const at = reinterpret_cast<const char*>(&line);
    for (std::size_t byte = 0; byte < sizeof line; byte += 64) __builtin_prefetch(at + byte);
}

/// Parts of whole lines that surfaces are in front of become pieces, as far as a look needs them. Those that look alike
/// and follow each other are one piece, unless a look tells one invisibility from another. `farthest_nearness`: what
/// the lines' nearness counts from.
std::vector<LinePiece> pieces_behind(std::span<const WholeLine> lines, std::span<const LinePart> parts,
                                     const DrawingNeeds& needs, double farthest_nearness);

}  // namespace burin
