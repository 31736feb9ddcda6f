// The quality of strokes made of masks: levels, widths, ends, as the method's paper implies.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support/drawing.h"

namespace burin::patel_strokes_test {
namespace {

using namespace test;

/// A large half-plane in front of nothing, its border through the picture at an angle.
PolygonSoup half_plane(double angle_deg, double offset) {
    const double a = glm::radians(angle_deg);
    const glm::dvec3 along(std::cos(a), std::sin(a), 0), inwards(-along.y, along.x, 0);
    const glm::dvec3 p = glm::dvec3(64, 64, 0) + offset * inwards;
    return soup_of({p - 400.0 * along, p + 400.0 * along, p + 400.0 * along + 400.0 * inwards,
                    p - 400.0 * along + 400.0 * inwards},
                   {{0, 1, 2, 3}});
}

Drawing draw(double angle_deg, double offset, int bits, double width = 1, HaloShape shape = HaloShape::four,
             StrokeSide side = StrokeSide::both) {
    Scene scene = scene_of({half_plane(angle_deg, offset)});
    scene.patel.mask_bits = bits;
    scene.patel.halo = shape;
    scene.lines.style.width_px = width;
    scene.lines.style.side = side;
    return Drawing(scene, pixel_camera(128, 128), 128, 128);
}

/// Width of the stroke across, averaged along the part of the border inside the picture.
double mean_width(const Drawing& d, double angle_deg) {
    const double a = glm::radians(angle_deg);
    double mass = 0;
    // A band of columns or rows, whichever the border crosses.
    const bool by_columns = std::abs(std::cos(a)) >= std::abs(std::sin(a));
    for (int i = 24; i < 104; ++i) {
        for (int j = 0; j < 128; ++j) mass += by_columns ? d.line(i, j) : d.line(j, i);
    }
    return mass / 80 * std::max(std::abs(std::cos(a)), std::abs(std::sin(a)));
}

TEST(PatelStroke, WidthFollowsTheLawOfItsHalo) {
    for (const double angle : {0.0, 10.0, 22.5, 30.0, 45.0, 60.0, 90.0, 135.0}) {
        const double c = std::abs(std::cos(glm::radians(angle))), s = std::abs(std::sin(glm::radians(angle)));
        for (const int bits : {16, 64, 256}) {
            double four = 0, eight = 0;
            constexpr int kOffsets = 4;
            for (int i = 0; i < kOffsets; ++i) {
                four += mean_width(draw(angle, 0.031 + i * 0.25, bits), angle) / kOffsets;
                eight += mean_width(draw(angle, 0.031 + i * 0.25, bits, 1, HaloShape::eight), angle) / kOffsets;
            }
            EXPECT_NEAR(four, std::max(c, s), 0.02) << angle << " degrees, " << bits << " bits";
            EXPECT_NEAR(eight, c + s, 0.03) << angle << " degrees, " << bits << " bits";
        }
    }
}

TEST(PatelStroke, LevelsAreThoseOfThePixelsOwnSamples) {
    const std::pair<int, std::size_t> levels[] = {{16, 5}, {64, 17}, {256, 65}};
    for (const auto& [bits, most] : levels) {
        std::set<double> values;
        for (double angle = 3; angle < 90; angle += 7.3) {
            const Drawing d = draw(angle, 0.2, bits);
            for (const double c : d.coverage()) values.insert(c);
        }
        EXPECT_LE(values.size(), most) << bits;
        EXPECT_GE(values.size(), std::min<std::size_t>(most, 17)) << bits;
        for (const double v : values) {
            const double steps = v * static_cast<double>(most - 1);
            EXPECT_NEAR(steps, std::round(steps), 1e-2) << bits;
        }
    }
}

TEST(PatelStroke, OtherWidthsAreOtherAprons) {
    for (const double width : {1.0 / 3, 1.0, 3.0}) EXPECT_NEAR(mean_width(draw(0, 0.031, 64, width), 0), width, 1e-3);
    for (const double width : {1.0 / 7, 1.0 / 3, 0.6, 1.0, 10.0 / 6, 3.0, 7.0}) {
        EXPECT_NEAR(mean_width(draw(90, 0.031, 256, width), 90), width, 1e-3);
    }
}

TEST(PatelStroke, OneSideIsHalfOfIt) {
    const Drawing both = draw(20, 0.1, 64), in = draw(20, 0.1, 64, 1, HaloShape::four, StrokeSide::inside),
                  out = draw(20, 0.1, 64, 1, HaloShape::four, StrokeSide::outside);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
            EXPECT_NEAR(both.line(x, y), in.line(x, y) + out.line(x, y), 1e-3);
            // Outside strokes lie on the background, inside ones on the surface.
            EXPECT_LE(in.line(x, y), both.at("surface.A", x, y) + 1e-3);
        }
    }
    EXPECT_NEAR(in.sum("lines.A"), out.sum("lines.A"), 0.02 * both.sum("lines.A"));
}

TEST(PatelStroke, SurfaceCoverageIsAntiAliased) {
    const Drawing d = draw(17, 0.3, 256);
    double worst = 0;
    for (int y = 20; y < 108; ++y) {
        for (int x = 20; x < 108; ++x) {
            // Exact area of the half-plane in the pixel, from 64 x 64 samples.
            double inside = 0;
            const double a = glm::radians(17.0);
            for (int i = 0; i < 4096; ++i) {
                const double px = x + (i % 64 + 0.5) / 64, py = 128 - (y + (i / 64 + 0.5) / 64);
                inside += -(px - 64) * std::sin(a) + (py - 64) * std::cos(a) > 0.3;
            }
            worst = std::max(worst, std::abs(inside / 4096 - d.at("surface.A", x, y)));
        }
    }
    EXPECT_LT(worst, 0.08);
}

}  // namespace
}  // namespace burin::patel_strokes_test
