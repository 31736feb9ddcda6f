#pragma once

#include <span>
#include <string_view>

#include "render/patel.h"

namespace burin {

/// A way to draw the lines of a frame.
struct Method {
    std::string_view name;    ///< as on the command line
    std::string_view source;  ///< author, title, year
    LineClassSet draws;       ///< the classes that it can draw at all
    RenderStats (*render)(const Frame&, const RunOptions&, Film&);
};

/// All methods of this version; the first one is the default.
std::span<const Method> methods();

/// nullptr if there is none of that name.
const Method* find_method(std::string_view name);

/// Names that are reserved for methods of later versions.
bool is_planned_method(std::string_view name);

}  // namespace burin
