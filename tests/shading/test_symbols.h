#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shading/expression.h"

// Names for expressions in tests, and their values.

namespace burin::test {

/// All rates and types, three objects of which the second side may be the background, all line classes, two groups of
/// one name, a parameter, two lets, and ramps.
const ExpressionSymbols& test_symbols();

/// The loops for each set of instructions that this processor has.
std::vector<const ExpressionKernels*> all_expression_kernels();

/// Values of variables, by name; of a component: "C.0". Variables that are not there are 0.
using NamedValues = std::map<std::string, float, std::less<>>;

/// The result for one sample, component by component. NaN is 0 here.
std::vector<float> results_of(std::string_view text, bool is_color, const NamedValues& values = {});
/// Of an expression that is a number.
double value_of(std::string_view text, const NamedValues& values = {});

/// "column: message" of an expression that is wrong; nothing if it is not.
std::string fault_of(std::string_view text, const ExpressionTarget& target = {});

/// Columns of values for all inputs of a program, with special ones among them: 0, -0, infinities, NaN if `with_nan`,
/// the largest and the smallest numbers.
struct Columns {
    std::vector<std::vector<float>> values;
    std::vector<const float*> pointers;
    Columns(const ExpressionProgram& program, std::size_t count, bool with_special, std::uint64_t seed);
};

/// All results of a program, one column for each component, and what was not a number.
struct Results {
    std::vector<std::vector<float>> values;
    std::vector<NotNumbers> not_numbers;
};
/// In batches of `batch` samples.
Results evaluate_in_batches(const ExpressionProgram& program, const Columns& columns, std::size_t count,
                            std::size_t batch, const ExpressionKernels& kernels);

}  // namespace burin::test
