#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace burin {

enum class TokenKind : std::uint8_t { end, number, color, text, name, symbol };
enum class LengthUnit : std::uint8_t { px, mm, pt, world };

/// A word of an expression.
struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view words;  ///< as written; of a text: without its quotes
    std::size_t offset = 0;  ///< of its first byte
    float number = 0;
    LengthUnit unit = LengthUnit::px;  ///< of a number; px where there is none
    std::array<float, 3> color{};      ///< linear RGB

    bool is(std::string_view symbol) const { return kind == TokenKind::symbol && words == symbol; }
    bool is_name(std::string_view name) const { return kind == TokenKind::name && words == name; }
};

/// Takes an expression apart, word by word.
class Lexer {
  public:
    explicit Lexer(std::string_view text) : text_(text) {}
    /// Throws ExpressionError where no word begins.
    Token next();

  private:
    Token number(std::size_t start);
    Token color(std::size_t start);
    Token quoted(std::size_t start);
    Token symbol(std::size_t start);
    [[noreturn]] void fail(std::size_t offset, const char* message) const;
    std::size_t skip_digits();
    char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

    std::string_view text_;
    std::size_t at_ = 0;
};

bool is_letter(char c);  ///< one of those that names begin with, _ included
bool is_digit(char c);

}  // namespace burin
