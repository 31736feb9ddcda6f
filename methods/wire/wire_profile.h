#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

#include "scene/wire_settings.h"

// A profile says how dark a line is at a distance from its middle.

namespace burin {

/// Integral of exp2(-2 u^2) over u in [0, x].
inline double gauss_area(double x) {
    const double rate = std::sqrt(2 * std::numbers::ln2);
    return 0.5 * std::sqrt(std::numbers::pi) / rate * std::erf(rate * x);
}

/// Part of a pixel (unit square around its centre) in the half-plane whose border is `offset`
/// pixels beyond the centre in the direction of the unit vector `normal`: the distribution function
/// of a trapezoid, the two sides of the square being projected on the normal.
inline double pixel_area_below(double offset, glm::dvec2 normal) {
    const double a = std::max(std::abs(normal.x), std::abs(normal.y));
    const double b = std::min(std::abs(normal.x), std::abs(normal.y));
    if (b < 1e-6) return std::clamp(offset / a + 0.5, 0.0, 1.0);
    const auto ramp = [](double x) { return x > 0 ? x * x : 0.0; };
    const double far = 0.5 * (a + b), near = 0.5 * (a - b);
    const double area = ramp(offset + far) - ramp(offset + near) - ramp(offset - near) + ramp(offset - far);
    return std::clamp(area / (2 * a * b), 0.0, 1.0);
}

/// How dark a line is, from 0 to 1, at a distance in pixels from its middle.
///
/// - gauss: 1 up to `core` = t, then exp2(-2 ((d - t) / scale)^2). Baerentzen et al. 2006, 2008.
/// - nv (Gateau 2007): `core` = W; exp2(-2 u^2) with u = clamp(d - (W / 2 - 1), 0, 2), and nothing
///   beyond W / 2 + 1.
/// - step: d <= core. linear, smooth: a ramp one pixel wide around `core`, straight or smoothstep.
/// - box: the exact part of the pixel that a stroke of full width `core` covers.
struct WireProfile {
    WireProfileKind kind = WireProfileKind::gauss;
    double core_px = 0;
    double scale = 1;     ///< gauss: how much wider than published the flank is
    double gain = 1;      ///< factor on everything
    double cut = kNoCut;  ///< gauss: nothing is drawn beyond core + cut * scale

    /// There, less than 2^-20 is left.
    static constexpr double kNoCut = 3.1622776601683795;
    /// The smallest deviation of a Gaussian that pixels can show, as scale: that of a 1 px stroke.
    static constexpr double kLeastWidthPx = 1;

    /// `normal` is the unit vector across the line; only box looks at it.
    double intensity(double d, glm::dvec2 normal = {1, 0}) const {
        switch (kind) {
            case WireProfileKind::gauss: {
                const double u = (d - core_px) / scale;
                return u <= 0 ? gain : u > cut ? 0 : gain * std::exp2(-2 * u * u);
            }
            case WireProfileKind::nv: {
                if (d > core_px / 2 + 1) return 0;
                const double u = std::clamp(d - (core_px / 2 - 1), 0.0, 2.0);
                return std::exp2(-2 * u * u);
            }
            case WireProfileKind::step:
                return d <= core_px ? 1 : 0;
            case WireProfileKind::linear:
                return std::clamp(core_px + 0.5 - d, 0.0, 1.0);
            case WireProfileKind::smooth: {
                const double v = std::clamp(d - (core_px - 0.5), 0.0, 1.0);
                return 1 - v * v * (3 - 2 * v);
            }
            case WireProfileKind::box:
                return pixel_area_below(d + core_px / 2, normal) - pixel_area_below(d - core_px / 2, normal);
        }
        return 0;
    }

    /// Beyond this distance there is nothing. Pixels.
    double reach_px() const {
        switch (kind) {
            case WireProfileKind::gauss:
                return core_px + cut * scale;
            case WireProfileKind::nv:
                return std::max(core_px / 2 + 1, 0.0);
            case WireProfileKind::step:
                return core_px;
            case WireProfileKind::linear:
            case WireProfileKind::smooth:
                return std::max(core_px + 0.5, 0.0);
            case WireProfileKind::box:
                return core_px / 2 + 0.7071067811865476;
        }
        return 0;
    }

    /// The integral of intensity() across the line, both sides together. Pixels.
    double integrated_width_px() const {
        const double t = core_px;
        switch (kind) {
            case WireProfileKind::gauss:
                return 2 * gain * (t + scale * gauss_area(cut));
            case WireProfileKind::nv: {
                const double begin = 1 - t / 2;  // u at the middle of the line
                return begin <= 0 ? 2 * (gauss_area(2) - begin) : 2 * std::max(gauss_area(2) - gauss_area(begin), 0.0);
            }
            case WireProfileKind::step:
                return 2 * t;
            case WireProfileKind::linear:
                return t >= 0.5 ? 2 * t : std::pow(std::max(t + 0.5, 0.0), 2);
            case WireProfileKind::smooth: {
                if (t >= 0.5) return 2 * t;
                const double a = std::min(0.5 - t, 1.0);  // position on the ramp at the line's middle
                return 2 * (0.5 - (a - a * a * a + 0.5 * a * a * a * a));
            }
            case WireProfileKind::box:
                return t;
        }
        return 0;
    }
};

/// The profile whose integrated width is `width_px`; `cut` as in WireProfile.
///
/// A Gaussian flank has 1.505 px of its own. For lines from 1 to 1.505 px it is made narrower: at
/// 1 px it has the variance of a 1 px stroke seen through a pixel, 1/6 px^2. Still thinner lines
/// keep that shape and get lighter, as strokes thinner than a pixel do.
inline WireProfile matched_profile(WireProfileKind kind, double width_px, double cut = WireProfile::kNoCut) {
    WireProfile profile{kind, 0, 1, 1, cut};
    switch (kind) {
        case WireProfileKind::gauss: {
            const double flank = 2 * gauss_area(cut);
            if (width_px >= flank) {
                profile.core_px = (width_px - flank) / 2;
            } else {
                profile.scale = std::max(width_px, WireProfile::kLeastWidthPx) / flank;
                profile.gain = std::min(width_px / WireProfile::kLeastWidthPx, 1.0);
            }
            return profile;
        }
        case WireProfileKind::step:
            profile.core_px = width_px / 2;
            return profile;
        case WireProfileKind::box:
            profile.core_px = width_px;
            return profile;
        case WireProfileKind::linear:
            profile.core_px = width_px >= 1 ? width_px / 2 : std::sqrt(width_px) - 0.5;
            return profile;
        case WireProfileKind::nv:
        case WireProfileKind::smooth:
            break;
    }
    // Increasing in core_px; from nothing at -2 to more than asked for.
    double low = -2, high = width_px + 2;
    for (int i = 0; i < 60; ++i) {
        profile.core_px = 0.5 * (low + high);
        (profile.integrated_width_px() < width_px ? low : high) = profile.core_px;
    }
    return profile;
}

}  // namespace burin
