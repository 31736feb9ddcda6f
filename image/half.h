#pragma once

#include <cstdint>

namespace burin {

/// IEEE 754 half precision numbers as bit patterns: 1 sign, 5 exponent and 10 mantissa bits.

/// Rounds to the nearest half, ties to even. Beyond 65504 it gives infinity.
std::uint16_t half_from_float(float value);
float float_from_half(std::uint16_t half);

}  // namespace burin
