#include "shading/expression/lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "image/image_io.h"
#include "shading/expression/error.h"

namespace burin {
namespace {

int hexadecimal_digit(char c) {
    if (is_digit(c)) return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// A decimal number of any length; infinity if it is too large.
double decimal(std::string_view digits, std::size_t exponent_at, int exponent) {
    // How many digits stand in front of the point, from the first that is not 0 on, so that what cannot be a number of
    // single precision is known beforehand.
    const std::string_view mantissa = digits.substr(0, exponent_at);
    const std::size_t first = mantissa.find_first_not_of("0.");
    if (first == std::string_view::npos) return 0;
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const auto before_point = static_cast<long>(point) - static_cast<long>(first);
    const long magnitude = before_point + exponent;
    if (magnitude > 100) return HUGE_VAL;
    if (magnitude < -100) return 0;
    double value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value;
}

}  // namespace

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string in_quotes(std::string_view words) {
    constexpr std::size_t kMost = 40;
    std::size_t end = words.size();
    if (end > kMost) {
        end = kMost;
        while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xC0u) == 0x80u) --end;
    }
    std::string result = "'";
    for (const char c : words.substr(0, end)) result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    return result + (end < words.size() ? "...'" : "'");
}

void Lexer::fail(std::size_t offset, const char* message) const {
    throw ExpressionError(column_of(text_, offset), message);
}

std::size_t Lexer::skip_digits() {
    const std::size_t start = at_;
    while (is_digit(peek())) ++at_;
    return at_ - start;
}

Token Lexer::next() {
    while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') ++at_;
    const std::size_t start = at_;
    if (at_ == text_.size()) return {.words = {}, .offset = start};
    const char c = peek();
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return number(start);
    if (is_letter(c)) {
        while (is_letter(peek()) || is_digit(peek())) ++at_;
        return {.kind = TokenKind::name, .words = text_.substr(start, at_ - start), .offset = start};
    }
    if (c == '#') return color(start);
    if (c == '"') return quoted(start);
    return symbol(start);
}

Token Lexer::number(std::size_t start) {
    skip_digits();
    if (peek() == '.') {
        ++at_;
        skip_digits();
    }
    const std::size_t exponent_at = at_ - start;
    int exponent = 0;
    if (peek() == 'e' || peek() == 'E') {
        const bool has_sign = peek(1) == '-' || peek(1) == '+';
        if (is_digit(peek(has_sign ? 2 : 1))) {
            const bool is_negative = peek(1) == '-';
            at_ += has_sign ? 2 : 1;
            for (; is_digit(peek()); ++at_) exponent = std::min(100000, exponent * 10 + (peek() - '0'));
            if (is_negative) exponent = -exponent;
        }
    }
    const double value = decimal(text_.substr(start, at_ - start), exponent_at, exponent);
    if (!(value <= 3.4028234663852886e38)) fail(start, "the number is too large: the largest is 3.4e38");
    Token token{.kind = TokenKind::number, .words = {}, .offset = start, .number = static_cast<float>(value)};
    const std::size_t unit_at = at_;
    while (is_letter(peek()) || is_digit(peek())) ++at_;
    token.words = text_.substr(start, at_ - start);
    const std::string_view unit = text_.substr(unit_at, at_ - unit_at);
    if (unit == "mm") {
        token.unit = LengthUnit::mm;
    } else if (unit == "pt") {
        token.unit = LengthUnit::pt;
    } else if (unit == "world") {
        token.unit = LengthUnit::world;
    } else if (!unit.empty() && unit != "px") {
        throw ExpressionError(column_of(text_, unit_at),
                              "unknown unit " + in_quotes(unit) + ": give px, mm, pt or world");
    }
    return token;
}

Token Lexer::color(std::size_t start) {
    ++at_;
    while (is_letter(peek()) || is_digit(peek())) ++at_;
    Token token{.kind = TokenKind::color, .words = text_.substr(start, at_ - start), .offset = start};
    const std::string_view digits = token.words.substr(1);
    constexpr const char* kMessage = "a colour has six hexadecimal digits, as #1a2b3c";
    if (digits.size() != 6) fail(start, kMessage);
    for (std::size_t k = 0; k < 3; ++k) {
        const int high = hexadecimal_digit(digits[2 * k]), low = hexadecimal_digit(digits[2 * k + 1]);
        if (high < 0 || low < 0) fail(start, kMessage);
        token.color[k] = linear_from_srgb(static_cast<float>(16 * high + low) / 255.0f);
    }
    return token;
}

Token Lexer::quoted(std::size_t start) {
    const std::size_t end = text_.find('"', start + 1);
    if (end == std::string_view::npos) fail(start, "the text that begins here does not end: '\"' is missing");
    at_ = end + 1;
    return {.kind = TokenKind::text, .words = text_.substr(start + 1, end - start - 1), .offset = start};
}

Token Lexer::symbol(std::size_t start) {
    const std::string_view two = text_.substr(start, 2);
    if (two == "&&") fail(start, "unexpected '&&': use 'and'");
    if (two == "||") fail(start, "unexpected '||': use 'or'");
    const bool is_long = two == "<=" || two == ">=" || two == "==" || two == "!=";
    const char c = text_[start];
    if (!is_long) {
        if (c == '!') fail(start, "unexpected '!': use 'not', or '!=' for different");
        if (c == '=') fail(start, "unexpected '=': use '==' for equal");
        if (c == '\'') fail(start, "unexpected ''': texts stand in double quotes");
        if (c == '{' || c == '[') fail(start, "unexpected bracket: use '('");
        if (std::string_view("+-*/%^(),?:<>.").find(c) == std::string_view::npos) {
            if (c <= ' ' || c > '~') fail(start, "unexpected character");
            throw ExpressionError(column_of(text_, start), "unexpected " + in_quotes({&c, 1}));
        }
    }
    at_ += is_long ? 2 : 1;
    return {.kind = TokenKind::symbol, .words = text_.substr(start, is_long ? 2 : 1), .offset = start};
}

}  // namespace burin
