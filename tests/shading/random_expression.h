#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/shading/test_symbols.h"
#include "tests/support/random.h"

namespace burin::test {

/// An expression as a tree that can be written down, and computed in double precision by walking over it. It shares no
/// code with the engine.
struct RandomExpression {
    std::string word;  ///< operator, function, variable, component (".y"), number or colour
    int level = 0;     ///< how tightly its operator binds; leaves and calls: 9
    bool is_triple = false;
    bool is_vector = false;  ///< of a triple: by its first vector or colour
    double number = 0;
    std::array<double, 3> color{};
    std::vector<RandomExpression> operands;
};

/// `with_noise`: noise functions may be in it, which walk_over() does not know.
RandomExpression random_expression(Random& random, int depth, bool is_triple, bool with_noise);

/// Its text, with brackets where they are needed, and some that are not.
std::string written(const RandomExpression& expression, Random& random);

/// A number and how far single precision may be away from it.
struct Uncertain {
    double value = 0, error = 0;
};
/// The value for one sample, three times the same of a number; nothing where a small error would change it by much, or
/// where it leaves the range of single precision.
std::optional<std::array<Uncertain, 3>> walk_over(const RandomExpression& expression, const NamedValues& values);

}  // namespace burin::test
