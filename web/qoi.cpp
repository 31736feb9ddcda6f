#include "web/qoi.h"

#include <array>
#include <cstddef>

namespace burin {
namespace {

enum Tag : std::uint8_t { kIndex = 0x00, kDiff = 0x40, kLuma = 0x80, kRun = 0xC0, kRgb = 0xFE };
constexpr std::uint32_t kLongestRun = 62;

int part_of(std::uint32_t code, int c) { return static_cast<int>(code >> 8 * c & 0xFF); }
/// How much a part differs, modulo 256, from -128 to 127.
int change_of(std::uint32_t from, std::uint32_t to, int c) {
    return static_cast<std::int8_t>(part_of(to, c) - part_of(from, c));
}
bool lies_within(int value, int least, int most) { return value >= least && value <= most; }

/// Where a pixel is kept among 64; its alpha is 255.
std::size_t place_of(std::uint32_t code) {
    return static_cast<std::size_t>(part_of(code, 0) * 3 + part_of(code, 1) * 5 + part_of(code, 2) * 7 + 255 * 11) % 64;
}

class QoiWriter {
  public:
    explicit QoiWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) { seen_.fill(kNothing); }

    void add(std::uint32_t code) {
        if (code == before_) {
            if (++run_ == kLongestRun) end_run();
            return;
        }
        end_run();
        std::uint32_t& seen = seen_[place_of(code)];
        if (seen == code) {
            put(kIndex | static_cast<int>(place_of(code)));
        } else {
            seen = code;
            add_change(code);
        }
        before_ = code;
    }
    void end_run() {
        if (run_ > 0) put(kRun | static_cast<int>(run_ - 1));
        run_ = 0;
    }

  private:
    static constexpr std::uint32_t kNothing = 0xFFFFFFFFu;  // no pixel

    void put(int byte) { bytes_.push_back(static_cast<std::uint8_t>(byte)); }

    void add_change(std::uint32_t code) {
        const int red = change_of(before_, code, 0), green = change_of(before_, code, 1),
                  blue = change_of(before_, code, 2);
        if (lies_within(red, -2, 1) && lies_within(green, -2, 1) && lies_within(blue, -2, 1)) {
            put(kDiff | (red + 2) << 4 | (green + 2) << 2 | (blue + 2));
        } else if (lies_within(green, -32, 31) && lies_within(red - green, -8, 7) && lies_within(blue - green, -8, 7)) {
            put(kLuma | (green + 32));
            put((red - green + 8) << 4 | (blue - green + 8));
        } else {
            put(kRgb);
            for (int c = 0; c < 3; ++c) put(part_of(code, c));
        }
    }

    std::vector<std::uint8_t>& bytes_;
    std::array<std::uint32_t, 64> seen_;
    std::uint32_t before_ = 0, run_ = 0;  // it begins with black
};

}  // namespace

std::vector<std::uint8_t> qoi_of(std::span<const std::uint32_t> codes, int width, int height) {
    std::vector<std::uint8_t> bytes = {'q', 'o', 'i', 'f'};
    bytes.reserve(codes.size() / 8 + 64);
    for (const int side : {width, height}) {
        for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(side >> shift));
    }
    bytes.push_back(3);  // channels
    bytes.push_back(0);  // sRGB
    QoiWriter writer(bytes);
    for (const std::uint32_t code : codes) writer.add(code);
    writer.end_run();
    for (int i = 0; i < 7; ++i) bytes.push_back(0);
    bytes.push_back(1);
    return bytes;
}

}  // namespace burin
