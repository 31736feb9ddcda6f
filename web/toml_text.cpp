#include "web/toml_text.h"

#include <sstream>

namespace burin {

std::string text_of_toml(const toml::node& node) {
    // Of texts in single quotes, and of several lines, toml++ 3.3 writes some that do not read back.
    constexpr toml::format_flags kFlags =
        toml::toml_formatter::default_flags &
        ~(toml::format_flags::allow_literal_strings | toml::format_flags::allow_multi_line_strings);
    std::ostringstream text;
    text << toml::toml_formatter(node, kFlags);
    return text.str();
}

}  // namespace burin
