#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/shading/test_symbols.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;
using O = ExpressionOperation;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

float apply(O operation, float a, float b = 0, float c = 0) {
    float result = -77;
    const ExpressionBlock block{
        &result, {{&a, ~std::size_t{0}}, {&b, ~std::size_t{0}}, {&c, ~std::size_t{0}}}, 1, nullptr, 0};
    best_expression_kernels().loops[static_cast<std::size_t>(operation)](block);
    return result;
}

/// Any positive number, denormal ones as well.
float any_size(Random& random) { return std::bit_cast<float>(random.bits() % 0x7F800000u); }

/// How far results are off, in units of what expression_kernels.h allows.
template <typename Draw, typename Truth, typename Allowed>
void expect_within(O operation, const Draw& draw, const Truth& truth, const Allowed& allowed) {
    double worst = 0;
    for (std::uint64_t trial = 0; trial < 200000; ++trial) {
        Random random(trial);
        const auto [a, b] = draw(random);
        const long double expected = truth(static_cast<long double>(a), static_cast<long double>(b));
        if (std::abs(expected) > 3.4e38L) continue;
        const auto off = static_cast<double>(std::abs(static_cast<long double>(apply(operation, a, b)) - expected));
        const double share = off / allowed(expected, static_cast<double>(a), static_cast<double>(b));
        ASSERT_LE(share, 1) << "of " << a << ", " << b << ": " << apply(operation, a, b);
        worst = std::max(worst, share);
    }
    EXPECT_GT(worst, 0.1) << "the bound could be much lower";
    testing::Test::RecordProperty("worst_percent", static_cast<int>(100 * worst));
}

struct Pair {
    float a, b;
};
Pair uniform(Random& random, double low, double high) {
    return {static_cast<float>(random.real(low, high)), static_cast<float>(random.real(low, high))};
}
double size_of(long double v) { return std::abs(static_cast<double>(v)); }
constexpr double kSmallest = 1.5e-45;  ///< denormal numbers have fewer bits
constexpr long double kRadians = 0.0174532925199432957692369L;

TEST(ElementaryFunctions, AreWithinTheirBounds) {
    const auto relative = [](long double v, double, double) { return 2e-7 * size_of(v) + kSmallest; };
    expect_within(
        O::exponential, [](Random& r) { return uniform(r, -104, 88.7); },
        [](long double a, long double) { return std::exp(a); }, relative);
    expect_within(
        O::exponential2, [](Random& r) { return uniform(r, -150, 128); },
        [](long double a, long double) { return std::exp2(a); }, relative);
    const auto of_logarithm = [](long double v, double, double) { return 3e-7 * size_of(v); };
    const auto logarithm = [](long double a, long double) { return std::log2(a); };
    expect_within(
        O::logarithm2,
        [](Random& r) {
            return Pair{any_size(r) + std::numeric_limits<float>::denorm_min(), 0};
        },
        logarithm, of_logarithm);
    expect_within(
        O::logarithm2, [](Random& r) { return uniform(r, 0.5, 2); }, logarithm, of_logarithm);
    expect_within(
        O::hypotenuse,
        [](Random& r) {
            return Pair{any_size(r), -any_size(r)};
        },
        [](long double a, long double b) { return std::hypot(a, b); }, relative);
    const auto of_power = [](long double v, double, double b) {
        return 2e-7 * (2 + std::abs(b)) * size_of(v) + kSmallest;
    };
    const auto power = [](long double a, long double b) { return std::pow(a, b); };
    expect_within(
        O::power, [](Random& r) { return uniform(r, 0, 4); }, power, of_power);
    expect_within(
        O::power,
        [](Random& r) {
            return Pair{any_size(r), static_cast<float>(r.real(-4, 4))};
        },
        power, of_power);
    expect_within(
        O::power,
        [](Random& r) {
            return Pair{static_cast<float>(r.real(0.5, 2)), static_cast<float>(r.real(-100, 100))};
        },
        power, of_power);
    expect_within(
        O::angle, [](Random& r) { return uniform(r, -1, 1); },
        [](long double a, long double b) { return std::atan2(a, b) / kRadians; },
        [](long double, double, double) { return 3e-5; });
    const auto sine = [](long double a, long double) { return std::sin(std::fmod(a, 360.0L) * kRadians); };
    const auto cosine = [](long double a, long double) { return std::cos(std::fmod(a, 360.0L) * kRadians); };
    for (const double range : {360.0, 1e4, 16777216.0}) {
        const auto absolute = [](long double, double, double) { return 3e-7; };
        const auto draw = [&](Random& r) { return uniform(r, -range, range); };
        SCOPED_TRACE(range);
        expect_within(O::sine, draw, sine, absolute);
        expect_within(O::cosine, draw, cosine, absolute);
    }
}

TEST(ElementaryFunctions, AreExactWherePeopleLook) {
    for (int n = -149; n <= 127; ++n) EXPECT_EQ(apply(O::exponential2, static_cast<float>(n)), std::ldexp(1.0f, n));
    for (int n = -149; n <= 127; ++n) EXPECT_EQ(apply(O::logarithm2, std::ldexp(1.0f, n)), static_cast<float>(n));
    for (const float k : {-4.0f, -3.0f, -1.0f, 0.0f, 1.0f, 2.0f, 7.0f}) {
        EXPECT_EQ(apply(O::sine, 180 * k), 0);
        EXPECT_EQ(apply(O::cosine, 180 * k + 90), 0);
    }
    EXPECT_EQ(apply(O::exponential, 0), 1);
    EXPECT_EQ(apply(O::angle, 2, 2), 45);
    EXPECT_EQ(apply(O::hypotenuse, 0, -3), 3);
}

TEST(ElementaryFunctions, SinesNeverLeaveTheirRange) {
    for (std::uint64_t trial = 0; trial < 100000; ++trial) {
        Random random(trial);
        const float x = any_size(random);
        ASSERT_LE(std::abs(apply(O::sine, x)), 1) << x;
        ASSERT_LE(std::abs(apply(O::cosine, x)), 1) << x;
    }
    for (float x = 89.9f; x < 90.1f; x = std::nextafter(x, 100.0f)) ASSERT_LE(apply(O::sine, x), 1) << x;
}

TEST(ElementaryFunctions, AreTotal) {
    struct Case {
        O operation;
        float a, b, expected;
    };
    const std::vector<Case> cases{
        {O::divide, 1, 0, kInfinity},
        {O::divide, 0, 0, kNan},
        {O::modulo, 1, 0, kNan},
        {O::subtract, kInfinity, kInfinity, kNan},
        {O::minimum, kNan, 1, kNan},
        {O::minimum, 1, kNan, kNan},
        {O::maximum, kNan, 1, kNan},
        {O::maximum, 1, kNan, kNan},
        {O::magnitude, -kInfinity, 0, kInfinity},
        {O::floor, kInfinity, 0, kInfinity},
        {O::floor, kNan, 0, kNan},
        {O::floor, 1e30f, 0, 1e30f},
        {O::floor, -8388607.5f, 0, -8388608},
        {O::ceiling, 8388606.5f, 0, 8388607},
        {O::fraction, kInfinity, 0, kNan},
        {O::sign, kNan, 0, kNan},
        {O::square_root, -kInfinity, 0, 0},
        {O::square_root, kInfinity, 0, kInfinity},
        {O::square_root, kNan, 0, kNan},
        {O::exponential, -kInfinity, 0, 0},
        {O::exponential, kInfinity, 0, kInfinity},
        {O::exponential, kNan, 0, kNan},
        {O::exponential, 89, 0, kInfinity},
        {O::exponential, -104, 0, 0},
        {O::exponential2, 128, 0, kInfinity},
        {O::exponential2, -151, 0, 0},
        {O::exponential2, kNan, 0, kNan},
        {O::exponential2, 1e30f, 0, kInfinity},
        {O::logarithm2, 0, 0, -kInfinity},
        {O::logarithm2, -kInfinity, 0, -kInfinity},
        {O::logarithm2, kInfinity, 0, kInfinity},
        {O::logarithm2, kNan, 0, kNan},
        {O::power, -2, 2, 0},
        {O::power, -2, 0, 1},
        {O::power, kNan, 0, 1},
        {O::power, 1, kNan, 1},
        {O::power, 0, -1, kInfinity},
        {O::power, -0.0f, -1, kInfinity},
        {O::power, 0, 2, 0},
        {O::power, 0, 0, 1},
        {O::power, kInfinity, 2, kInfinity},
        {O::power, kInfinity, -2, 0},
        {O::power, 2, kInfinity, kInfinity},
        {O::power, 0.5f, kInfinity, 0},
        {O::power, 0.5f, -kInfinity, kInfinity},
        {O::power, 2, -kInfinity, 0},
        {O::power, kNan, 1, kNan},
        {O::power, 2, kNan, kNan},
        {O::hypotenuse, kInfinity, 1, kInfinity},
        {O::hypotenuse, 0, 0, 0},
        {O::hypotenuse, kNan, 1, kNan},
        {O::sine, kInfinity, 0, kNan},
        {O::cosine, kNan, 0, kNan},
        {O::angle, 0, 0, 0},
        {O::angle, -0.0f, -0.0f, 0},
        {O::angle, -0.0f, -1, 180},
        {O::angle, kInfinity, kInfinity, 45},
        {O::angle, 1, kInfinity, 0},
        {O::angle, kNan, 1, kNan},
        {O::angle, 1, kNan, kNan},
        {O::less, kNan, 1, 0},
        {O::less_or_equal, 1, kNan, 0},
        {O::equal, kNan, kNan, 0},
        {O::equal, 0.0f, -0.0f, 1},
        {O::logical_not, kNan, 0, 0},
        {O::logical_and, kNan, 1, 1},
        {O::noise, kNan, 0, kNan},
        {O::noise, kInfinity, 0, kNan},
        {O::noise, 1e30f, 0, 0},
    };
    for (const Case& c : cases) {
        const float result = apply(c.operation, c.a, c.b);
        const bool is_same = std::isnan(c.expected) ? std::isnan(result) : result == c.expected;
        EXPECT_TRUE(is_same) << "operation " << static_cast<int>(c.operation) << " of " << c.a << ", " << c.b << ": "
                             << result << " instead of " << c.expected;
    }
    EXPECT_TRUE(std::isnan(apply(O::linear_step, 0, 1, kNan)));
    EXPECT_TRUE(std::isnan(apply(O::linear_step, 1, 1, kNan)));
    EXPECT_TRUE(std::isnan(apply(O::smooth_step, 0, 1, kNan)));
    EXPECT_EQ(apply(O::linear_step, 0, 10, kInfinity), 1);
    EXPECT_EQ(apply(O::choose, kNan, 2, 3), 2);
    EXPECT_EQ(apply(O::choose, -0.0f, 2, 3), 3);
    EXPECT_TRUE(std::signbit(apply(O::floor, -0.0f)));
}

/// All loops, over all kinds of numbers: equal to the bit, but for which NaN it is.
TEST(ElementaryFunctions, HaveEqualBitsForAllInstructionSets) {
    constexpr std::size_t kCount = 4096 + 5;
    std::vector<std::vector<float>> operands(3, std::vector<float>(kCount));
    Random random(3);
    for (std::vector<float>& column : operands) {
        for (float& value : column)
            value = random.integer(0, 1) == 0 ? std::bit_cast<float>(random.bits())
                                              : static_cast<float>(random.real(-10, 10));
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(O::member); ++k) {
        std::vector<std::vector<float>> results;
        for (const ExpressionKernels* kernels : all_expression_kernels()) {
            std::vector<float>& result = results.emplace_back(kCount);
            const auto operand = [&](std::size_t i) { return ExpressionOperand{operands[i].data(), ~std::size_t{0}}; };
            kernels->loops[k]({result.data(), {operand(0), operand(1), operand(2)}, kCount, nullptr, 0});
        }
        for (std::size_t i = 0; i < kCount; ++i) {
            for (const std::vector<float>& result : results) {
                const bool is_same =
                    std::bit_cast<std::uint32_t>(result[i]) == std::bit_cast<std::uint32_t>(results[0][i]) ||
                    (std::isnan(result[i]) && std::isnan(results[0][i]));
                ASSERT_TRUE(is_same) << "operation " << k << " of " << operands[0][i] << ", " << operands[1][i] << ", "
                                     << operands[2][i];
            }
        }
    }
}

}  // namespace
}  // namespace burin
