#pragma once

#include <optional>
#include <string>

#include "image/image.h"
#include "output/output_format.h"

namespace burin {

/// What a file that was written earlier says of itself.
struct WholeFile {
    std::string fingerprint;        ///< empty: it has none
    std::optional<PixelRect> data;  ///< the pixels that it has; vector files have none
    bool is_deep = false;
};

/// Reads what stands at a path, whatever that is. Nothing if it is no regular file of this format, or not a whole one.
std::optional<WholeFile> find_whole_file(const std::string& path, OutputFormat format);
/// The same of a file of lines.
std::optional<WholeFile> find_whole_lines_file(const std::string& path);

}  // namespace burin
