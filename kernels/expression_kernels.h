#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

// What expressions of style sheets are made of: one loop per operation, over a block of samples.

namespace burin {

/// What one loop computes. The order is that of the table in expression_kernels.inc.
enum class ExpressionOperation : std::uint8_t {
    add,
    subtract,
    multiply,
    divide,
    modulo,  ///< a - b floor(a / b)
    negate,
    minimum,
    maximum,
    magnitude,
    floor,
    ceiling,
    round,  ///< floor(x + 1/2)
    fraction,
    sign,
    square_root,  ///< of a negative number: 0
    exponential,
    exponential2,
    logarithm2,  ///< of a negative number, as of 0: -infinity
    power,       ///< a negative base counts as 0; x^0 is 1
    hypotenuse,
    sine,    ///< of degrees
    cosine,  ///< of degrees
    angle,   ///< of (y, x), degrees above -180, at most 180; 0 of (0, 0); -0 counts as 0
    less,
    less_or_equal,
    equal,
    logical_and,
    logical_or,
    logical_not,
    choose,  ///< (condition, a, b)
    smooth_step,
    linear_step,
    noise,   ///< (x, seed): gradient noise on a line, -1 to 1
    noise3,  ///< (x, y, z): gradient noise in space, -1 to 1
    member,  ///< whether a number is in the set that the table describes
    ramp,    ///< the curve that the table describes
};
constexpr std::size_t kExpressionOperationCount = static_cast<std::size_t>(ExpressionOperation::ramp) + 1;

/// How many operands an operation has, 1 to 3.
constexpr int operand_count(ExpressionOperation operation) {
    using O = ExpressionOperation;
    switch (operation) {
        case O::negate:
        case O::magnitude:
        case O::floor:
        case O::ceiling:
        case O::round:
        case O::fraction:
        case O::sign:
        case O::square_root:
        case O::exponential:
        case O::exponential2:
        case O::logarithm2:
        case O::sine:
        case O::cosine:
        case O::logical_not:
        case O::member:
        case O::ramp:
            return 1;
        case O::choose:
        case O::smooth_step:
        case O::linear_step:
        case O::noise3:
            return 3;
        default:
            return 2;
    }
}

/// How many equal numbers a constant operand is, which is as many as the widest vector holds.
constexpr std::size_t kExpressionConstantWidth = 16;

/// An operand: one number per sample, or a constant.
struct ExpressionOperand {
    const float* values;
    std::size_t step_mask;  ///< sample i reads values[i & step_mask]: all bits, or 0 of a constant
};

/// A loop's input and output. `to` may be where one of the operands lies.
struct ExpressionBlock {
    float* to;
    ExpressionOperand from[3];
    std::size_t count;   ///< samples; nothing behind them is read or written
    const float* table;  ///< of `member`: the first number, then 0 or 1 for each number from there on; of `ramp`: see
                         ///< kRampColumns
    std::size_t table_size;
};

/// A ramp's table has as many columns as this, one after the other, each with a number per stop: where the stop is,
/// 1 / the distance to the next one (0 at the last), and c0 to c3. From a stop on, with u in [0, 1] the share of the
/// way to the next, the curve is c0 + u (c1 + u (c2 + u c3)). In front of the first stop and behind the last one it is
/// level.
constexpr std::size_t kRampColumns = 6;

/// How many samples had no number as their result, and the first of them.
struct NotNumbers {
    std::size_t count = 0;
    std::size_t first = 0;
};

/// One or three numbers per sample on their way out, and their range.
struct ExpressionDelivery {
    ExpressionOperand from[3];
    float* to[3];
    std::size_t components;  ///< 1 or 3
    std::size_t count;
    float least, most;
};

/// The loops for one set of vector instructions. All sets compute the same bits, for any number of samples in a block:
/// sums, products, quotients and square roots are IEEE's, everything else is made of these.
///
/// Errors, for all numbers but where said: exponential and exponential2 are within 2e-7 of their value, down to where
/// numbers have fewer bits; logarithm2 within 3e-7 of it; power within 2e-7 (2 + |exponent|) of it; hypotenuse within
/// 2e-7 of it; sine and cosine within 3e-7 up to 2^24 degrees, in [-1, 1] everywhere; angle within 3e-5 degrees.
///
/// NaN goes through: where an operand that counts is NaN, the result is. But comparisons with NaN are false, x^0 and
/// 1^x are 1, and a condition counts as true unless it is 0.
struct ExpressionKernels {
    std::string_view name;
    std::array<void (*)(const ExpressionBlock&), kExpressionOperationCount> loops;
    /// Writes results: 0 for what is not a number (in all components), else within the range.
    NotNumbers (*deliver)(const ExpressionDelivery&);
};

const ExpressionKernels& baseline_expression_kernels();
/// nullptr where this build or this machine has none.
const ExpressionKernels* avx2_expression_kernels();
const ExpressionKernels* avx512_expression_kernels();
/// The fastest ones that this machine has and allowed_instruction_set() permits.
const ExpressionKernels& best_expression_kernels();

}  // namespace burin
