#pragma once

#include <span>
#include <string_view>

#include "render/method.h"

// The table has every way to draw lines, by its name on the command line.

namespace burin {

/// All methods of this version; the first one is the default.
std::span<const Method> methods();

/// nullptr if there is none of that name.
const Method* find_method(std::string_view name);

}  // namespace burin
