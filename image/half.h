#pragma once

#include <bit>
#include <cstdint>

// EXR channels of type half need numbers of 16 bits, converted one by one or many at once.

namespace burin {

/// IEEE 754 half precision numbers as bit patterns: 1 sign, 5 exponent and 10 mantissa bits.

/// Rounds to the nearest half, ties to even. Beyond 65504 it gives infinity.
inline std::uint16_t half_from_float(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000u;
    const std::uint32_t magnitude = bits & 0x7FFFFFFFu;
    std::uint32_t half = 0;
    if (magnitude > 0x7F800000u) {
        half = 0x7E00u;  // NaN
    } else if (magnitude >= 0x477FF000u) {
        half = 0x7C00u;  // rounds to 65536 or more: infinity
    } else if (magnitude >= 0x38800000u) {
        // Normal: 13 mantissa bits go; adding just under half a unit, or half if odd, rounds.
        const std::uint32_t rounded = magnitude + 0xFFFu + (magnitude >> 13 & 1u);
        half = (rounded >> 13) - ((127u - 15u) << 10);
    } else {
        // Subnormal: adding 0.5 lets the float unit round to multiples of 2^-24.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
        half = std::bit_cast<std::uint32_t>(shifted) - 0x3F000000u;
    }
    return static_cast<std::uint16_t>(sign | half);
}

inline float float_from_half(std::uint16_t half) {
    const std::uint32_t sign = (half & 0x8000u) << 16;
    const std::uint32_t exponent = half >> 10 & 0x1Fu;
    const std::uint32_t mantissa = half & 0x3FFu;
    std::uint32_t bits = 0;
    if (exponent == 0x1Fu) {
        bits = 0x7F800000u | mantissa << 13;
    } else if (exponent != 0) {
        bits = (exponent + 127u - 15u) << 23 | mantissa << 13;
    } else {
        bits = std::bit_cast<std::uint32_t>(static_cast<float>(mantissa) * 0x1p-24f);
    }
    return std::bit_cast<float>(sign | bits);
}

/// Four at once, to the same bits, in the lower halves of lanes.
typedef float FourFloats __attribute__((vector_size(16)));
typedef std::int32_t FourHalves __attribute__((vector_size(16)));

inline FourHalves halves_from_floats(const FourFloats& values) {
    const FourHalves bits = std::bit_cast<FourHalves>(values), zero = {};
    const FourHalves sign = bits >> 16 & 0x8000, magnitude = bits & 0x7FFFFFFF;
    const FourHalves normal = ((magnitude + 0xFFF + (magnitude >> 13 & 1)) >> 13) - ((127 - 15) << 10);
    const FourHalves subnormal = std::bit_cast<FourHalves>(std::bit_cast<FourFloats>(magnitude) + 0.5f) - 0x3F000000;
    const FourHalves finite = magnitude >= 0x38800000 ? normal : subnormal;
    const FourHalves any = magnitude >= 0x477FF000 ? zero + 0x7C00 : finite;
    return sign | (magnitude > 0x7F800000 ? zero + 0x7E00 : any);
}

inline FourFloats floats_from_halves(const FourHalves& halves) {
    const FourHalves magnitude = (halves & 0x7FFF) << 13;
    const FourHalves finite = std::bit_cast<FourHalves>(std::bit_cast<FourFloats>(magnitude) * 0x1p112f);
    return std::bit_cast<FourFloats>((halves & 0x8000) << 16 |
                                     (magnitude >= 0x1F << 23 ? magnitude | 0x7F800000 : finite));
}

}  // namespace burin
