#include "lines/stroke_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
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
int expected(const std::vector<Stroke>& strokes, glm::dvec2 sample) {
    bool is_close = false;
    for (const Stroke& s : strokes) {
        const double beyond = s.distance(sample) - s.radius;
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
        const int kind = random.integer(0, 5);
        if (kind == 0) s.to = s.from;
        if (kind == 1) s.to.y = s.from.y;  // in one row: as wide as the canvas
        if (kind == 2) s.to.x = s.from.x;
        if (kind == 3) s.to = s.from + glm::dvec2(random.real(-1, 1), random.real(-1, 1));
        s.radius = std::pow(10.0, random.real(-1.5, 1.3));
    }
    return strokes;
}

void expect_samples(const StrokeCanvas& canvas, const std::vector<Stroke>& strokes, glm::ivec2 origin, std::uint64_t seed) {
    std::set<std::pair<int, int>> touched;
    for (int row = 0; row < canvas.height(); ++row) {
        for (int column = 0; column < canvas.width(); ++column) {
            std::uint32_t any = 0;
            for (int r = 0; r < StrokeMask::kRows; ++r) {
                const std::uint32_t bits = canvas.at(column, row).rows[static_cast<std::size_t>(r)];
                any |= bits;
                for (int c = 0; c < StrokeMask::kColumns; ++c) {
                    const glm::dvec2 sample((c + 0.5 + kStrokeRowShift[r]) / StrokeMask::kColumns, (r + 0.5) / StrokeMask::kRows);
                    const int wanted = expected(strokes, glm::dvec2(origin) + glm::dvec2(column, row) + sample);
                    if (wanted < 0) continue;
                    ASSERT_EQ(bits >> c & 1u, static_cast<unsigned>(wanted))
                        << "seed " << seed << ", pixel " << column << "," << row << ", sample " << c << "," << r;
                }
            }
            ASSERT_EQ(canvas.is_touched(column, row), any != 0) << "seed " << seed << ", pixel " << column << "," << row;
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
            const glm::ivec2 size(random.integer(1, 34), random.integer(1, 9)), origin(random.integer(-50, 50), random.integer(-50, 50));
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

}  // namespace
}  // namespace burin
