#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "lines/line_class.h"

namespace burin {

/// Where a line crosses the way between two neighbouring samples.
struct LineCrossing {
    glm::dvec2 pixel{0.0};
    LineClassSet classes;  ///< all that apply, among those asked for; none: it only hides strokes
    /// Of the mesh's edge that the line is; equal: there is none (intersections), or it leaves the screen.
    glm::dvec2 edge_ends[2] = {glm::dvec2(0.0), glm::dvec2(0.0)};
    glm::dvec2 along{0.0};          ///< which way the line runs, to and fro; 0: not known
    std::uint64_t line_key = 0;     ///< equal for two crossings of one mesh edge or one intersection
    double nearness = 0;            ///< of the front surface
    bool occludes = false;          ///< the front surface ends here, before another one or the background
    std::uint8_t opacity = 255;     ///< 255 = full
    glm::dvec2 towards_front{0.0};  ///< from the crossing to the sample of the front surface
};

/// Of the blocks of the picture within which pieces are merged: so that a crop of a picture merges the
/// same pieces.
constexpr int kMergeBlockPx = 8;

/// A straight piece of a line on the screen, in pixels.
struct LineSegment {
    glm::dvec2 from{0.0}, to{0.0};
    LineClass drawn_as = LineClass::silhouette;
    bool front_on_left = false;  ///< of the way from `from` to `to`, as seen on the screen
    bool occludes = false;       ///< a surface ends here; else the line lies on one, or between two in contact
    bool is_drawn = true;        ///< else it only hides strokes
    float nearness_from = 0, nearness_to = 0;
    std::uint64_t line_key = 0;
    std::uint8_t opacity = 255;  ///< 255 = full; less where the line fades
    std::uint32_t block = 0;     ///< only pieces of one block of the picture are merged
};

}  // namespace burin
