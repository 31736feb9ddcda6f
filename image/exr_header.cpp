#include "image/exr_header.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace burin {
namespace {

static_assert(std::endian::native == std::endian::little);  // as the file is

/// Takes values from the front of bytes. What is not there makes it fail, and all that is taken then is 0.
class ByteTaker {
  public:
    explicit ByteTaker(std::string_view bytes) : rest_(bytes) {}

    bool has_failed() const { return has_failed_; }
    std::size_t left() const { return rest_.size(); }
    std::string_view take(std::size_t count) {
        if (count > rest_.size()) {
            has_failed_ = true;
            return {};
        }
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    template <typename T>
    T value() {
        T result{};
        const std::string_view bytes = take(sizeof(T));
        if (!has_failed_) std::memcpy(&result, bytes.data(), sizeof(T));
        return result;
    }
    /// A text of up to 255 bytes that ends with a zero byte.
    std::string name() {
        const std::size_t end = rest_.substr(0, 256).find('\0');
        if (end == std::string_view::npos) {
            has_failed_ = true;
            return {};
        }
        std::string text(take(end));
        take(1);
        return text;
    }

  private:
    std::string_view rest_;
    bool has_failed_ = false;
};

struct Part {
    ExrHeader header;
    int compression = 0;
    bool has_window = false, is_deep = false;
    std::optional<std::int32_t> chunks;
};

void take_attribute(const std::string& name, const std::string& type, std::string_view value, Part& part) {
    ByteTaker in(value);
    if (name == "dataWindow" && type == "box2i") {
        const auto x0 = in.value<std::int32_t>(), y0 = in.value<std::int32_t>();
        const auto x1 = in.value<std::int32_t>(), y1 = in.value<std::int32_t>();
        constexpr std::int32_t kMost = 1 << 24;
        part.has_window =
            !in.has_failed() && x0 >= -kMost && y0 >= -kMost && x0 <= x1 && y0 <= y1 && x1 < kMost && y1 < kMost;
        if (part.has_window) part.header.data = {x0, y0, x1 + 1, y1 + 1};
    } else if (name == "compression") {
        part.compression = in.value<std::uint8_t>();
    } else if (name == "chunkCount") {
        part.chunks = in.value<std::int32_t>();
    } else if (name == "type") {
        part.is_deep = value == "deepscanline";
    } else if (type == "string") {
        part.header.texts.emplace(name, value);
    }
}

/// False if there is no further part.
bool take_part(ByteTaker& in, Part& part) {
    for (bool is_first = true;; is_first = false) {
        const std::string name = in.name();
        if (in.has_failed()) return false;
        if (name.empty()) return !is_first;
        const std::string type = in.name();
        const auto size = in.value<std::int32_t>();
        const std::string_view value = in.take(size < 0 ? std::string_view::npos : static_cast<std::size_t>(size));
        if (in.has_failed()) return false;
        take_attribute(name, type, value, part);
    }
}

int rows_per_chunk(int compression) {
    constexpr int kRows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};  // none rle zips zip piz pxr24 b44 b44a dwaa dwab
    return compression >= 0 && compression < 10 ? kRows[compression] : 1;
}

bool is_whole_chunk(std::string_view bytes, std::uint64_t offset, bool has_number, bool is_deep) {
    if (offset == 0 || offset >= bytes.size()) return false;
    ByteTaker in(bytes.substr(offset));
    if (has_number) in.value<std::int32_t>();
    in.value<std::int32_t>();  // its first row
    std::uint64_t size = 0;
    if (is_deep) {
        const auto table = in.value<std::uint64_t>(), data = in.value<std::uint64_t>();
        in.value<std::uint64_t>();
        if (table > bytes.size() || data > bytes.size()) return false;
        size = table + data;
    } else {
        size = in.value<std::uint32_t>();
    }
    return !in.has_failed() && size <= in.left();
}

}  // namespace

std::optional<ExrHeader> header_of_whole_exr(std::string_view bytes) {
    ByteTaker in(bytes);
    constexpr std::uint32_t kMagic = 20000630, kTiled = 0x200, kDeep = 0x800, kSeveral = 0x1000;
    if (in.value<std::uint32_t>() != kMagic) return std::nullopt;
    const auto version = in.value<std::uint32_t>();
    if (in.has_failed() || (version & 0xFF) != 2 || (version & kTiled) != 0) return std::nullopt;
    const bool has_several = (version & kSeveral) != 0;
    std::vector<Part> parts;
    do {
        Part part;
        part.is_deep = !has_several && (version & kDeep) != 0;
        if (!take_part(in, part)) break;
        parts.push_back(std::move(part));
    } while (has_several);
    if (in.has_failed() || parts.empty()) return std::nullopt;
    for (const Part& part : parts) {
        if (!part.has_window) return std::nullopt;
        const int rows = rows_per_chunk(part.compression), height = part.header.data.height();
        const std::int64_t count = part.chunks ? *part.chunks : (height + rows - 1) / rows;
        if (count <= 0 || static_cast<std::uint64_t>(count) > in.left() / 8) return std::nullopt;
        for (std::int64_t i = 0; i < count; ++i) {
            if (!is_whole_chunk(bytes, in.value<std::uint64_t>(), has_several, part.is_deep)) return std::nullopt;
        }
    }
    return parts.front().header;
}

}  // namespace burin
