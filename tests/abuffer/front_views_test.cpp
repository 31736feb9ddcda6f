// Parts that are seen along an axis: walls of very many triangles, edge-on.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "abuffer/fine/drawn_parts.h"
#include "abuffer/samples/fast_decision.h"
#include "abuffer/samples/surface_tile.h"
#include "abuffer/visible_pass.h"
#include "lines/line_decision.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::front_views_test {
namespace {

using namespace test;

constexpr int kSize = 64, kSamples = 2;
constexpr double kPxPerUnit = kSize / 2.0;

/// A box without a back, with walls of `rows` rows of triangles, perhaps before a plate. Where `is_on_samples`, two of
/// its walls lie exactly at samples.
PolygonSoup deep_box(Random& random, int rows, int columns, bool is_on_samples, bool has_plate) {
    PolygonSoup soup;
    const auto add = [&](const glm::dvec3& p) {
        soup.positions.push_back(p);
        return static_cast<std::uint32_t>(soup.positions.size() - 1);
    };
    const double off = is_on_samples ? 0.25 / kPxPerUnit : random.real(-0.01, 0.01), half = 0.5;
    const glm::dvec2 corners[4] = {
        {-half + off, -half + off}, {half + off, -half + off}, {half + off, half + off}, {-half + off, half + off}};
    std::vector<std::uint32_t> face;
    for (int side = 0; side < 4; ++side) {
        const glm::dvec2 from = corners[side], to = corners[(side + 1) % 4];
        std::vector<std::vector<std::uint32_t>> grid(static_cast<std::size_t>(rows + 1));
        for (int r = 0; r <= rows; ++r) {
            for (int c = 0; c <= columns; ++c) {
                const bool is_inner = r > 0 && r < rows && c > 0 && c < columns;
                const double share = (c + (is_inner ? random.real(-0.3, 0.3) : 0)) / columns;
                const double depth = (r + (is_inner ? random.real(-0.3, 0.3) : 0)) / rows;
                const std::uint32_t v = add({from + (to - from) * share, -depth});
                grid[static_cast<std::size_t>(r)].push_back(v);
                if (r == 0 && c < columns) face.push_back(v);
            }
        }
        for (std::size_t r = 0; r + 1 < grid.size(); ++r) {
            for (std::size_t c = 0; c + 1 < grid[r].size(); ++c) {
                soup.add_polygon(std::vector{grid[r][c], grid[r][c + 1], grid[r + 1][c + 1]});
                soup.add_polygon(std::vector{grid[r][c], grid[r + 1][c + 1], grid[r + 1][c]});
            }
        }
    }
    soup.add_polygon(face);
    if (has_plate)
        soup.add_polygon(
            std::vector{add({-0.8, -0.8, -2}), add({0.8, -0.8, -2}), add({0.8, 0.8, -2}), add({-0.8, 0.8, -2})});
    return soup;
}

struct Counts {
    int asked = 0, lines = 0, left_to_decide_line = 0;
};

Counts compare(const Scene& scene, const Camera& camera) {
    const Frame frame = make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const TriangleBins bins(screen, frame.crop, kSamples, best_kernels(), 1);
    SurfaceTile tile(frame, screen, bins, kSamples, best_kernels());
    FastDecision fast(screen, frame.criteria);
    const std::int32_t pitch = kSubpixelsPerPixel / kSamples;
    Counts counts;
    const auto ask = [&](const SampleTile& s, int column, int row, bool down) {
        const std::size_t a = s.index(column, row), b = down ? s.index(column, row + 1) : s.index(column + 1, row);
        if (s.ids[a] >> 1 == s.ids[b] >> 1) return;
        const NeighbourSamples pair{
            column * pitch + pitch / 2, row * pitch + pitch / 2, pitch, down, {tile.surface_at(a), tile.surface_at(b)}};
        ++counts.asked;
        LineDecision decision;
        double nearness = 0;
        if (!fast.decide(pair, decision, nearness)) {
            ++counts.left_to_decide_line;
            return;
        }
        const glm::dvec2 trifle(kSampleTrifleX, kSampleTrifleY);
        const VisiblePoint points[2] = {{pair.place(0) / 256.0 + trifle, pair.surfaces[0]},
                                        {pair.place(1) / 256.0 + trifle, pair.surfaces[1]}};
        const LineDecision exact = decide_line(frame.surfaces, points[0], points[1], frame.criteria);
        const LineClassSet wanted = frame.criteria.classes;
        ASSERT_EQ((decision.classes & wanted).bits, (exact.classes & wanted).bits)
            << column << ", " << row << (down ? " down" : "");
        if ((exact.classes & wanted).empty()) return;
        ++counts.lines;
        EXPECT_EQ(decision.reason, exact.reason);
        EXPECT_EQ(decision.front, exact.front);
        // Seen a trifle further at either sample.
        EXPECT_NEAR(decision.fraction, exact.fraction, 2 * kSampleTrifleX * kSamples) << column << ", " << row;
    };
    for (std::size_t t = 0; t < bins.tile_count(); ++t) {
        tile.draw(t);
        const SampleTile& s = tile.samples();
        for (int row = s.first_row; row + 1 < s.first_row + s.rows; ++row) {
            for (int column = s.first_column; column + 1 < s.first_column + s.columns; ++column) {
                ask(s, column, row, false);
                ask(s, column, row, true);
            }
        }
    }
    return counts;
}

/// Walls of a hundred rows and more are walked over on snapped vertices, and outlines exactly at samples found there:
/// nothing is left to decide_line() but at corners, and what is decided is the same.
TEST(FrontViews, NothingIsLeftToSlowDecisions) {
    Counts sum;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const bool is_on_samples = seed % 2 == 0, has_plate = seed % 4 < 2;
        const int rows = seed % 3 == 0 ? random.integer(100, 160) : random.integer(1, 40),
                  columns = random.integer(1, 5);
        Scene scene = scene_of({deep_box(random, rows, columns, is_on_samples, has_plate)});
        Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0});
        camera.orthographic = true;
        camera.height = 2;
        const Counts counts = compare(scene, camera);
        sum.asked += counts.asked;
        sum.lines += counts.lines;
        constexpr int kCorners = 4;  // whose vertices may lie at samples
        EXPECT_LE(counts.left_to_decide_line, kCorners);
        if (HasFailure()) return;
    }
    EXPECT_GT(sum.asked, 2000);
    EXPECT_GT(sum.lines, 2000);
}

std::size_t segment_count(const Scene& scene, const Camera& camera) {
    const Frame frame = make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    VisiblePass pass(frame, screen, nullptr, best_kernels(), 1, nullptr);
    LineDrawing drawing;
    Film film({0, 0, kSize, kSize}, {0, 0, kSize, kSize}, LayerSet{}, frame.criteria.classes);
    RenderStats stats;
    pass.draw({0, 0, kSize, kSize}, TileGrid::kTileSamples, nullptr, drawing, film, stats);
    std::size_t count = 0;
    for (const std::span<const LinePiece> list : drawing.visible()) count += list.size();
    return count;
}

/// All edges of a wall are on one line of the picture: one of them is drawn there, however many rows it has. Dashes
/// need each.
TEST(FrontViews, EdgesOfAWallAreOneLine) {
    Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0});
    camera.orthographic = true;
    camera.height = 2;
    const auto count_of = [&](int rows, bool has_dashes) {
        Random random(3);
        Scene scene = scene_of({deep_box(random, rows, 2, false, false)});
        scene.lines.classes =
            LineClass::silhouette | LineClassSet(LineClass::border) | LineClassSet(LineClass::polygon);
        if (has_dashes) scene.lines.style.dash_px = std::array{5.0, 3.0};
        return segment_count(scene, camera);
    };
    const std::size_t few = count_of(2, false), many = count_of(120, false), each = count_of(120, true);
    EXPECT_GT(few, 20u);
    EXPECT_LT(many, 4 * few);
    EXPECT_GT(each, 4 * many);
}

WholeLine random_line(Random& random) {
    WholeLine line;
    // Few places on few lines, so that many lie on each other.
    const glm::dvec2 directions[3] = {{1, 0}, {0, 1}, {2, -1}};
    const glm::dvec2 way = directions[random.integer(0, 2)], start(0, random.integer(0, 1) * 3);
    int a = random.integer(0, 12), b = random.integer(0, 12);
    if (a == b) b = a + 1;
    line.from = start + way * double(a);
    line.to = start + way * double(b);
    line.nearness_from = random.integer(0, 3);
    line.nearness_to = random.integer(0, 3);
    return line;
}

/// Place by place: whether a line nearer than this one, of its kind, is there.
TEST(DrawnParts, CoverOnlyWhatLiesBehindThemEverywhere) {
    int covered = 0, open = 0, told = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        DrawnParts drawn;
        struct Given {
            WholeLine line;
            double begin, end;
            DrawnParts::Kind kind;
        };
        std::vector<Given> given;
        const auto make = [&] {
            const double p = random.real(0, 1), q = random.real(0, 1);
            const auto kind = DrawnParts::Kind{random.integer(0, 3) == 0 ? LineClass::border : LineClass::silhouette,
                                               true, random.integer(0, 3) == 0};
            const bool is_whole = random.integer(0, 2) > 0;
            return Given{random_line(random), is_whole ? 0 : std::min(p, q), is_whole ? 1 : std::max(p, q), kind};
        };
        for (int k = 0; k < 12; ++k) {
            given.push_back(make());
            drawn.add(given.back().line, given.back().begin, given.back().end, given.back().kind);
        }
        for (int k = 0; k < 20; ++k) {
            const Given asked = make();
            const bool is_covered = drawn.cover(asked.line, asked.begin, asked.end, asked.kind, 1e-9);
            bool is_open = false;
            for (int i = 0; i <= 40; ++i) {
                const double t = glm::mix(asked.begin, asked.end, i / 40.0);
                const glm::dvec2 at = asked.line.at(t);
                const bool is_behind_any = std::any_of(given.begin(), given.end(), [&](const Given& g) {
                    const glm::dvec2 along = g.line.to - g.line.from, v = at - g.line.from;
                    const double share = glm::dot(v, along) / glm::dot(along, along);
                    const bool is_there = std::abs(along.x * v.y - along.y * v.x) < 1e-9 && share >= g.begin - 1e-9 &&
                                          share <= g.end + 1e-9;
                    const bool runs_alike = glm::dot(along, asked.line.to - asked.line.from) > 0;
                    const bool is_alike = g.kind.drawn_as == asked.kind.drawn_as &&
                                          (g.kind.front_on_left == asked.kind.front_on_left) == runs_alike;
                    return is_there && is_alike && g.line.nearness_at(share) >= asked.line.nearness_at(t) - 1e-6;
                });
                is_open = is_open || !is_behind_any;
            }
            ASSERT_FALSE(is_covered && is_open);
            ++(is_covered ? covered : open);
            told += is_covered == !is_open;
        }
    }
    EXPECT_GT(covered, 300);
    EXPECT_GT(open, 300);
    EXPECT_GT(told, 7 * (covered + open) / 8);
}

}  // namespace
}  // namespace burin::front_views_test
