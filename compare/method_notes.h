#pragma once

#include <string_view>

// Notes say what the figures of a method do not tell.

namespace burin {

/// What a reader of a comparison should know about a method.
struct MethodNote {
    std::string_view name;
    int passes;               ///< times that the geometry or the picture is gone through
    std::string_view how;     ///< how it finds and draws lines
    std::string_view limits;  ///< what it is known to do badly, from its source or its followers
};

/// nullptr if there is none.
const MethodNote* find_method_note(std::string_view name);

}  // namespace burin
