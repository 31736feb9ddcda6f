#include "mesh/gltf_json.h"

#include <algorithm>

namespace burin {
namespace {

constexpr int kMaxJsonDepth = 256;

/// How deep lists and objects stand in each other.
int nesting_depth(std::string_view text) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

}  // namespace

nlohmann::json parse_gltf_json(const std::string& path, std::string_view text) {
    // Not by the parser's callback, which takes time in the square of a list's length.
    if (nesting_depth(text) > kMaxJsonDepth) throw InputError(path + ": the JSON is nested too deeply");
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t at = std::min<std::size_t>(error.byte, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw InputError({path, static_cast<std::size_t>(line)},
                         "the JSON breaks off or is malformed at byte " + std::to_string(at) +
                             "; was the file written completely?");
    } catch (const nlohmann::json::exception&) {
        throw InputError(path + ": the JSON holds a number that no computer can hold; repair the file");
    }
}

}  // namespace burin
