#include "scene/plain_sheet.h"

#include <algorithm>
#include <utility>

namespace burin {
namespace {

StyleValue color_value(const glm::vec3& color) { return StyleValue::of_color({color.r, color.g, color.b}); }

void set_dash(SheetStyle& style, const std::array<double, 2>& dash_px) {
    for (const double length : dash_px) style.dash.push_back(StyleValue::of(length));
}

void add_set(StyleSheet& sheet, const std::string& name, LineClassSet classes, std::array<int, 2> qi,
             const SheetStyle& style) {
    const auto same = std::find_if(sheet.styles.begin(), sheet.styles.end(),
                                   [&](const SheetStyle& s) { return s.name == style.name; });
    LineSet set;
    set.name = name;
    set.classes = classes;
    set.qi = qi;
    set.style = static_cast<std::size_t>(same - sheet.styles.begin());
    sheet.sets.push_back(std::move(set));
    if (same == sheet.styles.end()) sheet.styles.push_back(style);
}

}  // namespace

StyleSheet plain_sheet(const LineSettings& lines) {
    StyleSheet sheet;
    sheet.name = "plain";
    const LineStyle& look = lines.style;
    SheetStyle ink;
    ink.width = StyleValue::of(look.width_px);
    ink.settings.side = look.side;
    if (look.dash_px) set_dash(ink, *look.dash_px);
    const bool has_one_color = [&] {
        const auto first = lines.classes.first();
        for (int c = 0; c < kLineClassCount; ++c) {
            const auto line_class = static_cast<LineClass>(c);
            if (lines.classes.has(line_class) && look.color_of(line_class) != look.color_of(*first)) return false;
        }
        return true;
    }();
    if (has_one_color) {
        ink.name = "ink";
        ink.color = color_value(look.color_of(lines.classes.first().value_or(LineClass::silhouette)));
        add_set(sheet, "visible", lines.classes, {0, 0}, ink);
    } else {
        // Classes in their order: a line of several of them has the colour of the first.
        for (int c = 0; c < kLineClassCount; ++c) {
            const auto line_class = static_cast<LineClass>(c);
            if (!lines.classes.has(line_class)) continue;
            ink.name = std::string(name_of(line_class));
            ink.color = color_value(look.color_of(line_class));
            add_set(sheet, ink.name, line_class, {0, 0}, ink);
        }
    }
    if (look.hidden.style == HiddenStyle::none) return sheet;
    SheetStyle hidden;
    hidden.name = "hidden";
    hidden.width = StyleValue::of(look.hidden_width_px());
    hidden.color = color_value(look.hidden.color);
    if (look.hidden.style == HiddenStyle::dashed) set_dash(hidden, look.hidden_dash_px());
    add_set(sheet, "hidden", lines.classes, {1, 255}, hidden);
    return sheet;
}

}  // namespace burin
