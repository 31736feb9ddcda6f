#pragma once

#include <limits>

namespace burin {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace burin
