#pragma once

#include <array>
#include <span>
#include <vector>

#include "methods/abuffer/layer_line.h"

namespace burin {

/// Where the two ends of each line stand along its chain, in pixels on the screen. Lines that alone
/// have a node in common follow each other in a chain; so dashes run on around the corners of a
/// polyline, and start anew where lines branch.
std::vector<std::array<double, 2>> positions_along_chains(std::span<const LayerLine> lines);

}  // namespace burin
