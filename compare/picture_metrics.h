#pragma once

#include "compare/metric_table.h"
#include "compare/plane.h"

// All metrics of a scene's picture are measured here.

namespace burin {

/// The metrics of the group "scene": a result's line coverage against the truth's.
/// Without any true line there is nothing to compare with, and no value.
void measure_picture(const Plane& result, const Plane& truth, int threads, MetricValues& values);

}  // namespace burin
