#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

// The digits of plain numbers in a text are read eight at a time.

namespace burin {

/// Digits of a text, eight at a time (Lemire 2021, "Number Parsing at a Gigabyte per Second"), for
/// the plain numbers that fill model files: no branch depends on how many digits a number has.

/// How many bytes behind its start a scan below may look at.
constexpr std::ptrdiff_t kScanReach = 32;

/// The eight characters at `p`, the first one in the lowest byte, with '0' as 0.
inline std::uint64_t load_eight(const char* p) {
    std::uint64_t bytes;
    std::memcpy(&bytes, p, 8);
    if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
    return bytes ^ 0x3030303030303030u;
}

/// How many digits the eight characters start with, 0..8.
inline int count_digits(std::uint64_t eight) {
    // Carries run to later characters only, so all up to the first that is no digit are right.
    const std::uint64_t others = ((eight + 0x7676767676767676u) | eight) & 0x8080808080808080u;
    return std::countr_zero(others) / 8;
}

/// The number that the first `count` characters make, 1..8 digits.
inline std::uint32_t value_of_digits(std::uint64_t eight, int count) {
    eight <<= 64 - 8 * count;  // zeros in front
    eight = (eight * 10 + (eight >> 8)) & 0x00FF00FF00FF00FFu;
    eight = (eight * 100 + (eight >> 16)) & 0x0000FFFF0000FFFFu;
    return static_cast<std::uint32_t>(eight * 10000 + (eight >> 32));
}

/// The powers of ten that a double holds exactly.
inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                          1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
inline constexpr std::uint64_t kIntegerPowersOfTen[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

/// Reads 1..7 digits at `p`. Returns the place behind them, or nullptr if there are more or none.
/// `p` must have kScanReach bytes.
inline const char* scan_plain_integer(const char* p, std::uint32_t& value) {
    const std::uint64_t eight = load_eight(p);
    const int count = count_digits(eight);
    if (static_cast<unsigned>(count - 1) > 6) return nullptr;
    value = value_of_digits(eight, count);
    return p + count;
}

/// Reads a number like -12.345 at `p`: at most 7 digits before the point, if there is one 1..8
/// digits behind it, no exponent. Returns the place behind it, or nullptr for any other text.
/// Correctly rounded: up to 15 digits and powers of ten up to 22 fit a double, so the one division
/// is the only rounding (Clinger 1990). `p` must have kScanReach bytes.
inline const char* scan_plain_decimal(const char* p, double& value) {
    const bool negative = *p == '-';
    std::uint32_t whole = 0;
    p = scan_plain_integer(p + negative, whole);
    if (p == nullptr) return nullptr;
    std::int64_t digits = whole;  // converts to double faster than an unsigned one
    int places = 0;
    if (*p == '.') {
        const std::uint64_t eight = load_eight(++p);
        places = count_digits(eight);
        if (places == 0) return nullptr;
        digits = static_cast<std::int64_t>(whole * kIntegerPowersOfTen[places]) + value_of_digits(eight, places);
        p += places;
    }
    // A ninth digit, a second point or an exponent.
    if (static_cast<unsigned char>(*p - '0') < 10 || *p == '.' || (*p | 0x20) == 'e') return nullptr;
    const double magnitude = static_cast<double>(digits) / kPowersOfTen[places];
    value = negative ? -magnitude : magnitude;
    return p;
}

}  // namespace burin
