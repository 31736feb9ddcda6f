#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace burin {

/// A PNG of one channel of 8 bits in sRGB. `stream`: its rows, each behind a byte 0, as a zlib stream.
std::vector<std::uint8_t> gray_png_of(std::span<const std::uint8_t> stream, int width, int height);

}  // namespace burin
