#include "compare/metrics_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace burin {
namespace {

TEST(CoverageError, CountsOnlyPixelsWithALineInEitherPicture) {
    Plane truth(10, 10), result(10, 10);
    truth.at(2, 2) = 1;      // missing
    result.at(5, 5) = 0.5f;  // invented
    truth.at(7, 7) = result.at(7, 7) = 1;
    const auto error = coverage_error(result, truth);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->line_pixels, 3u);
    EXPECT_DOUBLE_EQ(error->rmse, std::sqrt((1 + 0.25 + 0) / 3));
    EXPECT_DOUBLE_EQ(error->max_error, 1);
    EXPECT_DOUBLE_EQ(*error->psnr_db, 20 * std::log10(1 / error->rmse));
}

TEST(CoverageError, LeavesOutTheWorstTwoPercentWhereItSaysSo) {
    Plane truth(100, 1, 1.0f), result(100, 1, 0.9f);
    result.values[10] = result.values[20] = 0;  // two of a hundred
    const auto error = coverage_error(result, truth);
    EXPECT_NEAR(*error->psnr98_db, 20, 1e-4);
    EXPECT_NEAR(error->rmse, std::sqrt((98 * 0.01 + 2) / 100), 1e-6);
}

TEST(CoverageError, EqualPicturesHaveNoFinitePsnr) {
    const Plane line(4, 4, 0.3f);
    const auto error = coverage_error(line, line);
    EXPECT_EQ(error->rmse, 0);
    EXPECT_FALSE(error->psnr_db);
    EXPECT_FALSE(error->psnr98_db);
    EXPECT_FALSE(coverage_error(Plane(4, 4), Plane(4, 4)));
}

TEST(LineMass, ALineOnePixelAsideIsNeitherMissedNorInvented) {
    Plane truth(20, 20), result(20, 20);
    for (int y = 0; y < 20; ++y) truth.at(5, y) = result.at(6, y) = 1;
    const auto mass = line_mass(result, truth);
    EXPECT_EQ(mass->missed, 0);
    EXPECT_EQ(mass->invented, 0);
}

TEST(LineMass, ALineTwoPixelsAsideIsBoth) {
    Plane truth(20, 20), result(20, 20);
    for (int y = 0; y < 20; ++y) {
        truth.at(5, y) = 1;
        truth.at(15, y) = result.at(15, y) = 1;
        result.at(7, y) = 0.5f;
    }
    const auto mass = line_mass(result, truth);
    EXPECT_DOUBLE_EQ(mass->missed, 0.5);
    EXPECT_DOUBLE_EQ(mass->invented, 0.25);
    EXPECT_FALSE(line_mass(result, Plane(20, 20)));
}

TEST(CoverageLevels, CountsDifferentCoveragesBesideNothing) {
    Plane p(4, 1);
    p.values = {0.001f, 0.5f, 0.5001f, 1};
    EXPECT_EQ(coverage_levels(p), 2u);
}

}  // namespace
}  // namespace burin
