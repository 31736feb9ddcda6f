#include "web/command_text.h"

#include <charconv>

namespace burin {

std::string in_shell(const std::string& word) {
    constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string shortest_text(double number) {
    char text[40];
    const auto [end, error] = std::to_chars(text, text + sizeof text, number);
    return {text, error == std::errc() ? end : text};
}

const char* word_of(HiddenStyle style) {
    return style == HiddenStyle::none ? "none" : style == HiddenStyle::solid ? "solid" : "dashed";
}

void CommandText::add(const std::string& word) { text_ += " " + in_shell(word.starts_with('-') ? "./" + word : word); }

void CommandText::add(const char* option, const std::string& value) {
    text_ += " " + in_shell(std::string(option) + "=" + value);
}

void CommandText::add(const char* option, double value) { add(option, shortest_text(value)); }

void CommandText::add(const char* option, const glm::dvec3& value) {
    add(option, shortest_text(value.x) + "," + shortest_text(value.y) + "," + shortest_text(value.z));
}

}  // namespace burin
