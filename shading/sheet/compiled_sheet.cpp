#include "shading/sheet/compiled_sheet.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "shading/expression.h"
#include "shading/expression/glob.h"
#include "shading/line_shader.h"
#include "shading/sheet/compile_style.h"
#include "shading/sheet/sheet_notes.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {
namespace {

/// Compiles the lets by themselves, so that what is wrong with one is told with its own place.
void check_lets(const StyleSheet& sheet, const ExpressionSymbols& symbols, std::size_t& steps_left) {
    ExpressionCompiler compiler(symbols, steps_left);
    std::optional<std::pair<const SheetLet*, ExpressionError>> fault;
    for (const SheetLet& let : sheet.lets) {
        try {
            compiler.add(let.text.text, {.is_color = true});
        } catch (const ExpressionError& error) {
            // A let that uses a wrong one is not what is wrong.
            const auto is_of_another = [](const ExpressionError& e) {
                return std::string_view(e.what()).starts_with("in '");
            };
            if (!fault || (is_of_another(fault->second) && !is_of_another(error))) fault.emplace(&let, error);
        }
    }
    if (fault) fault->first->text.fail(fault->second.column(), fault->second.what());
    steps_left -= std::min(steps_left, compiler.steps());
}

/// For each number, 0 = background: whether globs take its name. The background has none, and is never taken.
std::vector<bool> taken_by(const std::vector<std::string>& globs, const std::vector<std::string>& names) {
    const GlobList list(globs);
    std::vector<bool> taken(names.size() + 1);
    for (std::size_t i = 0; i < names.size(); ++i) taken[i + 1] = list.takes(names[i]);
    return taken;
}

CompiledSet compile_set(const LineSet& set, const ExpressionSymbols& symbols, const SheetContext& context,
                        std::size_t& steps_left) {
    CompiledSet result;
    result.name = set.name;
    result.layer = set.layer;
    result.style = set.style;
    result.classes = set.classes;
    result.qi = set.qi;
    result.also = set.also;
    result.is_enabled = set.is_enabled;
    result.has_object_globs = !set.objects.empty();
    result.has_material_globs = !set.materials.empty();
    if (result.has_object_globs) result.objects = taken_by(set.objects, context.objects);
    if (result.has_material_globs) result.materials = taken_by(set.materials, context.materials);
    if (set.select) {
        try {
            ExpressionCompiler compiler(symbols, steps_left);
            compiler.add(set.select->text, {.highest_rate = ValueRate::piece});
            result.select = compiler.program();
            result.remarks = compiler.remarks();
            steps_left -= std::min(steps_left, compiler.steps());
        } catch (const ExpressionError& error) {
            set.select->fail(error.column(), error.what());
        }
        result.has_select = true;
    }
    if (set.test) result.test = test_named(*set.test, context.shaders);
    return result;
}

/// Hidden lines have strokes to both sides, and all else that is done to visible ones only where a set takes some.
bool takes_visible(const CompiledSet& set) { return set.qi[0] == 0; }

bool is_told_anyway(const std::array<int, 2>& qi) { return qi[0] <= 1 && (qi[1] == 0 || qi[1] == 255); }

}  // namespace

CompiledSheet::CompiledSheet(const StyleSheet& sheet, const SheetContext& context) {
    const ExpressionSymbols symbols = symbols_of(sheet, context);
    std::size_t steps_left = kMostSheetSteps;
    check_lets(sheet, symbols, steps_left);
    for (const LineSet& set : sheet.sets) sets_.push_back(compile_set(set, symbols, context, steps_left));
    for (const SheetStyle& style : sheet.styles) styles_.push_back(compile_style(style, symbols, context, steps_left));

    for (const CompiledSet& set : sets_) {
        if (!set.is_enabled) continue;
        const CompiledStyle& style = styles_[set.style];
        needs_.classes |= set.classes;
        needs_.most_invisibility = std::max(needs_.most_invisibility, set.qi[1]);
        if (!is_told_anyway(set.qi)) needs_.tells_invisibility = true;
        VariableSet matched = variables_of(set.select);
        if (set.has_object_globs) {
            matched.add(Variable::object);
            matched.add(Variable::object2);
        }
        if (set.has_material_globs) {
            matched.add(Variable::material);
            matched.add(Variable::material2);
        }
        select_variables_ |= matched;
        for (const std::string& name : style.attributes) needs_.surface.add_attribute(name);
        VariableSet read = matched;
        read |= style.variables;
        if (set.test) read |= set.test->needs();
        needs_.variables |= read;
        if (style.needs_chains || read.has_tier(VariableTier::chains))
            (takes_visible(set) ? needs_.chains : needs_.hidden_chains) = true;
        needs_.ends = needs_.ends || style.needs_ends || read.has(Variable::end_distance);
        if (style.settings.side != StrokeSide::both && takes_visible(set)) needs_.one_sided = true;
        needs_.most_reach_px = std::max(needs_.most_reach_px, style.most_reach_px);
    }
    if (needs_.variables.has(Variable::qi)) needs_.tells_invisibility = true;
    needs_.tells_transmission = needs_.variables.has(Variable::transmission);
    needs_.surface.kr = needs_.variables.has(Variable::kr);
    needs_.surface.uv = needs_.variables.has(Variable::u) || needs_.variables.has(Variable::v);
    needs_.surface.color = needs_.variables.has(Variable::Cv);
    needs_.sides = needs_.variables.has_tier(VariableTier::sides) || needs_.variables.has_tier(VariableTier::shadows);
    needs_.hidden_chains = needs_.hidden_chains || (needs_.chains && needs_.most_invisibility > 0);
    notes_on_names_ = notes_on_sheet(sheet, sets_, styles_, context);
}

std::vector<std::string> CompiledSheet::notes_on_wobble() const {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < styles_.size(); ++i) {
        const CompiledStyle& style = styles_[i];
        if (!style.has_wobble || style.wobble_anchor != WobbleAnchor::chain) continue;
        const bool draws_contours = std::any_of(sets_.begin(), sets_.end(), [&](const CompiledSet& set) {
            return set.is_enabled && set.style == i && set.classes.has(LineClass::silhouette);
        });
        if (!draws_contours) continue;
        notes.push_back("style " + style.name +
                        ": wobble with anchor = \"chain\" makes contours jump from frame to frame, for they begin "
                        "elsewhere in each view; anchor = \"object\" keeps the waves where they are");
    }
    return notes;
}

}  // namespace burin
