#include "shading/expression/function_table.h"

#include <array>

#include "shading/expression/error.h"

namespace burin {
namespace {

using O = ExpressionOperation;
using Builder = ExpressionBuilder;
using Arguments = std::span<const TypedValue>;

/// Functions that are one operation, component by component.
template <O operation>
TypedValue one(Builder& b, const FunctionCall& call) {
    const Arguments a = call.arguments;
    if constexpr (operand_count(operation) == 1) return b.compute(operation, {a[0]});
    if constexpr (operand_count(operation) == 2) return b.compute(operation, {a[0], a[1]});
    if constexpr (operand_count(operation) == 3) return b.compute(operation, {a[0], a[1], a[2]});
}

/// The least or the largest of two values or more.
template <O operation>
TypedValue all(Builder& b, const FunctionCall& call) {
    TypedValue value = call.arguments[0];
    for (const TypedValue& next : call.arguments.subspan(1)) value = b.compute(operation, {value, next});
    return value;
}

TypedValue clamp(Builder& b, const FunctionCall& call) {
    const Arguments a = call.arguments;
    return b.compute(O::minimum, {b.compute(O::maximum, {a[0], a[1]}), a[2]});
}

TypedValue mix(Builder& b, const FunctionCall& call) {
    const Arguments a = call.arguments;
    const TypedValue rest = b.compute(O::subtract, {b.constant(1), a[2]});
    return b.compute(O::add, {b.compute(O::multiply, {a[0], rest}), b.compute(O::multiply, {a[1], a[2]})});
}

TypedValue choose(Builder& b, const FunctionCall& call) {
    b.require_number(call.arguments[0], "a condition");
    return one<O::choose>(b, call);
}

TypedValue rgb(Builder& b, const FunctionCall& call) {
    for (const TypedValue& part : call.arguments) b.require_number(part, "a part of rgb()");
    return b.triple(ValueType::color, call.arguments[0], call.arguments[1], call.arguments[2]);
}

/// A channel is v - v s clamp(min(k, 4 - k), 0, 1), where k is 5, 3 or 1 and a sixth of a turn per 60 degrees, mod 6.
TypedValue hsv(Builder& b, const FunctionCall& call) {
    for (const TypedValue& part : call.arguments) b.require_number(part, "a part of hsv()");
    const TypedValue& value = call.arguments[2];
    const TypedValue sixths = b.compute(O::divide, {call.arguments[0], b.constant(60)});
    const TypedValue colored = b.compute(O::multiply, {value, call.arguments[1]});
    const auto channel = [&](float n) {
        const TypedValue k = b.compute(O::modulo, {b.compute(O::add, {sixths, b.constant(n)}), b.constant(6)});
        const TypedValue slope = b.compute(O::minimum, {k, b.compute(O::subtract, {b.constant(4), k})});
        const TypedValue share = b.compute(O::maximum, {b.compute(O::minimum, {slope, b.constant(1)}), b.constant(0)});
        return b.compute(O::subtract, {value, b.compute(O::multiply, {colored, share})});
    };
    const TypedValue red = channel(5), green = channel(3), blue = channel(1);
    return b.triple(ValueType::color, red, green, blue);
}

TypedValue dot_of(Builder& b, const TypedValue& u, const TypedValue& v) {
    const TypedValue products = b.compute(O::multiply, {u, v});
    return b.compute(
        O::add, {b.compute(O::add, {b.component(products, 0), b.component(products, 1)}), b.component(products, 2)});
}

TypedValue luminance(Builder& b, const FunctionCall& call) {
    b.require_triple(call.arguments[0], "what luminance() is of");
    return dot_of(b, call.arguments[0], b.color({0.2126f, 0.7152f, 0.0722f}));
}

TypedValue dot(Builder& b, const FunctionCall& call) {
    b.require_triple(call.arguments[0], "what dot() takes");
    b.require_triple(call.arguments[1], "what dot() takes");
    return dot_of(b, call.arguments[0], call.arguments[1]);
}

TypedValue length_of(Builder& b, const TypedValue& v) {
    return b.compute(O::hypotenuse,
                     {b.compute(O::hypotenuse, {b.component(v, 0), b.component(v, 1)}), b.component(v, 2)});
}

TypedValue length(Builder& b, const FunctionCall& call) {
    b.require_triple(call.arguments[0], "what length() is of");
    return length_of(b, call.arguments[0]);
}

/// Of a vector without length: itself.
TypedValue normalize(Builder& b, const FunctionCall& call) {
    b.require_triple(call.arguments[0], "what normalize() takes");
    const TypedValue length = length_of(b, call.arguments[0]);
    return b.compute(O::choose, {length, b.compute(O::divide, {call.arguments[0], length}), call.arguments[0]});
}

TypedValue noise(Builder& b, const FunctionCall& call) {
    for (const TypedValue& value : call.arguments) b.require_number(value, "what noise() takes");
    return b.compute(O::noise, {call.arguments[0], call.arguments.size() > 1 ? call.arguments[1] : b.constant(0)});
}

TypedValue noise_at(Builder& b, const TypedValue& place) {
    return b.compute(O::noise3, {b.component(place, 0), b.component(place, 1), b.component(place, 2)});
}

TypedValue noise3(Builder& b, const FunctionCall& call) {
    b.require_triple(call.arguments[0], "where noise3() is looked at");
    return noise_at(b, call.arguments[0]);
}

/// Octave i is of half the size and strength of the one before it. Their strengths add up to 1.
TypedValue fbm(Builder& b, const FunctionCall& call) {
    b.require_triple(call.arguments[0], "where fbm() is looked at");
    const TypedValue& octaves = call.arguments[1];
    b.require_number(octaves, "the number of octaves");
    const float count = b.is_constant(octaves) ? b.constant_value(octaves) : 0;
    constexpr int kMost = 8;
    int whole = 0;
    for (int i = 1; i <= kMost; ++i) {
        if (count == static_cast<float>(i)) whole = i;
    }
    if (whole == 0)
        b.fail(octaves.begin, "the number of octaves must be a whole number from 1 to 8 that does not vary");
    const float all_strengths = 2 - 1 / static_cast<float>(1 << (whole - 1));
    TypedValue sum;
    for (int i = 0; i < whole; ++i) {
        const auto times = static_cast<float>(1 << i);
        const TypedValue scaled = b.compute(O::multiply, {call.arguments[0], b.constant(times)});
        const TypedValue place = b.compute(O::add, {scaled, b.constant(31.7f * static_cast<float>(i))});
        const TypedValue octave = b.compute(O::multiply, {noise_at(b, place), b.constant(1 / (times * all_strengths))});
        sum = i == 0 ? octave : b.compute(O::add, {sum, octave});
    }
    return b.compute(O::maximum, {b.compute(O::minimum, {sum, b.constant(1)}), b.constant(-1)});
}

/// Where the surface is flat, or bends towards the eye, the distance is very large, not NaN.
TypedValue isophote(Builder& b, const FunctionCall& call) {
    b.require_number(call.arguments[0], "what isophote() takes");
    const TypedValue e =
        b.compute(O::minimum, {b.compute(O::maximum, {call.arguments[0], b.constant(0)}), b.constant(1)});
    const TypedValue bend = b.compute(O::maximum, {b.variable("kr", call.offset), b.constant(0)});
    const TypedValue scale = b.compute(O::multiply, {bend, b.variable("px_size", call.offset)});
    const TypedValue rest = b.compute(O::subtract, {b.constant(1), b.compute(O::multiply, {e, e})});
    const TypedValue height = b.compute(O::subtract, {b.constant(1), b.compute(O::square_root, {rest})});
    return b.compute(O::divide, {height, b.compute(O::maximum, {scale, b.constant(1e-37f)})});
}

TypedValue attr(Builder& b, const FunctionCall& call) {
    return b.attribute(call.arguments[0].text, call.arguments[0].begin);
}

TypedValue ramp(Builder& b, const FunctionCall& call) { return b.ramp_named(call.arguments[0], call.arguments[1]); }

TypedValue between(Builder& b, const FunctionCall& call, std::string_view one_side, std::string_view other_side) {
    const TypedValue u = b.variable(one_side, call.offset), v = b.variable(other_side, call.offset);
    const TypedValue &first = call.arguments[0], &second = call.arguments[1];
    const TypedValue straight = b.compute(O::logical_and, {b.is_name(u, first), b.is_name(v, second)});
    const TypedValue reversed = b.compute(O::logical_and, {b.is_name(u, second), b.is_name(v, first)});
    return b.compute(O::logical_or, {straight, reversed});
}

TypedValue between_objects(Builder& b, const FunctionCall& call) { return between(b, call, "object", "object2"); }
TypedValue between_materials(Builder& b, const FunctionCall& call) { return between(b, call, "material", "material2"); }

constexpr std::size_t kAnyNumber = 64;

constexpr std::array kFunctions = std::to_array<ExpressionFunction>({
    {"min", "a, b, ...", 2, kAnyNumber, 0, all<O::minimum>},
    {"max", "a, b, ...", 2, kAnyNumber, 0, all<O::maximum>},
    {"clamp", "x, low, high", 3, 3, 0, clamp},
    {"abs", "x", 1, 1, 0, one<O::magnitude>},
    {"sign", "x", 1, 1, 0, one<O::sign>},
    {"floor", "x", 1, 1, 0, one<O::floor>},
    {"ceil", "x", 1, 1, 0, one<O::ceiling>},
    {"round", "x", 1, 1, 0, one<O::round>},
    {"fract", "x", 1, 1, 0, one<O::fraction>},
    {"mod", "a, b", 2, 2, 0, one<O::modulo>},
    {"sqrt", "x", 1, 1, 0, one<O::square_root>},
    {"exp", "x", 1, 1, 0, one<O::exponential>},
    {"exp2", "x", 1, 1, 0, one<O::exponential2>},
    {"log2", "x", 1, 1, 0, one<O::logarithm2>},
    {"pow", "x, y", 2, 2, 0, one<O::power>},
    {"hypot", "x, y", 2, 2, 0, one<O::hypotenuse>},
    {"sind", "x", 1, 1, 0, one<O::sine>},
    {"cosd", "x", 1, 1, 0, one<O::cosine>},
    {"atan2d", "y, x", 2, 2, 0, one<O::angle>},
    {"mix", "a, b, t", 3, 3, 0, mix},
    {"step", "edge, x", 2, 2, 0, one<O::less_or_equal>},
    {"smoothstep", "edge0, edge1, x", 3, 3, 0, one<O::smooth_step>},
    {"linstep", "edge0, edge1, x", 3, 3, 0, one<O::linear_step>},
    {"if", "condition, a, b", 3, 3, 0, choose},
    {"select", "condition, a, b", 3, 3, 0, choose},
    {"rgb", "red, green, blue", 3, 3, 0, rgb},
    {"hsv", "hue, saturation, value", 3, 3, 0, hsv},
    {"luminance", "color", 1, 1, 0, luminance},
    {"dot", "a, b", 2, 2, 0, dot},
    {"length", "v", 1, 1, 0, length},
    {"normalize", "v", 1, 1, 0, normalize},
    {"noise", "x, seed", 1, 2, 0, noise},
    {"noise3", "P", 1, 1, 0, noise3},
    {"fbm", "P, octaves", 2, 2, 0, fbm},
    {"isophote", "e", 1, 1, 0, isophote},
    {"attr", "\"name\"", 1, 1, 1, attr},
    {"ramp", "\"name\", x", 2, 2, 1, ramp},
    {"between_objects", "\"a\", \"b\"", 2, 2, 2, between_objects},
    {"between_materials", "\"a\", \"b\"", 2, 2, 2, between_materials},
});

}  // namespace

std::span<const ExpressionFunction> expression_functions() { return kFunctions; }

const ExpressionFunction* find_function(std::string_view name) {
    for (const ExpressionFunction& function : kFunctions) {
        if (function.name == name) return &function;
    }
    return nullptr;
}

std::string signature(const ExpressionFunction& function) {
    return std::string(function.name) + "(" + std::string(function.arguments) + ")";
}

}  // namespace burin
