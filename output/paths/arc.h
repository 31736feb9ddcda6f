#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "output/paths/vector_drawing.h"

namespace burin {

/// The ellipse that an arc of a path is a part of, as SVG says it follows from its ends and radii: where the radii are
/// too small, they grow.
struct EllipseArc {
    glm::dvec2 center{0.0};
    glm::dvec2 first_axis{0.0}, second_axis{0.0};  ///< from the centre to the ellipse
    double begin = 0, sweep = 0;  ///< angles in radians: the place is center + cos * first + sin * second

    glm::dvec2 at(double share) const;
};
EllipseArc ellipse_of_arc(glm::dvec2 start, const PathStep& arc);

/// An arc as cubics, for what knows no arcs. Those of a quarter of an ellipse are off by 3e-4 of its radius, those of
/// half of that by 4e-6.
std::vector<PathStep> cubics_of_arc(glm::dvec2 start, const PathStep& arc, int parts_of_quarter = 1);

}  // namespace burin
