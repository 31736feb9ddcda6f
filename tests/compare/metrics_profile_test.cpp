#include "compare/metrics_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace burin {
namespace {

constexpr double kReach_px = 4;

Segment segment_at(double angle_deg) {
    const double a = angle_deg * 3.14159265358979323846 / 180;
    const glm::dvec2 middle(32.3, 31.8), along(std::cos(a), std::sin(a));
    return {middle - along * 20.0, middle + along * 20.0};
}

/// A long stroke through the picture, each pixel the value of `profile` at its distance.
template <typename Profile>
Plane drawn(const Segment& s, const Profile& profile) {
    Plane plane(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double u = glm::dot(glm::dvec2(x + 0.5, y + 0.5) - s.a, s.across());
            plane.at(x, y) = static_cast<float>(profile(u));
        }
    }
    return plane;
}
Plane exact_stroke(const Segment& s, double width_px) {
    return drawn(s, [&](double u) { return band_coverage(u, s.across(), width_px); });
}

// Against the area by a grid of samples.
TEST(BandCoverage, IsTheAreaOfAStrokeInAPixel) {
    for (const double angle : {0.0, 10.0, 45.0, 71.0, 90.0, 133.0}) {
        const glm::dvec2 n = segment_at(angle).across();
        for (const double u : {0.0, 0.3, 0.6, 1.1, -0.8}) {
            for (const double width : {0.2, 1.0, 2.5}) {
                constexpr int kGrid = 400;
                int inside = 0;
                for (int i = 0; i < kGrid * kGrid; ++i) {
                    const glm::dvec2 p((i % kGrid + 0.5) / kGrid - 0.5, (i / kGrid + 0.5) / kGrid - 0.5);
                    inside += std::abs(u + glm::dot(p, n)) <= width / 2;
                }
                EXPECT_NEAR(band_coverage(u, n, width), static_cast<double>(inside) / (kGrid * kGrid), 0.004)
                    << angle << " degrees, u " << u << ", width " << width;
            }
        }
    }
}

TEST(WidthsAlong, AnExactStrokeHasItsWidthInEveryDirection) {
    for (int angle = 0; angle < 180; angle += 7) {
        for (const double width : {0.5, 1.0, 2.0}) {
            const Segment s = segment_at(angle);
            const std::vector<double> widths = widths_along(exact_stroke(s, width), s, kReach_px);
            EXPECT_NEAR(mean_of(widths), width, 0.01 * width) << angle;
            EXPECT_NEAR(median_of(widths), width, 0.06 * width) << angle;
        }
    }
}

TEST(WithinBinDeviation, IsZeroForAProfileThatIsEqualInAllDirections) {
    const auto cone = [](double u) { return std::max(0.0, 1 - std::abs(u) / 3); };
    std::vector<ProfilePoint> points;
    for (int angle = 0; angle < 180; angle += 5) {
        const Segment s = segment_at(angle);
        const auto more = profile_points(drawn(s, cone), s, kReach_px, 1);
        points.insert(points.end(), more.begin(), more.end());
    }
    EXPECT_NEAR(*within_bin_deviation(points, kReach_px), 0, 1e-6);
}

// An aliased line's pixels are 1 within a quarter pixel of the line's middle only by chance.
TEST(WithinBinDeviation, OfAnAliasedLineIsThatOfCoinTosses) {
    std::vector<ProfilePoint> points;
    for (int i = 0; i < 40000; ++i) {
        const double u = -0.124 + 0.00001 * (i % 20000);
        points.push_back({u, i % 2 == 0 ? 1.0 : 0.0, 0});
    }
    EXPECT_NEAR(*within_bin_deviation(points, 0.125), 0.5, 0.001);
    EXPECT_FALSE(within_bin_deviation({}, 1));
}

TEST(Modulation, OfABoxIsThatOfItsFourBins) {
    LineSpread box{-3 + 0.125, std::vector<double>(24, 0.0)};
    for (int i = 10; i < 14; ++i) box.mean[static_cast<std::size_t>(i)] = 1;  // one pixel wide
    const auto m = modulation(box);
    ASSERT_TRUE(m);
    EXPECT_NEAR(m->values[0], 1, 1e-12);
    EXPECT_NEAR(*m->mtf50, 0.6176, 0.001);  // sin(pi f) / (4 sin(pi f / 4)) = .5, for four bins
    EXPECT_GT(m->energy_above_nyquist, 0.1);
    EXPECT_FALSE(modulation(LineSpread{0, std::vector<double>(8, 0.0)}));
}

TEST(LineSpread, FindsALineThatIsOffItsPlace) {
    const Segment s = segment_at(20);
    const Plane plane = drawn(s, [](double u) { return std::exp(-(u - 1) * (u - 1)); });
    const LineSpread spread = line_spread(profile_points(plane, s, kReach_px, 1), kReach_px);
    const auto top = std::max_element(spread.mean.begin(), spread.mean.end()) - spread.mean.begin();
    EXPECT_NEAR(spread.first_u + static_cast<double>(top) * LineSpread::kBin_px, 1, 0.13);
}

}  // namespace
}  // namespace burin
