#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "output/paths/vector_drawing.h"

namespace burin {

/// A smooth part of a line, without corners: its points lie on a curve, of which the straight parts between them are
/// chords.
struct SmoothPart {
    std::span<const glm::dvec2> points;  ///< at least two, no two of them in a row equal
    std::span<const double> sag_px;      ///< how far the curve may be from each chord
    double tolerance_px = 0;
    glm::dvec2 begin_way{0.0}, end_way{0.0};  ///< tangents at its ends, inwards, of length 1
};

/// Where a curve is farther from a part of a line than it may be, the number of a point inside near the worst place,
/// else 0. `curve`: places on it, in order, the first and last one at the ends of the part; between them it is as good
/// as straight.
std::size_t worst_point(std::span<const glm::dvec2> curve, const SmoothPart& part);

/// Adds cubics that are no farther from the points than the tolerance, and no farther from the chords than that and
/// their sag: one, or several with equal tangents where they meet, or straight steps where a curve would take more
/// (Schneider, An Algorithm for Automatically Fitting Digitized Curves, 1990).
void fit_cubics(const SmoothPart& part, std::vector<PathStep>& steps);

}  // namespace burin
