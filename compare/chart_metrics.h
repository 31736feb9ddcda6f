#pragma once

#include "compare/comparison.h"
#include "compare/test_chart.h"

// What a method drew of the test chart becomes values and curves.

namespace burin {

/// The classes to ask a method for on the chart: interior edges as creases, or as polygon edges if
/// that is all the method draws; and silhouettes.
LineClassSet chart_classes(LineClassSet draws);

/// Measures a method's drawing of the chart. `truth_width_px` is the width that it is compared
/// with. Does nothing for a method that draws no interior edges at all.
void measure_chart(const TestChart& chart, const Plane& coverage, LineClassSet draws, double truth_width_px,
                   ComparisonRow& row);

/// The integrated width of the chart's star alone.
double star_width_px(const TestChart& chart, const Plane& coverage);

}  // namespace burin
