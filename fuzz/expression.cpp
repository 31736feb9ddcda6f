// Reads its input as an expression of a style sheet, and computes it for a few samples. Anything must end in results or
// in an ExpressionError with a place in the text. The first byte says what the expression is for.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "shading/expression.h"

namespace {

burin::ExpressionSymbols make_symbols() {
    using enum burin::ValueType;
    using enum burin::ValueRate;
    const auto classes = std::make_shared<burin::NameList>(
        burin::NameList{"class", {"mark", "border", "silhouette", "crease"}, 0, true});
    const auto objects =
        std::make_shared<burin::NameList>(burin::NameList{"object", {"wheel_left", "wheel_right", "body"}, 1, false});
    burin::ExpressionSymbols symbols;
    symbols.variables = {{"depth", number, sample},
                         {"px_size", number, sample},
                         {"t", number, sample},
                         {"kr", number, sample},
                         {"qi", number, piece},
                         {"length_px", number, chain},
                         {"C", color, piece},
                         {"P", vector, sample},
                         {"class", number, piece, classes},
                         {"object", number, piece, objects},
                         {"object2", number, piece, objects}};
    symbols.parameters = {{"width", number, {1.5f, 0, 0}}, {"ink", color, {0.25f, 0.5f, 1}}};
    symbols.lets = {{"shade", "1 - t"}, {"ring", "ring + 1"}};
    symbols.groups = {{"wheels", "object", {"wheel*", "!*right"}}};
    symbols.ramps = {{"fade", {{{0, {0, 0, 0}}, {10, {5, 0, 0}}}, false, burin::RampBetween::curve}},
                     {"sky", {{{0, {1, 0, 0}}, {1, {0, 0, 1}}}, true, {}, burin::RampOutside::mirror}}};
    symbols.later = {"ridge"};
    return symbols;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const burin::ExpressionSymbols symbols = make_symbols();
    if (size == 0) return 0;
    const burin::ExpressionTarget target{.is_color = data[0] % 2 == 0,
                                         .least = -1000,
                                         .most = 1000,
                                         .highest_rate = static_cast<burin::ValueRate>(3 - data[0] / 2 % 4)};
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        const burin::ExpressionProgram program = burin::compile_expression(text, symbols, target);
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        static constexpr std::array kColumn{
            0.0f,  1.0f,   -0.0f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN(),
            3e38f, 1e-40f, 2.5f,  -3.0f};
        const std::vector<const float*> columns(program.inputs().size(), kColumn.data());
        std::array<std::array<float, kColumn.size()>, 3> values{};
        const std::array<float*, 3> to{values[0].data(), values[1].data(), values[2].data()};
        burin::NotNumbers not_numbers;
        program.evaluate(columns, kColumn.size(), to, {&not_numbers, 1});
        for (const auto& component : values) {
            for (const float value : component) {
                if (!(std::abs(value) <= 1000)) std::abort();
            }
        }
    } catch (const burin::ExpressionError& error) {
        if (error.column() < 1 || error.column() > text.size() + 1) std::abort();
    }
    return 0;
}
