#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/shading/random_expression.h"

// Walks over a tree in double precision, and keeps account of how far single precision may be off.

namespace burin::test {
namespace {

using Expression = RandomExpression;

struct Unsure {};
constexpr double kUnit = 1.0 / (1 << 24);  ///< rounding in single precision
using U = Uncertain;
using Triple = std::array<U, 3>;

U rounded(double value, double error) {
    if (!(std::abs(value) + error < 1e37)) throw Unsure{};
    return {value, error + std::abs(value) * kUnit + 2e-45};
}
U exact(double value) { return {value, 0}; }

bool is_true(const U& a) {
    if (std::abs(a.value) <= a.error && a.error > 0) throw Unsure{};
    return a.value != 0;
}
/// Whether a < b, where that is certain.
bool is_less(const U& a, const U& b) {
    const double error = a.error + b.error;
    if (std::abs(a.value - b.value) <= error && error > 0) throw Unsure{};
    return a.value < b.value;
}
U plus(const U& a, const U& b) { return rounded(a.value + b.value, a.error + b.error); }
U minus(const U& a, const U& b) { return rounded(a.value - b.value, a.error + b.error); }
U times(const U& a, const U& b) {
    return rounded(a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
}
U over(const U& a, const U& b) {
    const double least = std::abs(b.value) - b.error;
    if (!(least > 0)) throw Unsure{};
    const double value = a.value / b.value;
    return rounded(value, (a.error + std::abs(value) * b.error) / least);
}
U floor_of(const U& a) {
    const double low = std::floor(a.value - a.error), high = std::floor(a.value + a.error);
    if (low != high) throw Unsure{};
    return exact(low);
}
U modulo(const U& a, const U& b) { return minus(a, times(b, floor_of(over(a, b)))); }
U least(const U& a, const U& b) { return {std::min(a.value, b.value), std::max(a.error, b.error)}; }
U most(const U& a, const U& b) { return {std::max(a.value, b.value), std::max(a.error, b.error)}; }

/// A function that only rises or only falls, and how far an implementation may be off: relative to its value.
template <typename Function>
U monotone(const U& a, const Function& f, double relative) {
    const double value = f(a.value);
    const double error = std::max(std::abs(f(a.value - a.error) - value), std::abs(f(a.value + a.error) - value));
    return rounded(value, error + relative * std::abs(value));
}
U power(const U& a, const U& b) {
    if (b.error == 0 && b.value == 0) return exact(1);
    if (a.value <= 0 && a.error == 0) {
        if (is_less(b, exact(0))) throw Unsure{};  // infinite
        return exact(0);
    }
    if (a.value - a.error <= 0) throw Unsure{};
    const double value = std::pow(a.value, b.value);
    double error = 0;
    for (const double base : {a.value - a.error, a.value + a.error}) {
        for (const double exponent : {b.value - b.error, b.value + b.error})
            error = std::max(error, std::abs(std::pow(base, exponent) - value));
    }
    return rounded(value, error + value * 2e-7 * (2 + std::abs(b.value)));
}
U sine(const U& a, double shift) {
    if (std::abs(a.value) + a.error > 1e4) throw Unsure{};
    constexpr double kRadians = 0.017453292519943295;
    return {std::sin((a.value + shift) * kRadians), a.error * kRadians + 3e-7};
}
U angle(const U& y, const U& x) {
    const double length = std::hypot(x.value, y.value), error = x.error + y.error;
    if (length == 0 && error == 0) return exact(0);
    if (length <= 2 * error || length < 1e-35) throw Unsure{};
    if (x.value - x.error < 0 && std::abs(y.value) <= y.error && y.error > 0) throw Unsure{};
    // -0 counts as 0.
    return {std::atan2(y.value + 0.0, x.value) / 0.017453292519943295, error / (length - error) * 58 + 3e-5};
}
U hypotenuse(const U& x, const U& y) {
    const double value = std::hypot(x.value, y.value);
    return rounded(value, x.error + y.error + value * 2e-7);
}
U share(const U& a, const U& b, const U& x) {
    if (a.error == 0 && b.error == 0 && a.value == b.value) return exact(is_less(x, a) ? 0 : 1);
    return least(most(over(minus(x, a), minus(b, a)), exact(0)), exact(1));
}
U dot(const Triple& a, const Triple& b) { return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2])); }

U scalar(const std::string& word, const std::vector<U>& a) {
    if (word == "+") return plus(a[0], a[1]);
    if (word == "-") return minus(a[0], a[1]);
    if (word == "*") return times(a[0], a[1]);
    if (word == "/") return over(a[0], a[1]);
    if (word == "%" || word == "mod") return modulo(a[0], a[1]);
    if (word == "^" || word == "pow") return power(a[0], a[1]);
    if (word == "neg") return {-a[0].value, a[0].error};
    if (word == "<") return exact(is_less(a[0], a[1]));
    if (word == ">") return exact(is_less(a[1], a[0]));
    if (word == "<=" || word == "step") return exact(!is_less(a[1], a[0]));
    if (word == ">=") return exact(!is_less(a[0], a[1]));
    if (word == "==") return exact(!is_less(a[0], a[1]) && !is_less(a[1], a[0]));
    if (word == "!=") return exact(is_less(a[0], a[1]) || is_less(a[1], a[0]));
    if (word == "and") return exact(int{is_true(a[0])} * int{is_true(a[1])});
    if (word == "or") return exact(int{is_true(a[0])} + int{is_true(a[1])} > 0);
    if (word == "not") return exact(!is_true(a[0]));
    if (word == "abs") return {std::abs(a[0].value), a[0].error};
    if (word == "sign") return exact(int{is_less(exact(0), a[0])} - int{is_less(a[0], exact(0))});
    if (word == "floor") return floor_of(a[0]);
    if (word == "ceil") return exact(-floor_of({-a[0].value, a[0].error}).value);
    if (word == "round") return floor_of(plus(a[0], exact(0.5)));
    if (word == "fract") return minus(a[0], floor_of(a[0]));
    if (word == "sqrt")
        return monotone(
            a[0], [](double x) { return std::sqrt(std::max(x, 0.0)); }, kUnit);
    if (word == "exp")
        return monotone(
            a[0], [](double x) { return std::exp(x); }, 2e-7);
    if (word == "exp2")
        return monotone(
            a[0], [](double x) { return std::exp2(x); }, 2e-7);
    if (word == "log2") {
        if (a[0].value - a[0].error <= 0) throw Unsure{};
        return monotone(
            a[0], [](double x) { return std::log2(x); }, 3e-7);
    }
    if (word == "sind") return sine(a[0], 0);
    if (word == "cosd") return sine(a[0], 90);
    if (word == "atan2d") return angle(a[0], a[1]);
    if (word == "hypot") return hypotenuse(a[0], a[1]);
    if (word == "min") return least(a[0], a[1]);
    if (word == "max") return a.size() == 2 ? most(a[0], a[1]) : most(most(a[0], a[1]), a[2]);
    if (word == "clamp") return least(most(a[0], a[1]), a[2]);
    if (word == "mix") return plus(times(a[0], minus(exact(1), a[2])), times(a[1], a[2]));
    if (word == "linstep") return share(a[0], a[1], a[2]);
    if (word == "smoothstep") {
        const U t = share(a[0], a[1], a[2]);
        return times(times(t, t), minus(exact(3), times(exact(2), t)));
    }
    throw std::logic_error("no such word: " + word);
}

/// By sixths of the circle, as it is usually written: another form than the engine's.
Triple from_hsv(const U& hue, const U& saturation, const U& value) {
    const U turn = modulo(over(hue, exact(60)), exact(6));
    const int sector = static_cast<int>(floor_of(turn).value);
    const U f = minus(turn, exact(sector));
    const U low = times(value, minus(exact(1), saturation));
    const U falling = times(value, minus(exact(1), times(saturation, f)));
    const U rising = times(value, minus(exact(1), times(saturation, minus(exact(1), f))));
    switch (sector) {
        case 0:
            return {value, rising, low};
        case 1:
            return {falling, value, low};
        case 2:
            return {low, value, rising};
        case 3:
            return {low, falling, value};
        case 4:
            return {rising, low, value};
        default:
            return {value, low, falling};
    }
}

Triple walk(const Expression& e, const NamedValues& values) {
    if (e.operands.empty()) {
        if (e.word.front() == '#') {
            Triple color;
            for (std::size_t k = 0; k < 3; ++k) color[k] = {e.color[k], 1e-6};
            return color;
        }
        if (!e.is_triple) {
            const auto found = values.find(e.word);
            const double value = found == values.end() ? e.number : static_cast<double>(found->second);
            return {exact(value), exact(value), exact(value)};
        }
        Triple result;
        for (std::size_t k = 0; k < 3; ++k)
            result[k] = exact(static_cast<double>(values.at(e.word + "." + std::to_string(k))));
        return result;
    }
    // All operands are computed, as the engine does, but only the chosen one must be certain.
    if (e.word == "?" || e.word == "if" || e.word == "select")
        return walk(e.operands[is_true(walk(e.operands[0], values)[0]) ? 1 : 2], values);
    std::vector<Triple> a;
    for (const Expression& operand : e.operands) a.push_back(walk(operand, values));
    const auto same = [](const U& value) { return Triple{value, value, value}; };
    if (e.word.front() == '.') return same(a[0][e.word == ".x" ? 0 : e.word == ".g" ? 1 : 2]);
    if (e.word == "rgb") return {a[0][0], a[1][0], a[2][0]};
    if (e.word == "hsv") {
        Triple color = from_hsv(a[0][0], a[1][0], a[2][0]);
        // The engine's form differs in its rounding.
        for (U& part : color)
            part.error =
                4 * part.error + 4e-6 * (std::abs(a[2][0].value) * (1 + std::abs(a[1][0].value)) + 1) +
                8 * (a[0][0].error + kUnit * std::abs(a[0][0].value)) * (std::abs(a[2][0].value * a[1][0].value) + 1);
        return color;
    }
    if (e.word == "luminance") return same(dot(a[0], {U{0.2126, 2e-8}, U{0.7152, 6e-8}, U{0.0722, 1e-8}}));
    if (e.word == "dot") return same(dot(a[0], a[1]));
    if (e.word == "length") return same(hypotenuse(hypotenuse(a[0][0], a[0][1]), a[0][2]));
    if (e.word == "normalize") {
        const U length = hypotenuse(hypotenuse(a[0][0], a[0][1]), a[0][2]);
        if (!is_true(length)) return a[0];
        return {over(a[0][0], length), over(a[0][1], length), over(a[0][2], length)};
    }
    Triple result;
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<U> parts;
        for (const Triple& operand : a) parts.push_back(operand[k]);
        result[k] = scalar(e.word, parts);
    }
    return result;
}

}  // namespace

std::optional<std::array<Uncertain, 3>> walk_over(const RandomExpression& expression, const NamedValues& values) {
    try {
        return walk(expression, values);
    } catch (const Unsure&) {
        return std::nullopt;
    }
}

}  // namespace burin::test
