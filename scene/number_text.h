#pragma once

#include <cstdio>
#include <string>

namespace burin {

/// A number as messages show it.
inline std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

}  // namespace burin
