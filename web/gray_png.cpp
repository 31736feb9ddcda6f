#include "web/gray_png.h"

#include <array>
#include <initializer_list>

namespace burin {
namespace {

/// Remainders of bytes divided by the polynomial of CRC-32 (PNG, annex D).
constexpr std::array<std::uint32_t, 256> crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
        std::uint32_t c = n;
        for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xEDB88320u ^ c >> 1 : c >> 1;
        table[n] = c;
    }
    return table;
}

std::uint32_t crc_of(std::span<const std::uint8_t> bytes) {
    static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
    std::uint32_t c = 0xFFFFFFFFu;
    for (const std::uint8_t byte : bytes) c = kTable[(c ^ byte) & 0xFF] ^ c >> 8;
    return ~c;
}

void add_number(std::vector<std::uint8_t>& file, std::uint32_t number) {
    for (const int shift : {24, 16, 8, 0}) file.push_back(static_cast<std::uint8_t>(number >> shift));
}

void add_chunk(std::vector<std::uint8_t>& file, const char (&name)[5], std::span<const std::uint8_t> data) {
    add_number(file, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = file.size();
    for (int i = 0; i < 4; ++i) file.push_back(static_cast<std::uint8_t>(name[i]));
    file.insert(file.end(), data.begin(), data.end());
    add_number(file, crc_of({file.data() + begin, file.size() - begin}));
}

}  // namespace

std::vector<std::uint8_t> gray_png_of(std::span<const std::uint8_t> stream, int width, int height) {
    std::vector<std::uint8_t> file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    file.reserve(stream.size() + 100);
    std::vector<std::uint8_t> header;
    add_number(header, static_cast<std::uint32_t>(width));
    add_number(header, static_cast<std::uint32_t>(height));
    const std::uint8_t rest[] = {8, 0, 0, 0, 0};  // bits, grey, deflate, filters by row, no interlace
    header.insert(header.end(), std::begin(rest), std::end(rest));
    add_chunk(file, "IHDR", header);
    add_chunk(file, "IDAT", stream);
    add_chunk(file, "IEND", {});
    return file;
}

}  // namespace burin
