#include <gtest/gtest.h>

#include <cmath>

#include "tests/shading/random_expression.h"

namespace burin {
namespace {

using namespace test;

/// The engine and a walk over the tree in double precision agree, within the error that single precision makes.
TEST(ExpressionOracle, RandomExpressionsHaveTheirValues) {
    std::size_t certain = 0, all = 0, refused = 0;
    for (std::uint64_t trial = 0; trial < 4000; ++trial) {
        Random random(trial);
        const bool is_color = random.integer(0, 3) == 0;
        const RandomExpression expression = random_expression(random, random.integer(1, 5), is_color, false);
        const std::string text = written(expression, random);
        const std::string fault = fault_of(text, {.is_color = is_color});
        if (!fault.empty()) {
            const bool is_large =
                fault.find("longer than") != std::string::npos || fault.find("more than") != std::string::npos;
            ASSERT_TRUE(is_large) << text << "\n" << fault;
            ++refused;
            continue;
        }
        const ExpressionProgram program = compile_expression(text, test_symbols(), {.is_color = is_color});
        constexpr std::size_t kSamples = 16;
        const Columns columns(program, kSamples, false, trial);
        const Results results = evaluate_in_batches(program, columns, kSamples, kSamples, best_expression_kernels());
        for (std::size_t i = 0; i < kSamples; ++i) {
            NamedValues values;
            for (const char* name : {"depth", "facing", "light", "s", "t", "qi", "frame", "gap", "C.0", "C.1", "C.2",
                                     "P.0", "P.1", "P.2", "N.0", "N.1", "N.2"})
                values[name] = 0;
            for (std::size_t k = 0; k < program.inputs().size(); ++k) {
                const ExpressionInput& input = program.inputs()[k];
                const bool is_triple = values.contains(input.name + ".0");
                values[is_triple ? input.name + "." + std::to_string(input.component) : input.name] =
                    columns.values[k][i];
            }
            ++all;
            const auto expected = walk_over(expression, values);
            if (!expected) continue;
            ++certain;
            for (std::size_t k = 0; k < (is_color ? 3u : 1u); ++k) {
                const Uncertain& e = (*expected)[k];
                ASSERT_NEAR(static_cast<double>(results.values[k][i]), e.value, 1.05 * e.error + 1e-40)
                    << "trial " << trial << " sample " << i << ": " << text;
            }
        }
    }
    EXPECT_LT(refused, 40u);
    EXPECT_GT(certain, all / 2);
}

}  // namespace
}  // namespace burin
