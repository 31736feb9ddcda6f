#pragma once

#include <string>
#include <string_view>

// Files that a model names are read only if they lie in its folder or below.

namespace burin {

/// The path of the file that a model names by `reference`, relative to the model's folder.
/// Empty when the reference is absolute, or leads out of the folder, also by a symbolic link.
std::string path_inside_model_folder(const std::string& model_path, std::string_view reference);

/// What a part of a URI stands for: "a%20b" for "a b".
std::string decode_percent(std::string_view text);

}  // namespace burin
