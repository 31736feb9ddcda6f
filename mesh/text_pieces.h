#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace burin {

/// Where a part of a text begins: at the start of a line.
struct TextPiece {
    const char* begin = nullptr;
    std::size_t line = 0;  ///< its number
};

/// Cuts a text whose first line has the number `first_line` into pieces of similar size, for many
/// threads to read at the same time. The first one begins where the text does. Lines are counted on
/// `threads` threads.
std::vector<TextPiece> split_at_lines(std::string_view text, std::size_t first_line, int threads);

}  // namespace burin
