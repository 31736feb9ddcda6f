#pragma once

#include <cstdint>
#include <string>

namespace burin {

/// Something in a model file that is not drawn, and how often it is there.
struct LeftOut {
    std::string file;
    std::string what;  ///< in the plural: "primitives of points"
    std::uint64_t count = 0;

    bool operator==(const LeftOut&) const = default;
};

}  // namespace burin
