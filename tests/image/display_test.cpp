#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "image/half.h"
#include "image/image_io.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using Color = std::array<float, 4>;

Image one_color(PixelRect display, PixelRect data, const Color& premultiplied) {
    Image image(display, data);
    const char* const names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c) {
        for (float& v : image.add(names[c], PixelType::float32).as<float>()) v = premultiplied[c];
    }
    return image;
}

int value_at(const DisplayImage& image, int x, int y, int channel) {
    return image.pixels[static_cast<std::size_t>((y * image.width + x) * image.channels + channel)];
}

/// The transfer function as IEC 61966-2-1 writes it, in double precision.
double code_of(double linear) {
    return 65535 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

TEST(Srgb, TheFunctionsAreInverses) {
    for (int code = 0; code <= 65535; ++code) {
        const float unit = static_cast<float>(code) / 65535.0f;
        EXPECT_NEAR(static_cast<double>(srgb_from_linear(linear_from_srgb(unit))), code / 65535.0, 1e-6);
    }
    for (int i = 0; i <= 10000; ++i) {
        const float linear = static_cast<float>(i) / 10000.0f;
        EXPECT_NEAR(static_cast<double>(linear_from_srgb(srgb_from_linear(linear))), i / 10000.0, 1e-6);
    }
}

TEST(Srgb, KnownValues) {
    EXPECT_EQ(srgb_from_linear(0.0f), 0.0f);
    EXPECT_NEAR(static_cast<double>(srgb_from_linear(1.0f)), 1.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(srgb_from_linear(0.5f)), 0.735357, 1e-5);
    EXPECT_NEAR(static_cast<double>(linear_from_srgb(0.5f)), 0.214041, 1e-5);
    EXPECT_NEAR(static_cast<double>(srgb_from_linear(0.002f)), 0.02584, 1e-6);
}

TEST(ToDisplay, LaysThePictureOverPaper) {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const double alpha = trial % 3 == 0 ? trial % 2 : random.real(0, 1);
        glm::dvec3 color, paper;
        for (int c = 0; c < 3; ++c) {
            color[c] = alpha * random.real(0, 1);
            paper[c] = random.real(0, 1);
        }
        const Image image = one_color({0, 0, 2, 1}, {0, 0, 2, 1},
                                      {static_cast<float>(color.x), static_cast<float>(color.y),
                                       static_cast<float>(color.z), static_cast<float>(alpha)});
        const DisplayImage display = to_display(image, glm::vec3(paper));
        ASSERT_EQ(display.channels, 3);
        for (int c = 0; c < 3; ++c) {
            const double expected = code_of(color[c] + (1 - alpha) * paper[c]);
            ASSERT_NEAR(value_at(display, 1, 0, c), expected, 1.0) << trial;
        }
    }
}

TEST(ToDisplay, WithoutPaperTheAlphaIsNotMultipliedIn) {
    const DisplayImage half = to_display(one_color({0, 0, 1, 1}, {0, 0, 1, 1}, {0.25f, 0.1f, 0.0f, 0.5f}), {});
    ASSERT_EQ(half.channels, 4);
    EXPECT_NEAR(value_at(half, 0, 0, 0), code_of(0.5), 1.0);
    EXPECT_NEAR(value_at(half, 0, 0, 1), code_of(0.2), 1.0);
    EXPECT_EQ(value_at(half, 0, 0, 2), 0);
    EXPECT_EQ(value_at(half, 0, 0, 3), 32768);  // linear: alpha is no light

    const DisplayImage nothing = to_display(one_color({0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 0}), {});
    for (int c = 0; c < 4; ++c) EXPECT_EQ(value_at(nothing, 0, 0, c), 0);
}

TEST(ToDisplay, ExtremesAreExact) {
    // Beyond 0..1 and NaN clamp; white on white paper stays white whatever the alpha.
    const DisplayImage odd = to_display(one_color({0, 0, 1, 1}, {0, 0, 1, 1}, {2.0f, -1.0f, NAN, 1.0f}), glm::vec3(0));
    EXPECT_EQ(value_at(odd, 0, 0, 0), 65535);
    EXPECT_EQ(value_at(odd, 0, 0, 1), 0);
    EXPECT_EQ(value_at(odd, 0, 0, 2), 0);
    const DisplayImage black = to_display(one_color({0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 1}), glm::vec3(1));
    EXPECT_EQ(value_at(black, 0, 0, 0), 0);
    const DisplayImage paper = to_display(one_color({0, 0, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 0}), glm::vec3(1));
    EXPECT_EQ(value_at(paper, 0, 0, 0), 65535);
}

TEST(ToDisplay, ReadsHalfChannels) {
    Image image({0, 0, 1, 1}, {0, 0, 1, 1});
    for (const char* name : {"R", "G", "B", "A"}) {
        image.add(name, PixelType::float16).as<std::uint16_t>()[0] = half_from_float(0.5f);
    }
    EXPECT_NEAR(value_at(to_display(image, glm::vec3(0)), 0, 0, 2), code_of(0.5), 1.0);
}

TEST(ToDisplay, ACropLiesInTheDisplayWindow) {
    // A display window that starts elsewhere, too.
    for (const int origin : {0, -3, 40}) {
        const PixelRect display{origin, origin, origin + 10, origin + 8};
        const PixelRect data{origin + 2, origin + 3, origin + 6, origin + 5};
        const Image image = one_color(display, data, {0, 0, 0, 1});
        const DisplayImage over = to_display(image, glm::vec3(1.0f));
        const DisplayImage clear = to_display(image, {});
        ASSERT_EQ(over.width, 10);
        ASSERT_EQ(over.height, 8);
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 10; ++x) {
                const bool inside = x >= 2 && x < 6 && y >= 3 && y < 5;
                EXPECT_EQ(value_at(over, x, y, 0), inside ? 0 : 65535) << x << ',' << y;
                EXPECT_EQ(value_at(clear, x, y, 3), inside ? 65535 : 0) << x << ',' << y;
            }
        }
    }
}

TEST(ToDisplay, RowsAndColumnsKeepTheirPlace) {
    Image image({0, 0, 3, 2}, {0, 0, 3, 2});
    const char* const names[] = {"R", "G", "B", "A"};
    for (int c = 0; c < 4; ++c) {
        auto values = image.add(names[c], PixelType::float32).as<float>();
        for (std::size_t i = 0; i < 6; ++i) values[i] = c == 3 ? 1.0f : linear_from_srgb(static_cast<float>(i) / 10);
    }
    const DisplayImage display = to_display(image, glm::vec3(0));
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(value_at(display, i % 3, i / 3, 1), 6553.5 * i, 1.0);
}

}  // namespace
}  // namespace burin
