#pragma once

#include <string>
#include <string_view>

namespace burin {

/// A text as the value of an XML attribute between double quotes. What is no UTF-8, and characters that XML has not,
/// such as most control characters, become U+FFFD.
std::string xml_text(std::string_view text);

}  // namespace burin
