// The intensity functions of the wireframe methods: what their papers' lines weigh.

#include <gtest/gtest.h>

#include <set>

#include "methods/wire/wire_profile.h"
#include "tests/support/random.h"

namespace burin::wire_profile_test {
namespace {

using Kind = WireProfileKind;
constexpr Kind kKinds[] = {Kind::gauss, Kind::nv, Kind::step, Kind::linear, Kind::smooth, Kind::box};

/// Across a line that runs along an axis, both sides.
double measured_width(const WireProfile& p) {
    constexpr int kSteps = 200000;
    const double reach = p.reach_px() + 0.01;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += p.intensity((i + 0.5) / kSteps * reach);
    return 2 * sum * reach / kSteps;
}

/// Sum over a column of pixels that a level line crosses, its middle `phase` below a centre.
double column_sum(const WireProfile& p, double phase) {
    double sum = 0;
    for (int i = -8; i <= 8; ++i) sum += p.intensity(std::abs(i - phase), {0, 1});
    return sum;
}

struct Ripple {
    double lowest = 1e9, highest = 0, least_peak = 1;
};
Ripple ripple(const WireProfile& p) {
    Ripple r;
    for (int i = 0; i < 512; ++i) {
        const double phase = i / 512.0, sum = column_sum(p, phase);
        r.lowest = std::min(r.lowest, sum);
        r.highest = std::max(r.highest, sum);
        r.least_peak = std::min(r.least_peak, std::max(p.intensity(phase), p.intensity(1 - phase)));
    }
    return r;
}

TEST(WireProfile, GaussOfTheFirstPaper) {
    const WireProfile p{Kind::gauss};
    EXPECT_EQ(p.intensity(0), 1);
    EXPECT_NEAR(p.intensity(0.5), 0.70711, 1e-5);
    EXPECT_NEAR(p.intensity(1), 0.25, 1e-12);
    EXPECT_NEAR(p.intensity(1.5), 0.04419, 1e-5);
    EXPECT_NEAR(p.intensity(2), 0.00391, 1e-5);
    EXPECT_NEAR(p.intensity(std::sqrt(0.5)), 0.5, 1e-12);  // full width at half maximum sqrt(2)
    EXPECT_NEAR(p.intensity(1), std::exp(-0.5 / (0.60056 * 0.60056)), 1e-4);
    EXPECT_NEAR(p.integrated_width_px(), 1.50538, 1e-5);
    EXPECT_NEAR(gauss_area(10), 0.75269, 1e-5);
    const Ripple r = ripple(p);
    EXPECT_NEAR(r.lowest, 1.50295, 2e-5);
    EXPECT_NEAR(r.highest, 1.50782, 2e-5);
    EXPECT_NEAR(r.least_peak, 0.7071, 1e-3);
}

TEST(WireProfile, GaussWithACoreAndACut) {
    for (const double t : {0.0, 0.5, 2.0}) {
        const WireProfile p{Kind::gauss, t, 1, 1, 1.8};
        EXPECT_EQ(p.intensity(t), 1);
        EXPECT_NEAR(p.intensity(t + 1.8), 0.0112, 1e-4);
        EXPECT_EQ(p.intensity(t + 1.8001), 0);
        EXPECT_NEAR(p.integrated_width_px(), 2 * t + 1.5013, 1e-4);
    }
}

TEST(WireProfile, NvidiasIsNarrowerThanItsName) {
    const std::pair<double, double> widths[] = {{1, 0.6085}, {1.5, 1.0182}, {2, 1.5041}, {2.5, 2.0041}, {3, 2.5041}};
    for (const auto& [w, full] : widths) {
        const WireProfile p{Kind::nv, w};
        EXPECT_NEAR(p.integrated_width_px(), full, 1e-4);
        EXPECT_NEAR(p.intensity(w / 2), 0.25, 1e-12);
        EXPECT_EQ(p.intensity(w / 2 + 1.001), 0);
    }
    EXPECT_NEAR((WireProfile{Kind::nv, 1}.intensity(0)), 0.7071, 1e-4);
    EXPECT_NEAR((WireProfile{Kind::nv, 1.5}.intensity(0)), 0.9170, 1e-4);
    EXPECT_EQ((WireProfile{Kind::nv, 2}.intensity(0)), 1);
}

TEST(WireProfile, RampsWeighTwiceTheirCore) {
    for (const double t : {0.5, 0.8, 3.0}) {
        for (const Kind kind : {Kind::step, Kind::linear, Kind::smooth}) {
            EXPECT_NEAR((WireProfile{kind, t}.integrated_width_px()), 2 * t, 1e-12);
        }
    }
}

TEST(WireProfile, IntegratedWidthIsTheIntegral) {
    for (const Kind kind : kKinds) {
        for (const double core : {0.2, 0.7, 1.6, 3.0}) {
            const WireProfile p{kind, core};
            EXPECT_NEAR(p.integrated_width_px(), measured_width(p), 1e-4) << static_cast<int>(kind) << " " << core;
        }
    }
}

TEST(WireProfile, MatchedIsAsWideAsAsked) {
    for (const Kind kind : kKinds) {
        for (const double width : {0.1, 0.5, 1.0, 1.3, 1.6, 2.0, 5.0, 40.0}) {
            for (const double cut : {1.8, WireProfile::kNoCut}) {
                const WireProfile p = matched_profile(kind, width, cut);
                EXPECT_NEAR(p.integrated_width_px(), width, 1e-9) << static_cast<int>(kind) << " " << width;
                EXPECT_NEAR(measured_width(p), width, 1e-3 + 1e-4 * width) << static_cast<int>(kind) << " " << width;
            }
        }
    }
}

TEST(WireProfile, AMatchedGaussOfOnePixelIsABoxFilteredStroke) {
    const WireProfile p = matched_profile(Kind::gauss, 1);
    double mass = 0, second = 0;
    for (int i = 0; i < 40000; ++i) {
        const double d = (i + 0.5) * 1e-4;
        mass += p.intensity(d);
        second += p.intensity(d) * d * d;
    }
    EXPECT_NEAR(second / mass, 1.0 / 6, 0.008);
    // The price: a level line's ink varies by less than 9 % with its place among the pixels.
    const Ripple r = ripple(p);
    EXPECT_GT(r.lowest, 0.91);
    EXPECT_LT(r.highest, 1.09);
    EXPECT_GT(r.highest, 1.08);
    // Thinner lines get lighter, and ripple no more.
    const Ripple thin = ripple(matched_profile(Kind::gauss, 0.25));
    EXPECT_NEAR(thin.highest / 0.25, r.highest, 1e-9);
}

TEST(WireProfile, BoxIsTheAreaOfTheStrokeInThePixel) {
    for (std::uint64_t trial = 0; trial < 40; ++trial) {
        test::Random random(trial);
        const double angle = random.real(0, 6.3), width = random.real(0.1, 3), d = random.real(0, 2);
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        const WireProfile p{Kind::box, width};
        constexpr int kSide = 400;
        int inside = 0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const glm::dvec2 at((i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5);
            inside += std::abs(glm::dot(at, normal) + d) <= width / 2;
        }
        EXPECT_NEAR(p.intensity(d, normal), static_cast<double>(inside) / (kSide * kSide), 4e-3) << trial;
    }
    // Level and upright lines, where the trapezoid is a box; and no ripple for them at all.
    const Ripple r = ripple({Kind::box, 0.7});
    EXPECT_NEAR(r.lowest, 0.7, 1e-12);
    EXPECT_NEAR(r.highest, 0.7, 1e-12);
    EXPECT_NEAR(pixel_area_below(0.2, {1, 0}), 0.7, 1e-12);
    EXPECT_NEAR(pixel_area_below(0.2, {1, 1e-5}), 0.7, 1e-4);
}

TEST(WireProfile, StepHasTwoLevels) {
    std::set<double> levels;
    for (double d = 0; d < 3; d += 0.01) levels.insert(WireProfile{Kind::step, 0.8}.intensity(d));
    EXPECT_EQ(levels, (std::set<double>{0, 1}));
}

}  // namespace
}  // namespace burin::wire_profile_test
