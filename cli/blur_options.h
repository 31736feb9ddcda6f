#pragma once

#include <array>
#include <string>

#include "cli/arguments.h"

namespace burin {

/// Options of motion blur and depth of field as they were typed.
struct BlurTexts {
    std::string shutter, samples, lens, focus;
};

/// How an option is typed, and what the help says of it.
struct BlurOption {
    const char* name;
    std::string* text;
    const char* help;
};
std::array<BlurOption, 4> blur_options(BlurTexts& texts);

/// Checks them. Throws UsageError.
void fill_blur_options(const BlurTexts& texts, Arguments& arguments);

}  // namespace burin
