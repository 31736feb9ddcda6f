// Motion blur and depth of field against what they are in closed form, and what must not change them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/limit_error.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "methods/blurred_frame.h"
#include "methods/method_table.h"
#include "tests/support/drawing.h"

namespace burin::blur_test {
namespace {

using test::pixel_camera;
using test::same_bits;
using test::scene_of;
using test::soup_of;

constexpr int kWidth = 64, kHeight = 16;

/// Half of a plane: its left border is the one line in the picture, upright, through x = 0.
Scene upright_line(double width_px, double z = 0, double size = 1000) {
    Scene scene = scene_of({soup_of({{0, -size, z}, {size, -size, z}, {size, size, z}, {0, size, z}}, {{0, 1, 2, 3}})});
    scene.lines.style.width_px = width_px;
    return scene;
}

LayerSet some_layers(bool with_geometry = false) {
    LayerSet layers;
    layers.coverage = true;
    layers.depth = layers.normal = layers.ids = with_geometry;
    return layers;
}

Image blurred(const Blur& blur, int count, const MomentAt& moment_at, int width = kWidth, int height = kHeight,
              const RunOptions& options = {1}, const Method& method = methods().front(), bool with_geometry = false,
              std::optional<PixelRect> crop = {}) {
    const PixelRect display{0, 0, width, height};
    Film film(display, crop.value_or(display), some_layers(with_geometry), kDefaultLineClasses);
    render_blurred(method, blur, count, moment_at, width, height, options, film);
    return film.image();
}

Image sharp(const Scene& scene, const Camera& camera, int width, int height, const Method& method = methods().front()) {
    const PixelRect display{0, 0, width, height};
    Film film(display, display, some_layers(true), kDefaultLineClasses);
    method.render(make_frame(scene, camera, width, height, display), {1}, film);
    return film.image();
}

ShutterSettings shutter(double open, double close, double rise = 0, double fall = 0) {
    ShutterSettings settings;
    settings.open = open;
    settings.close = close;
    settings.rise = rise;
    settings.fall = fall;
    return settings;
}

std::vector<double> row_of(const Image& image, int y) {
    std::vector<double> row;
    for (int x = 0; x < image.width(); ++x) row.push_back(image.value(*image.find("lines.A"), x, y));
    return row;
}

/// What a pixel sees of an upright line of this width, whose middle is so far from its own.
double trapezoid(double x, double width) {
    const double low = std::abs(1 - width) / 2, high = (1 + width) / 2;
    return std::min(1.0, width) * std::clamp((high - std::abs(x)) / (high - low), 0.0, 1.0);
}

/// The mean of trapezoid(x - offset) over offsets from `low` to `high`, which have a weight.
template <typename Weight>
double smeared(double x, double width, double low, double high, const Weight& weight) {
    constexpr int kSteps = 2000;
    double sum = 0, all = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double offset = low + (high - low) * (i + 0.5) / kSteps, w = weight(offset);
        sum += w * trapezoid(x - offset, width);
        all += w;
    }
    return sum / all;
}

TEST(MotionBlur, OfALineIsABoxAsLongAsItsWay) {
    const Camera camera = pixel_camera(kWidth, kHeight);
    for (const double way_px : {10.0, 7.3, 2.5}) {
        for (const double width_px : {1.0, 3.0, 0.5}) {
            Scene scene = upright_line(width_px);
            Blur blur;
            blur.shutter = shutter(0, 1);
            const double start = 27.4;
            const MomentAt moment_at = [&](double time, MomentUse) {
                scene.objects[0].to_world[3].x = start + way_px * time;
                return Moment{&scene, camera, nullptr};
            };
            const int count = sub_frame_count(blur, moment_at, kWidth, kHeight);
            ASSERT_EQ(count, 16) << way_px;
            const auto row = row_of(blurred(blur, count, moment_at), kHeight / 2);
            const double step = way_px / count;
            double mass = 0;
            for (int x = 0; x < kWidth; ++x) {
                const double seen = row[static_cast<std::size_t>(x)];
                const double right = smeared(x + 0.5 - start, width_px, 0, way_px, [](double) { return 1.0; });
                ASSERT_NEAR(seen, right, step * step / (6 * way_px) + 1.0 / 500)
                    << way_px << " " << width_px << " " << x;
                mass += seen;
            }
            ASSERT_NEAR(mass, width_px, 1e-3 * std::max(width_px, 1.0)) << way_px;
        }
    }
}

TEST(MotionBlur, FollowsTheCurveOfTheShutter) {
    const Camera camera = pixel_camera(kWidth, kHeight);
    Scene scene = upright_line(1);
    Blur blur;
    blur.shutter = shutter(-0.5, 0.5, 0.5, 0.5);
    const double way_px = 12;
    const MomentAt moment_at = [&](double time, MomentUse) {
        scene.objects[0].to_world[3].x = 32 + way_px * time;
        return Moment{&scene, camera, nullptr};
    };
    const auto row = row_of(blurred(blur, 64, moment_at), kHeight / 2);
    for (int x = 0; x < kWidth; ++x) {
        const double right = smeared(x + 0.5 - 32, 1, -way_px / 2, way_px / 2,
                                     [&](double offset) { return 1 - std::abs(offset) / (way_px / 2); });
        ASSERT_NEAR(row[static_cast<std::size_t>(x)], right, 0.01) << x;
    }
}

/// At the origin, looking along -Z: a unit is `focal` pixels at distance 1.
Camera lens_camera(double radius, double focus, double fov_deg = 20) {
    Camera camera;
    camera.fov_deg = fov_deg;
    camera.lens_radius = radius;
    camera.focus = focus;
    return camera;
}

TEST(DepthOfField, OfALineIsTheProjectionOfADisc) {
    const double focus = 10, depth = 14;
    for (const double circle_px : {10.0, 4.0, 1.5}) {
        for (const double width_px : {1.0, 3.0}) {
            Camera camera = lens_camera(1, focus);
            const double focal_px = camera.projection(kWidth, kHeight, 0).focal_px;
            camera.lens_radius = circle_px / (2 * focal_px * (1 / focus - 1 / depth));
            const Scene scene = upright_line(width_px, -depth);
            Blur blur;
            blur.has_lens = true;
            const MomentAt moment_at = [&](double, MomentUse) { return Moment{&scene, camera, nullptr}; };
            const int count = sub_frame_count(blur, moment_at, kWidth, kHeight);
            ASSERT_EQ(count, static_cast<int>(std::ceil(16 + 5 * circle_px - 1e-9))) << circle_px;
            const auto row = row_of(blurred(blur, count, moment_at), kHeight / 2);
            double mass = 0, peak = 0;
            for (int x = 0; x < kWidth; ++x) {
                const double seen = row[static_cast<std::size_t>(x)], r = circle_px / 2;
                const double right = smeared(x + 0.5 - 32, width_px, -r, r,
                                             [&](double offset) { return std::sqrt(r * r - offset * offset); });
                ASSERT_NEAR(seen, right, 0.03) << circle_px << " " << width_px << " " << x;
                mass += seen;
                peak = std::max(peak, seen);
            }
            ASSERT_NEAR(mass, width_px, 1e-3 * width_px);
            if (circle_px == 10 && width_px == 1) {
                ASSERT_NEAR(peak, 4 / (std::numbers::pi * circle_px), 0.03);
            }
        }
    }
}

TEST(DepthOfField, LeavesThePlaneInFocusAsItIs) {
    const Camera camera = lens_camera(0.5, 8);
    const Scene scene = upright_line(1.5, -8);
    Blur blur;
    blur.has_lens = true;
    const MomentAt moment_at = [&](double, MomentUse) { return Moment{&scene, camera, nullptr}; };
    EXPECT_EQ(sub_frame_count(blur, moment_at, kWidth, kHeight), 1);
    const auto row = row_of(blurred(blur, 24, moment_at), 8),
               sharp_row = row_of(sharp(scene, camera, kWidth, kHeight), 8);
    EXPECT_EQ(row, sharp_row);
}

TEST(Blur, TheNumberOfSubFramesFollowsFromWhatIsSeen) {
    const Camera camera = pixel_camera(kWidth, kHeight);
    Scene scene = upright_line(1);
    Blur blur;
    double way_px = 0;
    const MomentAt moment_at = [&](double time, MomentUse use) {
        EXPECT_EQ(use, MomentUse::extent);
        scene.objects[0].to_world[3].x = 32 + way_px * time;
        return Moment{&scene, camera, nullptr};
    };
    EXPECT_EQ(sub_frame_count(blur, moment_at, kWidth, kHeight), 1);
    blur.shutter = shutter(0, 1);
    // Its corners are far outside of the picture; the border that crosses it counts.
    for (const auto& [way, count] : {std::pair{0.0, 1}, {0.06, 1}, {0.07, 16}, {15.5, 16}, {31.0, 31}}) {
        way_px = way;
        EXPECT_EQ(sub_frame_count(blur, moment_at, kWidth, kHeight), count) << way;
    }
    way_px = 1e4;
    EXPECT_EQ(sub_frame_count(blur, moment_at, 65535, kHeight), 256);
    blur.samples = 5;
    EXPECT_EQ(sub_frame_count(blur, moment_at, kWidth, kHeight), 5);
}

TEST(Blur, AWayThereAndBackIsMeasured) {
    const Camera camera = pixel_camera(kWidth, kHeight);
    Scene scene = upright_line(1, 0, 3);
    Blur blur;
    blur.shutter = shutter(0, 1);
    const MomentAt moment_at = [&](double time, MomentUse) {
        scene.objects[0].to_world[3] = glm::dvec4(20 + 60 * std::min(time, 1 - time), 8, 0, 1);
        return Moment{&scene, camera, nullptr};
    };
    EXPECT_EQ(sub_frame_count(blur, moment_at, kWidth, kHeight), 60);
}

/// A teapot before a ball that goes through a box, with all kinds of lines.
Scene still_life(HiddenStyle hidden) {
    Scene scene = scene_of({make_teapot(3), make_sphere(1, 16, 8), make_box({1, 1, 1})});
    scene.objects[0].to_world = glm::dmat4(0.4);
    scene.objects[0].to_world[3] = glm::dvec4(0, 0, 0, 1);
    scene.objects[1].to_world[3] = glm::dvec4(1, 0.3, -2, 1);
    scene.objects[2].to_world[3] = glm::dvec4(1.6, 0.3, -1.5, 1);
    scene.lines.style.hidden.style = hidden;
    return scene;
}

TEST(Blur, EqualSubFramesHaveTheBytesOfOne) {
    const Camera camera = test::perspective_camera({0.3, 2.1, 7}, {0, 0.5, 0});
    for (const HiddenStyle hidden : {HiddenStyle::none, HiddenStyle::dashed}) {
        const Scene scene = still_life(hidden);
        const MomentAt moment_at = [&](double, MomentUse) { return Moment{&scene, camera, nullptr}; };
        Blur blur;
        blur.shutter = ShutterSettings();
        for (const Method& method : methods()) {
            if (method.name != "abuffer" && hidden != HiddenStyle::none) continue;
            const Image one = sharp(scene, camera, 120, 90, method);
            EXPECT_TRUE(same_bits(one, blurred(blur, 7, moment_at, 120, 90, {1}, method, true))) << method.name;
        }
    }
}

TEST(Blur, ThreadsPiecesAndCropsChangeNoByte) {
    constexpr int kW = 150, kH = 110;
    for (const HiddenStyle hidden : {HiddenStyle::none, HiddenStyle::solid}) {
        Scene scene = still_life(hidden);
        Camera camera = test::perspective_camera({0.3, 2.1, 7}, {0, 0.5, 0});
        camera.lens_radius = 0.1;
        camera.focus = 6;
        const MomentAt moment_at = [&](double time, MomentUse) {
            scene.objects[0].to_world[3].x = time;
            return Moment{&scene, camera, nullptr};
        };
        Blur blur;
        blur.shutter = ShutterSettings();
        blur.has_lens = true;
        const Image first = blurred(blur, 9, moment_at, kW, kH, {1}, methods().front(), true);
        EXPECT_FALSE(same_bits(first, sharp(scene, camera, kW, kH)));
        for (const int threads : {2, 7}) {
            EXPECT_TRUE(same_bits(first, blurred(blur, 9, moment_at, kW, kH, {threads}, methods().front(), true)));
        }
        const PixelRect crop{37, 21, 113, 98};
        const Image part = blurred(blur, 9, moment_at, kW, kH, {2}, methods().front(), true, crop);
        for (const Channel& channel : part.channels()) {
            for (int y = 0; y < part.height(); ++y) {
                for (int x = 0; x < part.width(); ++x) {
                    ASSERT_EQ(part.value(channel, x, y),
                              first.value(*first.find(channel.name), x + crop.x0, y + crop.y0))
                        << channel.name << " " << x << " " << y;
                }
            }
        }
    }
}

TEST(Blur, ACapForMemoryChangesNoByte) {
    constexpr int kW = 800, kH = 600;
    for (const HiddenStyle hidden : {HiddenStyle::none, HiddenStyle::solid}) {
        Scene scene = still_life(hidden);
        const Camera camera = test::perspective_camera({0.3, 2.1, 7}, {0, 0.5, 0});
        const MomentAt moment_at = [&](double time, MomentUse) {
            scene.objects[0].to_world[3].x = time;
            return Moment{&scene, camera, nullptr};
        };
        Blur blur;
        blur.shutter = ShutterSettings();
        RunOptions pieces{2};
        pieces.memory_bytes = 36000000;
        Film film({0, 0, kW, kH}, {0, 0, kW, kH}, some_layers(true), kDefaultLineClasses);
        EXPECT_GT(sub_frames_drawn(3, pieces, film), 4u) << "the picture must be made in bands";
        EXPECT_TRUE(same_bits(blurred(blur, 3, moment_at, kW, kH, {2}, methods().front(), true),
                              blurred(blur, 3, moment_at, kW, kH, pieces, methods().front(), true)));
        pieces.memory_bytes = 1000000;
        EXPECT_THROW(blurred(blur, 3, moment_at, kW, kH, pieces), LimitError);
    }
}

TEST(Blur, DepthsAndIdsAreThoseOfTheMiddle) {
    Scene scene = still_life(HiddenStyle::none);
    const Camera camera = test::perspective_camera({0.3, 2.1, 7}, {0, 0.5, 0});
    const MomentAt moment_at = [&](double time, MomentUse) {
        scene.objects[0].to_world[3].x = 2 * time;
        return Moment{&scene, camera, nullptr};
    };
    Blur blur;
    blur.shutter = shutter(0, 0.5);
    const Image image = blurred(blur, 8, moment_at, 120, 90, {1}, methods().front(), true);
    moment_at(0.25, MomentUse::drawing);
    const Image middle = sharp(scene, camera, 120, 90);
    for (const char* name : {"Z", "N.X", "id.object", "id.polygon"}) {
        EXPECT_EQ(image.find(name)->bytes, middle.find(name)->bytes) << name;
    }
    EXPECT_NE(image.find("lines.A")->bytes, middle.find("lines.A")->bytes);
}

TEST(Shift, APictureIsAPartOfALargerOneWhoseMiddleIsTheAxis) {
    constexpr int kLarge = 192, kSmall = 96;
    const Scene scene = still_life(HiddenStyle::none);
    Camera camera = test::perspective_camera({0.3, 2.1, 5}, {0, 0.5, 0}, 40);
    for (const Method& method : methods()) {
        const Image large = sharp(scene, camera, kLarge, kLarge, method);
        Camera shifted = camera;
        shifted.fov_deg = glm::degrees(2 * std::atan(0.5 * std::tan(glm::radians(20.0))));
        shifted.shift = {0.25, -0.125};
        const Image small = sharp(scene, shifted, kSmall, kSmall, method);
        // The middle is 24 pixels to the right of the axis, and 12 below it.
        const int x0 = (kLarge - kSmall) / 2 + 24, y0 = (kLarge - kSmall) / 2 + 12;
        int different = 0;
        for (int y = 0; y < kSmall; ++y) {
            for (int x = 0; x < kSmall; ++x) {
                for (const char* name : {"R", "A", "lines.A", "id.object"}) {
                    different += std::abs(small.value(*small.find(name), x, y) -
                                          large.value(*large.find(name), x0 + x, y0 + y)) > 0.02;
                }
            }
        }
        // Operators on images and dashes begin at the picture's edge.
        EXPECT_LE(different, method.name == "abuffer" ? 0 : 40) << method.name;
    }
}

}  // namespace
}  // namespace burin::blur_test
