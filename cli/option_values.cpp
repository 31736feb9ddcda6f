#include "cli/option_values.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "mesh/text_scan.h"
#include "render/layer_names.h"

namespace burin::option_values {
namespace {

bool to_number(std::string_view text, double& value) {
    const char* const end = text.data() + text.size();
    return scan_number(text.data(), end, value) == end && !text.empty() && std::isfinite(value);
}

}  // namespace

void fail(const std::string& option, const std::string& message) { throw UsageError(option + ": " + message); }

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t at = text.find(separator);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

std::vector<std::string> join_negative_values(int argc, char** argv) {
    std::vector<std::string> arguments;
    for (int i = 1; i < argc; ++i) {
        std::string argument = argv[i];
        const std::string_view next = i + 1 < argc ? argv[i + 1] : "";
        const bool takes_vector =
            argument == "--eye" || argument == "--target" || argument == "--up" || argument == "--shutter";
        const bool takes_frames = argument == "-f" || argument == "--frames";
        const bool is_negative = next.size() > 1 && next[0] == '-' && next[1] >= '0' && next[1] <= '9';
        if (takes_frames && is_negative) argument = "--frames";
        if ((takes_vector && i + 1 < argc) || (takes_frames && is_negative)) argument += std::string("=") + argv[++i];
        arguments.push_back(std::move(argument));
    }
    return arguments;
}

std::string in_our_words(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    const std::pair<std::string_view, std::string_view> rewordings[] = {
        {": At Most 1 required", ": is given more than once; remove one"},
        {": 1 required TEXT missing", ": a value is missing"}};
    for (const auto& [theirs, ours] : rewordings) {
        const std::size_t at = message.find(theirs);
        if (at != std::string::npos) message = message.substr(0, at).append(ours);
    }
    return message;
}

std::vector<std::string> words(std::string_view text) {
    std::vector<std::string> all;
    for (const std::string_view part : split(text, ',')) {
        const std::string word(part);
        if (std::find(all.begin(), all.end(), word) == all.end()) all.push_back(word);
    }
    return all;
}

bool to_integer(std::string_view text, int& value) {
    std::int64_t wide = 0;
    const char* const end = text.data() + text.size();
    if (text.empty() || scan_integer(text.data(), end, wide) != end) return false;
    value = static_cast<int>(std::clamp<std::int64_t>(wide, -2000000000, 2000000000));
    return true;
}

double number(const std::string& option, std::string_view text) {
    double value = 0;
    if (!to_number(text, value)) fail(option, "'" + printable(text) + "' is no finite number");
    return value;
}

int integer(const std::string& option, std::string_view text, int low, int high) {
    int value = 0;
    if (!to_integer(text, value)) fail(option, "'" + printable(text) + "' is no whole number");
    if (value < low || value > high) {
        fail(option, "must be from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return value;
}

std::uint64_t byte_count(const std::string& option, std::string_view text) {
    constexpr std::string_view kUnits = "KMGT";
    std::string_view digits = text;
    double bytes = 1;
    const std::size_t unit =
        text.empty() ? std::string_view::npos : kUnits.find(static_cast<char>(text.back() & ~0x20));
    if (unit != std::string_view::npos && std::isalpha(static_cast<unsigned char>(text.back())) != 0) {
        digits.remove_suffix(1);
        bytes = std::ldexp(1.0, 10 * (static_cast<int>(unit) + 1));
    }
    double value = 0;
    const bool is_plain = digits.find_first_not_of("0123456789.") == std::string_view::npos;
    if (!is_plain || !to_number(digits, value))
        fail(option, "must be a size like 200M or 2G, got '" + printable(text) + "'");
    bytes *= value;
    if (!(bytes >= 1 && bytes < 0x1p62)) fail(option, "must be from 1 byte to 4000000T");
    return static_cast<std::uint64_t>(bytes);
}

glm::dvec3 vector(const std::string& option, std::string_view text) {
    const auto parts = split(text, ',');
    glm::dvec3 v;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (parts.size() != 3 || !to_number(parts[k], v[i])) {
            fail(option, "must be three numbers X,Y,Z, got '" + printable(text) + "'");
        }
    }
    return v;
}

LineClassSet line_classes(std::string_view text) {
    LineClassSet classes;
    const std::vector<std::string_view> names = split(text, ',');
    for (const std::string_view name : names) {
        if (name == "all") {
            classes = LineClassSet::all();
        } else if (const auto line_class = line_class_named(name)) {
            classes |= *line_class;
        } else if (name == "none") {
            if (names.size() > 1) fail("--lines", "none cannot stand beside other words; remove one");
        } else {
            fail("--lines", "unknown line class '" + printable(name) + "'; known are " +
                                to_string(LineClassSet::all()) + ",all,none");
        }
    }
    return classes;
}

LayerSet layer_set(std::string_view text) {
    try {
        return layers_named(text);
    } catch (const UsageError& error) {
        fail("--layers", error.what());
    }
}

GBufferOperatorSet gbuffer_operators(std::string_view text) {
    GBufferOperatorSet set;
    for (const std::string_view name : split(text, ',')) {
        const auto found = gbuffer_operator_named(name);
        if (!found) {
            std::string known;
            for (const std::string_view n : kGBufferOperatorNames) {
                known += (known.empty() ? "" : ",") + std::string(n);
            }
            fail("--operator", "unknown operator '" + printable(name) + "'; known are " + known);
        }
        set.add(*found);
    }
    return set;
}

}  // namespace burin::option_values
