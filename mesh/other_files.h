#pragma once

#include <string>
#include <vector>

namespace burin {

/// Files beside a model's own.
struct OtherFiles {
    std::vector<std::string> read;      ///< materials, buffers
    std::vector<std::string> pictures;  ///< that these name; they are not read, and may be missing or anything else
};

}  // namespace burin
