#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "shading/sheet/compiled_sheet.h"

// Shaders and tests of programs are run here, in batches, and every number that they leave is checked.

namespace burin {

/// Has the shader of a style change the ink of `count` samples. `ink`: columns in the order of CompiledStyle::ink, with
/// what that computed; then with finite numbers in the same ranges. Returns for each InkValue how many samples had NaN,
/// which became 0, a colour as a whole.
std::array<NotNumbers, kInkValueCount> run_shader(const CompiledStyle& style, const VariableColumns& variables,
                                                  std::size_t count, std::span<float* const> ink);

/// Has a test fill `strength`, from 0 to 1, for the samples of a style. Returns how many samples had NaN, which became
/// 0.
NotNumbers run_test(const LineTest& test, const CompiledStyle& style, const VariableColumns& variables,
                    std::span<float> strength);

}  // namespace burin
