#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "output/paths/vector_drawing.h"

// What the writers of vector files have in common: layers and their names, and the size on paper.

namespace burin {

/// Whether two groups that follow each other are in one layer: visible lines, or hidden ones, or those behind a number
/// of surfaces.
bool is_one_layer(const VectorGroup& a, const VectorGroup& b);
/// "1 visible", "2 hidden", "3 hidden 2", "surfaces": plotters' programs look for numbers.
std::string label_of_layer(const VectorGroup& group);
/// What a group within a layer is: "crease, edges", or the name of an object; with views in front of it that of its.
std::string label_of_group(const VectorDrawing& drawing, const VectorGroup& group);

/// The part of the picture that a file shows: where it begins and how large it is, in pixels. A sheet of paper is not
/// rounded to whole ones.
struct ShownArea {
    glm::dvec2 low_px{0.0}, size_px{0.0};
    double mm_per_px = 1;

    glm::dvec2 size_mm() const { return size_px * mm_per_px; }
};
ShownArea shown_area(const VectorDrawing& drawing);

/// A colour as its sRGB codes, 0 to 255.
glm::ivec3 srgb_codes(glm::vec3 linear);

/// The points of a path, its start first, as straight lines that are at most `tolerance_px` from it.
std::vector<glm::dvec2> flattened(const VectorPath& path, std::span<const PathStep> steps, double tolerance_px);

}  // namespace burin
