#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace burin {

/// What a fingerprint is called in files that have names for texts.
constexpr char kFingerprintName[] = "burin/fingerprint";

/// A picture for the screen: rows from the top, 3 or 4 values per pixel, sRGB-encoded, 0..65535,
/// alpha not multiplied in.
struct DisplayImage {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<std::uint16_t> pixels;
    std::string fingerprint = {};  ///< of what it was made from, for the file; empty: the file has none
};

}  // namespace burin
