#include "shading/expression/builder.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "shading/expression/error.h"
#include "shading/expression/function_table.h"
#include "shading/expression/unknown_word.h"

namespace burin {
namespace {

using O = ExpressionOperation;

const char* name_of(ValueType type) {
    switch (type) {
        case ValueType::number:
            return "a number";
        case ValueType::color:
            return "a colour";
        case ValueType::vector:
            return "a vector";
    }
    return "";
}

}  // namespace

void ExpressionBuilder::fail(std::size_t offset, const std::string& message) const {
    throw ExpressionError(column_of(text_, offset), message);
}

void ExpressionBuilder::count_steps(std::size_t steps) {
    graph_.count_steps(steps);
    if (graph_.steps() > most_steps_)
        throw ExpressionError(1,
                              "the expressions of this sheet are too many or too long, where lets and inherited "
                              "values count wherever they are used: make them shorter");
}

TypedValue ExpressionBuilder::build(std::string_view text, ValueRate highest) {
    count_steps(text.size());
    const SyntaxTree tree = parse_expression(text);
    const auto outer = std::tuple(text_, highest_, tree_);
    text_ = text;
    highest_ = highest;
    tree_ = &tree;
    std::vector<TypedValue> built;
    built.reserve(tree.nodes.size());
    std::vector<TypedValue> operands;
    for (const SyntaxNode& part : tree.nodes) {
        operands.clear();
        for (std::size_t k = 0; k < part.operands; ++k) operands.push_back(built[tree.operands[part.first + k]]);
        TypedValue value = node(part, operands);
        value.begin = part.begin;
        built.push_back(value);
        count_steps(1);
        if (graph_.is_full()) fail(0, "the expression has more than 1024 operations: make it shorter");
    }
    if (built.back().is_text)
        fail(built.back().begin, "a text is no value: compare it with a name, as in class == \"crease\"");
    std::tie(text_, highest_, tree_) = outer;
    return built.back();
}

TypedValue ExpressionBuilder::node(const SyntaxNode& of, std::span<const TypedValue> operands) {
    const Token& token = of.token;
    switch (of.kind) {
        case SyntaxKind::number:
            return number(token);
        case SyntaxKind::color:
            return color(token.color);
        case SyntaxKind::text: {
            TypedValue value;
            value.is_text = true;
            value.text = token.words;
            return value;
        }
        case SyntaxKind::name:
            return name(token);
        case SyntaxKind::call:
            return call(of, operands);
        case SyntaxKind::unary:
            if (token.words == "-") return compute(O::negate, {operands[0]});
            require_number(operands[0], "what 'not' turns round");
            return compute(O::logical_not, {operands[0]});
        case SyntaxKind::binary:
            return binary(token, operands[0], operands[1]);
        case SyntaxKind::in:
            return membership(token, operands[0]);
        case SyntaxKind::choose:
            require_number(operands[0], "a condition");
            return compute(O::choose, {operands[0], operands[1], operands[2]});
        case SyntaxKind::component:
            if (operands[0].is_text || operands[0].type == ValueType::number)
                fail(token.offset, "a number has no components: only colours and vectors have");
            return component(operands[0], std::string_view("xyzrgb").find(token.words[0]) % 3);
    }
    return {};
}

TypedValue ExpressionBuilder::number(const Token& token) {
    const TypedValue value = constant(token.number);
    const double px_per_pt = symbols_.px_per_mm * 25.4 / 72;
    switch (token.unit) {
        case LengthUnit::px:
            return value;
        case LengthUnit::mm:
            return constant(static_cast<float>(static_cast<double>(token.number) * symbols_.px_per_mm));
        case LengthUnit::pt:
            return constant(static_cast<float>(static_cast<double>(token.number) * px_per_pt));
        case LengthUnit::world:
            return compute(O::divide, {value, variable("px_size", token.offset)});
    }
    return value;
}

TypedValue ExpressionBuilder::constant(float value) {
    TypedValue result;
    result.parts.fill(graph_.constant(value));
    return result;
}

TypedValue ExpressionBuilder::color(const std::array<float, 3>& linear) {
    TypedValue result;
    result.type = ValueType::color;
    for (std::size_t k = 0; k < 3; ++k) result.parts[k] = graph_.constant(linear[k]);
    return result;
}

TypedValue ExpressionBuilder::compute(O operation, std::initializer_list<TypedValue> values) {
    TypedValue result;
    for (const TypedValue& value : values) {
        if (value.is_text) fail(value.begin, "a text is no value: compare it with a name, as in class == \"crease\"");
        if (result.type == ValueType::number) result.type = value.type;
        result.rate = std::max(result.rate, value.rate);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (k > 0 && result.type == ValueType::number) {
            result.parts[k] = result.parts[0];
            continue;
        }
        std::array<ExpressionGraph::Index, 3> operands{};
        std::transform(values.begin(), values.end(), operands.begin(), [&](const TypedValue& v) { return v.parts[k]; });
        result.parts[k] = graph_.compute(operation, operands);
    }
    return result;
}

TypedValue ExpressionBuilder::component(const TypedValue& whole, std::size_t k) const {
    TypedValue result;
    result.parts.fill(whole.parts[k]);
    result.rate = whole.rate;
    return result;
}

TypedValue ExpressionBuilder::triple(ValueType type, const TypedValue& x, const TypedValue& y,
                                     const TypedValue& z) const {
    TypedValue result;
    result.type = type;
    result.parts = {x.parts[0], y.parts[0], z.parts[0]};
    result.rate = std::max({x.rate, y.rate, z.rate});
    return result;
}

void ExpressionBuilder::require_number(const TypedValue& value, std::string_view what) const {
    if (value.is_text) fail(value.begin, std::string(what) + " must be a number, not a text");
    if (value.type != ValueType::number)
        fail(value.begin, std::string(what) + " must be a number, not " + name_of(value.type));
}

void ExpressionBuilder::require_triple(const TypedValue& value, std::string_view what) const {
    if (value.is_text || value.type == ValueType::number)
        fail(value.begin, std::string(what) + " must be a colour or a vector, as C or P");
}

TypedValue ExpressionBuilder::binary(const Token& sign, const TypedValue& a, const TypedValue& b) {
    if (sign.words == "+") return compute(O::add, {a, b});
    if (sign.words == "-") return compute(O::subtract, {a, b});
    if (sign.words == "*") return compute(O::multiply, {a, b});
    if (sign.words == "/") return compute(O::divide, {a, b});
    if (sign.words == "%") return compute(O::modulo, {a, b});
    if (sign.words == "^") return compute(O::power, {a, b});
    if (sign.words == "and" || sign.words == "or") {
        require_number(a, "a condition");
        require_number(b, "a condition");
        return compute(sign.words == "and" ? O::logical_and : O::logical_or, {a, b});
    }
    return comparison(sign, a, b);
}

TypedValue ExpressionBuilder::comparison(const Token& sign, const TypedValue& a, const TypedValue& b) {
    const bool is_equality = sign.words == "==" || sign.words == "!=";
    TypedValue result;
    if (is_equality && a.is_text != b.is_text) {
        result = a.is_text ? is_name(b, a) : is_name(a, b);
    } else {
        require_number(a, "what is compared");
        require_number(b, "what is compared");
        if (a.names != nullptr && b.names != nullptr && a.names->kind != b.names->kind)
            fail(sign.offset, "names of kind '" + a.names->kind + "' and '" + b.names->kind + "' cannot be compared");
        const bool is_reversed = sign.words[0] == '>';
        const O operation = is_equality ? O::equal : sign.words.size() == 1 ? O::less : O::less_or_equal;
        result = is_reversed ? compute(operation, {b, a}) : compute(operation, {a, b});
    }
    return sign.words == "!=" ? compute(O::logical_not, {result}) : result;
}

TypedValue ExpressionBuilder::call(const SyntaxNode& node, std::span<const TypedValue> arguments) {
    const Token& token = node.token;
    const ExpressionFunction* const function = find_function(token.words);
    if (function == nullptr || is_word_of(symbols_.later, token.words)) fail_unknown_function(token);
    if (arguments.size() < function->least || arguments.size() > function->most) {
        const std::string most = function->most > 16 ? "or more" : "to " + std::to_string(function->most);
        const std::string count =
            std::to_string(function->least) + (function->most > function->least ? " " + most : "");
        fail(token.offset, signature(*function) + " takes " + count + (count == "1" ? " value" : " values") + ", not " +
                               std::to_string(arguments.size()));
    }
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        if (k < function->texts && !arguments[k].is_text)
            fail(arguments[k].begin, signature(*function) + " needs a text here, in double quotes");
        if (k >= function->texts && arguments[k].is_text)
            fail(arguments[k].begin, signature(*function) + " needs a value here, not a text");
    }
    return function->build(*this, {token.offset, arguments});
}

bool ExpressionBuilder::is_bright(const std::array<float, 3>& color) {
    return *std::max_element(color.begin(), color.end()) > 1;
}

void ExpressionBuilder::remark_bright(const TypedValue& color) {
    std::vector<std::array<ExpressionGraph::Index, 3>> ways{color.parts};
    constexpr std::size_t kMostWays = 64;
    for (std::size_t i = 0; i < ways.size() && i < kMostWays; ++i) {
        const auto parts = ways[i];
        for (const BrightStop& stop : bright_stops_) {
            if (stop.ramp == parts) remarks_.add(stop.value);
        }
        const auto all_of = [&](const auto& is) { return is(parts[0]) && is(parts[1]) && is(parts[2]); };
        if (all_of([&](auto part) { return graph_.is_constant(part); })) {
            const std::array<float, 3> value{graph_.constant_value(parts[0]), graph_.constant_value(parts[1]),
                                             graph_.constant_value(parts[2])};
            if (is_bright(value)) remarks_.add(value);
        } else if (all_of([&](auto part) {
                       const GraphNode& node = graph_.nodes()[part];
                       return node.kind == GraphNode::Kind::operation && node.operation == O::choose;
                   })) {
            for (const std::size_t way : {1, 2}) {
                ways.push_back({graph_.nodes()[parts[0]].operands[way], graph_.nodes()[parts[1]].operands[way],
                                graph_.nodes()[parts[2]].operands[way]});
            }
        }
    }
}

TypedValue ExpressionBuilder::ramp(const Ramp& ramp, const TypedValue& x) {
    require_number(x, "where a ramp is looked at");
    const TypedValue first = constant(ramp.stops.front().at), last = constant(ramp.stops.back().at);
    TypedValue place = x;
    if (ramp.outside != RampOutside::hold && ramp.stops.size() > 1) {
        const TypedValue length = compute(O::subtract, {last, first}), from_first = compute(O::subtract, {x, first});
        if (ramp.outside == RampOutside::repeat) {
            place = compute(O::add, {first, compute(O::modulo, {from_first, length})});
        } else {
            const TypedValue both_ways = compute(O::add, {length, length});
            const TypedValue there = compute(O::modulo, {from_first, both_ways});
            place = compute(O::add, {first, compute(O::minimum, {there, compute(O::subtract, {both_ways, there})})});
        }
    }
    TypedValue result;
    result.type = ramp.is_color ? ValueType::color : ValueType::number;
    result.rate = x.rate;
    for (std::size_t k = 0; k < 3; ++k) {
        result.parts[k] =
            k > 0 && !ramp.is_color ? result.parts[0] : graph_.look_up(O::ramp, place.parts[0], ramp_table(ramp, k));
    }
    for (const RampStop& stop : ramp.stops) {
        if (ramp.is_color && is_bright(stop.value)) bright_stops_.push_back({result.parts, stop.value});
    }
    return result;
}

}  // namespace burin
