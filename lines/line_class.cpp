#include "lines/line_class.h"

#include <algorithm>

namespace burin {

std::optional<LineClass> line_class_named(std::string_view name) {
    const auto it = std::find(kLineClassNames.begin(), kLineClassNames.end(), name);
    if (it == kLineClassNames.end()) return std::nullopt;
    return static_cast<LineClass>(it - kLineClassNames.begin());
}

std::string to_string(LineClassSet classes) {
    std::string text;
    for (int i = 0; i < kLineClassCount; ++i) {
        if (!classes.has(static_cast<LineClass>(i))) continue;
        if (!text.empty()) text += ',';
        text += kLineClassNames[static_cast<std::size_t>(i)];
    }
    return text;
}

}  // namespace burin
