#include "web/picture_bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

#include "base/interrupt.h"
#include "image/half.h"
#include "image/image_io.h"
#include "web/gray_png.h"
#include "web/qoi.h"

namespace burin {
namespace {

/// A pixel as films keep it: the bits of R, G, B, A.
using PixelBits = std::uint64_t;

std::uint8_t eight_bits(float linear) {
    // In two steps, as where a file is written.
    const float code = linear >= 1 ? 1 : linear > 0 ? srgb_from_linear(linear) : 0;
    const auto sixteen = static_cast<std::uint32_t>(std::lround(std::clamp(code, 0.0f, 1.0f) * 65535.0f));
    return static_cast<std::uint8_t>((sixteen * 255 + 32767) / 65535);
}

std::uint32_t code_of(PixelBits bits, const glm::vec3& paper) {
    const auto part = [&](int i) { return float_from_half(static_cast<std::uint16_t>(bits >> 16 * i)); };
    const float alpha = part(3);
    std::uint32_t code = 0;
    for (int c = 0; c < 3; ++c) code |= std::uint32_t{eight_bits(part(c) + (1 - alpha) * paper[c])} << 8 * c;
    return code;
}

bool is_gray(std::uint32_t code) { return (code & 0xFFFF) == (code >> 8 & 0xFFFF); }

/// Codes of pixels that were seen not long ago: most ink comes again and again, and encoding takes long.
class SeenPixels {
  public:
    explicit SeenPixels(const glm::vec3& paper) : paper_(paper) {
        bits_.fill(0);
        codes_.fill(code_of(0, paper));
    }
    std::uint32_t code(PixelBits bits) {
        const std::size_t place = (bits * 0x9E3779B97F4A7C15u) >> (64 - kLogSize);
        if (bits_[place] != bits) {
            bits_[place] = bits;
            codes_[place] = code_of(bits, paper_);
        }
        return codes_[place];
    }

  private:
    static constexpr int kLogSize = 12;
    glm::vec3 paper_;
    std::array<PixelBits, std::size_t{1} << kLogSize> bits_;
    std::array<std::uint32_t, std::size_t{1} << kLogSize> codes_;
};

/// The parts of pixels, of all rows one after the other.
struct HalfPlanes {
    const std::uint16_t* of[4];

    explicit HalfPlanes(const Image& image) {
        const char* const names[4] = {"R", "G", "B", "A"};
        for (std::size_t c = 0; c < 4; ++c) of[c] = image.find(names[c])->as<std::uint16_t>().data();
    }
    PixelBits at(std::size_t i) const {
        return PixelBits{of[0][i]} | PixelBits{of[1][i]} << 16 | PixelBits{of[2][i]} << 32 | PixelBits{of[3][i]} << 48;
    }
    /// How many pixels from `i` on have these bits, in steps of four.
    std::size_t alike(std::size_t i, std::size_t end, PixelBits bits) const {
        std::array<std::uint64_t, 4> four;
        for (std::size_t c = 0; c < 4; ++c) four[c] = (bits >> 16 * c & 0xFFFF) * 0x0001000100010001u;
        std::size_t at = i;
        for (; at + 4 <= end; at += 4) {
            std::uint64_t differing = 0;
            for (std::size_t c = 0; c < 4; ++c) {
                std::uint64_t here;
                std::memcpy(&here, of[c] + at, sizeof here);
                differing |= here ^ four[c];
            }
            if (differing != 0) break;
        }
        return at - i;
    }
};

/// Calls put(pixel, count, code) for the runs of equal pixels of a row, from the left, until it returns false. Returns
/// whether it never did.
template <typename Put>
bool for_runs(const HalfPlanes& planes, std::size_t begin, std::size_t end, SeenPixels& seen, const Put& put) {
    for (std::size_t i = begin; i < end;) {
        const PixelBits bits = planes.at(i);
        const std::size_t count = 1 + planes.alike(i + 1, end, bits);
        if (!put(i, count, seen.code(bits))) return false;
        i += count;
    }
    return true;
}

}  // namespace

PictureBytes PictureEncoder::encode(const Image& image, const PictureSettings& picture) {
    const HalfPlanes planes(image);
    const auto width = static_cast<std::size_t>(image.width()), height = static_cast<std::size_t>(image.height());
    SeenPixels seen(picture.background.value_or(glm::vec3(1.0f)));
    rows_.resize((width + 1) * height);
    bool is_all_gray = true;
    for (std::size_t y = 0; y < height && is_all_gray; ++y) {
        throw_if_interrupted();
        std::uint8_t* const row = &rows_[y * (width + 1)];
        row[0] = 0;
        is_all_gray =
            for_runs(planes, y * width, (y + 1) * width, seen, [&](std::size_t i, std::size_t count, auto code) {
                std::memset(row + 1 + (i - y * width), static_cast<int>(code & 0xFF), count);
                return is_gray(code);
            });
    }
    if (is_all_gray) return {"png", gray_png_of(deflater_.compress(rows_), image.width(), image.height())};
    codes_.resize(width * height);
    for_runs(planes, 0, codes_.size(), seen, [&](std::size_t i, std::size_t count, auto code) {
        std::fill_n(&codes_[i], count, code);
        return true;
    });
    throw_if_interrupted();
    return {"qoi", qoi_of(codes_, image.width(), image.height())};
}

}  // namespace burin
