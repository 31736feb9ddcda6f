#pragma once

#include "render/frame.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {

/// What compiling a style sheet must know of a frame.
SheetContext sheet_context_of(const Frame& frame);

}  // namespace burin
