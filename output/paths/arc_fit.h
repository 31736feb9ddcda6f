#pragma once

#include <vector>

#include "output/paths/cubic_fit.h"

namespace burin {

/// Adds arcs of one ellipse, each of at most a quarter of it, if the part turns enough and lies on one as fit_cubics()
/// wants it; else returns false.
bool fit_arcs(const SmoothPart& part, std::vector<PathStep>& steps);

}  // namespace burin
