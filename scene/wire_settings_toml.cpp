#include "scene/wire_settings_toml.h"

namespace burin {
namespace {

constexpr double kMostPixels = 1024;

/// The value at the index of the word; nothing if the key is missing.
template <typename Value>
std::optional<Value> read_choice(TomlReader& t, std::string_view key, const std::vector<std::string_view>& words) {
    const auto index = t.choice(key, words);
    if (!index) return std::nullopt;
    return static_cast<Value>(*index);
}

/// A number that a setting takes if it is there.
void read_number(TomlReader& t, std::string_view key, TomlReader::Range range, double& setting) {
    setting = t.number(key, range).value_or(setting);
}

}  // namespace

WireSettings read_wire_settings(TomlReader& t) {
    WireSettings s;
    s.width = read_choice<WireWidth>(t, "width", {"matched", "published"}).value_or(s.width);
    s.profile = read_choice<WireProfileKind>(t, "profile", {"gauss", "nv", "step", "linear", "smooth", "box"});
    s.thickness_px = t.number("thickness", {0, kMostPixels});
    s.path = read_choice<WirePath>(t, "path", {"linear", "premultiplied", "homogeneous", "cases"});
    s.exclude = read_choice<WireExclude>(t, "exclude", {"flags", "q", "polygon"});
    read_number(t, "q", {0, 1e9}, s.q_px);
    read_number(t, "fade_distance", {0, 1e30}, s.fade_distance);
    s.thinning = read_choice<WireThinning>(t, "thinning", {"none", "linear", "hermite"}).value_or(s.thinning);
    read_number(t, "alpha_test", {0, 1}, s.alpha_test);
    s.dotted_diagonals = t.choice("diagonals", {"hidden", "dotted"}).value_or(0) == 1;
    read_number(t, "transition", {0, 16, true, false}, s.transition_px);
    s.slope = t.boolean("slope").value_or(s.slope);
    s.pattern = read_choice<WirePattern>(t, "pattern", {"solid", "dash", "dots"}).value_or(s.pattern);
    read_number(t, "period", {0, 1e6, true, false}, s.period_px);
    read_number(t, "dot_period", {1, 1e6}, s.dot_period);
    read_number(t, "duty", {0, 1}, s.duty);
    read_number(t, "phase", {-1e6, 1e6}, s.phase);
    read_number(t, "repeats", {0, 1e6}, s.repeats);
    if (const auto squeeze = t.numbers("squeeze", 2)) {
        s.squeeze_min = (*squeeze)[0];
        s.squeeze_max = (*squeeze)[1];
        for (const double part : *squeeze) {
            if (!(part >= 0 && part <= 1)) t.fail("squeeze", "must be two numbers from 0 to 1");
        }
    }
    read_number(t, "dual", {0, 1, false, true}, s.dual);
    t.finish();
    return s;
}

}  // namespace burin
