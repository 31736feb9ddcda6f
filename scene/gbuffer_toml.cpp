#include "scene/gbuffer_toml.h"

#include <algorithm>

#include "mesh/text_scan.h"

namespace burin {
namespace {

GBufferOperatorSet read_operators(TomlReader& t, GBufferOperatorSet fallback) {
    const auto names = t.texts("operators");
    if (!names) return fallback;
    GBufferOperatorSet set;
    for (const std::string& name : *names) {
        const auto found = gbuffer_operator_named(name);
        if (!found) {
            std::string known;
            for (const std::string_view n : kGBufferOperatorNames) known += " " + std::string(n);
            t.fail("operators", "unknown operator '" + printable(name) + "'; known are" + known);
        }
        set.add(*found);
    }
    return set;
}

ContourField read_field(TomlReader& t, std::string_view key) {
    static constexpr ContourField kFields[] = {ContourField::none, ContourField::x, ContourField::y, ContourField::z,
                                               ContourField::distance};
    return kFields[t.choice(key, {"none", "x", "y", "z", "distance"}).value_or(0)];
}

}  // namespace

std::optional<GBufferOperator> gbuffer_operator_named(std::string_view name) {
    const auto it = std::find(kGBufferOperatorNames.begin(), kGBufferOperatorNames.end(), name);
    if (it == kGBufferOperatorNames.end()) return std::nullopt;
    return static_cast<GBufferOperator>(it - kGBufferOperatorNames.begin());
}

GBufferSettings read_gbuffer(TomlReader& t) {
    GBufferSettings s;
    s.operators = read_operators(t, s.operators);
    s.supersample = t.integer("supersample", 1, 8).value_or(s.supersample);
    if (s.supersample != 1 && s.supersample != 2 && s.supersample != 4 && s.supersample != 8) {
        t.fail("supersample", "must be 1, 2, 4 or 8");
    }
    s.dilate = t.boolean("dilate").value_or(s.dilate);
    s.smooth = t.boolean("smooth").value_or(s.smooth);
    static constexpr LineComposition kCompositions[] = {LineComposition::multiply, LineComposition::maximum};
    s.composition = kCompositions[t.choice("composition", {"multiply", "maximum"}).value_or(0)];

    s.depth_scale = t.number("depth_scale", kPositive).value_or(s.depth_scale);
    s.reference_distance = t.number("reference_distance", {0, 1e30}).value_or(s.reference_distance);
    s.depth_bits = t.integer("depth_bits", 0, 24).value_or(s.depth_bits);
    if (s.depth_bits != 0 && s.depth_bits != 8 && s.depth_bits != 16 && s.depth_bits != 24) {
        t.fail("depth_bits", "must be 8, 16, 24, or 0 for exact depth");
    }

    s.jump_limit = t.number("jump_limit", kPositive).value_or(s.jump_limit);
    s.profile_limit = t.number("profile_limit", kPositive).value_or(s.profile_limit);
    s.profile_power = t.number("profile_power", {0, 16, true, false}).value_or(s.profile_power);
    s.gate = t.boolean("gate").value_or(s.gate);
    s.crease_limit = t.number("crease_limit", kPositive).value_or(s.crease_limit);
    s.relative_jump = t.number("relative_jump", kPositive).value_or(s.relative_jump);
    s.relative_jump_slope = t.number("relative_jump_slope", {0, 1e30}).value_or(s.relative_jump_slope);
    static constexpr IdComparison kComparisons[] = {IdComparison::differs, IdComparison::less, IdComparison::greater};
    s.id_comparison = kComparisons[t.choice("id_comparison", {"differs", "less", "greater"}).value_or(0)];
    s.id_neighbours = t.integer("id_neighbours", 4, 8).value_or(s.id_neighbours);
    if (s.id_neighbours != 4 && s.id_neighbours != 8) t.fail("id_neighbours", "must be 4 or 8");

    s.contours = read_field(t, "contours");
    s.contour_step = t.number("contour_step", kPositive).value_or(s.contour_step);
    s.contour_width_px = t.number("contour_width", {0, 1024, true, false}).value_or(s.contour_width_px);
    s.hatching = t.boolean("hatching").value_or(s.hatching);
    s.cross_hatching = read_field(t, "cross_hatching");
    s.cross_darkness = t.number("cross_darkness", {0, 1}).value_or(s.cross_darkness);
    t.finish();
    return s;
}

}  // namespace burin
