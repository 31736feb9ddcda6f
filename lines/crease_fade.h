#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "lines/line_class.h"

// Creases may fade in between two angles, so that they do not pop in an animation.

namespace burin {

/// CreaseFade says how opaque a crease is drawn: not at all where its polygons' normals differ by `from_deg`, fully
/// from `to_deg` on, in between linear in the angle. So a crease that opens or closes in an animation does not pop.
struct CreaseFade {
    double from_deg = 0, to_deg = 0;  ///< equal: creases do not fade

    /// Opacity, 255 = full, of a line with these classes. `cosine` is between the normals of the crease.
    /// Where the edge is drawn as a polygon's anyway, there is nothing to fade from.
    std::uint8_t opacity(LineClassSet classes, double cosine) const {
        if (!(from_deg < to_deg) || classes.first() != LineClass::crease || classes.has(LineClass::polygon)) {
            return 255;
        }
        const double angle_deg = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
        const double share = std::clamp((angle_deg - from_deg) / (to_deg - from_deg), 0.0, 1.0);
        return static_cast<std::uint8_t>(std::lround(255 * share));
    }
};

}  // namespace burin
