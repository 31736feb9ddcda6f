#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace burin {

/// What is wrong with an expression, and where. Whoever knows the file makes an InputError of it.
class ExpressionError : public std::runtime_error {
  public:
    ExpressionError(std::size_t column, const std::string& message) : std::runtime_error(message), column_(column) {}
    /// In the text of the expression, in characters, from 1; one more than the text has: at its end.
    std::size_t column() const { return column_; }

  private:
    std::size_t column_;
};

/// The column of a byte of a text in UTF-8.
inline std::size_t column_of(std::string_view text, std::size_t offset) {
    std::size_t column = 1;
    for (std::size_t i = 0; i < offset && i < text.size(); ++i) {
        if ((static_cast<unsigned char>(text[i]) & 0xC0u) != 0x80u) ++column;
    }
    return column;
}

/// Words of an input as messages show them: in quotes, at most 40 bytes, without control characters.
std::string in_quotes(std::string_view words);

}  // namespace burin
