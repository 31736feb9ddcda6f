#pragma once

#include <string>
#include <utility>
#include <vector>

#include "image/image.h"

namespace burin {

struct ExrOptions {
    int threads = 1;
    /// Text attributes of the header, in this order. No date goes into it: equal images give equal
    /// files.
    std::vector<std::pair<std::string, std::string>> texts;
};

/// Writes all channels as one scan-line part, ZIP compressed, with the image's display and data
/// windows. The file appears under its name only when it is complete. Throws InputError.
void write_exr(const std::string& path, const Image& image, const ExrOptions& options);

/// Reads all channels of a single-part flat EXR. Throws InputError. For tests and tools.
Image read_exr(const std::string& path);

}  // namespace burin
