// Reads its input as a style sheet, matches its sets with a few pieces, and computes its styles for a few samples.
// Anything must end in ink within its bounds, or in an InputError with a place in the sheet.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "scene/sheet_toml.h"
#include "shading/line_shader.h"
#include "shading/sheet/compiled_sheet.h"

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::array kColumn{0.0f,  1.0f,   -0.0f, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN(),
                             3e38f, 1e-40f, 2.5f,  -3.0f};

struct NoShader final : burin::LineShader {
    burin::VariableSet needs() const override { return {}; }
    void shade(const burin::StrokeSamples&, burin::StrokeInk&) const override {}
};
struct NoTest final : burin::LineTest {
    burin::VariableSet needs() const override { return {}; }
    void test(const burin::StrokeSamples&, std::span<float>) const override {}
};

void require(bool holds) {
    if (!holds) std::abort();
}

std::vector<std::vector<float>> results_of(const burin::ExpressionProgram& program, std::size_t count) {
    const std::vector<const float*> columns(program.inputs().size(), kColumn.data());
    std::vector<std::vector<float>> values(count, std::vector<float>(kColumn.size()));
    std::vector<float*> to;
    for (std::vector<float>& column : values) to.push_back(column.data());
    std::vector<burin::NotNumbers> not_numbers(program.outputs().size());
    program.evaluate(columns, kColumn.size(), to, not_numbers);
    return values;
}

void check_style(const burin::CompiledStyle& style) {
    const auto ink = results_of(style.ink, burin::kInkColumnCount);
    static_assert(burin::kInkValueCount == 4, "each of them has a range here");
    const auto column_of = [&ink](burin::InkValue value) { return ink[burin::column_of(value)]; };
    for (const float width : column_of(burin::InkValue::width)) require(width >= 0 && width <= 4096);
    for (const float opacity : column_of(burin::InkValue::opacity)) require(opacity >= 0 && opacity <= 1);
    for (const float offset : column_of(burin::InkValue::offset)) require(std::abs(offset) <= 4096);
    for (std::size_t k = burin::column_of(burin::InkValue::color); k < ink.size(); ++k) {
        for (const float part : ink[k]) require(part >= 0 && part <= 65504);
    }
    for (const std::vector<float>& column : results_of(style.chain, burin::kChainValueCount)) {
        for (const float value : column) require(std::abs(value) <= 65535);
    }
}

void check_match(const burin::CompiledSheet& sheet) {
    std::array<burin::LineClassSet, kColumn.size()> classes;
    std::array<std::uint8_t, kColumn.size()> invisibility{};
    for (std::size_t i = 0; i < kColumn.size(); ++i) {
        classes[i] = burin::LineClassSet::from_bits(static_cast<unsigned>(1u << i % burin::kLineClassCount | i));
        invisibility[i] = static_cast<std::uint8_t>(i * i * 3);
    }
    burin::MatchInput input{kColumn.size(), classes, invisibility, {}};
    for (auto& column : input.columns.columns) column.fill(kColumn.data());
    const burin::SetMatches matches = sheet.match(input);
    for (const std::uint16_t set : matches.sets) require(set < sheet.sets().size() && sheet.sets()[set].is_enabled);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    burin::SheetContext context;
    context.objects = {"wheel_left", "wheel_spare", "body"};
    context.materials = {"steel", "glass"};
    static const burin::LineShaders shaders{{{"mine", std::make_shared<NoShader>()}},
                                            {{"mine", std::make_shared<NoTest>()}}};
    context.shaders = &shaders;
    try {
        const burin::CompiledSheet sheet(burin::read_sheet_text(text, "s.toml"), context);
        for (const burin::CompiledStyle& style : sheet.styles()) check_style(style);
        check_match(sheet);
    } catch (const burin::InputError& error) {
        const std::string_view message = error.what();
        require(message.starts_with("s.toml:") && message.find('\n') == std::string_view::npos);
    }
    return 0;
}
