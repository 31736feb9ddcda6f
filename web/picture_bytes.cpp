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
    for (int c = 0; c < 3; ++c)
        code |= std::uint32_t{eight_bits(part(c) + (1 - alpha) * paper[c])} << 8 * c;
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

struct HalfPlanes {
    const std::uint16_t* of[4];

    PixelBits at(std::size_t i) const {
        return PixelBits{of[0][i]} | PixelBits{of[1][i]} << 16 | PixelBits{of[2][i]} << 32 | PixelBits{of[3][i]} << 48;
    }
    /// Whether pixels [i, i + 4) all have these bits.
    bool has_four(std::size_t i, const std::array<std::uint64_t, 4>& repeated) const {
        std::uint64_t differing = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            std::uint64_t four;
            std::memcpy(&four, of[c] + i, sizeof four);
            differing |= four ^ repeated[c];
        }
        return differing == 0;
    }
};

/// Each part of a pixel four times.
std::array<std::uint64_t, 4> repeated(PixelBits bits) {
    std::array<std::uint64_t, 4> result;
    for (std::size_t c = 0; c < 4; ++c) result[c] = (bits >> 16 * c & 0xFFFF) * 0x0001000100010001u;
    return result;
}

}  // namespace

/// Returns whether all of them are grey.
bool PictureEncoder::find_codes(const Image& image, const PictureSettings& picture) {
    HalfPlanes planes{};
    const char* const names[4] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c) planes.of[c] = image.find(names[c])->as<std::uint16_t>().data();
    const auto count = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    codes_.resize(count);
    SeenPixels seen(picture.background.value_or(glm::vec3(1.0f)));
    std::uint32_t all_gray = 1;
    std::size_t i = 0;
    while (i < count) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const PixelBits bits = planes.at(i);
        const std::uint32_t code = seen.code(bits);
        all_gray &= is_gray(code) ? 1u : 0u;
        codes_[i++] = code;
        const std::array<std::uint64_t, 4> four = repeated(bits);
        for (; i + 4 <= count && planes.has_four(i, four); i += 4) std::fill_n(&codes_[i], 4, code);
    }
    return all_gray != 0;
}

/// Rows of a PNG of one channel: each behind the number of its filter, which is none.
void PictureEncoder::find_gray_rows(std::size_t width) {
    const std::size_t height = codes_.size() / width;
    rows_.resize(height * (width + 1));
    std::uint8_t* out = rows_.data();
    const std::uint32_t* code = codes_.data();
    for (std::size_t y = 0; y < height; ++y) {
        *out++ = 0;
        for (std::size_t x = 0; x < width; ++x) *out++ = static_cast<std::uint8_t>(*code++);
    }
}

PictureBytes PictureEncoder::encode(const Image& image, const PictureSettings& picture) {
    const bool is_all_gray = find_codes(image, picture);
    if (!is_all_gray) return {"qoi", qoi_of(codes_, image.width(), image.height())};
    find_gray_rows(static_cast<std::size_t>(image.width()));
    return {"png", gray_png_of(deflater_.compress(rows_), image.width(), image.height())};
}

}  // namespace burin
