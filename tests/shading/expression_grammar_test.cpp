#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "tests/shading/test_symbols.h"

namespace burin {
namespace {

using namespace test;

struct Example {
    std::string text;
    double value;
};

void expect_values(const std::vector<Example>& examples, const NamedValues& values = {}) {
    for (const Example& example : examples) {
        SCOPED_TRACE(example.text);
        EXPECT_EQ(fault_of(example.text), "");
        const double tolerance = 2e-7 * std::max(1.0, std::abs(example.value));
        if (std::isinf(example.value)) {
            EXPECT_EQ(value_of(example.text, values), example.value);
        } else {
            EXPECT_NEAR(value_of(example.text, values), example.value, tolerance);
        }
    }
}

TEST(ExpressionGrammar, NumbersAndUnits) {
    expect_values({{"12", 12},
                   {".5", 0.5},
                   {"2.", 2},
                   {"1e3", 1000},
                   {"1E-2", 0.01},
                   {"2.5e+1", 25},
                   {"0e999", 0},
                   {"1e-999", 0},
                   {std::string("0.") + std::string(200, '0') + "1e201", 1},
                   {std::string("1") + std::string(200, '0') + "e-200", 1},
                   {"3.4028234e38 / 3.4028234e38", 1},
                   {"3px", 3},
                   {"25.4mm", 96},
                   {"72pt", 96},
                   {"1e1mm", 960 / 25.4},
                   {" 1\t+\n2 ", 3}});
    expect_values({{"3world", 12}, {"1px + 0.5world", 3}}, {{"px_size", 0.25f}});
}

TEST(ExpressionGrammar, MillimetresFollowTheResolution) {
    ExpressionSymbols symbols = test_symbols();
    symbols.px_per_mm = 300 / 25.4;
    const ExpressionProgram program = compile_expression("25.4mm + 0.24pt", symbols, {});
    float value = 0;
    float* const to = &value;
    NotNumbers not_numbers;
    program.evaluate({}, 1, {&to, 1}, {&not_numbers, 1});
    EXPECT_FLOAT_EQ(value, 301);
}

TEST(ExpressionGrammar, Operators) {
    expect_values({{"7 + 2", 9},     {"7 - 2", 5},    {"7 * 2", 14}, {"7 / 2", 3.5}, {"7 % 2", 1},     {"-7 % 2", 1},
                   {"7 % -2", -1},   {"7 ^ 2", 49},   {"-7", -7},    {"7 < 2", 0},   {"2 < 7", 1},     {"2 < 2", 0},
                   {"2 <= 2", 1},    {"7 <= 2", 0},   {"7 > 2", 1},  {"2 > 2", 0},   {"2 >= 2", 1},    {"2 >= 7", 0},
                   {"2 == 2", 1},    {"2 == 7", 0},   {"2 != 7", 1}, {"2 != 2", 0},  {"1 and 2", 1},   {"1 and 0", 0},
                   {"0 or 0", 0},    {"0 or -1", 1},  {"not 0", 1},  {"not 3", 0},   {"1 ? 5 : 6", 5}, {"0 ? 5 : 6", 6},
                   {"(3)", 3},       {"P.y", 2},      {"C.r", 4},    {"C.x", 4},     {"P.b", 3},       {"(P * 2).z", 6},
                   {"(C + P).g", 7}, {"#ffffff.g", 1}},
                  {{"P.0", 1.0f}, {"P.1", 2.0f}, {"P.2", 3.0f}, {"C.0", 4.0f}, {"C.1", 5.0f}, {"C.2", 6.0f}});
}

/// Each of these has another value if operators bind in another way.
TEST(ExpressionGrammar, Precedence) {
    expect_values({{"2 + 3 * 4", 14},
                   {"2 * 3 + 4", 10},
                   {"20 - 3 - 4", 13},
                   {"24 / 3 / 2", 4},
                   {"24 / 3 * 2", 16},
                   {"20 % 7 * 2", 12},
                   {"2 * 20 % 7", 5},
                   {"-2 ^ 2", -4},
                   {"2 ^ -2", 0.25},
                   {"2 ^ 3 ^ 2", 512},
                   {"2 * 3 ^ 2", 18},
                   {"2 ^ -3 ^ 2 * 512", 1},
                   {"- -3", 3},
                   {"3 - -3", 6},
                   {"-3 + 4", 1},
                   {"-3 * 2 + 7", 1},
                   {"1 + 1 < 3", 1},
                   {"1 + (1 < 3)", 2},
                   {"not 1 < 3", 0},
                   {"(not 1) < 3", 1},
                   {"not 0 and 0", 0},
                   {"not (0 and 0)", 1},
                   {"not not 3", 1},
                   {"1 or 1 and 0", 1},
                   {"(1 or 1) and 0", 0},
                   {"0 and 1 or 1", 1},
                   {"1 or 0 ? 2 : 3", 2},
                   {"0 ? 1 : 0 ? 2 : 3", 3},
                   {"1 ? 0 ? 4 : 5 : 6", 5},
                   {"2 * (0 ? 1 : 4)", 8},
                   {"(1 < 2) == 1 ? 1 : 0", 1}});
}

TEST(ExpressionGrammar, Functions) {
    const double infinity = HUGE_VAL;
    expect_values({{"min(3, 2)", 2},
                   {"min(3, 2, 5, 1, 4)", 1},
                   {"max(3, 2, 5, 1, 4)", 5},
                   {"clamp(7, 1, 3)", 3},
                   {"clamp(-7, 1, 3)", 1},
                   {"clamp(2, 1, 3)", 2},
                   {"abs(-2)", 2},
                   {"sign(-2)", -1},
                   {"sign(2)", 1},
                   {"sign(0)", 0},
                   {"floor(-1.5)", -2},
                   {"floor(1.5)", 1},
                   {"ceil(-1.5)", -1},
                   {"ceil(1.2)", 2},
                   {"round(1.5)", 2},
                   {"round(-1.5)", -1},
                   {"round(1.4)", 1},
                   {"fract(1.25)", 0.25},
                   {"fract(-1.25)", 0.75},
                   {"mod(-1, 3)", 2},
                   {"mod(1, -3)", -2},
                   {"sqrt(9)", 3},
                   {"sqrt(-9)", 0},
                   {"exp(0)", 1},
                   {"exp(2)", std::exp(2.0)},
                   {"exp2(-3)", 0.125},
                   {"log2(8)", 3},
                   {"log2(0)", -infinity},
                   {"log2(-5)", -infinity},
                   {"pow(2, 10)", 1024},
                   {"pow(9, 0.5)", 3},
                   {"pow(-2, 2)", 0},
                   {"pow(-2, 0)", 1},
                   {"pow(0, 0)", 1},
                   {"0 ^ -1", infinity},
                   {"pow(0, 3)", 0},
                   {"hypot(3, -4)", 5},
                   {"hypot(3e30, 4e30) / 1e30", 5},
                   {"hypot(0, 0)", 0},
                   {"sind(30)", 0.5},
                   {"sind(-90)", -1},
                   {"cosd(60)", 0.5},
                   {"cosd(180)", -1},
                   {"cosd(90)", 0},
                   {"sind(180)", 0},
                   {"sind(3600030)", 0.5},
                   {"atan2d(1, 1)", 45},
                   {"atan2d(1, -1)", 135},
                   {"atan2d(-1, -1)", -135},
                   {"atan2d(-1, 0)", -90},
                   {"atan2d(0, -1)", 180},
                   {"atan2d(0, 0)", 0},
                   {"mix(2, 4, 0.25)", 2.5},
                   {"mix(2, 4, 1)", 4},
                   {"mix(2, 4, 2)", 6},
                   {"step(2, 1.9)", 0},
                   {"step(2, 2)", 1},
                   {"smoothstep(0, 4, 1)", 0.15625},
                   {"smoothstep(0, 4, 5)", 1},
                   {"smoothstep(4, 0, 1)", 0.84375},
                   {"smoothstep(2, 2, 1.9)", 0},
                   {"smoothstep(2, 2, 2)", 1},
                   {"linstep(2, 4, 2.5)", 0.25},
                   {"linstep(4, 2, 2.5)", 0.75},
                   {"linstep(2, 2, 1)", 0},
                   {"linstep(2, 2, 2)", 1},
                   {"if(2 > 1, 5, 6)", 5},
                   {"select(0, 5, 6)", 6},
                   {"luminance(rgb(1, 1, 1))", 1},
                   {"luminance(rgb(0, 1, 0))", 0.7152},
                   {"dot(rgb(1, 2, 3), rgb(4, 5, 6))", 32},
                   {"length(rgb(2, 3, 6))", 7},
                   {"length(rgb(2e30, 3e30, 6e30)) / 1e30", 7},
                   {"normalize(rgb(2, 3, 6)).z", 6.0 / 7},
                   {"normalize(rgb(0, 0, 0)).x", 0},
                   {"ramp(\"fade\", 5)", 2.5},
                   {"ramp(\"fade\", -5)", 0},
                   {"ramp(\"fade\", 50)", 5},
                   {"ramp(\"sky\", 0.25).b", 0.25},
                   {"1 / 0", infinity},
                   {"-1 / 0", -infinity}});
    expect_values({{"attr(\"wear\") * 2", 6}, {"attr(\"a b\")", 0}}, {{"wear", 3.0f}});
    EXPECT_EQ(fault_of("noise(s) + noise(s, 2) + noise3(P) + fbm(P, 3)"), "");
}

TEST(ExpressionGrammar, Isophotes) {
    // On a ball of radius 100 px: kr = 1 / radius, and pixels are of size 1.
    const NamedValues ball{{"kr", 0.01f}, {"px_size", 1.0f}};
    EXPECT_NEAR(value_of("isophote(0.3)", ball), 100 * (1 - std::sqrt(1 - 0.09)), 1e-4);
    EXPECT_EQ(value_of("isophote(0)", ball), 0);
    EXPECT_EQ(value_of("isophote(0)"), 0);  // flat: 0 / 0 is not NaN
    EXPECT_GT(value_of("isophote(0.3)", {{"kr", -1.0f}, {"px_size", 1.0f}}), 1e30);
    EXPECT_NEAR(value_of("isophote(2)", ball), 100, 1e-4);  // no such angle: as 1
    EXPECT_EQ(value_of("isophote(-0.3)", ball), 0);         // nor this: as 0
    EXPECT_EQ(value_of("isophote(-2)", ball), 0);
}

TEST(ExpressionGrammar, Colors) {
    const auto expect_color = [](const std::string& text, double r, double g, double b,
                                 const NamedValues& values = {}) {
        SCOPED_TRACE(text);
        const std::vector<float> color = results_of(text, true, values);
        EXPECT_NEAR(static_cast<double>(color[0]), r, 1e-6);
        EXPECT_NEAR(static_cast<double>(color[1]), g, 1e-6);
        EXPECT_NEAR(static_cast<double>(color[2]), b, 1e-6);
    };
    const auto linear = [](int code) { return static_cast<double>(linear_from_srgb(static_cast<float>(code) / 255)); };
    expect_color("#1aB2c3", linear(0x1A), linear(0xB2), linear(0xC3));
    expect_color("rgb(0.1, 0.2, 0.3)", 0.1, 0.2, 0.3);
    expect_color("0.5", 0.5, 0.5, 0.5);
    expect_color("0.5 * rgb(1, 2, 4)", 0.5, 1, 2);
    expect_color("rgb(1, 2, 4) - 1", 0, 1, 3);
    expect_color("max(rgb(1, 2, 4), 3)", 3, 3, 4);
    expect_color("mix(rgb(1, 0, 0), rgb(0, 1, 0), 0.25)", 0.75, 0.25, 0);
    expect_color("1 < 2 ? rgb(1, 2, 3) : 0", 1, 2, 3);
    expect_color("hsv(0, 1, 1)", 1, 0, 0);
    expect_color("hsv(60, 1, 1)", 1, 1, 0);
    expect_color("hsv(120, 1, 0.5)", 0, 0.5, 0);
    expect_color("hsv(240, 0.5, 1)", 0.5, 0.5, 1);
    expect_color("hsv(-30, 1, 1)", 1, 0, 0.5);
    expect_color("hsv(390, 1, 1)", 1, 0.5, 0);
    expect_color("ink * 2", 0.5, 1, 2);
    expect_color("ramp(\"sky\", 0.25)", 0.75, 0, 0.25);
    expect_color("C * facing", 2, 4, 6, {{"facing", 2.0f}, {"C.0", 1.0f}, {"C.1", 2.0f}, {"C.2", 3.0f}});
}

}  // namespace
}  // namespace burin
