#include "shading/expression/ramp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/shading/test_symbols.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

float at(const Ramp& ramp, float x) {
    ExpressionSymbols symbols = test_symbols();
    symbols.ramps = {{"r", ramp}};
    ExpressionCompiler compiler(symbols);
    compiler.add("ramp(\"r\", s)", {});
    compiler.add_ramp(ramp, "s", {});
    const ExpressionProgram program = compiler.program();
    EXPECT_EQ(program.inputs().size(), 1u);
    const float* const column = &x;
    float values[2] = {-77, -77};
    float* const to[2] = {&values[0], &values[1]};
    NotNumbers not_numbers[2];
    program.evaluate({&column, 1}, 1, to, not_numbers);
    EXPECT_EQ(values[0], values[1]);
    return values[0];
}

Ramp ramp_of(std::initializer_list<std::pair<float, float>> stops, RampBetween between = RampBetween::linear,
             RampOutside outside = RampOutside::hold) {
    Ramp ramp;
    for (const auto& [place, value] : stops) ramp.stops.push_back({place, {value, 0, 0}});
    ramp.between = between;
    ramp.outside = outside;
    return ramp;
}

TEST(Ramp, GoesThroughItsStops) {
    for (const RampBetween between :
         {RampBetween::linear, RampBetween::smooth, RampBetween::step, RampBetween::curve}) {
        const Ramp ramp = ramp_of({{-1, 3}, {0, 1}, {0.3f, 1}, {7, 11}}, between);
        for (const RampStop& stop : ramp.stops)
            EXPECT_NEAR(static_cast<double>(at(ramp, stop.at)), static_cast<double>(stop.value[0]), 1e-6);
        EXPECT_EQ(at(ramp, -50), 3);
        EXPECT_EQ(at(ramp, 50), 11);
        EXPECT_EQ(at(ramp, std::numeric_limits<float>::infinity()), 11);
        EXPECT_EQ(at(ramp, std::numeric_limits<float>::quiet_NaN()), 0);  // and counted
    }
    EXPECT_EQ(at(ramp_of({{2, 5}}), 1), 5);
    EXPECT_EQ(at(ramp_of({{2, 5}}, RampBetween::curve, RampOutside::mirror), 1), 5);
}

TEST(Ramp, BetweenStops) {
    EXPECT_EQ(at(ramp_of({{0, 1}, {4, 3}}), 1), 1.5f);
    EXPECT_EQ(at(ramp_of({{0, 1}, {4, 3}}, RampBetween::step), 3.99f), 1);
    EXPECT_EQ(at(ramp_of({{0, 0}, {4, 1}}, RampBetween::smooth), 1), 0.15625f);
    // Fritsch and Carlson: a straight line stays one, and a plateau has no bump.
    EXPECT_NEAR(static_cast<double>(at(ramp_of({{0, 0}, {1, 2}, {3, 6}}, RampBetween::curve), 2.5f)), 5, 1e-6);
    EXPECT_EQ(at(ramp_of({{0, 0}, {1, 2}, {2, 2}, {3, 9}}, RampBetween::curve), 1.5f), 2);
}

TEST(Ramp, Outside) {
    const auto stops = {std::pair{1.0f, 0.0f}, {3.0f, 2.0f}};
    const Ramp repeat = ramp_of(stops, RampBetween::linear, RampOutside::repeat);
    const Ramp mirror = ramp_of(stops, RampBetween::linear, RampOutside::mirror);
    EXPECT_EQ(at(repeat, 3.5f), 0.5f);
    EXPECT_EQ(at(repeat, 0.5f), 1.5f);
    EXPECT_EQ(at(mirror, 3.5f), 1.5f);
    EXPECT_EQ(at(mirror, 0.5f), 0.5f);
    EXPECT_EQ(at(mirror, 5.5f), 0.5f);
}

/// Between two stops a curve stays between their values and does not turn round.
TEST(Ramp, CurvesAreMonotone) {
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
        Random random(trial);
        Ramp ramp;
        ramp.between = RampBetween::curve;
        float place = 0;
        for (int i = random.integer(2, 8); i > 0; --i) {
            place += static_cast<float>(random.real(0.01, 2));
            ramp.stops.push_back({place, {static_cast<float>(random.integer(0, 5)), 0, 0}});
        }
        ASSERT_EQ(fault_of_ramp(ramp), std::nullopt);
        for (std::size_t i = 0; i + 1 < ramp.stops.size(); ++i) {
            const float begin = ramp.stops[i].value[0], end = ramp.stops[i + 1].value[0];
            float before = begin;
            for (int k = 0; k <= 20; ++k) {
                const float x =
                    ramp.stops[i].at + (ramp.stops[i + 1].at - ramp.stops[i].at) * static_cast<float>(k) / 20;
                const float value = at(ramp, x);
                ASSERT_GE((value - before) * (end >= begin ? 1 : -1), -1e-5f) << "trial " << trial;
                before = value;
            }
        }
    }
}

TEST(Ramp, FaultsAreNamed) {
    EXPECT_EQ(fault_of_ramp({}), "a ramp needs a stop at least");
    EXPECT_EQ(fault_of_ramp(ramp_of({{0, 1}, {0, 2}})), "stop 2 does not lie behind the one before it");
    EXPECT_EQ(fault_of_ramp(ramp_of({{0, 1}, {1, 2}, {0.5f, 2}})), "stop 3 does not lie behind the one before it");
    EXPECT_EQ(fault_of_ramp(ramp_of({{0, 1}, {1, 1e20f}})), "stop 2 has a number beyond 1e15");
    EXPECT_EQ(fault_of_ramp(ramp_of({{std::numeric_limits<float>::quiet_NaN(), 1}})),
              "stop 1 has a number beyond 1e15");
    Ramp many;
    for (int i = 0; i < 65; ++i) many.stops.push_back({static_cast<float>(i), {}});
    EXPECT_EQ(fault_of_ramp(many), "a ramp has at most 64 stops");
    many.stops.pop_back();
    EXPECT_EQ(fault_of_ramp(many), std::nullopt);
    EXPECT_EQ(at(many, 40.5f), 0);
}

}  // namespace
}  // namespace burin
