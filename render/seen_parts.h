#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "render/mattes.h"

// What lines of a pixel leave of what they lie over.

namespace burin {

/// Shares of a pixel.
struct LeftByLines {
    double above = 1;  ///< by visible lines that lie over all others
    double all = 1;    ///< by all visible lines

    explicit LeftByLines(const Mattes::DeepPixel& pixel) {
        if (pixel.is_mean) return;  // shares are what is seen
        double taken_above = 0, taken_below = 0;
        for (const DeepLine& line : pixel.lines) {
            if (!line.line.is_hidden)
                (line.line.is_below ? taken_below : taken_above) += static_cast<double>(line.line.share);
        }
        above = std::max(1.0 - taken_above, 0.0);
        all = above * std::max(1.0 - taken_below, 0.0);
    }
    /// How much is seen of a visible line, of the pixel.
    double seen_of(const DeepLine& line) const {
        return static_cast<double>(line.line.share) * (line.line.is_below ? above : 1.0);
    }
};

/// A line's colour per share over surfaces, of which a pixel has this colour, times what they cover of it.
inline glm::dvec3 color_over(const DeepLine& line, const glm::dvec3& surfaces, double covered) {
    return glm::dvec3(line.color) + glm::dvec3(line.passes) * surfaces + glm::dvec3(line.tint) * (1.0 - covered);
}

}  // namespace burin
