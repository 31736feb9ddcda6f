#include "shading/ink/found_needs.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "shading/surface/shadow_casters.h"

namespace burin {
namespace {

bool has_other_creases(const StyleSheet& style, const FoundLines& lines) {
    const auto differs = [](double a, double b) { return std::abs(a - b) > 1e-9; };
    return style.crease_angle_deg && (differs((*style.crease_angle_deg)[0], lines.crease_angle_deg[0]) ||
                                      differs((*style.crease_angle_deg)[1], lines.crease_angle_deg[1]));
}
bool has_other_contours(const StyleSheet& style, const FoundLines& lines) {
    return style.smooth_contours && *style.smooth_contours != lines.has_smooth_contours;
}

/// As lights_of() has it for a frame.
ViewLight key_light_of(const StyleSheet& style, const FoundLines& lines) {
    if (style.light) return {false, glm::normalize(*style.light)};
    return lines.scene_light.value_or(light_at_eye(lines.projection));
}

}  // namespace

FoundLinesNeeds found_needs_of(const SheetNeeds& sheet) {
    constexpr Variable kOfNormals[] = {Variable::N,     Variable::N2,     Variable::facing, Variable::facing2,
                                       Variable::light, Variable::light2, Variable::lit};
    FoundLinesNeeds needs;
    needs.normals =
        std::any_of(std::begin(kOfNormals), std::end(kOfNormals), [&](Variable v) { return sheet.variables.has(v); });
    needs.chains = sheet.chains;
    needs.hidden_chains = sheet.hidden_chains;
    needs.surface = sheet.surface;
    return needs;
}

std::string missing_for(const StyleSheet& style, const SheetNeeds& sheet, const FoundLines& lines) {
    const FoundLinesNeeds needs = found_needs_of(sheet);
    std::string missing;
    const auto add = [&missing](bool is_missing, const std::string& what) {
        if (is_missing) missing += (missing.empty() ? "" : ", ") + what;
    };
    const auto classes = LineClassSet::from_bits(sheet.classes.bits & ~unsigned{lines.classes.bits});
    add(!classes.empty(), "lines of class " + to_string(classes));
    add(sheet.most_invisibility > lines.most_invisibility,
        lines.most_invisibility == 0 ? "hidden lines" : "lines behind more surfaces");
    add(sheet.tells_invisibility && !lines.tells_invisibility, "how many surfaces are in front (qi)");
    add(sheet.sides && !lines.has_beyond, "the surfaces behind lines");
    add(needs.normals && !lines.has_normals, "normals");
    if (sheet.variables.has(Variable::lit)) {
        add(!lines.casters, "what casts shadows (lit)");
        add(lines.casters && lines.casters->light() != key_light_of(style, lines),
            "what casts shadows (lit) in the light of this sheet");
    }
    add((needs.chains && !lines.has_chains) || (needs.hidden_chains && !lines.has_hidden_chains), "chains");
    add(needs.surface.kr && !lines.surface.kr, "curvature (kr)");
    add(needs.surface.uv && !lines.surface.uv, "texture coordinates (u, v)");
    add(needs.surface.color && !lines.surface.color, "colours of vertices (Cv)");
    for (const std::string& name : needs.surface.attributes)
        add(!lines.surface.column_of_attribute(name), "the attribute '" + name + "'");
    add(has_other_creases(style, lines), "creases by another crease_angle");
    add(has_other_contours(style, lines), "other contours");
    return missing;
}

bool find_all_keeps(const StyleSheet& style, const SheetNeeds& sheet, const FoundLines& lines) {
    return sheet.surface.empty() && !sheet.variables.has(Variable::lit) && !has_other_creases(style, lines) &&
           !has_other_contours(style, lines);
}

}  // namespace burin
