#include "shading/surface/surface_look.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "kernels/expression_kernels.h"
#include "shading/expression.h"
#include "shading/expression/ramp.h"
#include "shading/sheet/sheet_attributes.h"
#include "shading/sheet/sheet_notes.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {
namespace {

constexpr float kMostSurfaceColor = 65504;  // the largest half
constexpr std::array<std::string_view, kSurfaceVariableCount - 1> kNames = {
    "x",     "y",   "depth", "distance", "px_size",  "P",  "PO", "N", "facing",
    "light", "lit", "C",     "object",   "material", "kr", "u",  "v", "Cv"};

std::optional<SurfaceVariable> surface_variable_named(std::string_view name) {
    const auto* const at = std::find(kNames.begin(), kNames.end(), name);
    if (at == kNames.end()) return std::nullopt;
    return static_cast<SurfaceVariable>(at - kNames.begin());
}

/// The names that expressions of surfaces may use: of the variables of lines, those that surfaces have, too.
ExpressionSymbols surface_symbols(const SheetContext& context) {
    ExpressionSymbols symbols = symbols_of(StyleSheet{}, context);
    std::erase_if(symbols.variables, [](const ExpressionVariable& v) { return !surface_variable_named(v.name); });
    if (std::none_of(symbols.variables.begin(), symbols.variables.end(), [](const auto& v) { return v.name == "lit"; }))
        symbols.variables.push_back({"lit"});
    for (ExpressionVariable& v : symbols.variables) v.rate = ValueRate::sample;
    symbols.later.clear();
    symbols.hint_for_unknown = "; surfaces have variables of their own, and know no parameters and lets of a sheet";
    return symbols;
}

/// Puts values of surfaces into one program.
class SurfaceCompiler {
  public:
    explicit SurfaceCompiler(const SheetContext& context) : symbols_(surface_symbols(context)), compiler_(symbols_) {}

    void add(const StyleValue& value, const ExpressionTarget& target) {
        try {
            switch (value.kind) {
                case StyleValue::Kind::number:
                    compiler_.add(text_of(value.number), target);
                    return;
                case StyleValue::Kind::color:
                    compiler_.add("rgb(" + text_of(static_cast<double>(value.color[0])) + ", " +
                                      text_of(static_cast<double>(value.color[1])) + ", " +
                                      text_of(static_cast<double>(value.color[2])) + ")",
                                  target);
                    return;
                case StyleValue::Kind::expression:
                    compiler_.add(value.source.text, target);
                    return;
                case StyleValue::Kind::ramp:
                    if (value.ramp.is_color != target.is_color)
                        value.source.fail(target.is_color ? "the values of this ramp must be colours"
                                                          : "the values of this ramp must be numbers, not colours");
                    compiler_.add_ramp(value.ramp, value.source.text, target);
                    return;
            }
        } catch (const ExpressionError& error) {
            value.source.fail(error.column(), error.what());
        }
    }
    void add_share(const StyleValue& value) { add(value, {false, 0, 1}); }
    const ExpressionRemarks& remarks() const { return compiler_.remarks(); }
    void add_color(const StyleValue& value) { add(value, {true, 0, kMostSurfaceColor}); }

    ExpressionProgram program(const SourcePosition& where) const {
        try {
            return compiler_.program();
        } catch (const ExpressionError& error) {
            throw InputError(where, std::string("[surfaces]: ") + error.what());
        }
    }

  private:
    ExpressionSymbols symbols_;
    ExpressionCompiler compiler_;
};

SurfaceInput surface_input(const ExpressionInput& input) {
    if (input.is_attribute) return {SurfaceVariable::attribute, 0};
    return {*surface_variable_named(input.name), input.component};
}

/// Where a variable is a value of files, which one.
std::optional<SurfaceLayer> layer_of(SurfaceVariable variable, const std::string& name) {
    if (variable == SurfaceVariable::attribute) return SurfaceLayer{AttributeKind::named, name};
    if (variable == SurfaceVariable::Cv) return SurfaceLayer{AttributeKind::color, {}};
    if (variable == SurfaceVariable::u || variable == SurfaceVariable::v) return SurfaceLayer{AttributeKind::uv, {}};
    return std::nullopt;
}

double length_px(const StyleValue& value, double least, double most, const SheetContext& context) {
    const double px = in_pixels(value.number, value.unit, context);
    // What depends on the size of the picture is right in some sizes: in others the nearest length stands for it.
    const bool is_too_small = px < least && value.unit == SheetUnit::px,
               is_too_large = px > most && value.unit != SheetUnit::percent;
    if (is_too_small || is_too_large)
        value.source.fail("is " + text_of(px) + " px; it must be from " + text_of(least) + " to " + text_of(most));
    return std::clamp(px, least, most);
}

}  // namespace

ToneCurve::ToneCurve(const Ramp& ramp)
    : stops_(ramp.stops.size()), is_color_(ramp.is_color), has_steps_(ramp.between == RampBetween::step) {
    for (std::size_t k = 0; k < tables_.size(); ++k) tables_[k] = ramp_table(ramp, ramp.is_color ? k : 0);
}

glm::vec3 ToneCurve::stop_value(std::size_t stop) const {
    return {tables_[0][2 * stops_ + stop], tables_[1][2 * stops_ + stop], tables_[2][2 * stops_ + stop]};
}

glm::vec3 ToneCurve::at(double light, double spread) const {
    const std::vector<float>& table = tables_[0];
    if (has_steps_) {
        glm::vec3 tone = stop_value(0);
        for (std::size_t i = 1; i < stops_; ++i) {
            const double step = light - static_cast<double>(table[i]);
            double share = step >= 0 ? 1 : 0;
            if (spread > 0) {
                const double u = std::clamp(step / spread + 0.5, 0.0, 1.0);
                share = u * u * (3 - 2 * u);
            }
            tone += (stop_value(i) - tone) * static_cast<float>(share);
        }
        return tone;
    }
    std::size_t stop = 0;
    while (stop + 1 < stops_ && light >= static_cast<double>(table[stop + 1])) ++stop;
    const auto column = [&](std::size_t of, std::size_t k) { return tables_[of][k * stops_ + stop]; };
    const float u = std::clamp((static_cast<float>(light) - column(0, 0)) * column(0, 1), 0.0f, 1.0f);
    glm::vec3 tone;
    for (int k = 0; k < 3; ++k) {
        const auto of = static_cast<std::size_t>(k);
        tone[k] = column(of, 2) + u * (column(of, 3) + u * (column(of, 4) + u * column(of, 5)));
    }
    return tone;
}

SurfaceLook::SurfaceLook(SurfaceShading of, const SurfaceRecipe& recipe, const SheetContext& context)
    : shading(of),
      has_smooth_normals(recipe.has_smooth_normals),
      has_shadows(recipe.has_shadows),
      cool(recipe.cool),
      warm(recipe.warm),
      hatch_space(recipe.space),
      hatch_angle_deg(recipe.angle_deg),
      hatch_axis(recipe.axis),
      hatch_levels(recipe.levels) {
    SurfaceCompiler compiler(context);
    switch (shading) {
        case SurfaceShading::toon:
            tones = ToneCurve(recipe.tones);
            softness_px = length_px(recipe.softness, 0, 4096, context);
            if (recipe.detail) {
                has_detail = true;
                detail_tones = ToneCurve(recipe.detail->tones);
                compiler.add_share(recipe.detail->over);
            }
            break;
        case SurfaceShading::hatch:
            hatch_spacing_px = length_px(recipe.spacing, 1, 4096, context);
            compiler.add_share(recipe.tone);
            compiler.add_color(recipe.ink);
            compiler.add_color(recipe.ground);
            break;
        case SurfaceShading::expression:
            compiler.add_color(recipe.color);
            break;
        default:
            break;
    }
    program = compiler.program(recipe.where);
    add_notes_on("[surfaces]", compiler.remarks(), context, notes);
    for (const ExpressionInput& input : program.inputs()) {
        SurfaceInput& made = inputs.emplace_back(surface_input(input));
        if (const auto layer = layer_of(made.variable, input.name)) made.layer = layer_number(*layer);
        variables.set(number_of(made.variable));
    }
    if (shading == SurfaceShading::hatch && hatch_space == HatchSpace::uv)
        hatch_layer = layer_number({AttributeKind::uv, {}});
    needs_lit = has_shadows || variables[number_of(SurfaceVariable::lit)];
}

std::size_t SurfaceLook::layer_number(const SurfaceLayer& layer) {
    const auto at = std::find(layers.begin(), layers.end(), layer);
    const auto number = static_cast<std::size_t>(at - layers.begin());
    if (at == layers.end()) layers.push_back(layer);
    return number;
}

void add_attributes_named_in(const SurfaceRecipe& recipe, AttributeWish& wish) {
    for (const StyleValue* const value : {&recipe.color, &recipe.tone, &recipe.ink, &recipe.ground})
        add_attributes_named_in(*value, wish);
    wish.uv = wish.uv || recipe.space == HatchSpace::uv;
    if (recipe.detail) add_attributes_named_in(recipe.detail->over, wish);
}

Ramp default_tones() {
    Ramp ramp;
    ramp.between = RampBetween::step;
    ramp.stops = {{0.0f, {0.35f}}, {0.35f, {0.7f}}, {0.8f, {1.0f}}};
    return ramp;
}

}  // namespace burin
