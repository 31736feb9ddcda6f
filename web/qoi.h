#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace burin {

/// A picture in the "Quite OK Image Format" (qoiformat.org), three channels in sRGB. `codes`: of each pixel, row by
/// row, red, green, blue, from the lowest byte on.
std::vector<std::uint8_t> qoi_of(std::span<const std::uint32_t> codes, int width, int height);

}  // namespace burin
