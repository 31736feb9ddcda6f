#include "output/srgb_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace burin {
namespace {

void add_number(std::string& out, std::uint32_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xFF);
}

using Xyz = std::array<std::uint32_t, 3>;          // in 1/65536
constexpr Xyz kWhite = {0xF6D6, 0x10000, 0xD32D};  // D50
constexpr Xyz kPrimaries[] = {{0x6FA2, 0x38F5, 0x0390}, {0x6299, 0xB785, 0x18DA}, {0x24A0, 0x0F84, 0xB6CF}};

std::string xyz_tag(const Xyz& color) {
    std::string tag("XYZ \0\0\0\0", 8);
    for (const std::uint32_t v : color) add_number(tag, v, 4);
    return tag;
}

/// The curve from codes to light.
std::string curve_tag() {
    constexpr int kEntries = 256;
    std::string tag("curv\0\0\0\0", 8);
    add_number(tag, kEntries, 4);
    for (int i = 0; i < kEntries; ++i) {
        const double code = i / (kEntries - 1.0);
        const double light = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
        add_number(tag, static_cast<std::uint32_t>(light * 65535 + 0.5), 2);
    }
    return tag;
}

std::string text_tag(std::string_view text) { return std::string("text\0\0\0\0", 8) + std::string(text) + '\0'; }

std::string description_tag(std::string_view text) {
    std::string tag("desc\0\0\0\0", 8);
    add_number(tag, static_cast<std::uint32_t>(text.size()) + 1, 4);
    tag += text;
    return tag + std::string(1 + 8 + 3 + 67, '\0');  // no texts in other scripts
}

}  // namespace

std::string srgb_profile() {
    const std::string curve = curve_tag();
    const std::vector<std::pair<std::string_view, std::string>> tags = {{"desc", description_tag("sRGB")},
                                                                        {"cprt", text_tag("No copyright, use freely")},
                                                                        {"wtpt", xyz_tag(kWhite)},
                                                                        {"rXYZ", xyz_tag(kPrimaries[0])},
                                                                        {"gXYZ", xyz_tag(kPrimaries[1])},
                                                                        {"bXYZ", xyz_tag(kPrimaries[2])},
                                                                        {"rTRC", curve},
                                                                        {"gTRC", {}},
                                                                        {"bTRC", {}}};
    std::string table, data;
    add_number(table, static_cast<std::uint32_t>(tags.size()), 4);
    const std::size_t begin = 128 + 4 + 12 * tags.size();
    std::size_t at = begin, size = 0;
    for (const auto& [name, bytes] : tags) {
        if (!bytes.empty()) {  // else the one before is meant
            data.resize((data.size() + 3) / 4 * 4);
            at = begin + data.size();
            size = bytes.size();
            data += bytes;
        }
        table += name;
        add_number(table, static_cast<std::uint32_t>(at), 4);
        add_number(table, static_cast<std::uint32_t>(size), 4);
    }
    data.resize((data.size() + 3) / 4 * 4);
    std::string header;
    add_number(header, static_cast<std::uint32_t>(begin + data.size()), 4);
    add_number(header, 0, 4);
    add_number(header, 0x02100000, 4);
    header += "mntrRGB XYZ ";
    for (const std::uint32_t v : {2000, 1, 1, 0, 0, 0}) add_number(header, v, 2);  // a date must be there
    header += "acsp";
    header.resize(68);
    for (const std::uint32_t v : kWhite) add_number(header, v, 4);
    header.resize(128);
    return header + table + data;
}

}  // namespace burin
