#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace burin {

/// The character that a text begins with, and of how many bytes it is; 0 for what is no UTF-8, of one byte.
struct Utf8Character {
    std::uint32_t code;
    std::size_t bytes;
};
Utf8Character first_character(std::string_view text);

}  // namespace burin
