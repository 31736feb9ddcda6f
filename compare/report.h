#pragma once

#include <string>
#include <string_view>

#include "compare/comparison.h"

namespace burin {

/// Writes metrics.json and metrics.csv into a folder. Throws InputError.
void write_metrics(const Comparison& comparison, const std::string& folder);

/// Writes report.html into the folder with the comparison's pictures: one page with everything in
/// it, pictures too, that needs nothing else to be looked at or printed. Throws InputError.
void write_report(const Comparison& comparison, const std::string& folder);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace burin
