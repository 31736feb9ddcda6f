#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "shading/ink/inked_lines.h"

namespace burin {

/// Adds the outline of a stroke whose width varies, as a closed line: its last point is its first one. Filled by the
/// rule "nonzero", it is the union of the stroke's cones but for what is within 1/64 pixel of round ends and joins.
/// Nothing is added for a stroke without width.
void add_outline(std::span<const InkPoint> stroke, bool has_round_caps, bool is_closed, std::vector<glm::dvec2>& out);

}  // namespace burin
