#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/shading/test_symbols.h"

namespace burin {
namespace {

using namespace test;

std::size_t operations(const std::string& text) {
    return compile_expression(text, test_symbols(), {}).operation_count();
}

TEST(ExpressionPrograms, ConstantsAreFoldedAndEqualPartsAreOne) {
    EXPECT_EQ(operations("2 * 3 + sind(30) * noise(0.3)"), 0u);
    EXPECT_EQ(operations("width * 2"), 0u);
    EXPECT_EQ(operations("depth * (2 * width)"), 1u);
    EXPECT_EQ(operations("sind(depth) + sind(depth)"), 2u);
    EXPECT_EQ(operations("normalize(P).x"), operations("P.x / length(P)") + 1);
    EXPECT_EQ(operations("deep + shade + deep"), 4u);  // 1 - light, * depth, +, +
    EXPECT_TRUE(compile_expression("2 + 3", test_symbols(), {}).is_constant(0));
    EXPECT_FALSE(compile_expression("t", test_symbols(), {}).is_constant(0));
    EXPECT_FALSE(compile_expression("t + 1", test_symbols(), {}).is_constant(0));
}

TEST(ExpressionPrograms, OnlyWhatCountsIsRead) {
    const ExpressionProgram program = compile_expression("C.g + depth + attr(\"wear\")", test_symbols(), {});
    const std::vector<ExpressionInput> expected{{"C", 1, false}, {"depth", 0, false}, {"wear", 0, true}};
    for (const ExpressionInput& input : expected)
        EXPECT_EQ(std::count(program.inputs().begin(), program.inputs().end(), input), 1) << input.name;
    EXPECT_EQ(program.inputs().size(), 3u);
}

TEST(ExpressionPrograms, RatesAreThoseOfTheVariables) {
    const auto rate = [](const std::string& text) {
        return compile_expression(text, test_symbols(), {}).outputs()[0].rate;
    };
    EXPECT_EQ(rate("1 + width"), ValueRate::frame);
    EXPECT_EQ(rate("frame"), ValueRate::frame);
    EXPECT_EQ(rate("frame + length_px"), ValueRate::chain);
    EXPECT_EQ(rate("length_px * (object in wheels)"), ValueRate::piece);
    EXPECT_EQ(rate("C.r + qi"), ValueRate::piece);
    EXPECT_EQ(rate("qi + shade"), ValueRate::sample);
}

/// Results of several expressions are those of each by itself; what they share is computed once.
TEST(ExpressionPrograms, SeveralResultsShareTheirParts) {
    ExpressionCompiler compiler(test_symbols());
    compiler.add("2 * shade", {});
    EXPECT_THROW(compiler.add("2 * shade +", {}), ExpressionError);
    EXPECT_THROW(compiler.add("C", {}), ExpressionError);
    compiler.add("C * shade", {.is_color = true});
    compiler.add("t", {});
    const ExpressionProgram program = compiler.program();
    EXPECT_EQ(program.operation_count(), 5u);
    ASSERT_EQ(program.outputs().size(), 3u);
    const Columns columns(program, 300, false, 1);
    const Results results = evaluate_in_batches(program, columns, 300, 300, best_expression_kernels());
    ASSERT_EQ(results.values.size(), 5u);
    for (std::size_t i = 0; i < 300; ++i) {
        NamedValues values;
        for (std::size_t k = 0; k < program.inputs().size(); ++k) {
            const ExpressionInput& input = program.inputs()[k];
            values[input.name == "C" ? "C." + std::to_string(input.component) : input.name] = columns.values[k][i];
        }
        ASSERT_EQ(results.values[0][i], 2 * (1 - values["light"]));
        ASSERT_EQ(results.values[2][i], values["C.1"] * (1 - values["light"]));
        ASSERT_EQ(results.values[4][i], values["t"]);
    }
}

/// Where results together need too many registers, each is computed by itself.
TEST(ExpressionPrograms, ManyResultsNeedNoMoreRegistersThanOne) {
    ExpressionCompiler compiler(test_symbols());
    for (int i = 0; i < 100; ++i) compiler.add("s * " + std::to_string(i) + " + t", {});
    const ExpressionProgram program = compiler.program();
    const Columns columns(program, 40, false, 1);
    const Results results = evaluate_in_batches(program, columns, 40, 40, best_expression_kernels());
    const std::size_t s = program.inputs()[0].name == "s" ? 0 : 1;
    for (std::size_t k = 0; k < 100; ++k)
        EXPECT_EQ(results.values[k][7], columns.values[s][7] * static_cast<float>(k) + columns.values[1 - s][7]);
}

TEST(ExpressionPrograms, WhatIsNotANumberIsNoughtAndCounted) {
    ExpressionCompiler compiler(test_symbols());
    compiler.add("0 / s", {.least = 0.5f, .most = 2});
    compiler.add("rgb(1, 0 / s, 3)", {.is_color = true, .least = 0, .most = 2});
    compiler.add("1 / s", {.least = -5, .most = 5});
    const ExpressionProgram program = compiler.program();
    const std::vector<float> s{1, 2, 0, 4, 0};
    const float* const column = s.data();
    std::vector<std::vector<float>> values(5, std::vector<float>(5));
    std::vector<float*> to;
    for (std::vector<float>& value : values) to.push_back(value.data());
    std::vector<NotNumbers> found(3);
    for (const ExpressionKernels* kernels : all_expression_kernels()) {
        program.evaluate({&column, 1}, 5, to, found, *kernels);
        EXPECT_EQ(values[0], (std::vector<float>{0.5f, 0.5f, 0.5f, 0.5f, 0.5f}));
        EXPECT_EQ(values[1], (std::vector<float>{1, 1, 0, 1, 0}));  // the whole colour
        EXPECT_EQ(values[2], (std::vector<float>{0, 0, 0, 0, 0}));
        EXPECT_EQ(values[3], (std::vector<float>{2, 2, 0, 2, 0}));
        EXPECT_EQ(values[4], (std::vector<float>{1, 0.5f, 5, 0.25f, 5}));  // infinity is a number
        EXPECT_EQ(found[0].count, 2u);
        EXPECT_EQ(found[0].first, 2u);
        EXPECT_EQ(found[1].count, 2u);
        EXPECT_EQ(found[2].count, 0u);
    }
}

TEST(ExpressionPrograms, FirstNotANumberIsFoundInAnyBlock) {
    const ExpressionProgram program = compile_expression("0 / s", test_symbols(), {});
    for (const std::size_t place : {0u, 15u, 16u, 255u, 256u, 700u, 999u}) {
        std::vector<float> s(1000, 1.0f), value(1000);
        s[place] = 0;
        const float* const column = s.data();
        float* const to = value.data();
        NotNumbers found;
        for (const ExpressionKernels* kernels : all_expression_kernels()) {
            program.evaluate({&column, 1}, s.size(), {&to, 1}, {&found, 1}, *kernels);
            EXPECT_EQ(found.count, 1u);
            EXPECT_EQ(found.first, place);
        }
    }
}

/// A program is a value: a copy works when compiler, table and original are gone.
TEST(ExpressionPrograms, AreValues) {
    ExpressionProgram copy;
    {
        const ExpressionSymbols symbols = test_symbols();
        const ExpressionProgram program = compile_expression("ramp(\"fade\", s) + (object == \"wheel*\")", symbols, {});
        copy = program;
    }
    const Columns columns(copy, 10, false, 3);
    EXPECT_EQ(evaluate_in_batches(copy, columns, 10, 10, best_expression_kernels()).values[0].size(), 10u);
}

}  // namespace
}  // namespace burin
