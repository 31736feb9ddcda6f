#pragma once

#include <cstdint>
#include <vector>

#include "kernels/screen_triangle.h"
#include "lines/surface_walk.h"

// Which edges may be lines in some view is found once per mesh, so that frames look at few.

namespace burin {

constexpr std::uint8_t kThinTriangle = kMayBeSliver;

/// An edge is smooth where the cosine is greater than the crease angle's by more than this: normals are single
/// precision.
constexpr float kCreaseSlack = 1e-5f;

/// Per triangle of a mesh, bit k: its half-edge k may be a line in some view without being a contour.
/// That is, it has not exactly one partner wound the other way, or a class asked for. An edge without
/// its bit is none, under any transform that keeps angles.
/// kThinTriangle: the triangle may be a sliver, see is_sliver(), under any such transform.
std::vector<std::uint8_t> find_sharp_edges(const Mesh& mesh, const LineCriteria& criteria, int threads = 1);

/// Whether a transform keeps angles, as far as single precision tells: rotation, translation and one scale for all
/// directions.
bool keeps_angles(const glm::dmat4& transform);

}  // namespace burin
