#pragma once

#include <string>
#include <vector>

#include "shading/ink/inked_lines.h"
#include "shading/ink/line_columns.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {

/// What is wanted beside strokes.
struct InkWishes {
    bool origins = false;     ///< InkedLines::origins
    bool cuts_dashes = true;  ///< else strokes of constant ink keep their pattern in StrokeOrigin
};

/// Draws lines as a style sheet says: finds the line sets that take each piece, evaluates their styles at as many
/// stroke samples as the bound on errors needs, and makes strokes of them. This is the same for all outputs.
///
/// The bounds, beside what a straight change between two samples gives: of width 1 % of it, at least 1/64 and at most
/// 1/8 pixel; of places 1/16 pixel; of opacity and of each colour channel 1/128.
///
/// `lines`: with what the sheet needs. `notes`: gets a message for each value that was no number.
InkedLines ink_lines(const FoundLines& lines, const CompiledSheet& sheet, int threads, std::vector<std::string>& notes,
                     const InkWishes& wishes = {});

}  // namespace burin
