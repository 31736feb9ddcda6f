#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "lines/line_class.h"
#include "mesh/text_scan.h"
#include "render/film.h"
#include "scene/scene_description.h"

/// Reads values of options as they are typed. What is no such value throws UsageError, which names the option.
namespace burin::option_values {

[[noreturn]] void fail(const std::string& option, const std::string& message);

/// Values may begin with a minus: "--eye -1,2,3" becomes "--eye=-1,2,3", and "-f -5:5" is "--frames=-5:5".
std::vector<std::string> join_negative_values(int argc, char** argv);
/// What CLI11 says against a command line, without its jargon.
std::string in_our_words(std::string message);
/// Words, each once, in the order given.
std::vector<std::string> words(std::string_view text);
std::vector<std::string_view> split(std::string_view text, char separator);
bool to_integer(std::string_view text, int& value);

double number(const std::string& option, std::string_view text);
int integer(const std::string& option, std::string_view text, int low, int high);
/// Reads a number of bytes. A K, M, G or T behind it stands for 1024 bytes, 1024 K, 1024 M or 1024 G.
std::uint64_t byte_count(const std::string& option, std::string_view text);
glm::dvec3 vector(const std::string& option, std::string_view text);
/// Reads N whole numbers. `form` says in messages how they are written.
template <std::size_t N>
std::array<int, N> integers(const std::string& option, std::string_view text, char separator, const char* form) {
    const auto parts = split(text, separator);
    std::array<int, N> values{};
    for (std::size_t i = 0; i < N; ++i) {
        if (parts.size() != N || !to_integer(parts[i], values[i])) {
            fail(option, "must be " + std::string(form) + ", got '" + printable(text) + "'");
        }
    }
    return values;
}

LineClassSet line_classes(std::string_view text);
LayerSet layer_set(std::string_view text);
GBufferOperatorSet gbuffer_operators(std::string_view text);

}  // namespace burin::option_values
