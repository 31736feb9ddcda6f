#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "lines/line_class.h"
#include "lines/line_id.h"

namespace burin {

/// Where a line crosses the way between two neighbouring samples.
struct LineCrossing {
    glm::dvec2 pixel{0.0};
    LineClassSet classes;  ///< all that apply, among those asked for; none: it only hides strokes
    /// The ends of the mesh's edge that the line is. Equal ends: there is no edge (intersections), or it leaves the
    /// screen.
    glm::dvec2 edge_ends[2] = {glm::dvec2(0.0), glm::dvec2(0.0)};
    glm::dvec2 along{0.0};  ///< which way the line runs, to and fro; 0: not known
    LineId line;
    double nearness = 0;            ///< of the front surface
    bool occludes = false;          ///< the front surface ends here, before another one or the background
    std::uint8_t opacity = 255;     ///< 255 = full
    glm::dvec2 towards_front{0.0};  ///< from the crossing to the sample of the front surface
};

}  // namespace burin
