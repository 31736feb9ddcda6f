#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "lines/line_class.h"
#include "lines/mask_stroke.h"

namespace burin {

/// How lines look.
struct LineStyle {
    double width_px = 1;  ///< full width of a stroke
    StrokeSide side = StrokeSide::both;
    std::array<glm::vec3, kLineClassCount> colors{};  ///< linear RGB, per class; black by default

    const glm::vec3& color_of(LineClass c) const { return colors[static_cast<std::size_t>(c)]; }
};

}  // namespace burin
