#pragma once

#include <glm/glm.hpp>

#include "compare/plane.h"
#include "image/image_io.h"

// A picture shows where a method has ink that the truth has not, and the reverse.

namespace burin {

/// sRGB, 0..1: ink that the truth does not have, and ink that is missing.
constexpr glm::vec3 kTooMuchColor{0.757f, 0.275f, 0.118f};
constexpr glm::vec3 kMissingColor{0.106f, 0.396f, 0.655f};

/// Where a result differs from the truth, and which way: the colours above on white, in proportion
/// to the difference, over the truth in light grey.
DisplayImage difference_picture(const Plane& result, const Plane& truth);

}  // namespace burin
