#include "strokes/stroke_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <utility>

#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin::stroke_mask_test {
namespace {

using namespace test;

struct Stroke {
    glm::dvec2 from, to;
    double radius;

    double distance(glm::dvec2 p) const {
        const glm::dvec2 along = to - from;
        const double square = glm::dot(along, along);
        const double t = square > 0 ? std::clamp(glm::dot(p - from, along) / square, 0.0, 1.0) : 0;
        return glm::distance(p, from + t * along);
    }
};

/// 1: some stroke covers the sample, 0: none, -1: rounding decides.
int expected(const std::vector<Stroke>& strokes, int column, glm::dvec2 sample) {
    bool is_close = false;
    for (const Stroke& s : strokes) {
        const glm::dvec2 along = s.to - s.from;
        const double down = std::abs(along.y) * 16 <= std::abs(along.x)
                                ? kStrokeColumnShifts[static_cast<std::size_t>(column % 8)] / 16
                                : 0.0;
        const double beyond = s.distance(sample + glm::dvec2(0, down)) - s.radius;
        if (beyond < -1e-9) return 1;
        is_close = is_close || beyond < 1e-9;
    }
    return is_close ? -1 : 0;
}

std::vector<Stroke> some_strokes(Random& random, glm::dvec2 low, glm::dvec2 size) {
    std::vector<Stroke> strokes(static_cast<std::size_t>(random.integer(1, 6)));
    for (Stroke& s : strokes) {
        const auto place = [&] { return low + size * glm::dvec2(random.real(-0.3, 1.3), random.real(-0.3, 1.3)); };
        s.from = place();
        s.to = place();
        const int kind = random.integer(0, 6);
        if (kind == 0) s.to = s.from;
        if (kind == 1) s.to.y = s.from.y;  // in one row: as wide as the canvas
        if (kind == 2) s.to.x = s.from.x;
        if (kind == 4) s.to.y = s.from.y + random.real(-0.1, 0.1) * (s.to.x - s.from.x);  // level, or nearly
        if (kind == 3) s.to = s.from + glm::dvec2(random.real(-1, 1), random.real(-1, 1));
        s.radius = std::pow(10.0, random.real(-1.5, 1.3));
    }
    return strokes;
}

void expect_samples(const StrokeCanvas& canvas, const std::vector<Stroke>& strokes, glm::ivec2 origin,
                    std::uint64_t seed) {
    std::set<std::pair<int, int>> touched;
    for (int row = 0; row < canvas.height(); ++row) {
        for (int column = 0; column < canvas.width(); ++column) {
            std::uint32_t any = 0;
            for (int r = 0; r < StrokeMask::kRows; ++r) {
                const std::uint32_t bits = canvas.at(column, row).rows[static_cast<std::size_t>(r)];
                any |= bits;
                for (int c = 0; c < StrokeMask::kColumns; ++c) {
                    const double shift = stroke_row_shift((origin.y + row) * StrokeMask::kRows + r);
                    const glm::dvec2 sample((c + 0.5 + shift) / StrokeMask::kColumns, (r + 0.5) / StrokeMask::kRows);
                    const int wanted = expected(strokes, c, glm::dvec2(origin) + glm::dvec2(column, row) + sample);
                    if (wanted < 0) continue;
                    ASSERT_EQ(bits >> c & 1u, static_cast<unsigned>(wanted))
                        << "seed " << seed << ", pixel " << column << "," << row << ", sample " << c << "," << r;
                }
            }
            ASSERT_EQ(canvas.is_touched(column, row), any != 0)
                << "seed " << seed << ", pixel " << column << "," << row;
            if (any != 0) touched.insert({row, column});
        }
    }
    std::vector<std::pair<int, int>> visited;
    canvas.for_touched([&](int column, int row) { visited.push_back({row, column}); });
    ASSERT_EQ(visited, std::vector(touched.begin(), touched.end())) << "seed " << seed;
}

TEST(StrokeCanvas, HasTheSamplesNearTheLines) {
    for (const TileKernels* kernels : all_kernels()) {
        StrokeCanvas canvas(*kernels);
        for (std::uint64_t seed = 0; seed < 80; ++seed) {
            if (seed % 2 == 1) canvas = StrokeCanvas(*kernels);  // without room left over from larger ones
            Random random(seed);
            const glm::ivec2 size(random.integer(1, 34), random.integer(1, 9)),
                origin(random.integer(-50, 50), random.integer(-50, 50));
            canvas.reset(origin.x, origin.y, size.x, size.y);
            const std::vector<Stroke> strokes = some_strokes(random, origin, size);
            for (const Stroke& s : strokes) canvas.draw(s.from, s.to, s.radius);
            expect_samples(canvas, strokes, origin, seed);
            if (seed % 4 != 0) continue;
            canvas.reset(origin.x, origin.y, size.x, size.y);  // only what was touched is cleared
            expect_samples(canvas, {}, origin, seed);
        }
    }
}

/// Tiles and crops show what the whole picture shows, to the bit.
TEST(StrokeCanvas, TheSamplesDoNotDependOnWhereItLies) {
    for (const TileKernels* kernels : all_kernels()) {
        StrokeCanvas whole(*kernels), part(*kernels);
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            Random random(seed);
            const glm::ivec2 corner(random.integer(-5000, 5000), random.integer(-5000, 5000)), size(600, 40);
            const glm::ivec2 inset(random.integer(0, 590), random.integer(0, 30));
            const glm::ivec2 part_size(random.integer(1, size.x - inset.x), random.integer(1, size.y - inset.y));
            whole.reset(corner.x, corner.y, size.x, size.y);
            part.reset(corner.x + inset.x, corner.y + inset.y, part_size.x, part_size.y);
            for (const Stroke& s : some_strokes(random, corner, size)) {
                whole.draw(s.from, s.to, s.radius);
                part.draw(s.from, s.to, s.radius);
            }
            for (int row = 0; row < part_size.y; ++row) {
                for (int column = 0; column < part_size.x; ++column) {
                    ASSERT_EQ(part.at(column, row).rows, whole.at(column + inset.x, row + inset.y).rows)
                        << "seed " << seed;
                }
            }
        }
    }
}

int count_bits(const StrokeMask& mask) {
    int count = 0;
    for (const std::uint32_t bits : mask.rows) count += std::popcount(bits);
    return count;
}

/// Lines from snapped vertices are like that: their sides lie on the samples' grid.
TEST(StrokeCanvas, SnappedLevelStrokesAreAsWideAsAsked) {
    StrokeCanvas canvas;
    for (int place = 0; place < 256; ++place) {
        for (const int width : {32, 39, 128, 200, 384}) {  // 1/128 pixel
            canvas.reset(0, 0, 1, 8);
            const glm::dvec2 ends[2] = {{-4, 4 + place / 256.0}, {5, 4 + place / 256.0}};
            canvas.draw(ends[place % 2], ends[1 - place % 2], width / 256.0);
            int count = 0;
            canvas.for_touched([&](int column, int row) { count += count_bits(canvas.at(column, row)); });
            ASSERT_EQ(count, 4 * width) << place;
        }
    }
}

constexpr double kSamples = StrokeMask::kRows * StrokeMask::kColumns;

/// The samples are in step with some slopes: 1/2, 3/4, whole numbers of columns in a row.
TEST(StrokeCanvas, StrokesAreAsWideAtAnyAngle) {
    constexpr int kSize = 72;
    constexpr double kLength = 60, kWidth = 0.25;
    std::vector<double> angles;
    for (int degree = 0; degree < 180; ++degree) angles.push_back(glm::radians(static_cast<double>(degree)));
    for (int rows = 1; rows <= 16; ++rows) {
        for (int columns = -48; columns <= 48; ++columns) angles.push_back(std::atan2(rows / 16.0, columns / 32.0));
    }
    Random random(11);
    StrokeCanvas canvas;
    for (const double angle : angles) {
        const glm::dvec2 half = 0.5 * kLength * glm::dvec2(std::cos(angle), std::sin(angle));
        const int y0 = random.integer(-100, 100);
        canvas.reset(0, y0, kSize, kSize);
        const glm::dvec2 middle =
            glm::dvec2(0.5 * kSize, y0 + 0.5 * kSize) + glm::dvec2(random.real(-1, 1), random.real(-1, 1));
        canvas.draw(middle - half, middle + half, 0.5 * kWidth);
        int count = 0;
        canvas.for_touched([&](int column, int row) { count += count_bits(canvas.at(column, row)); });
        const double area = kLength * kWidth + glm::radians(45.0) * kWidth * kWidth;
        EXPECT_NEAR(count / kSamples / area, 1, 0.015) << glm::degrees(angle) << " degrees";
    }
}

TEST(StrokeCanvas, LevelStrokesHaveTheirCoverageInEachPixel) {
    Random random(12);
    StrokeCanvas canvas;
    for (int trial = 0; trial < 200; ++trial) {
        const double radius = random.real(0.1, 2), y = random.real(4, 8),
                     fall = trial % 2 == 0 ? 0 : random.real(-0.06, 0.06);
        canvas.reset(0, 0, 8, 12);
        canvas.draw({-10, y - 14 * fall}, {18, y + 14 * fall}, radius);
        const double reach = radius * std::hypot(1, fall);
        for (int row = 0; row < 12; ++row) {
            for (int column = 0; column < 8; ++column) {
                constexpr int kSteps = 64;
                double expected = 0;
                for (int i = 0; i < kSteps; ++i) {
                    const double middle = y + fall * (column + (i + 0.5) / kSteps - 4);
                    expected +=
                        std::max(std::min(middle + reach, row + 1.0) - std::max(middle - reach, 1.0 * row), 0.0) /
                        kSteps;
                }
                ASSERT_NEAR(count_bits(canvas.at(column, row)) / kSamples, expected, 0.01)
                    << "trial " << trial << ", fall " << fall;
            }
        }
    }
}

TEST(StrokeCanvas, KnowsWhereItIsOpen) {
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
        test::Random random(trial);
        const int width = random.integer(1, 40), height = random.integer(1, 40);
        StrokeCanvas canvas;
        canvas.reset(3, 5, width, height);
        for (int k = 0; k < 20; ++k) {
            const auto place = [&] { return glm::dvec2(random.real(-5, width + 10), random.real(-5, height + 10)); };
            canvas.draw(place(), place(), std::pow(2.0, random.real(0, 4)));
            const int x0 = random.integer(0, width - 1), y0 = random.integer(0, height - 1);
            const StrokeCanvas::Box box{x0, y0, random.integer(x0, width), random.integer(y0, height)};
            const StrokeCanvas::Box open = canvas.open_part(box);
            StrokeCanvas::Box expected{box.x1, box.y1, box.x0, box.y0};
            for (int y = box.y0; y < box.y1; ++y) {
                for (int x = box.x0; x < box.x1; ++x) {
                    if (canvas.is_full(x, y)) continue;
                    expected = {std::min(expected.x0, x), std::min(expected.y0, y), std::max(expected.x1, x + 1),
                                std::max(expected.y1, y + 1)};
                }
            }
            ASSERT_EQ(open.is_empty(), expected.is_empty()) << trial;
            if (open.is_empty()) continue;
            ASSERT_TRUE(open.x0 == expected.x0 && open.y0 == expected.y0 && open.x1 == expected.x1 &&
                        open.y1 == expected.y1)
                << trial;
        }
    }
}

// Wide strokes are left out where all pixels are full: the masks are those of each alone, together.
TEST(StrokeCanvas, WideStrokesAreTheUnionOfEach) {
    for (std::uint64_t trial = 0; trial < 30; ++trial) {
        test::Random random(trial);
        StrokeCanvas all, one, expected;
        for (StrokeCanvas* c : {&all, &expected}) c->reset(0, 0, 32, 32);
        for (int k = 0; k < 12; ++k) {
            const glm::dvec2 from(random.real(-60, 90), random.real(-60, 90)),
                to(random.real(-60, 90), random.real(-60, 90));
            const double radius_px = random.real(8, 40);
            all.draw(from, to, radius_px);
            one.reset(0, 0, 32, 32);
            one.draw(from, to, radius_px);
            one.for_touched([&](int x, int y) { expected.add(x, y, one.at(x, y)); });
        }
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x)
                ASSERT_EQ(all.at(x, y).rows, expected.at(x, y).rows) << trial << ' ' << x << ' ' << y;
        }
    }
}

}  // namespace
}  // namespace burin::stroke_mask_test
