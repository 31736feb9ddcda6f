#include "image/exr_container.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <span>

#include "base/error.h"

namespace burin {
namespace {

constexpr std::uint32_t kTiledFlag = 0x200, kDeepFlag = 0x800, kPartsFlag = 0x1000;
/// Hostile headers are refused before they take much memory or time.
constexpr std::size_t kMostParts = 4096, kMostAttributes = 65536, kLongestName = 255;

/// Reads a file's bytes one after the other.
class ByteReader {
  public:
    ByteReader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

    [[noreturn]] void fail(const std::string& what) const { throw InputError(path_ + ": " + what); }
    std::size_t position() const { return at_; }
    void go_to(std::size_t place) { at_ = place; }
    bool has(std::uint64_t count) const { return count <= bytes_.size() - at_; }

    std::string_view take(std::uint64_t count, const char* what) {
        if (!has(count)) fail(std::string("the file ends within ") + what);
        const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(count));
        at_ += taken.size();
        return taken;
    }
    template <typename T>
    T number(const char* what) {
        T value;
        std::memcpy(&value, take(sizeof(T), what).data(), sizeof(T));  // EXR and all our machines: little-endian
        return value;
    }
    /// A text that ends with 0.
    std::string_view name(const char* what) {
        const std::size_t end = bytes_.find('\0', at_);
        if (end == std::string_view::npos) fail(std::string("the file ends within ") + what);
        if (end - at_ > kLongestName) fail(std::string(what) + " is longer than 255 bytes");
        const std::string_view taken = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return taken;
    }
    bool take_end_of_header() {
        if (!has(1)) fail("the file ends within its header");
        if (bytes_[at_] != '\0') return false;
        ++at_;
        return true;
    }

  private:
    const std::string& path_;
    std::string_view bytes_;
    std::size_t at_ = 0;
};

/// Rows of a chunk by the number of the compression (OpenEXR's `Compression`); 0: there is no such compression.
int rows_of_compression(unsigned char number) {
    //                      none rle zips zip piz pxr24 b44 b44a dwaa dwab
    constexpr std::array rows{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return number < rows.size() ? rows[number] : 0;
}

PixelRect window_of(const ContainedPart& part, const std::string& name, ByteReader& reader) {
    const ContainedAttribute* const window = part.find(name);
    if (window == nullptr || window->type != "box2i" || window->value.size() != 16) reader.fail("it has no " + name);
    std::array<std::int32_t, 4> corners{};
    std::memcpy(corners.data(), window->value.data(), 16);
    constexpr std::int32_t kFarthest = 1 << 28;
    for (const std::int32_t c : corners) {
        if (c <= -kFarthest || c >= kFarthest) reader.fail("its " + name + " is beyond what pictures have");
    }
    if (corners[2] < corners[0] || corners[3] < corners[1]) reader.fail("its " + name + " is empty");
    return {corners[0], corners[1], corners[2] + 1, corners[3] + 1};
}

ContainedPart read_header(ByteReader& reader, bool is_named_kind, std::uint32_t version) {
    ContainedPart part;
    while (!reader.take_end_of_header()) {
        if (part.attributes.size() == kMostAttributes) reader.fail("its header has too many attributes");
        ContainedAttribute attribute;
        attribute.name = reader.name("an attribute's name");
        attribute.type = reader.name("an attribute's type");
        const auto size = reader.number<std::int32_t>("an attribute's size");
        if (size < 0) reader.fail("an attribute has a negative size");
        attribute.value = reader.take(static_cast<std::uint64_t>(size), "an attribute's value");
        part.attributes.push_back(attribute);
    }
    part.display = window_of(part, "displayWindow", reader);
    part.data = window_of(part, "dataWindow", reader);
    const ContainedAttribute* const compression = part.find("compression");
    if (compression == nullptr || compression->value.size() != 1) reader.fail("it has no compression");
    part.rows_per_chunk = rows_of_compression(static_cast<unsigned char>(compression->value[0]));
    if (part.rows_per_chunk == 0) reader.fail("its compression is unknown");
    const std::string_view kind = is_named_kind ? part.text("type").value_or("") : "scanlineimage";
    part.is_deep = kind == "deepscanline";
    if ((version & kTiledFlag) != 0 || (kind != "scanlineimage" && !part.is_deep))
        reader.fail("it has tiles or is of another kind; only scan lines can be read");
    return part;
}

/// A chunk as a whole; `number`: of its part.
std::string_view chunk_at(ByteReader& reader, std::uint64_t place, std::size_t headers_end, bool has_parts,
                          std::size_t number, const ContainedPart& part, int y) {
    if (place == 0) reader.fail("it is half written: rows from " + std::to_string(y) + " on are missing");
    reader.go_to(0);
    if (place < headers_end || !reader.has(place)) reader.fail("its table of chunks points out of the file");
    reader.go_to(static_cast<std::size_t>(place));
    const std::size_t begin = reader.position();
    std::uint64_t length = 8;
    if (has_parts) {
        if (reader.number<std::int32_t>("a chunk") != static_cast<std::int32_t>(number))
            reader.fail("its table of chunks leads to another part");
        length += 4;
    }
    if (reader.number<std::int32_t>("a chunk") != y)
        reader.fail("its table of chunks leads to other rows than those from " + std::to_string(y) + " on");
    if (part.is_deep) {
        const auto table = reader.number<std::uint64_t>("a chunk"), data = reader.number<std::uint64_t>("a chunk");
        reader.number<std::uint64_t>("a chunk");  // size of the data before compression
        if (!reader.has(table) || !reader.has(data)) reader.fail("the file ends within a chunk");
        length += 20 + table + data;
    } else {
        const auto size = reader.number<std::int32_t>("a chunk");
        if (size < 0) reader.fail("a chunk has a negative size");
        length += static_cast<std::uint64_t>(size);
    }
    reader.go_to(begin);
    return reader.take(length, "a chunk");
}

}  // namespace

const ContainedAttribute* ContainedPart::find(std::string_view name) const {
    const auto found =
        std::find_if(attributes.begin(), attributes.end(), [&](const ContainedAttribute& a) { return a.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

std::optional<std::string_view> ContainedPart::text(std::string_view name) const {
    const ContainedAttribute* const found = find(name);
    if (found == nullptr || found->type != "string") return std::nullopt;
    return found->value;
}

ExrContainer parse_exr_container(const std::string& path, std::string_view bytes) {
    ByteReader reader(path, bytes);
    ExrContainer file;
    if (bytes.size() < 8 || bytes.substr(0, 4) != std::string_view("\x76\x2f\x31\x01", 4))
        reader.fail("this is no EXR file");
    file.magic_and_version = reader.take(4, "its header");
    const auto version = reader.number<std::uint32_t>("its header");
    file.magic_and_version = bytes.substr(0, 8);
    if ((version & 0xFF) != 2) reader.fail("its version of EXR is unknown");
    file.has_parts = (version & kPartsFlag) != 0;
    const bool is_named_kind = file.has_parts || (version & kDeepFlag) != 0;
    do {
        if (file.parts.size() == kMostParts) reader.fail("it has too many parts");
        file.parts.push_back(read_header(reader, is_named_kind, version));
    } while (file.has_parts && !reader.take_end_of_header());

    std::vector<std::vector<std::uint64_t>> places(file.parts.size());
    for (std::size_t p = 0; p < file.parts.size(); ++p) {
        const ContainedPart& part = file.parts[p];
        const auto count =
            static_cast<std::uint64_t>((part.data.height() + part.rows_per_chunk - 1) / part.rows_per_chunk);
        if (!reader.has(count * sizeof(std::uint64_t))) reader.fail("the file ends within its table of chunks");
        for (std::uint64_t i = 0; i < count; ++i) places[p].push_back(reader.number<std::uint64_t>("its table"));
    }
    const std::size_t headers_end = reader.position();
    for (std::size_t p = 0; p < file.parts.size(); ++p) {
        ContainedPart& part = file.parts[p];
        for (std::size_t i = 0; i < places[p].size(); ++i) {
            const int y = part.data.y0 + static_cast<int>(i) * part.rows_per_chunk;
            part.chunks.push_back(chunk_at(reader, places[p][i], headers_end, file.has_parts, p, part, y));
        }
    }
    return file;
}

}  // namespace burin
