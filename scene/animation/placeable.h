#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <string>

#include "mesh/text_scan.h"

namespace burin {

/// Whether a matrix is one that an object of a scene may have: finite, and not far too large.
inline bool is_placeable(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!(std::abs(m[c][r]) <= 1e60)) return false;
        }
    }
    return true;
}

/// What is said of an object whose matrix is none.
inline std::string not_placeable(const std::string& object) {
    return "object '" + printable(object) + "' has a transform that is not finite or far too large";
}

}  // namespace burin
