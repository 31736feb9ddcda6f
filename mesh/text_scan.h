#pragma once

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "base/error.h"
#include "mesh/digit_scan.h"
#include "mesh/line_ends.h"

// Numbers and lines of a text are read here, with the line numbers that messages need.

namespace burin {

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

/// Reads one number at `p`, correctly rounded. Returns the place behind it, or nullptr if there is
/// none. Accepts what C's strtod accepts in decimal, and a leading '+'.
///
/// The short way is exact: up to 15 digits fit a double, and so do powers of ten up to 22, so one
/// multiplication or division rounds once (Clinger 1990). Everything else goes to from_chars.
inline const char* scan_number(const char* p, const char* end, double& value) {
    if (end - p >= kScanReach) {
        if (const char* const next = scan_plain_decimal(p, value)) return next;
    }
    const char* const start = p;
    const bool negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+')) ++p;
    const char* const digits_start = p;
    std::uint64_t mantissa = 0;
    while (p < end && is_digit(*p)) mantissa = 10 * mantissa + static_cast<unsigned>(*p++ - '0');
    std::ptrdiff_t digits = p - digits_start;
    int exponent = 0;
    if (p < end && *p == '.') {
        const char* const fraction_start = ++p;
        while (p < end && is_digit(*p)) {
            mantissa = 10 * mantissa + static_cast<unsigned>(*p++ - '0');
        }
        digits += p - fraction_start;
        exponent = -static_cast<int>(p - fraction_start);
    }
    bool simple = digits > 0 && digits <= 15 && exponent >= -22;
    if (simple && p < end && (*p == 'e' || *p == 'E')) {
        const char* q = p + 1;
        const bool negative_exponent = q < end && *q == '-';
        if (q < end && (*q == '-' || *q == '+')) ++q;
        int written = 0;
        const char* const exponent_start = q;
        while (q < end && is_digit(*q) && q - exponent_start < 4) written = 10 * written + (*q++ - '0');
        if (q > exponent_start) {
            exponent += negative_exponent ? -written : written;
            p = q;
            simple = exponent >= -22 && exponent <= 22 && !(q < end && is_digit(*q));
        }
    }
    if (simple) {
        const double magnitude = static_cast<double>(mantissa);
        const double scaled = exponent < 0 ? magnitude / kPowersOfTen[-exponent] : magnitude * kPowersOfTen[exponent];
        value = negative ? -scaled : scaled;
        return p;
    }
    const char* const from = start < end && *start == '+' ? start + 1 : start;
    if (from != start && from < end && *from == '-') return nullptr;
    const auto [ptr, error] = std::from_chars(from, end, value);
    if (error == std::errc::result_out_of_range) {
        // from_chars does not say whether it was too small or too large; strtod does.
        value = std::strtod(std::string(from, ptr).c_str(), nullptr);
        return ptr;
    }
    return error == std::errc() ? ptr : nullptr;
}

/// Reads a decimal integer at `p`. Returns the place behind it, or nullptr if there is none or it
/// does not fit 64 bits.
inline const char* scan_integer(const char* p, const char* end, std::int64_t& value) {
    if (p < end && *p == '+' && ++p < end && *p == '-') return nullptr;
    const auto [ptr, error] = std::from_chars(p, end, value);
    return error == std::errc() ? ptr : nullptr;
}

/// One line of a text file, or a part of it.
class LineScanner {
  public:
    LineScanner(std::string_view line) : p_(line.data()), end_(line.data() + line.size()) {}

    void skip_blanks() {
        while (p_ < end_ && is_blank(*p_)) ++p_;
    }
    bool at_end() {
        skip_blanks();
        return p_ == end_;
    }
    /// The next word, empty at the end.
    std::string_view word() {
        skip_blanks();
        const char* const start = p_;
        while (p_ < end_ && !is_blank(*p_)) ++p_;
        return {start, static_cast<std::size_t>(p_ - start)};
    }
    /// Everything that is left, without blanks around it.
    std::string_view rest() {
        skip_blanks();
        const char* last = end_;
        while (last > p_ && is_blank(last[-1])) --last;
        return {p_, static_cast<std::size_t>(last - p_)};
    }
    bool number(double& value) {
        skip_blanks();
        const char* const next = scan_number(p_, end_, value);
        if (next == nullptr || (next < end_ && !is_blank(*next))) return false;
        p_ = next;
        return true;
    }
    bool integer(std::int64_t& value) {
        skip_blanks();
        const char* const next = scan_integer(p_, end_, value);
        if (next == nullptr || (next < end_ && !is_blank(*next))) return false;
        p_ = next;
        return true;
    }

  private:
    const char* p_;
    const char* end_;
};

/// A word as ASCII small letters: many formats have keywords in either case.
inline std::string lower_case(std::string_view word) {
    std::string result(word);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

/// Goes through a text line by line and counts the lines.
class LineReader {
  public:
    explicit LineReader(std::string_view text) : p_(text.data()), end_(text.data() + text.size()) {}

    /// Fetches the next line without its line end; false at the end of the text.
    bool next(std::string_view& line) {
        if (p_ == end_) return false;
        const char* const line_end = find_line_end(p_, end_);
        line = {p_, static_cast<std::size_t>(line_end - p_)};
        p_ = behind_line_end(line_end, end_);
        ++line_number_;
        return true;
    }
    /// Goes on behind the line feed at `feed`, which is that of the next line.
    void pass(const char* feed) {
        p_ = feed + 1;
        ++line_number_;
    }
    std::size_t line_number() const { return line_number_; }
    /// Text behind the last line fetched.
    std::string_view rest() const { return {p_, static_cast<std::size_t>(end_ - p_)}; }

  private:
    const char* p_;
    const char* end_;
    std::size_t line_number_ = 0;
};

/// Text without the mark that some editors of Windows put before UTF-8.
inline std::string_view without_byte_order_mark(std::string_view text) {
    return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

/// Text from a file, safe to print inside a one-line message: cut short, no control characters.
inline std::string printable(std::string_view text, std::size_t max_length = 40) {
    std::string result;
    for (const char c : text.substr(0, max_length)) {
        result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    }
    if (text.size() > max_length) result += "...";
    return result;
}

/// Coordinates beyond this are refused: their squares and products must stay finite.
constexpr double kLargestCoordinate = 1e30;

}  // namespace burin
