#include "mesh/model_path.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace burin {
namespace fs = std::filesystem;

std::string path_inside_model_folder(const std::string& model_path, std::string_view reference) {
    const fs::path relative(reference);
    if (reference.empty() || reference.find('\0') != std::string_view::npos || relative.is_absolute()) {
        return {};
    }
    std::error_code error;
    fs::path folder = fs::path(model_path).parent_path();
    if (folder.empty()) folder = ".";
    folder = fs::weakly_canonical(folder, error);
    if (error) return {};
    const fs::path target = fs::weakly_canonical(folder / relative, error);
    if (error) return {};
    const auto [end_of_folder, rest] = std::mismatch(folder.begin(), folder.end(), target.begin(), target.end());
    if (end_of_folder != folder.end() || rest == target.end()) return {};
    return target.string();
}

std::string decode_percent(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr == text.data() + i + 3) {
            result += static_cast<char>(value);
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

}  // namespace burin
