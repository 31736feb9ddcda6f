#pragma once

#include <cstdint>
#include <vector>

#include "shading/ink/line_columns.h"
#include "shading/ink/stroke_values.h"
#include "shading/sheet/compiled_sheet.h"

// Which sets draw which pieces, cut into parts of the work that do not depend on the number of threads.

namespace burin {

/// The line sets of each piece.
SetMatches match_pieces(const LineColumns& lines, const CompiledSheet& sheet);

/// A part of the work: stretches that one set draws.
struct LineChunk {
    std::uint32_t set = 0;
    std::vector<LineStretch> stretches;
    std::size_t pieces = 0;
};

/// The work for all sets, set by set.
std::vector<LineChunk> chunks_of(const LineRuns& runs, const SetMatches& matches, std::size_t set_count);

}  // namespace burin
