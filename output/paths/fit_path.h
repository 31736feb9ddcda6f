#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "output/paths/vector_drawing.h"

namespace burin {

/// How far a path may be from its line.
struct FitBounds {
    double tolerance_px = 0.02;  ///< from the line's points
    /// From the straight parts between them, in addition, as far as a curve through the points is from its chords. The
    /// chords of a coarse mesh are farther from one, and stay straight. As much as the tolerance, unless asked for.
    double chord_sag_px = tolerance_px;
};

/// Adds the steps of a path along a line, and returns where it begins: at the line's first point, or near it if it is
/// closed. The line's points lie on the true curve, as vertices of a mesh do. Corners of more than 25 degrees stay;
/// what is straight stays straight. `is_closed`: its last point is its first one.
glm::dvec2 fit_path(std::span<const glm::dvec2> line, bool is_closed, const FitBounds& bounds,
                    std::vector<PathStep>& steps);

}  // namespace burin
