#include "tests/shading/test_symbols.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "lines/line_class.h"
#include "tests/support/random.h"

namespace burin::test {
namespace {

ExpressionSymbols make_symbols() {
    using enum ValueType;
    using enum ValueRate;
    const auto classes =
        std::make_shared<NameList>(NameList{"class", {kLineClassNames.begin(), kLineClassNames.end()}, 0, true});
    const auto objects =
        std::make_shared<NameList>(NameList{"object", {"wheel_left", "wheel_right", "body"}, 1, false});
    const auto materials = std::make_shared<NameList>(NameList{"material", {"steel", "glass"}, 1, false});
    ExpressionSymbols symbols;
    symbols.variables = {
        {"depth", number, sample},
        {"px_size", number, sample},
        {"facing", number, sample},
        {"gap", number, sample},
        {"light", number, sample},
        {"s", number, sample},
        {"t", number, sample},
        {"kr", number, sample},
        {"qi", number, piece},
        {"length_px", number, chain},
        {"rand_chain", number, piece},
        {"frame", number, frame},
        {"C", color, piece},
        {"P", vector, sample},
        {"N", vector, sample},
        {"class", number, piece, classes},
        {"object", number, piece, objects},
        {"object2", number, piece, objects},
        {"material", number, piece, materials},
        {"material2", number, piece, materials},
    };
    symbols.parameters = {{"width", number, {1.5f, 0, 0}}, {"ink", color, {0.25f, 0.5f, 1}}};
    symbols.lets = {
        {"shade", "1 - light"}, {"deep", "shade * depth"}, {"wrong", "1 +"}, {"ring", "2 * gnir"}, {"gnir", "ring"}};
    symbols.groups = {{"wheels", "object", {"wheel*", "!*right"}},
                      {"wheels", "material", {"steel"}},
                      {"metals", "material", {"steel"}}};
    symbols.ramps = {{"fade", {{{0, {0, 0, 0}}, {10, {5, 0, 0}}}}}, {"sky", {{{0, {1, 0, 0}}, {1, {0, 0, 1}}}, true}}};
    symbols.later = {"suggestive", "ridge", "k1", "valley"};
    return symbols;
}

}  // namespace

const ExpressionSymbols& test_symbols() {
    static const ExpressionSymbols symbols = make_symbols();
    return symbols;
}

std::vector<const ExpressionKernels*> all_expression_kernels() {
    std::vector<const ExpressionKernels*> result{&baseline_expression_kernels()};
    for (const ExpressionKernels* kernels : {avx2_expression_kernels(), avx512_expression_kernels()}) {
        if (kernels != nullptr) result.push_back(kernels);
    }
    return result;
}

std::vector<float> results_of(std::string_view text, bool is_color, const NamedValues& values) {
    const ExpressionProgram program = compile_expression(text, test_symbols(), {.is_color = is_color});
    std::vector<float> columns;
    for (const ExpressionInput& input : program.inputs()) {
        auto found = values.find(input.name);
        if (found == values.end()) found = values.find(input.name + "." + std::to_string(input.component));
        columns.push_back(found == values.end() ? 0 : found->second);
    }
    std::vector<const float*> pointers;
    for (const float& column : columns) pointers.push_back(&column);
    std::vector<float> result(is_color ? 3 : 1, -77);
    std::vector<float*> to;
    for (float& value : result) to.push_back(&value);
    NotNumbers not_numbers;
    program.evaluate(pointers, 1, to, {&not_numbers, 1});
    return result;
}

double value_of(std::string_view text, const NamedValues& values) {
    return static_cast<double>(results_of(text, false, values).front());
}

std::string fault_of(std::string_view text, const ExpressionTarget& target) {
    try {
        compile_expression(text, test_symbols(), target);
        return {};
    } catch (const ExpressionError& error) {
        return std::to_string(error.column()) + ": " + error.what();
    }
}

Columns::Columns(const ExpressionProgram& program, std::size_t count, bool with_special, std::uint64_t seed) {
    Random random(seed);
    const std::vector<float> special{0.0f,
                                     -0.0f,
                                     1.0f,
                                     -1.0f,
                                     std::numeric_limits<float>::infinity(),
                                     -std::numeric_limits<float>::infinity(),
                                     std::numeric_limits<float>::quiet_NaN(),
                                     std::numeric_limits<float>::max(),
                                     std::numeric_limits<float>::min(),
                                     -std::numeric_limits<float>::denorm_min()};
    for (std::size_t k = 0; k < program.inputs().size(); ++k) {
        std::vector<float>& column = values.emplace_back(count);
        for (float& value : column) {
            value = static_cast<float>(random.real(-2, 8));
            if (random.integer(0, 3) == 0) value = std::floor(value);
            if (with_special && random.integer(0, 7) == 0)
                value = special[static_cast<std::size_t>(random.integer(0, static_cast<int>(special.size()) - 1))];
        }
    }
    for (const std::vector<float>& column : values) pointers.push_back(column.data());
}

Results evaluate_in_batches(const ExpressionProgram& program, const Columns& columns, std::size_t count,
                            std::size_t batch, const ExpressionKernels& kernels) {
    std::size_t components = 0;
    for (const ExpressionOutput& output : program.outputs()) components += output.components;
    Results results{std::vector<std::vector<float>>(components, std::vector<float>(count, -77)),
                    std::vector<NotNumbers>(program.outputs().size())};
    std::vector<NotNumbers> found(program.outputs().size());
    for (std::size_t first = 0; first < count; first += batch) {
        std::vector<const float*> from;
        for (const float* column : columns.pointers) from.push_back(column + first);
        std::vector<float*> to;
        for (std::vector<float>& column : results.values) to.push_back(column.data() + first);
        program.evaluate(from, std::min(batch, count - first), to, found, kernels);
        for (std::size_t k = 0; k < found.size(); ++k) {
            NotNumbers& all = results.not_numbers[k];
            if (all.count == 0 && found[k].count > 0) all.first = first + found[k].first;
            all.count += found[k].count;
        }
    }
    return results;
}

}  // namespace burin::test
