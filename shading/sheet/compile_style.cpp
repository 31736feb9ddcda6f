#include "shading/sheet/compile_style.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "shading/expression.h"
#include "shading/expression/error.h"
#include "shading/expression/unknown_word.h"
#include "shading/line_shader.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {
namespace {

using Kind = StyleValue::Kind;

constexpr float kMostWidthPx = 4096, kMostLengthPx = 65535, kMostHaloPx = 1024;
constexpr float kMostColor = 65504;        // the largest half
constexpr float kLeastDashPx = 1.0f / 64;  // so that no line has too many

struct Range {
    float least, most;
};

/// Puts the values of a style, one after the other, into a program.
class ValueCompiler {
  public:
    ValueCompiler(const ExpressionSymbols& symbols, const SheetContext& context, ValueRate highest,
                  std::size_t most_steps)
        : compiler_(symbols, most_steps), context_(context), highest_(highest) {}

    void add(const StyleValue& value, Range range) { add(value, {false, range.least, range.most, highest_}); }
    void add_color(const StyleValue& value) { add(value, {true, 0, kMostColor, highest_}); }

    std::size_t steps() const { return compiler_.steps(); }
    const ExpressionRemarks& remarks() const { return compiler_.remarks(); }

    ExpressionProgram program(const std::string& style, const SourcePosition& where) const {
        try {
            return compiler_.program();
        } catch (const ExpressionError& error) {
            throw InputError(where, "[style." + style + "]: " + error.what());
        }
    }

    /// The most that a value can be, as far as that is known without its variables.
    float most_of(const StyleValue& value, Range range) const {
        double most = range.most;
        if (value.kind == Kind::number && value.unit != SheetUnit::world) most = pixels(value.number, value.unit);
        if (value.kind == Kind::ramp) {
            most = 0;
            for (const RampStop& stop : value.ramp.stops)
                most = std::max(most, std::abs(pixels(static_cast<double>(stop.value[0]), value.unit)));
        }
        return static_cast<float>(std::min(std::abs(most), static_cast<double>(range.most)));
    }

  private:
    double pixels(double number, SheetUnit unit) const { return in_pixels(number, unit, context_); }

    void add(const StyleValue& value, const ExpressionTarget& target) {
        try {
            switch (value.kind) {
                case Kind::number:
                    compiler_.add(text_of_number(value, target), target);
                    return;
                case Kind::color:
                    compiler_.add("rgb(" + text_of(static_cast<double>(value.color[0])) + ", " +
                                      text_of(static_cast<double>(value.color[1])) + ", " +
                                      text_of(static_cast<double>(value.color[2])) + ")",
                                  target);
                    return;
                case Kind::expression:
                    compiler_.add(value.source.text, target);
                    return;
                case Kind::ramp:
                    add_ramp(value, target);
                    return;
            }
        } catch (const ExpressionError& error) {
            value.source.fail(error.column(), error.what());
        }
    }

    std::string text_of_number(const StyleValue& value, const ExpressionTarget& target) const {
        if (value.unit == SheetUnit::world) {
            if (target.highest_rate != ValueRate::sample)
                value.source.fail("a length in world units changes along a line; here it must be in px, mm, pt or %");
            return text_of(value.number) + "world";
        }
        double px = pixels(value.number, value.unit);
        // In pictures of another size it is possible.
        if (value.unit == SheetUnit::percent) {
            const auto most = static_cast<double>(target.most);
            px = std::clamp(px, -most, most);
        }
        if (px > static_cast<double>(target.most) || px < -static_cast<double>(std::abs(target.most)))
            value.source.fail("is " + text_of(px) + " px; at most " + text_of(static_cast<double>(target.most)) +
                              " px are possible");
        return text_of(px);
    }

    void add_ramp(const StyleValue& value, const ExpressionTarget& target) {
        if (value.ramp.is_color != target.is_color) {
            value.source.fail(target.is_color ? "the values of this ramp must be colours"
                                              : "the values of this ramp must be numbers, not colours");
        }
        Ramp ramp = value.ramp;
        if (!ramp.is_color) {
            for (RampStop& stop : ramp.stops)
                stop.value[0] = static_cast<float>(pixels(static_cast<double>(stop.value[0]), value.unit));
        }
        if (const auto fault = fault_of_ramp(ramp)) value.source.fail(*fault);
        compiler_.add_ramp(ramp, value.source.text, target);
    }

    ExpressionCompiler compiler_;
    const SheetContext& context_;
    ValueRate highest_;
};

/// What a sheet's name stands for. `kind`: "line shader"; `call`: of the library, that adds one.
template <typename Named>
typename Named::mapped_type named(const SheetText& name, const Named* known, const std::string& kind,
                                  const std::string& call) {
    if (known == nullptr)
        name.fail("a " + kind + " is code of a program that draws with the library (" + call +
                  "); this program has none");
    if (const auto found = known->find(name.text); found != known->end()) return found->second;
    std::vector<std::string> names;
    for (const auto& one : *known) names.push_back(one.first);
    const std::string suggestion = suggestion_of(name.text, names);
    name.fail("there is no " + kind + " " + in_quotes(name.text) +
              (suggestion.empty() ? "; the program that draws adds it by " + call : suggestion));
}

bool is_zero(const StyleValue& value) { return value.kind == Kind::number && value.number == 0; }

}  // namespace

std::shared_ptr<const LineShader> shader_named(const SheetText& name, const LineShaders* known) {
    return named(name, known == nullptr ? nullptr : &known->shaders, "line shader", "burin_add_line_shader()");
}
std::shared_ptr<const LineTest> test_named(const SheetText& name, const LineShaders* known) {
    return named(name, known == nullptr ? nullptr : &known->tests, "line test", "burin_add_line_test()");
}

VariableSet variables_of(const ExpressionProgram& program) {
    VariableSet set;
    for (const ExpressionInput& input : program.inputs()) {
        if (input.is_attribute) continue;
        if (const auto variable = variable_named(input.name)) set.add(*variable, input.component);
    }
    return set;
}

CompiledStyle compile_style(const SheetStyle& style, const ExpressionSymbols& symbols, const SheetContext& context,
                            std::size_t& steps_left) {
    CompiledStyle result;
    result.name = style.name;
    result.settings = style.settings;
    result.has_taper = style.taper && !(is_zero(style.taper->start) && is_zero(style.taper->end));
    result.has_wobble = style.wobble && !is_zero(style.wobble->amplitude);
    result.has_overshoot = !is_zero(style.overshoot);
    result.has_offset = !is_zero(style.offset);
    result.has_halo = !is_zero(style.halo);
    result.has_min_length = !(is_zero(style.min_length[0]) && is_zero(style.min_length[1]));
    result.dash_lengths = style.dash.size();
    const StyleTaper taper = style.taper.value_or(StyleTaper{});
    const StyleWobble wobble = style.wobble.value_or(StyleWobble{.amplitude = StyleValue::of(0)});
    result.taper_shape = taper.shape;
    result.taper_at = taper.at;
    result.wobble_octaves = wobble.octaves;
    result.wobble_anchor = wobble.anchor;
    result.wobble_pin = wobble.pin;
    result.smooth_px = static_cast<float>(in_pixels(style.smooth.number, style.smooth.unit, context));
    if (style.smooth.unit == SheetUnit::percent) result.smooth_px = std::min(result.smooth_px, kMostHaloPx);
    if (result.smooth_px > kMostHaloPx)
        style.smooth.source.fail("is " + text_of(static_cast<double>(result.smooth_px)) +
                                 " px; at most 1024 are possible");

    constexpr Range kShare{0, 1}, kWidth{0, kMostWidthPx}, kWay{-kMostWidthPx, kMostWidthPx}, kLength{0, kMostLengthPx};
    constexpr Range kWavelength{0.25f, kMostLengthPx};
    constexpr Range kDash{kLeastDashPx, kMostLengthPx}, kPhase{-kMostLengthPx, kMostLengthPx}, kHalo{0, kMostHaloPx};
    ValueCompiler ink(symbols, context, ValueRate::sample, steps_left);
    static_assert(kInkValueCount == 4, "they are added in the order of InkValue");
    ink.add(style.width, kWidth);
    ink.add(style.opacity, kShare);
    ink.add(style.offset, kWay);
    ink.add_color(style.color);
    result.ink = ink.program(style.name, style.where);

    steps_left -= std::min(steps_left, ink.steps());

    ValueCompiler chain(symbols, context, ValueRate::chain, steps_left);
    static_assert(kChainValueCount == 11 + kMostDashLengths, "they are added in the order of ChainValue");
    chain.add(taper.start, kLength);
    chain.add(taper.end, kLength);
    chain.add(style.dash_phase, kPhase);
    chain.add(style.overshoot, kWay);
    chain.add(wobble.amplitude, kWidth);
    chain.add(wobble.wavelength, kWavelength);
    chain.add(style.halo, kHalo);
    for (const StyleValue& depth : style.halo_depth) chain.add(depth, kLength);
    for (const StyleValue& length : style.min_length) chain.add(length, kLength);
    for (std::size_t k = 0; k < kMostDashLengths; ++k)
        chain.add(k < style.dash.size() ? style.dash[k] : StyleValue::of(1), kDash);
    result.chain = chain.program(style.name, style.where);
    steps_left -= std::min(steps_left, chain.steps());
    result.remarks = ink.remarks();
    result.remarks.add(chain.remarks());

    result.variables = variables_of(result.ink);
    result.variables |= variables_of(result.chain);
    if (style.shader) {
        result.shader = shader_named(*style.shader, context.shaders);
        result.variables |= result.shader->needs();
    }
    for (const ExpressionInput& input : result.ink.inputs()) {
        if (input.is_attribute) result.attributes.push_back(input.name);
    }
    if (result.has_wobble && result.wobble_anchor == WobbleAnchor::object) {
        result.variables.add(Variable::PO);
        result.variables.add(Variable::px_size);
    }
    result.needs_chains = result.has_taper || result.has_wobble || result.has_overshoot || result.has_offset ||
                          result.has_min_length || result.dash_lengths > 0 || result.smooth_px > 0 || result.shader ||
                          result.settings.copies > 1 || result.settings.caps == StrokeCaps::butt ||
                          result.variables.has_tier(VariableTier::chains);
    result.needs_ends = result.has_overshoot || (result.has_taper && result.taper_at != TaperAt::all);
    const float most_width = style.shader ? kMostWidthPx : ink.most_of(style.width, kWidth);
    const float most_offset = style.shader ? kMostWidthPx : ink.most_of(style.offset, kWay);
    result.most_reach_px = 0.5f * most_width + most_offset + chain.most_of(style.overshoot, kWay) +
                           chain.most_of(wobble.amplitude, kWidth) + chain.most_of(style.halo, kHalo);
    return result;
}

}  // namespace burin
