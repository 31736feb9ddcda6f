#pragma once

#include <cstddef>
#include <cstdlib>
#include <string>

#include "mesh/text_scan.h"

namespace burin::test {

/// Reads a number like -12.345 with 15 digits at most, one of them at least on either side of the point. Returns the
/// place behind it, or nullptr. The text must end with something that is no part of a number.
inline const char* plain_decimal(const char* p, double& value) {
    const char* q = p + (*p == '-' ? 1 : 0);
    const char* const whole = q;
    while (is_digit(*q)) ++q;
    const std::ptrdiff_t before = q - whole;
    if (*q != '.') return nullptr;
    const char* const fraction = ++q;
    while (is_digit(*q)) ++q;
    const std::ptrdiff_t behind = q - fraction;
    if (before == 0 || behind == 0 || before + behind > 15) return nullptr;
    const std::string number(p, q);
    value = std::strtod(number.c_str(), nullptr);
    return q;
}

}  // namespace burin::test
