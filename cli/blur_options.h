#pragma once

#include <string>

#include "cli/arguments.h"

namespace burin {

/// Options of motion blur and depth of field as they were typed.
struct BlurTexts {
    std::string shutter, samples, lens, focus;
};

/// Checks them. Throws UsageError.
void fill_blur_options(const BlurTexts& texts, Arguments& arguments);

}  // namespace burin
