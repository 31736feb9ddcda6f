#include "scene/lines_toml.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/text_scan.h"

namespace burin {
namespace {

/// "a,b" is a list, too, as on the command line.
std::vector<std::string> separated(const std::vector<std::string>& texts) {
    std::vector<std::string> result;
    for (const std::string& text : texts) {
        for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
            end = text.find(',', begin);
            const std::string part = text.substr(begin, end - begin);
            const std::size_t first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
            result.push_back(first == std::string::npos ? part : part.substr(first, last + 1 - first));
        }
    }
    return result;
}

LineClassSet read_classes(TomlReader& t) {
    LineClassSet classes;
    const std::vector<std::string> names = separated(*t.texts("draw"));
    for (const std::string& name : names) {
        const auto line_class = line_class_named(name);
        if (name == "all") {
            classes = LineClassSet::all();
        } else if (line_class) {
            classes |= *line_class;
        } else if (name == "none") {
            if (names.size() > 1) t.fail("draw", "none cannot stand beside other words; remove one");
        } else {
            t.fail("draw", "unknown line class '" + printable(name) + "'; known are " + to_string(LineClassSet::all()) +
                               ",all,none");
        }
    }
    return classes;
}

std::optional<std::array<double, 2>> read_dash(TomlReader& t) {
    const auto dash = t.numbers("dash", 2);
    if (!dash) return std::nullopt;
    for (const double length : *dash) {
        if (!(length > 0 && length <= 65535))
            t.fail("dash", "must be two lengths in pixels, greater than 0 and at most 65535");
    }
    return std::array{(*dash)[0], (*dash)[1]};
}

void read_hidden(TomlReader& t, HiddenLineStyle& hidden) {
    static constexpr HiddenStyle kStyles[] = {HiddenStyle::none, HiddenStyle::solid, HiddenStyle::dashed};
    hidden.style = kStyles[t.choice("style", {"none", "solid", "dashed"}).value_or(0)];
    hidden.width_px = t.number("width", {0, 1024, true, false});
    hidden.color = t.color("color").value_or(hidden.color);
    hidden.dash_px = read_dash(t);
    t.finish();
}

/// What of a sheet says what a key of [lines] says: "[style.ink] width says it".
std::string what_says_it(std::string_view key, const StyleSheet& sheet) {
    if (key == "hidden") {
        for (const LineSet& set : sheet.sets) {
            if (set.is_enabled && set.qi[1] > 0)
                return "the set '" + set.name + "' draws hidden lines in [style." + sheet.styles[set.style].name + "]";
        }
        return "a set with qi = [1, 255] would draw hidden lines";
    }
    // All styles of visible lines, in the order of the sets; at most three are named.
    std::vector<std::size_t> styles;
    for (const LineSet& set : sheet.sets) {
        const bool is_new = std::find(styles.begin(), styles.end(), set.style) == styles.end();
        if (set.is_enabled && set.qi[0] == 0 && is_new) styles.push_back(set.style);
    }
    const std::string its_key = key == "colors" ? "color" : std::string(key);
    if (styles.empty()) return its_key + " of its styles says it";
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(styles.size(), 3); ++i)
        names += (i > 0 ? ", [style." : "[style.") + sheet.styles[styles[i]].name + "] " + its_key;
    if (styles.size() > 3) names += ", ...";
    return names + (styles.size() > 1 ? " say it" : " says it");
}

}  // namespace

std::optional<std::array<double, 2>> read_crease_angle(TomlReader& t) {
    if (!t.has("crease_angle")) return std::nullopt;
    if (t.is_number("crease_angle")) {
        const double angle = *t.number("crease_angle", {0, 180});
        return std::array{angle, angle};
    }
    const std::vector<double> angles = *t.numbers("crease_angle", 2);
    if (!(angles[0] >= 0 && angles[0] <= angles[1] && angles[1] <= 180)) {
        t.fail("crease_angle", "must be an angle, or two from 0 to 180 degrees, the smaller one first");
    }
    return std::array{angles[0], angles[1]};
}

std::optional<PixelFilter> read_pixel_filter(TomlReader& t) {
    static constexpr PixelFilter kFilters[] = {PixelFilter::box, PixelFilter::gaussian, PixelFilter::mitchell};
    const auto filter = t.choice("filter", {"box", "gaussian", "mitchell"});
    if (!filter) return std::nullopt;
    return kFilters[*filter];
}

LineSettings read_line_settings(TomlReader& t) {
    LineSettings lines;
    if (t.node("draw") != nullptr) lines.classes = read_classes(t);
    lines.style.width_px = t.number("width", {0, 1024, true, false}).value_or(1);
    if (const auto angles = read_crease_angle(t)) lines.set_crease_angle((*angles)[0], (*angles)[1]);
    static constexpr Contours kContours[] = {Contours::mesh, Contours::smooth};
    lines.contours = kContours[t.choice("contours", {"mesh", "smooth"}).value_or(0)];
    lines.style.dash_px = read_dash(t);
    static constexpr StrokeSide kSides[] = {StrokeSide::both, StrokeSide::inside, StrokeSide::outside};
    lines.style.side = kSides[t.choice("side", {"both", "inside", "outside"}).value_or(0)];
    lines.style.filter = read_pixel_filter(t).value_or(PixelFilter::box);
    if (const auto color = t.color("color")) lines.style.colors.fill(*color);
    if (auto colors = t.table("colors")) {
        for (std::size_t i = 0; i < kLineClassCount; ++i) {
            if (const auto color = colors->color(kLineClassNames[i])) lines.style.colors[i] = *color;
        }
        colors->finish();
    }
    if (auto hidden = t.table("hidden")) read_hidden(*hidden, lines.style.hidden);
    t.finish();
    return lines;
}

std::vector<std::string> keys_beside_sheet(const TomlReader& t, const StyleSheet& sheet, bool may_have_looks) {
    std::vector<std::string> unread;
    if (t.has("draw")) unread.emplace_back("draw");
    for (const char* const key : {"width", "color", "colors", "dash", "side", "hidden"}) {
        if (!t.has(key)) continue;
        if (!may_have_looks)
            t.fail(key,
                   "cannot stand beside a style sheet, where " + what_says_it(key, sheet) + "; remove one of the two");
        unread.emplace_back(key);
    }
    return unread;
}

}  // namespace burin
