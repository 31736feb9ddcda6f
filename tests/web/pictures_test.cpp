// Pictures for a page have the values that a PNG has.

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "image/half.h"
#include "image/image_io.h"
#include "render/film.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"
#include "web/picture_bytes.h"
#include "web/qoi.h"

namespace burin::test::pictures_test {
namespace {

/// Unpacks a QOI, by the specification alone.
std::vector<std::uint32_t> unpacked(const std::vector<std::uint8_t>& file, std::size_t count) {
    std::vector<std::uint32_t> codes;
    std::array<std::uint32_t, 64> seen{};
    std::array<unsigned, 3> p{0, 0, 0};
    std::size_t at = 14;
    const auto code = [&] { return p[0] | p[1] << 8 | p[2] << 16; };
    while (codes.size() < count && at < file.size()) {
        const unsigned tag = file[at++];
        if (tag == 0xFE) {
            for (unsigned& part : p) part = file[at++];
        } else if (tag >> 6 == 0) {
            for (std::size_t c = 0; c < 3; ++c) p[c] = seen[tag] >> 8 * c & 0xFF;
        } else if (tag >> 6 == 1) {
            for (std::size_t c = 0; c < 3; ++c) p[c] = (p[c] + (tag >> (4 - 2 * c) & 3) - 2) & 0xFF;
        } else if (tag >> 6 == 2) {
            const unsigned change = (tag & 63) - 32, others = file[at++];
            p[0] = (p[0] + change + (others >> 4) - 8) & 0xFF;
            p[1] = (p[1] + change) & 0xFF;
            p[2] = (p[2] + change + (others & 15) - 8) & 0xFF;
        } else {
            codes.insert(codes.end(), (tag & 63) + 1, code());
            continue;
        }
        seen[(p[0] * 3 + p[1] * 5 + p[2] * 7 + 255 * 11) % 64] = code();
        codes.push_back(code());
    }
    return codes;
}

/// A film with runs, single pixels and noise. `is_gray`: of grey ink.
Film random_film(int width, int height, bool is_gray, std::uint32_t seed) {
    const PixelRect all{0, 0, width, height};
    Film film(all, all, LayerSet{true, false, false, false, false}, kDefaultLineClasses);
    Random random(seed);
    PixelResult pixel{};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (random.real(0, 1) < 0.2) {
                const float alpha = static_cast<float>(random.real(0, 1));
                for (int c = 0; c < 3; ++c)
                    pixel.beauty[c] =
                        is_gray && c > 0 ? pixel.beauty[0] : alpha * static_cast<float>(random.real(0, 1));
                pixel.beauty[3] = alpha;
            }
            film.put(x, y, pixel);
        }
    }
    return film;
}

std::vector<std::uint32_t> codes_of(const DisplayImage& image) {
    std::vector<std::uint32_t> codes;
    for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels)) {
        std::uint32_t code = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t part = image.channels >= 3 ? c : 0;
            code |= (image.pixels[i + part] * 255u + 32767) / 65535 << 8 * c;
        }
        codes.push_back(code);
    }
    return codes;
}

TEST(PicturesForPages, AreThoseOfFiles) {
    const TemporaryFolder folder;
    PictureEncoder encoder;
    for (std::uint32_t trial = 0; trial < 24; ++trial) {
        const bool is_gray = trial % 2 == 0;
        const int width = 1 + static_cast<int>(trial) * 7, height = 60 - static_cast<int>(trial);
        const Film film = random_film(width, height, is_gray, trial);
        PictureSettings picture;
        if (trial % 3 == 1) picture.background = glm::vec3(0.2f);
        if (trial % 3 == 2 && !is_gray) picture.background = glm::vec3(0.1f, 0.5f, 0.9f);
        const auto wanted = codes_of(to_display(film.image(), picture.background.value_or(glm::vec3(1))));
        const PictureBytes made = encoder.encode(film.image(), picture);
        if (is_gray) {
            ASSERT_EQ(made.format, "png") << trial;
            const std::string path =
                folder.write("a.png", {reinterpret_cast<const char*>(made.bytes.data()), made.bytes.size()});
            const DisplayImage read = read_display_image(path);
            EXPECT_EQ(read.width, width);
            EXPECT_EQ(codes_of(read), wanted) << trial;
        } else {
            ASSERT_EQ(made.format, "qoi") << trial;
            EXPECT_EQ(unpacked(made.bytes, wanted.size()), wanted) << trial;
        }
    }
}

TEST(PicturesForPages, QoiHoldsEveryChange) {
    Random random(1);
    std::vector<std::uint32_t> codes(3, 0);  // begins with a run of black
    for (int i = 0; i < 60000; ++i) {
        const std::uint32_t last = codes.back();
        const double what = random.real(0, 1);
        if (what < 0.3) {
            codes.push_back(last);
        } else if (what < 0.5) {
            codes.push_back(codes[codes.size() / 2]);
        } else {
            const int reach = what < 0.8 ? 3 : what < 0.9 ? 40 : 256;
            std::uint32_t code = 0;
            for (int c = 0; c < 3; ++c) {
                const int part =
                    static_cast<int>(last >> 8 * c & 0xFF) + static_cast<int>(random.real(0, 1) * reach) - reach / 2;
                code |= static_cast<std::uint32_t>(part & 0xFF) << 8 * c;
            }
            codes.push_back(code);
        }
    }
    codes.insert(codes.end(), 200, codes.back());  // longer than the longest run
    EXPECT_EQ(unpacked(qoi_of(codes, static_cast<int>(codes.size()), 1), codes.size()), codes);
}

}  // namespace
}  // namespace burin::test::pictures_test
