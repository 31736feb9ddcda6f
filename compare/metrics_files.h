#pragma once

#include <string>

#include "compare/comparison.h"

// A comparison becomes metrics.json and metrics.csv.

namespace burin {

/// metrics.json: what was compared, what the metrics mean, and per method all values; what does not
/// apply is null. docs/compare.md lists the keys.
std::string metrics_json(const Comparison& comparison);

/// metrics.csv: two lines per method, "published" and "equal_width"; what does not apply is empty.
std::string metrics_csv(const Comparison& comparison);

}  // namespace burin
