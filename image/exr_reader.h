#pragma once

#include <string>

#include "image/image.h"

namespace burin {

/// Reads all channels of a single-part flat EXR. Throws InputError. For tests and tools: a library of its own, so that
/// the program need not load what only reading takes.
Image read_exr(const std::string& path);
/// Has OpenEXR flatten a deep EXR: its R, G, B and A in single precision. Throws InputError.
Image read_flattened_exr(const std::string& path);

}  // namespace burin
