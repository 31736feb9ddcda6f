#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "render/frame.h"
#include "shading/ink/line_columns.h"
#include "shading/sheet/style_sheet.h"

// Parameters and lets that stand in a style's values.

namespace burin {

/// A parameter or a let, and its value at a place: a length in pixels.
struct ExplainedName {
    std::string name;
    ValueType type = ValueType::number;
    std::array<float, 3> value{};  ///< a number: in the first one; a colour: linear RGB
};

/// Those that the texts of some values name themselves, in the order in which they do.
std::vector<ExplainedName> names_in(std::span<const StyleValue* const> values, const Frame& frame,
                                    const LineColumns& lines, const LineSample& sample, const SampleVariant& variant);

}  // namespace burin
