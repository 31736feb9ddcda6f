#include "render/matte_names.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <unordered_map>

#include "base/interrupt.h"
#include "base/murmur_hash.h"
#include "mesh/text_scan.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {
namespace {

/// How many bytes a character of UTF-8 has that a text begins with; 0: none begins there.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    if (length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if (byte(i) >> 6 != 2) return 0;
    }
    if (length < 3) return length;
    const bool is_too_short = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool is_no_character = (lead == 0xED && byte(1) >= 0xA0) || (lead == 0xF4 && byte(1) >= 0x90);
    return is_too_short || is_no_character ? 0 : length;
}

}  // namespace

std::uint32_t crypto_id(std::string_view name) {
    const std::uint32_t hash = murmur_hash(name), exponent = hash >> 23 & 0xFF;
    return exponent == 0 || exponent == 0xFF ? hash ^ 1u << 23 : hash;
}

std::string matte_name(std::string_view name) {
    if (name.empty()) return "default";
    std::string clean;
    while (!name.empty()) {
        const std::size_t length = utf8_length(name);
        const auto first = static_cast<unsigned char>(name.front());
        const bool is_control = first < 0x20 || first == 0x7F;
        if (length == 0 || is_control) {
            clean += '_';
        } else {
            clean += name.substr(0, length);
        }
        name.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return clean;
}

std::string MatteNames::manifest() const {
    std::map<std::string_view, std::uint32_t> sorted;
    for (std::size_t i = 0; i < names.size(); ++i) sorted.emplace(names[i], ids[i]);
    std::string text = "{";
    for (const auto& [name, id] : sorted) {
        if (text.size() > 1) text += ',';
        text += '"';
        for (const char c : name) {
            if (c == '"' || c == '\\') text += '\\';
            text += c;
        }
        char digits[16];
        std::snprintf(digits, sizeof digits, "%08x", id);
        text += "\":\"" + std::string(digits) + '"';
    }
    return text + '}';
}

MatteNames matte_names_of(CryptoLayer layer, const Frame& frame) {
    MatteNames known;
    const auto add = [&](std::string_view name) {
        known.names.push_back(matte_name(name));
        known.ids.push_back(crypto_id(known.names.back()));
    };
    const Scene& scene = *frame.scene;
    switch (layer) {
        case CryptoLayer::object:
        case CryptoLayer::line_object:
            for (const SceneObject& object : scene.objects) add(object.name);
            break;
        case CryptoLayer::material:
            for (const Material& material : scene.materials) add(material.name);
            break;
        case CryptoLayer::line:
            for (const std::string_view name : kLineClassNames) add(name);
            for (const std::string_view name : kLineClassNames) add("hidden " + std::string(name));
            break;
        case CryptoLayer::line_set:
            if (!frame.sheet) break;
            for (const CompiledSet& set : frame.sheet->sets()) add(set.name);
            break;
    }
    return known;
}

std::vector<std::string> warnings_on_names(const std::vector<std::string>& names) {
    std::vector<std::string> warnings;
    std::unordered_map<std::uint32_t, std::string> known;
    for (const std::string& raw : names) {
        throw_if_interrupted();
        const std::string name = matte_name(raw);
        const auto [other, is_new] = known.emplace(crypto_id(name), name);
        if (!is_new) {
            if (other->second != name)
                warnings.push_back(printable(name) + ": has the Cryptomatte number of " + printable(other->second) +
                                   "; they cannot be told apart");
            continue;
        }
        const bool is_number = name.size() > 2 && name.front() == '<' && name.back() == '>';
        if (name.find(',') != std::string::npos || is_number)
            warnings.push_back(printable(name) + ": Blender cannot find a Cryptomatte name " +
                               (is_number ? "in angle brackets" : "with a comma") + " that is typed, only pick it");
    }
    return warnings;
}

}  // namespace burin
