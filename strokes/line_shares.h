#pragma once

#include <vector>

#include "render/mattes.h"

namespace burin {

/// Brings the shares that lines have in a pixel into the range in which they are drawn. What lies below visible strokes
/// becomes a share of what these leave; `opaque`: how much of the pixel the opaque ones take. `is_filtered`: what a
/// filter's negative lobes take away is cut off.
void bring_into_range(std::vector<LineShare>& lines, float opaque, bool is_filtered);

/// A share in steps that do not show how crops round.
float in_share_steps(float share);

}  // namespace burin
