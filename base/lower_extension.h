#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

// Readers and writers are chosen by the extension of a path.

namespace burin {

/// The extension of a path in lower case, with its dot: what kind of file it names. Empty if it has none.
inline std::string lower_extension(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace burin
