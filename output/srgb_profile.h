#pragma once

#include <string>

namespace burin {

/// An ICC profile (version 2.1) of sRGB: the bytes that files name their colours by.
std::string srgb_profile();

}  // namespace burin
