#include "output/whole_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "base/error.h"
#include "base/mapped_file.h"
#include "image/display_image.h"
#include "image/exr_container.h"
#include "output/lines_file.h"

namespace burin {
namespace {

constexpr std::size_t kDigits = 16;

bool is_regular_file(const std::string& path) {
    struct stat info {};
    return ::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode);
}

/// The fingerprint that stands behind `mark`; empty if there is none.
std::string fingerprint_behind(std::string_view text, std::string_view mark) {
    const std::size_t at = text.find(mark);
    if (at == std::string_view::npos) return {};
    const std::string_view digits = text.substr(at + mark.size(), kDigits);
    const bool is_one =
        digits.size() == kDigits && digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    return is_one ? std::string(digits) : std::string();
}

std::uint32_t number_at(std::string_view bytes, std::size_t place, std::size_t size, bool big_endian) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const auto byte = static_cast<std::uint8_t>(bytes[place + (big_endian ? i : size - 1 - i)]);
        number = number << 8 | byte;
    }
    return number;
}

PixelRect rect_of(std::uint32_t width, std::uint32_t height) {
    constexpr std::uint32_t kMost = 1 << 24;
    return {0, 0, static_cast<int>(std::min(width, kMost)), static_cast<int>(std::min(height, kMost))};
}

std::optional<WholeFile> png_of(std::string_view bytes) {
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    if (!bytes.starts_with(kSignature)) return std::nullopt;
    WholeFile file;
    const std::string mark = std::string(kFingerprintName) + '\0';
    for (std::size_t at = kSignature.size(); bytes.size() - at >= 12;) {
        const std::size_t size = number_at(bytes, at, 4, true);
        const std::string_view kind = bytes.substr(at + 4, 4);
        if (size > bytes.size() - at - 12) return std::nullopt;
        const std::string_view data = bytes.substr(at + 8, size);
        if (kind == "IHDR" && size >= 8) file.data = rect_of(number_at(data, 0, 4, true), number_at(data, 4, 4, true));
        if (kind == "tEXt" && data.starts_with(mark)) file.fingerprint = fingerprint_behind(data, mark);
        at += size + 12;
        if (kind == "IEND") return file.data && at == bytes.size() ? std::optional(file) : std::nullopt;
    }
    return std::nullopt;
}

/// The entries of the first directory of a TIFF.
class TiffDirectory {
  public:
    explicit TiffDirectory(std::string_view bytes) : bytes_(bytes) {
        if (bytes.size() < 8) return;
        big_endian_ = bytes.starts_with("MM");
        if (!big_endian_ && !bytes.starts_with("II")) return;
        const std::size_t at = number_at(bytes, 4, 4, big_endian_);
        if (number_at(bytes, 2, 2, big_endian_) != 42 || at > bytes.size() - 2) return;
        const std::size_t count = number_at(bytes, at, 2, big_endian_);
        if (count > (bytes.size() - at - 2) / 12) return;
        begin_ = at + 2;
        count_ = count;
    }
    /// The bytes of a value and how many numbers it has; nothing if it is not there.
    struct Value {
        std::string_view bytes;
        std::size_t count = 0, size = 0;
    };
    Value find(std::uint32_t tag) const {
        for (std::size_t i = 0; i < count_; ++i) {
            const std::size_t at = begin_ + 12 * i;
            if (number_at(bytes_, at, 2, big_endian_) != tag) continue;
            constexpr std::size_t kSizes[] = {0, 1, 1, 2, 4, 8};
            const std::uint32_t type = number_at(bytes_, at + 2, 2, big_endian_);
            const std::size_t count = number_at(bytes_, at + 4, 4, big_endian_);
            if (type > 5 || kSizes[type] == 0 || count > bytes_.size()) return {};
            const std::size_t length = count * kSizes[type];
            const std::size_t place = length <= 4 ? at + 8 : number_at(bytes_, at + 8, 4, big_endian_);
            if (place > bytes_.size() || length > bytes_.size() - place) return {};
            return {bytes_.substr(place, length), count, kSizes[type]};
        }
        return {};
    }
    std::uint32_t number(const Value& value, std::size_t i) const {
        return i < value.count && value.size <= 4 ? number_at(value.bytes, i * value.size, value.size, big_endian_) : 0;
    }

  private:
    std::string_view bytes_;
    bool big_endian_ = false;
    std::size_t begin_ = 0, count_ = 0;
};

std::optional<WholeFile> tiff_of(std::string_view bytes) {
    constexpr std::uint32_t kWidth = 256, kHeight = 257, kDescription = 270, kOffsets = 273, kByteCounts = 279;
    const TiffDirectory directory(bytes);
    const auto offsets = directory.find(kOffsets), counts = directory.find(kByteCounts);
    const std::uint32_t width = directory.number(directory.find(kWidth), 0),
                        height = directory.number(directory.find(kHeight), 0);
    if (width == 0 || height == 0 || offsets.count == 0 || offsets.count != counts.count) return std::nullopt;
    for (std::size_t i = 0; i < offsets.count; ++i) {
        const std::size_t begin = directory.number(offsets, i), size = directory.number(counts, i);
        if (begin == 0 || size == 0 || begin > bytes.size() || size > bytes.size() - begin) return std::nullopt;
    }
    const std::string mark = std::string(kFingerprintName) + " ";
    return WholeFile{fingerprint_behind(directory.find(kDescription).bytes, mark), rect_of(width, height)};
}

std::optional<WholeFile> text_of(std::string_view bytes, std::string_view begin, std::string_view end,
                                 std::string_view mark) {
    if (!bytes.starts_with(begin) || !bytes.ends_with(end)) return std::nullopt;
    return WholeFile{fingerprint_behind(bytes, mark), std::nullopt};
}

/// Where the last chunk of an EXR ends.
const char* end_of_chunks(const ExrContainer& file) {
    const char* end = nullptr;
    for (const ContainedPart& part : file.parts) {
        for (const std::string_view chunk : part.chunks) end = std::max(end, chunk.data() + chunk.size());
    }
    return end;
}

std::optional<WholeFile> whole_file_of(std::string_view bytes, OutputFormat format) {
    switch (format) {
        case OutputFormat::exr: {
            const ExrContainer file = parse_exr_container({}, bytes);
            if (end_of_chunks(file) != bytes.data() + bytes.size()) return std::nullopt;
            const std::string_view fingerprint = file.parts.front().text(kFingerprintName).value_or("");
            return WholeFile{std::string(fingerprint), file.parts.front().data, file.parts.front().is_deep};
        }
        case OutputFormat::png:
            return png_of(bytes);
        case OutputFormat::tiff:
            return tiff_of(bytes);
        case OutputFormat::svg:
            return text_of(bytes, "<?xml", "</svg>\n", "data-burin-fingerprint=\"");
        case OutputFormat::pdf:
            return text_of(bytes, "%PDF-", "%%EOF\n", std::string(kFingerprintName) + " ");
        case OutputFormat::dxf:
            return text_of(bytes, "999\n", "EOF\n", std::string(kFingerprintName) + " ");
    }
    return std::nullopt;
}

}  // namespace

std::optional<WholeFile> find_whole_file(const std::string& path, OutputFormat format) {
    if (!is_regular_file(path)) return std::nullopt;
    try {
        const MappedFile file(path);
        return whole_file_of(file.bytes(), format);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

std::optional<WholeFile> find_whole_lines_file(const std::string& path) {
    if (!is_regular_file(path)) return std::nullopt;
    try {
        read_lines_file(path);
        const MappedFile file(path);
        return WholeFile{fingerprint_behind(file.bytes(), "\"fingerprint\":\""), std::nullopt};
    } catch (const InputError&) {
        return std::nullopt;
    }
}

}  // namespace burin
