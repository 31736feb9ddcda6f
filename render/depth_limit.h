#pragma once

#include <string_view>

namespace burin {

/// How deep surfaces may lie over each other before a picture is refused: the depth complexity, the area of all
/// triangles on the screen over that of the picture. Time grows with it, and a small file can ask for very much.
struct DepthLimit {
    double surfaces_per_px = 0;    ///< 0: no limit
    std::string_view option = {};  ///< what raises it, as messages name it; a literal
};

}  // namespace burin
