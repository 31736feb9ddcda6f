#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "image/image.h"

namespace burin {

/// What the header of an EXR file says, as far as that is needed to know whether the file is the one that is wanted.
struct ExrHeader {
    PixelRect data;                            ///< of the first part
    std::map<std::string, std::string> texts;  ///< attributes of type string, of the first part
};

/// Reads the header of a file's bytes, whatever these are. Nothing if it is no whole EXR of scan lines: if a chunk of
/// any part is missing or cut off.
std::optional<ExrHeader> header_of_whole_exr(std::string_view bytes);

}  // namespace burin
