// Which sub-frames a blurred picture has: times, points of the lens, numbers.

#include "render/sub_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "image/half.h"
#include "render/blur_sums.h"
#include "tests/support/random.h"

namespace burin::sub_frames_test {
namespace {

/// How open the shutter is at a part of its time.
double openness(const ShutterSettings& s, double x) {
    if (x < s.rise) return x / s.rise;
    return x > 1 - s.fall ? (1 - x) / s.fall : 1;
}

TEST(SubFrames, EachHasAsMuchLight) {
    for (const auto& [rise, fall] : {std::pair{0.0, 0.0}, {0.5, 0.5}, {0.3, 0.1}, {0.0, 1.0}, {1.0, 0.0}, {0.2, 0.0}}) {
        ShutterSettings shutter;
        shutter.open = -0.75;
        shutter.close = 1.25;
        shutter.rise = rise;
        shutter.fall = fall;
        EXPECT_NEAR(shutter_time(shutter, 0), -0.75, 1e-12);
        EXPECT_NEAR(shutter_time(shutter, 1), 1.25, 1e-7);
        constexpr int kParts = 16, kSteps = 20000;
        double before = -0.75;
        for (int i = 1; i <= kParts; ++i) {
            const double after = shutter_time(shutter, static_cast<double>(i) / kParts);
            ASSERT_GT(after, before);
            double light = 0;
            for (int k = 0; k < kSteps; ++k) {
                const double time = before + (after - before) * (k + 0.5) / kSteps;
                light += openness(shutter, (time + 0.75) / 2) * (after - before) / 2 / kSteps;
            }
            ASSERT_NEAR(light, (1 - (rise + fall) / 2) / kParts, 1e-7) << rise << " " << fall << " " << i;
            before = after;
        }
    }
}

TEST(SubFrames, TimesOfABoxAreTheMiddlesOfEqualParts) {
    const ShutterSettings shutter;
    const auto all = sub_frames(&shutter, false, 4);
    const double times[] = {-0.1875, -0.0625, 0.0625, 0.1875};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(all[i].time, times[i]);
        EXPECT_EQ(all[i].lens, glm::dvec2(0.0));
    }
    EXPECT_EQ(middle_sub_frame(&shutter).time, 0);
    EXPECT_EQ(sub_frames(nullptr, true, 3)[2].time, 0);
}

TEST(SubFrames, LensPointsAreASunflower) {
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (const int count : {1, 2, 16, 66, 4096}) {
        const auto points = lens_points(count);
        ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
        for (int j = 0; j < count; ++j) {
            const double r = std::sqrt((j + 0.5) / count), angle = j * golden;
            ASSERT_NEAR(points[static_cast<std::size_t>(j)].x, r * std::cos(angle), 1e-11) << j;
            ASSERT_NEAR(points[static_cast<std::size_t>(j)].y, r * std::sin(angle), 1e-11) << j;
        }
    }
}

TEST(SubFrames, EachLensPointHasOneTime) {
    for (int count = 1; count <= 4096; ++count) {
        const int step = lens_step(count);
        ASSERT_EQ(std::gcd(step, count), 1) << count;
        ASSERT_GE(step, count / 1.618034);
        for (int less = static_cast<int>(std::ceil(count / 1.618034)); less < step; ++less)
            ASSERT_NE(std::gcd(less, count), 1) << count;
    }
    const ShutterSettings shutter;
    const auto points = lens_points(66);
    const auto all = sub_frames(&shutter, true, 66);
    const int step = lens_step(66);
    std::set<std::pair<double, double>> seen;
    for (int i = 0; i < 66; ++i) {
        const auto& sub = all[static_cast<std::size_t>(i)];
        ASSERT_EQ(sub.lens, points[static_cast<std::size_t>(i * step % 66)]);
        seen.insert({sub.lens.x, sub.lens.y});
    }
    EXPECT_EQ(seen.size(), 66u);
}

TEST(SubFrames, AsManyAsHideTheirNumber) {
    EXPECT_EQ(automatic_sub_frames(0, 0), 1);
    EXPECT_EQ(automatic_sub_frames(0.0624, 0.0624), 1);
    EXPECT_EQ(automatic_sub_frames(0.0625, 0), 16);
    EXPECT_EQ(automatic_sub_frames(0, 0.0625), 17);
    EXPECT_EQ(automatic_sub_frames(100.2, 10), 101);
    EXPECT_EQ(automatic_sub_frames(20, 10), 66);
    EXPECT_EQ(automatic_sub_frames(1e300, 0), 256);
    EXPECT_EQ(automatic_sub_frames(0, 1e300), 256);
}

/// A picture of random half numbers, many of them 0, and one channel without a mean.
Image random_picture(test::Random& random, PixelRect rect) {
    Image image(rect, rect);
    for (const char* name : {"R", "lines.A"}) {
        for (std::uint16_t& value : image.add(name, PixelType::float16).as<std::uint16_t>())
            value =
                random.integer(0, 3) == 0 ? half_from_float(static_cast<float>(random.real(0, 2))) : std::uint16_t{0};
    }
    for (float& value : image.add("Z", PixelType::float32).as<float>()) value = 7;
    return image;
}

TEST(BlurSums, AreTheMeanInSinglePrecision) {
    const PixelRect rect{3, 5, 50, 42};
    test::Random random(1);
    std::vector<Image> pictures;
    for (int i = 0; i < 11; ++i) pictures.push_back(random_picture(random, rect));
    BlurSums sums(rect, pictures[0].formats());
    for (const Image& picture : pictures) sums.add(picture, 3);
    Image mean = random_picture(random, rect);
    sums.put_mean(11, mean, 2);
    for (const char* name : {"R", "lines.A"}) {
        for (std::size_t i = 0; i < mean.pixel_count(); ++i) {
            float sum = 0;
            for (const Image& picture : pictures) sum += float_from_half(picture.find(name)->as<std::uint16_t>()[i]);
            ASSERT_EQ(mean.find(name)->as<std::uint16_t>()[i], half_from_float(sum / 11)) << i;
        }
    }
    EXPECT_EQ(mean.find("Z")->as<float>()[9], 7);
}

TEST(BlurSums, ColoursAndCoveragesHaveAMean) {
    for (const char* name : {"R", "A", "lines.A", "lines_hidden.R", "coverage.crease", "surface.G", "lines_thick.B"})
        EXPECT_TRUE(has_mean({name, PixelType::float16})) << name;
    EXPECT_FALSE(has_mean({"Z", PixelType::float32}));
    EXPECT_FALSE(has_mean({"N.X", PixelType::float32}));
    EXPECT_FALSE(has_mean({"id.object", PixelType::uint32}));
    EXPECT_FALSE(has_mean({"line.width", PixelType::float16}));
}

TEST(BlurSums, TheMeanOfEqualPicturesIsThePicture) {
    const PixelRect rect{0, 0, 256, 128};
    Image all(rect, rect);
    const auto values = all.add("R", PixelType::float16).as<std::uint16_t>();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(i < 0x7C00 ? i : 0);
    for (const int count : {2, 3, 7, 64, 255, 256, 4096}) {
        BlurSums sums(rect, all.formats());
        for (int i = 0; i < count; ++i) sums.add(all, 1);
        Image mean(rect, rect);
        mean.add("R", PixelType::float16);
        sums.put_mean(count, mean, 1);
        ASSERT_EQ(mean.find("R")->bytes, all.find("R")->bytes) << count;
    }
}

}  // namespace
}  // namespace burin::sub_frames_test
