#include "cli/sheet_wishes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "base/error.h"
#include "image/image_io.h"
#include "scene/color.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {
namespace {

SheetParameter& parameter_for(StyleSheet& sheet, const std::string& name, const std::string& option) {
    const auto found = std::find_if(sheet.parameters.begin(), sheet.parameters.end(),
                                    [&](const SheetParameter& p) { return p.name == name; });
    if (found != sheet.parameters.end()) return *found;
    std::string known;
    for (const SheetParameter& p : sheet.parameters) known += (known.empty() ? "" : ", ") + p.name;
    throw UsageError(option + ": the style sheet " + sheet.name + " has no parameter '" + name + "'; it has " +
                     (known.empty() ? "none" : known));
}

void set_parameter(StyleSheet& sheet, const std::string& name, const std::string& option, const StyleValue& value,
                   const SheetContext& context) {
    SheetParameter& parameter = parameter_for(sheet, name, option);
    if (parameter.value.kind != value.kind) {
        throw UsageError(option + ": the parameter '" + name + "' of the style sheet " + sheet.name + " is " +
                         (value.kind == StyleValue::Kind::color ? "no colour" : "a colour, not a number"));
    }
    parameter.value = value;
    parameter.value.source.where.file = option;
    parameter.value.source.context = "the parameter " + name;
    parameter.value.source.is_from_command_line = true;
    if (const auto fault = fault_of_parameter(parameter, &context)) throw UsageError(option + ": " + *fault);
}

/// What of a sheet draws hidden lines, and what would have it draw all of them.
std::string how_hidden_lines_are_chosen(const StyleSheet& sheet) {
    for (const LineSet& set : sheet.sets) {
        if (!set.is_enabled || set.qi[1] == 0) continue;
        const std::string& style = sheet.styles[set.style].name;
        return "in " + sheet.name + " the set '" + set.name + "' draws them in the style '" + style +
               "': --set 'style.set." + set.name + ".qi=[" + std::to_string(std::min(set.qi[0], 1)) +
               ", 255]' draws those behind any number of surfaces, --set style." + style +
               ".KEY=VALUE changes how they look";
    }
    return "a set with qi = [1, 255] would draw them, and " + sheet.name + " has none";
}

}  // namespace

void take_hidden_lines_away(StyleSheet& sheet) {
    for (LineSet& set : sheet.sets) {
        if (set.qi[0] > 0) {
            set.is_enabled = false;
        } else {
            set.qi[1] = 0;
        }
    }
}

std::shared_ptr<const StyleSheet> sheet_as_wished(StyleSheet sheet, const Arguments& a, const SheetContext& context) {
    if (a.lines) throw UsageError("--lines: the style sheet says which lines are drawn; remove one of the two");
    if (a.hidden && *a.hidden != HiddenStyle::none) {
        throw UsageError("--hidden: the style sheet says how hidden lines are drawn; only none can stand beside it; " +
                         how_hidden_lines_are_chosen(sheet));
    }
    if (a.line_width_px) set_parameter(sheet, "width", "--line-width", StyleValue::of(*a.line_width_px), context);
    if (!a.line_color.empty()) {
        const glm::vec3 color = *color_from_hex(a.line_color);
        set_parameter(sheet, "color", "--color", StyleValue::of_color({color.r, color.g, color.b}), context);
    }
    if (a.hidden) take_hidden_lines_away(sheet);
    return std::make_shared<StyleSheet>(std::move(sheet));
}

}  // namespace burin
