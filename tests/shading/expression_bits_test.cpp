#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "tests/shading/random_expression.h"

namespace burin {
namespace {

using namespace test;

std::vector<std::uint32_t> bits_of(const Results& results) {
    std::vector<std::uint32_t> bits;
    for (const std::vector<float>& column : results.values) {
        for (const float value : column) bits.push_back(std::bit_cast<std::uint32_t>(value));
    }
    for (const NotNumbers& not_numbers : results.not_numbers) {
        bits.push_back(static_cast<std::uint32_t>(not_numbers.count));
        bits.push_back(static_cast<std::uint32_t>(not_numbers.first));
    }
    return bits;
}

/// Over columns with infinities, NaN, -0 and denormal numbers, too.
TEST(ExpressionBits, AreEqualForAllInstructionSetsAndBatches) {
    std::size_t not_numbers = 0, values = 0;
    for (std::uint64_t trial = 0; trial < 3000; ++trial) {
        Random random(trial);
        ExpressionCompiler compiler(test_symbols());
        std::string texts;
        for (int k = random.integer(1, 3); k > 0; --k) {
            const bool is_color = random.integer(0, 2) == 0;
            const std::string text = written(random_expression(random, random.integer(1, 5), is_color, true), random);
            try {
                compiler.add(text, {.is_color = is_color, .least = -1e6f, .most = 1e6f});
                texts += text + "\n";
            } catch (const ExpressionError&) {  // too large
            }
        }
        const ExpressionProgram program = compiler.program();
        const auto count = static_cast<std::size_t>(random.integer(1, 600));
        const Columns columns(program, count, true, trial);
        const Results expected = evaluate_in_batches(program, columns, count, count, baseline_expression_kernels());
        for (const NotNumbers& found : expected.not_numbers) not_numbers += found.count;
        for (const std::vector<float>& column : expected.values) {
            values += column.size();
            for (const float value : column) ASSERT_LE(std::abs(value), 1e6f) << texts;
        }
        const auto batch = static_cast<std::size_t>(random.integer(1, 40));
        for (const ExpressionKernels* kernels : all_expression_kernels()) {
            for (const std::size_t size : {count, batch, std::size_t{256}}) {
                ASSERT_EQ(bits_of(evaluate_in_batches(program, columns, count, size, *kernels)), bits_of(expected))
                    << kernels->name << ", batches of " << size << ", trial " << trial << ":\n"
                    << texts;
            }
        }
    }
    EXPECT_GT(values, 500000u);
    EXPECT_GT(not_numbers, values / 100);
    EXPECT_LT(not_numbers, values / 2);
}

/// What is computed when a program is compiled has the bits that samples would have: variables become parameters of the
/// same values.
TEST(ExpressionBits, OfConstantsAreThoseOfSamples) {
    std::size_t compared = 0;
    for (std::uint64_t trial = 0; trial < 3000; ++trial) {
        Random random(trial);
        const std::string text = written(random_expression(random, random.integer(1, 5), true, true), random);
        if (!fault_of(text, {.is_color = true}).empty()) continue;  // too large
        const ExpressionProgram varying = compile_expression(text, test_symbols(), {.is_color = true});
        const Columns columns(varying, 1, true, trial);
        ExpressionSymbols symbols = test_symbols();
        for (const ExpressionVariable& variable : symbols.variables) {
            ExpressionParameter parameter{variable.name, variable.type, {}};
            for (std::size_t k = 0; k < varying.inputs().size(); ++k) {
                const ExpressionInput& input = varying.inputs()[k];
                if (input.name == variable.name) parameter.value[input.component] = columns.values[k][0];
            }
            symbols.parameters.push_back(parameter);
        }
        symbols.variables.clear();
        const ExpressionProgram constant = compile_expression(text, symbols, {.is_color = true});
        ASSERT_TRUE(constant.is_constant(0)) << text;
        const Columns none(constant, 1, false, 0);
        ASSERT_EQ(bits_of(evaluate_in_batches(constant, none, 1, 1, best_expression_kernels())),
                  bits_of(evaluate_in_batches(varying, columns, 1, 1, best_expression_kernels())))
            << "trial " << trial << ": " << text;
        ++compared;
    }
    EXPECT_GT(compared, 2900u);
}

/// A program does not read or write behind the samples that it gets.
TEST(ExpressionBits, NothingBehindTheSamplesIsTouched) {
    const ExpressionProgram program = compile_expression("depth * 2 + s", test_symbols(), {});
    for (const ExpressionKernels* kernels : all_expression_kernels()) {
        for (std::size_t count = 0; count < 70; ++count) {
            const std::vector<float> depth(count, 2.0f), s(count, 1.0f);  // sanitizers look at their ends
            std::vector<float> result(count + 20, -77);
            const std::vector<const float*> columns{depth.data(), s.data()};
            float* const to = result.data();
            NotNumbers not_numbers;
            program.evaluate(columns, count, {&to, 1}, {&not_numbers, 1}, *kernels);
            for (std::size_t i = 0; i < result.size(); ++i)
                ASSERT_EQ(result[i], i < count ? 5.0f : -77.0f) << kernels->name;
        }
    }
}

}  // namespace
}  // namespace burin
