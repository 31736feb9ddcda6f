#pragma once

#include <cstdint>
#include <vector>

namespace burin {

/// A picture for the screen: rows from the top, 3 or 4 values per pixel, sRGB-encoded, 0..65535,
/// alpha not multiplied in.
struct DisplayImage {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<std::uint16_t> pixels;
};

}  // namespace burin
