#include "view/scan_convert.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "mesh/triangulate.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using SampleCounts = std::map<std::pair<int, int>, int>;  // (row, column) -> how often covered

ScreenPolygon triangle(SubpixelPoint a, SubpixelPoint b, SubpixelPoint c) {
    ScreenPolygon p;
    p.count = 3;
    p.corners[0] = a;
    p.corners[1] = b;
    p.corners[2] = c;
    return p;
}

void count_samples(const ScreenPolygon& polygon, int samples_per_pixel, SampleCounts& counts) {
    const ScanConverter scan(polygon, samples_per_pixel);
    for (int row = scan.first_row(); row < scan.end_row(); ++row) {
        const SampleSpan span = scan.span(row);
        for (int column = span.begin; column < span.end; ++column) ++counts[{row, column}];
    }
}

/// Exact test by side of edge, with the top-left rule as commonly stated: a sample on an
/// edge is covered if the edge is a left one, or a horizontal one at the top.
bool covers(const ScreenPolygon& p, int s, int row, int column) {
    const std::int64_t scale = 2 * s;
    const std::int64_t x = 256 * (2 * std::int64_t{column} + 1), y = 256 * (2 * std::int64_t{row} + 1);
    std::int64_t px[3], py[3];
    for (std::size_t k = 0; k < 3; ++k) {
        px[k] = scale * p.corners[k].x;
        py[k] = scale * p.corners[k].y;
    }
    const auto cross = [](std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by) {
        const std::int64_t c = ax * by - ay * bx;  // far from overflow: the polygons are small
        return c > 0 ? 1 : c < 0 ? -1 : 0;
    };
    const int area = cross(px[1] - px[0], py[1] - py[0], px[2] - px[0], py[2] - py[0]);
    if (area == 0) return false;
    for (int k = 0; k < 3; ++k) {
        // Walk so that the inside is to the right on a screen with y down.
        const int from = area > 0 ? k : (k + 1) % 3;
        const int to = area > 0 ? (k + 1) % 3 : k;
        const int side = cross(px[to] - px[from], py[to] - py[from], x - px[from], y - py[from]);
        const bool is_top = py[from] == py[to] && px[to] > px[from];
        const bool is_left = py[to] < py[from];
        if (side < 0 || (side == 0 && !is_top && !is_left)) return false;
    }
    return true;
}

SubpixelPoint random_point(Random& random, int size_px, bool on_samples) {
    // Half of the points lie exactly on samples of the 2x2 grid, where ties are.
    if (on_samples) return {128 * random.integer(0, 2 * size_px) + 64, 128 * random.integer(0, 2 * size_px) + 64};
    return {random.integer(0, 256 * size_px), random.integer(0, 256 * size_px)};
}

TEST(ScanConvert, AgreesWithTheExactTestOnEverySample) {
    for (int trial = 0; trial < 3000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const bool ties = trial % 2 == 0;
        const ScreenPolygon t =
            triangle(random_point(random, 6, ties), random_point(random, 6, ties), random_point(random, 6, ties));
        for (const int s : {1, 2, 3, 4, 6, 8, 14}) {
            SampleCounts counts;
            count_samples(t, s, counts);
            for (int row = -1; row <= 6 * s; ++row) {
                for (int column = -1; column <= 6 * s; ++column) {
                    const auto it = counts.find({row, column});
                    ASSERT_EQ(it != counts.end(), covers(t, s, row, column))
                        << "trial " << trial << ", " << s << " samples per pixel, row " << row << ", column " << column;
                }
            }
        }
    }
}

TEST(ScanConvert, TrianglesOfAPolygonCoverEachSampleOnce) {
    for (int trial = 0; trial < 500; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        // A star-shaped polygon around a centre: simple, usually concave.
        const int corners = random.integer(3, 12);
        std::vector<SubpixelPoint> outline;
        std::vector<glm::dvec3> positions;
        for (int i = 0; i < corners; ++i) {
            const double angle = 6.283185307179586 * (i + random.real(0, 0.9)) / corners;
            const double radius = random.real(200, 1500);
            const SubpixelPoint p{static_cast<int>(1700 + radius * std::cos(angle)),
                                  static_cast<int>(1700 + radius * std::sin(angle))};
            outline.push_back(p);
            positions.emplace_back(p.x, p.y, 0);
        }
        std::vector<std::array<std::uint32_t, 3>> pieces;
        triangulate_polygon(positions, pieces);
        SampleCounts counts;
        for (const auto& [a, b, c] : pieces) count_samples(triangle(outline[a], outline[b], outline[c]), 4, counts);
        // Even-odd rule for the outline itself, at each sample's position.
        for (int row = 0; row < 4 * 14; ++row) {
            for (int column = 0; column < 4 * 14; ++column) {
                const double x = 32 + 64 * column + 1e-3, y = 32 + 64 * row + 1e-6;
                bool inside = false;
                for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
                    const auto &p = outline[i], &q = outline[j];
                    if ((p.y > y) != (q.y > y) && x < p.x + (y - p.y) * (q.x - p.x) / (q.y - p.y)) inside = !inside;
                }
                const auto it = counts.find({row, column});
                ASSERT_EQ(it == counts.end() ? 0 : it->second, inside ? 1 : 0)
                    << "trial " << trial << ", row " << row << ", column " << column;
            }
        }
    }
}

TEST(ScanConvert, ColumnsOfSomeRowsHoldWhatIsCoveredThereAndLittleMore) {
    for (int trial = 0; trial < 20000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const bool ties = trial % 2 == 0;
        const int size_px = trial % 3 == 0 ? 60000 : 12;  // with a third of them doubles round
        const ScreenPolygon t = triangle(random_point(random, size_px, ties), random_point(random, size_px, ties),
                                         random_point(random, size_px, ties));
        const ScanConverter scan(t, random.integer(0, 1) != 0 ? 2 : 4);
        if (scan.first_row() >= scan.end_row()) continue;
        const int first = random.integer(scan.first_row(), scan.end_row() - 1);
        const int end = std::min(first + random.integer(1, 8), scan.end_row());
        SampleSpan all{std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
        for (int row = first; row < end; ++row) {
            const SampleSpan span = scan.span(row);
            all = {std::min(all.begin, span.begin), std::max(all.end, span.end)};
        }
        // Diagonal slivers touch no sample of some rows.
        if (all.begin >= all.end) continue;
        const SampleSpan columns = scan.columns_in(first, end);
        ASSERT_LE(columns.begin, all.begin) << "trial " << trial;
        ASSERT_GE(columns.end, all.end) << "trial " << trial;
        // A corner between two rows may reach farther than what is covered in them.
        const bool has_corner = std::any_of(t.corners.begin(), t.corners.begin() + 3, [&](const SubpixelPoint& p) {
            return p.y > 64 * (first - 1) && p.y < 128 * (end + 1);
        });
        if (has_corner) continue;
        ASSERT_GE(columns.begin, all.begin - 1) << "trial " << trial;
        ASSERT_LE(columns.end, all.end + 1) << "trial " << trial;
    }
}

TEST(ScanConvert, MovingByWholePixelsMovesTheSamples) {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const SubpixelPoint a = random_point(random, 5, false), b = random_point(random, 5, false),
                            c = random_point(random, 5, false);
        const int dx = random.integer(-900, 900), dy = random.integer(-900, 900);
        const auto moved = [&](SubpixelPoint p) { return SubpixelPoint{p.x + 256 * dx, p.y + 256 * dy}; };
        SampleCounts here, there;
        count_samples(triangle(a, b, c), 4, here);
        count_samples(triangle(moved(a), moved(b), moved(c)), 4, there);
        SampleCounts shifted;
        for (const auto& [at, n] : here) shifted[{at.first + 4 * dy, at.second + 4 * dx}] = n;
        ASSERT_EQ(shifted, there) << trial;
    }
}

TEST(ScanConvert, NothingOfNothing) {
    EXPECT_EQ(ScanConverter(ScreenPolygon{}, 4).first_row(), ScanConverter(ScreenPolygon{}, 4).end_row());
    SampleCounts counts;
    count_samples(triangle({100, 100}, {100, 100}, {100, 100}), 4, counts);
    count_samples(triangle({0, 64}, {900, 64}, {2000, 64}), 4, counts);  // flat, along a row of samples
    count_samples(triangle({64, 0}, {64, 900}, {64, 2000}), 4, counts);
    EXPECT_TRUE(counts.empty());
}

}  // namespace
}  // namespace burin
