#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "lines/line_class.h"

// A line style says how lines look: width, side, filter, colours, dashes, hidden lines.

namespace burin {

/// Which side of the boundary a stroke is drawn on.
enum class StrokeSide : std::uint8_t {
    both,
    inside,   ///< on the nearer surface only
    outside,  ///< on the farther one only
};

/// What a pixel sees of the lines around its centre. Separable in x and y.
enum class PixelFilter : std::uint8_t {
    box,       ///< its own square
    gaussian,  ///< standard deviation 1/2 pixel
    mitchell,  ///< Mitchell and Netravali 1988, B = C = 1/3; has negative lobes
};

/// How far beyond a pixel's own square its filter reaches. Whole pixels.
constexpr int reach_px(PixelFilter filter) { return filter == PixelFilter::box ? 0 : 2; }

enum class HiddenStyle : std::uint8_t { none, solid, dashed };

/// HiddenLineStyle says how lines look that opaque surfaces hide.
struct HiddenLineStyle {
    HiddenStyle style = HiddenStyle::none;
    std::optional<double> width_px;                ///< as visible lines where not set
    std::optional<std::array<double, 2>> dash_px;  ///< lengths of a dash and of a gap
    glm::vec3 color{0.21586f};                     ///< linear RGB; sRGB #808080
};

/// LineStyle says how lines look.
struct LineStyle {
    double width_px = 1;  ///< full width of a stroke
    StrokeSide side = StrokeSide::both;
    PixelFilter filter = PixelFilter::box;
    std::array<glm::vec3, kLineClassCount> colors{};  ///< linear RGB, per class; black by default

    std::optional<std::array<double, 2>> dash_px;  ///< lengths of a dash and of a gap; none: solid
    HiddenLineStyle hidden;

    const glm::vec3& color_of(LineClass c) const { return colors[static_cast<std::size_t>(c)]; }
    /// How far from a line its stroke changes pixels, hidden or not.
    double reach_px() const { return 0.5 * std::max(width_px, hidden_width_px()) + burin::reach_px(filter); }
    double hidden_width_px() const { return hidden.width_px.value_or(width_px); }
    std::array<double, 2> hidden_dash_px() const {
        const double unit = std::max(1.0, hidden_width_px());
        return hidden.dash_px.value_or(std::array<double, 2>{4 * unit, 3 * unit});
    }
};

}  // namespace burin
