#include "methods/wire/wire_stroke.h"

namespace burin {

double thinning_factor(WireThinning thinning, double z) {
    switch (thinning) {
        case WireThinning::none:
            return 1;
        case WireThinning::linear:
            return std::clamp(1 - z, 0.0, 1.0);
        case WireThinning::hermite: {
            const double v = std::clamp((z - 0.75) / 0.25, 0.0, 1.0);
            return 1 - v * v * (3 - 2 * v);
        }
    }
    return 1;
}

double dash_coverage(double x, double spread, double duty) {
    // Length of what is on before a position.
    const auto on_before = [duty](double at) {
        const double whole = std::floor(at);
        return whole * duty + std::min(at - whole, duty);
    };
    if (!(spread > 1e-12)) return x - std::floor(x) < duty ? 1 : 0;
    return std::clamp((on_before(x + 0.5 * spread) - on_before(x - 0.5 * spread)) / spread, 0.0, 1.0);
}

WireStroke::WireStroke(const WireSettings& settings, double width_px, WireProfileKind profile, double core_px,
                       double cut)
    : settings_(settings), width_px_(width_px) {
    const WireProfileKind kind = settings.profile.value_or(profile);
    // The disc of a dot is as wide again as the line.
    if (settings.width == WireWidth::matched) {
        profile_ = matched_profile(kind, width_px, cut);
        dot_profile_ = matched_profile(kind, 2 * width_px, cut);
    } else {
        profile_ = {kind, settings.thickness_px.value_or(kind == profile ? core_px : 0.5), 1, 1, cut};
        width_px_ = profile_.integrated_width_px();
        dot_profile_ = profile_;
        dot_profile_.core_px += width_px_ / (kind == WireProfileKind::nv || kind == WireProfileKind::box ? 1 : 2);
    }
    is_plain_ = settings.pattern == WirePattern::solid && settings.thinning == WireThinning::none &&
                settings.squeeze_min == 1 && settings.squeeze_max == 1 && settings.dual == 0;
    const bool has_dots = settings.pattern == WirePattern::dots || settings.dotted_diagonals;
    reach_px_ = std::max(profile_.reach_px(), has_dots ? dot_profile_.reach_px() : 0.0);
}

WireProfile WireStroke::thinned(double share, double part) const {
    if (settings_.width == WireWidth::matched) {
        return matched_profile(profile_.kind, width_px_ * share * part, profile_.cut);
    }
    WireProfile result = profile_;
    result.core_px *= share * part;
    return result;
}

double WireStroke::dash(const WireEdge& edge, double along, double length) const {
    if (settings_.repeats == 0) {
        return dash_coverage(along / settings_.period_px + settings_.phase, 1 / settings_.period_px, settings_.duty);
    }
    // The place on the edge in space, and how fast it changes on the screen.
    const bool is_flat = edge.from_nearness <= 0;  // orthographic: nearness is no 1/w
    const double w0 = is_flat ? 1 : edge.from_nearness, w1 = is_flat ? 1 : edge.to_nearness;
    const double weight = (length - along) * w0 + along * w1;
    const double scale = (edge.to_part - edge.from_part) * settings_.repeats;
    const double x = edge.from_part * settings_.repeats + scale * along * w1 / weight;
    return dash_coverage(x + settings_.phase, scale * length * w0 * w1 / (weight * weight), settings_.duty);
}

double WireStroke::dots(double distance, double along) const {
    const double spacing = 2 * settings_.dot_period * width_px_;
    const double phase = along / spacing + settings_.phase;
    const double from_dot = (phase - std::floor(phase)) * spacing - 0.5 * spacing;
    return dot_profile_.intensity(std::hypot(from_dot, distance));
}

double WireStroke::intensity(const WireEdge& edge, double distance, double along, double z) const {
    const glm::dvec2 normal(edge.line);
    if (is_plain_) return profile_.intensity(distance, normal);
    const double length = edge.length_px();
    along = std::clamp(along, 0.0, length);
    const double q = length > 0 ? along / length : 0;
    const double squeeze =
        settings_.squeeze_min + (settings_.squeeze_max - settings_.squeeze_min) * (1 - std::sin(std::numbers::pi * q));
    const double part = squeeze * thinning_factor(settings_.thinning, z);
    double result = (part == 1 ? profile_ : thinned(1, part)).intensity(distance, normal);
    if (settings_.dual > 0) result = std::abs(result - thinned(settings_.dual, part).intensity(distance, normal));
    switch (settings_.pattern) {
        case WirePattern::solid:
            return result;
        case WirePattern::dash:
            return length > 0 ? result * dash(edge, along, length) : 0;
        case WirePattern::dots:
            return dots(distance, along);
    }
    return result;
}

}  // namespace burin
