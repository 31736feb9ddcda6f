#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "output/paths/vector_drawing.h"

namespace burin {

/// Chords of a mesh may be this far from the curve that its vertices lie on, at most; where they are farther, the mesh
/// is drawn as it is.
constexpr double kMostSagPx = 0.05;

/// Adds the steps of a path along a line, and returns where it begins: at the line's first point, or near it if it is
/// closed. The line's points lie on the true curve, as vertices of a mesh
/// do: curves pass them within `tolerance_px`, and are no farther from the straight parts between than that and the sag
/// of the chords there, at most kMostSagPx. Corners of more than 25 degrees stay; what is straight stays straight.
/// `is_closed`: its last point is its first one.
glm::dvec2 fit_path(std::span<const glm::dvec2> line, bool is_closed, double tolerance_px,
                    std::vector<PathStep>& steps);

}  // namespace burin
