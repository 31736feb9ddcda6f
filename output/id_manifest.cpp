#include "output/id_manifest.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "image/deflate.h"

// The serial form is that of OpenEXR's IDManifest (ImfIDManifest.cpp).

namespace burin {
namespace {

/// Numbers of a manifest are little-endian.
void put_bytes(std::uint64_t number, int count, std::string& out) {
    for (int i = 0; i < count; ++i) out.push_back(static_cast<char>(number >> 8 * i & 0xFF));
}
void put_int(std::size_t number, std::string& out) { put_bytes(number, 4, out); }

/// Seven bits after the other, low ones first; all but the last byte have the eighth.
void put_varint(std::uint64_t number, std::string& out) {
    for (; number > 127; number >>= 7) out.push_back(static_cast<char>(128 | (number & 127)));
    out.push_back(static_cast<char>(number));
}

void put_counted(std::string_view text, std::string& out) {
    put_int(text.size(), out);
    out += text;
}

/// A list of one text.
void put_list_of_one(std::string_view text, std::string& out) {
    put_int(1, out);
    put_varint(text.size(), out);
    out += text;
}

/// A text but for what it has in common with the one before, whose length decides how long the count of that is.
std::string without_common(std::string_view text, std::string_view before) {
    constexpr std::size_t kLongOfByte = 255, kMostOfTwo = 65535;
    const bool is_wide = before.size() > kLongOfByte;
    const std::size_t most = std::min({before.size(), text.size(), is_wide ? kMostOfTwo : kLongOfByte});
    std::size_t common = 0;
    while (common < most && before[common] == text[common]) ++common;
    std::string rest;
    if (is_wide) rest.push_back(static_cast<char>(common >> 8));
    rest.push_back(static_cast<char>(common & 0xFF));
    return rest += text.substr(common);
}

}  // namespace

std::vector<std::uint8_t> id_manifest(const std::vector<NamedIds>& groups) {
    std::map<std::string_view, std::size_t> places;
    for (const NamedIds& group : groups) {
        for (const auto& [id, name] : group.names) places.emplace(name, 0);
    }
    std::string lengths, texts;
    std::string_view before;
    std::size_t place = 0;
    for (auto& [name, own_place] : places) {
        const std::string rest = place == 0 ? std::string(name) : without_common(name, before);
        put_varint(rest.size(), lengths);
        texts += rest;
        own_place = place++;
        before = name;
    }
    std::string out;
    put_int(0, out);  // version
    put_int(places.size(), out);
    out += lengths + texts;
    if (places.empty()) {
        put_int(0, out);
    } else {  // the numbers of names are their places
        put_int(1, out);
        put_int(0, out);
        put_int(places.size() - 1, out);
    }
    constexpr char kIsStable = 2, kIdsAreDifferences = 2;
    put_int(groups.size(), out);
    for (const NamedIds& group : groups) {
        put_list_of_one(group.channel, out);
        put_list_of_one(group.component, out);
        out.push_back(kIsStable);
        put_counted("MurmurHash3_32", out);
        put_counted("id", out);
        out.push_back(kIdsAreDifferences);
        put_int(group.names.size(), out);
        std::uint32_t last = 0;
        for (const auto& [id, name] : group.names) {
            put_varint(id - last, out);
            put_varint(places.at(name), out);
            last = id;
        }
    }
    std::string size;
    put_bytes(out.size(), 8, size);
    std::vector<std::uint8_t> value(size.begin(), size.end());
    Deflater deflater;
    const std::span<const std::uint8_t> stream =
        deflater.compress({reinterpret_cast<const std::uint8_t*>(out.data()), out.size()});
    value.insert(value.end(), stream.begin(), stream.end());
    return value;
}

}  // namespace burin
