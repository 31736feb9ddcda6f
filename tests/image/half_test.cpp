#include "image/half.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

constexpr std::uint16_t kInfinity = 0x7C00;

/// The value of a finite half by its definition.
double value_of(std::uint16_t half) {
    const int exponent = half >> 10 & 31;
    const int mantissa = half & 1023;
    const double magnitude = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

/// The nearest half by search among all of them; of two equally near ones the even one.
std::uint16_t nearest_half(float value) {
    const auto sign = static_cast<std::uint16_t>(std::signbit(value) ? 0x8000 : 0);
    const double magnitude = std::abs(static_cast<double>(value));
    // Positive halves are in the order of their bits; 0x7C00 stands for 65536 while rounding.
    int low = 0, high = kInfinity;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        (value_of(static_cast<std::uint16_t>(middle)) <= magnitude ? low : high) = middle;
    }
    const double below = value_of(static_cast<std::uint16_t>(low));
    const double above = high == kInfinity ? 65536.0 : value_of(static_cast<std::uint16_t>(high));
    if (magnitude >= 65536.0) return static_cast<std::uint16_t>(sign | kInfinity);
    const double to_below = magnitude - below, to_above = above - magnitude;  // exact
    const bool up = to_above < to_below || (to_above == to_below && (low & 1) != 0);
    return static_cast<std::uint16_t>(sign | (up ? high : low));
}

TEST(Half, EveryHalfSurvivesTheWayToFloatAndBack) {
    for (unsigned bits = 0; bits < 0x10000; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const float value = float_from_half(half);
        if ((half & 0x7FFF) > kInfinity) {
            ASSERT_TRUE(std::isnan(value)) << bits;
            ASSERT_TRUE(std::isnan(float_from_half(half_from_float(value)))) << bits;
            continue;
        }
        if ((half & 0x7FFF) == kInfinity) {
            ASSERT_TRUE(std::isinf(value)) << bits;
        } else {
            ASSERT_EQ(static_cast<double>(value), value_of(half)) << bits;
        }
        ASSERT_EQ(std::signbit(value), (half & 0x8000) != 0) << bits;
        ASSERT_EQ(half_from_float(value), half) << bits;
    }
}

TEST(Half, LargerBitsAreLargerNumbers) {
    for (unsigned bits = 0; bits < kInfinity; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const auto next = static_cast<std::uint16_t>(bits + 1);
        ASSERT_LT(float_from_half(half), float_from_half(next)) << bits;
        ASSERT_GT(float_from_half(half | 0x8000), float_from_half(next | 0x8000)) << bits;
    }
}

TEST(Half, RoundsHalfwayToEven) {
    for (unsigned bits = 0; bits < kInfinity; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const double above = bits + 1 == kInfinity ? 65536.0 : value_of(static_cast<std::uint16_t>(bits + 1));
        const auto middle = static_cast<float>((value_of(half) + above) / 2);  // exact in a float
        for (const float near : {std::nextafter(middle, 0.0f), middle, std::nextafter(middle, 1e9f)}) {
            ASSERT_EQ(half_from_float(near), nearest_half(near)) << bits;
            ASSERT_EQ(half_from_float(-near), nearest_half(-near)) << bits;
        }
    }
}

TEST(Half, RoundsRandomNumbersToTheNearest) {
    Random random(1);
    for (int trial = 0; trial < 300000; ++trial) {
        const float any = std::bit_cast<float>(random.bits());
        if (!std::isnan(any)) {
            ASSERT_EQ(half_from_float(any), nearest_half(any)) << trial << ": " << any;
        }
        const auto usual = static_cast<float>(std::ldexp(random.real(-1, 1), random.integer(-30, 18)));
        ASSERT_EQ(half_from_float(usual), nearest_half(usual)) << trial << ": " << usual;
    }
}

TEST(Half, FourAtOnceAreTheSame) {
    for (unsigned bits = 0; bits < 0x10000; bits += 4) {
        FourHalves halves{};
        for (unsigned k = 0; k < 4; ++k) halves[k] = static_cast<std::int32_t>(bits + k);
        const FourFloats values = floats_from_halves(halves);
        for (unsigned k = 0; k < 4; ++k) {
            const float one = float_from_half(static_cast<std::uint16_t>(bits + k));
            ASSERT_EQ(std::bit_cast<std::uint32_t>(float{values[k]}), std::bit_cast<std::uint32_t>(one)) << bits + k;
        }
    }
    Random random(2);
    for (int trial = 0; trial < 100000; ++trial) {
        FourFloats values{};
        for (unsigned k = 0; k < 4; ++k) {
            const float usual = static_cast<float>(std::ldexp(random.real(-1, 1), random.integer(-30, 18)));
            const float halfway = float_from_half(static_cast<std::uint16_t>(random.bits())) * (1 + 0x1p-11f);
            values[k] = trial % 3 == 0 ? std::bit_cast<float>(random.bits()) : trial % 3 == 1 ? usual : halfway;
        }
        const FourHalves halves = halves_from_floats(values);
        for (unsigned k = 0; k < 4; ++k) ASSERT_EQ(halves[k], half_from_float(values[k])) << trial << ": " << values[k];
    }
}

TEST(Half, SpecialNumbers) {
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(half_from_float(0.0f), 0x0000);
    EXPECT_EQ(half_from_float(-0.0f), 0x8000);
    EXPECT_EQ(half_from_float(1.0f), 0x3C00);
    EXPECT_EQ(half_from_float(65504.0f), 0x7BFF);
    EXPECT_EQ(half_from_float(65519.0f), 0x7BFF);
    EXPECT_EQ(half_from_float(65520.0f), kInfinity);
    EXPECT_EQ(half_from_float(infinity), kInfinity);
    EXPECT_EQ(half_from_float(-infinity), kInfinity | 0x8000);
    EXPECT_EQ(half_from_float(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_TRUE(std::isnan(float_from_half(half_from_float(std::nanf("")))));
}

}  // namespace
}  // namespace burin
