#pragma once

#include <string>
#include <vector>

#include "burin/drawing.h"
#include "shading/ink/ink_lines.h"

namespace burin {

/// Makes ink of a drawing's lines, which were found for a style sheet. `style`: the text of another sheet, its name or
/// file; nullptr: the sheet that they were found for. Throws InputError for a sheet that is wrong, UsageError for one
/// that needs more than the drawing has. `notes`: gets what users should know.
InkedLines inked_lines_of(const burin_drawing& drawing, const char* style, int threads, std::vector<std::string>& notes,
                          const InkWishes& wishes = {});

}  // namespace burin
