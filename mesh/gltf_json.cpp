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

/// The word that ends with byte `end`, and what is left of it; empty at the end of the text.
std::string word_at(std::string_view text, std::size_t end) {
    constexpr std::string_view kBetween = " \t\r\n,:[]{}";
    constexpr std::size_t kLongest = 20;
    if (text.find_first_not_of(" \t\r\n", end - 1) == std::string_view::npos) return {};
    const std::size_t before = text.substr(0, end - 1).find_last_of(kBetween);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    std::string word(text.substr(begin, std::min(text.find_first_of(kBetween, end), begin + kLongest) - begin));
    std::replace_if(
        word.begin(), word.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return word;
}

/// What is wrong at a byte, counted from 1.
std::string malformed_at(std::string_view text, std::size_t byte) {
    const std::string word = byte == 0 || byte > text.size() ? std::string() : word_at(text, byte);
    if (word.empty())
        return "the JSON breaks off at byte " + std::to_string(byte) + "; was the file written completely?";
    std::string lower = word;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    const bool is_no_number = lower.find("nan") != std::string::npos || lower.find("inf") != std::string::npos;
    return "the JSON is malformed at byte " + std::to_string(byte) + ", at '" + word + "'; " +
           (is_no_number ? "JSON has no such number: find what made it in the program that exported the file"
                         : "export the file again");
}

}  // namespace

nlohmann::json parse_gltf_json(const std::string& path, std::string_view text) {
    // The depth is not counted by the parser's callback, which takes time in the square of a list's length.
    if (nesting_depth(text) > kMaxJsonDepth) throw InputError(path + ": the JSON is nested too deeply");
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t at = std::min<std::size_t>(error.byte, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw InputError({path, static_cast<std::size_t>(line)}, malformed_at(text, error.byte));
    } catch (const nlohmann::json::exception&) {
        throw InputError(path + ": the JSON holds a number that no computer can hold; repair the file");
    }
}

}  // namespace burin
