#pragma once

#include <span>

namespace burin {

/// Whether two patterns of dashes are one that was stretched by different factors, as it is to fit the lengths of
/// lines.
bool is_one_pattern(std::span<const float> a, std::span<const float> b);

}  // namespace burin
