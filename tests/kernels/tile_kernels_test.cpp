#include "kernels/tile_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

#include "abuffer/samples/sample_tile.h"
#include "tests/kernels/random_triangles.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"
#include "view/scan_convert.h"

namespace burin {
namespace {

using namespace test;

TEST(TileKernels, TrianglesAreDrawnAsSampleBySample) {
    std::size_t left_out = 0;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        const int per_pixel = 1 << seed % 4;
        Triangles triangles(seed, per_pixel, 37, -20);
        SampleTile expected;
        expected.reset(37, -20, 129, 97, per_pixel);
        std::vector<TileTriangle> drawable;
        for (std::uint32_t t = 0; t < triangles.count(); ++t) {
            if (triangles.area(t) == 0) continue;
            draw_slowly(triangles, t, expected);
            drawable.push_back(in_tile(triangles, t, expected));
        }
        for (const TileKernels* kernels : all_kernels()) {
            for (const bool with_look : {false, true}) {
                SampleTile tile;
                tile.reset(37, -20, 129, 97, per_pixel);
                std::vector<float> farthest(BlockTable::kSize);
                std::size_t drawn = 0;
                for (std::size_t first = 0; first < drawable.size(); first += 50) {
                    const std::size_t count = std::min<std::size_t>(50, drawable.size() - first);
                    std::vector<std::uint32_t> numbers(count);
                    for (std::size_t i = 0; i < count; ++i) numbers[i] = drawable[first + i].triangle;
                    if (with_look) {
                        kernels->blocks.find_farthest(view_of(tile), farthest.data());
                        numbers.resize(kernels->blocks.find_nearer(farthest.data(), 0, 0, &drawable[first], count,
                                                                   numbers.data()));
                    }
                    kernels->draw.small_triangles(view_of(tile), triangles.mesh, numbers.data(), numbers.size());
                    drawn += numbers.size();
                }
                if (!with_look) {
                    EXPECT_EQ(drawn, drawable.size());
                }
                left_out += drawable.size() - drawn;
                for (int row = -20; row < 77; ++row) {
                    for (int column = 37; column < 166; ++column) {
                        const std::size_t i = tile.index(column, row);
                        ASSERT_EQ(tile.ids[i], expected.ids[i]) << kernels->name << " seed " << seed;
                        ASSERT_EQ(tile.nearness[i], expected.nearness[i]) << kernels->name << " seed " << seed;
                    }
                }
            }
        }
    }
    EXPECT_GT(left_out, 0u);
}

/// Polygons have all sizes, corners on samples and rows, and lie in tiles near and far from the origin.
TEST(TileKernels, PolygonsAreDrawnRowByRow) {
    int fitting = 0, drawn = 0;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const int per_pixel = 2 << seed % 3, pitch = kSubpixelsPerPixel / per_pixel;
        const int first_column = random.integer(-20000, 20000), first_row = random.integer(-20000, 20000);
        SampleTile tile;
        tile.reset(first_column, first_row, random.integer(1, 129), random.integer(1, 40), per_pixel);
        const int reach = 1 << random.integer(7, 24), mask = random.integer(0, 1) == 0 ? ~(pitch / 2 - 1) : ~0;
        ScreenPolygon polygon;
        polygon.count = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            polygon.corners[k] = {(first_column * pitch + random.integer(-reach, reach)) & mask,
                                  (first_row * pitch + random.integer(-reach, reach)) & mask};
        }
        const ScanConverter scan(polygon, per_pixel);
        if (!scan.fits_doubles()) continue;
        ++fitting;
        SpanPlane plane{};
        plane.per_x = 0.001f;
        plane.low = -3;
        plane.high = 3;
        plane.id = 10;
        const int top = std::max(scan.first_row() - first_row, 0),
                  bottom = std::min(scan.end_row() - first_row, tile.rows);
        const SampleRect rect{random.integer(0, tile.columns - 1), top, random.integer(1, tile.columns),
                              std::max(bottom, top)};
        SampleTile expected = tile;
        int count = 0;
        for (int row = rect.first_row; row < rect.end_row; ++row) {
            const SampleSpan span = scan.span(row + first_row);
            const int from = std::max(span.begin - first_column, rect.first_column),
                      to = std::min(span.end - first_column, rect.end_column);
            if (from >= to) continue;
            baseline_kernels().draw.span(view_of(expected), row, from, to, plane);
            count += to - from;
        }
        drawn += count;
        for (const TileKernels* kernels : all_kernels()) {
            SampleTile found = tile;
            EXPECT_EQ(kernels->draw.polygon(view_of(found), scan.edges().data(), scan.edges().size(), rect, plane),
                      count)
                << kernels->name << " seed " << seed;
            EXPECT_EQ(found.ids, expected.ids) << kernels->name << " seed " << seed;
            EXPECT_EQ(found.nearness, expected.nearness) << kernels->name << " seed " << seed;
        }
    }
    EXPECT_GT(fitting, 1500);
    EXPECT_GT(drawn, 50000);
}

// What is level with what is seen is not plain there, in whichever order surfaces come.
TEST(TileKernels, WhatIsLevelHangsOnNoOrder) {
    constexpr int kColumns = 8;
    int plain = 0, level = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        std::vector<SpanPlane> planes(static_cast<std::size_t>(random.integer(2, 4)));
        for (std::size_t i = 0; i < planes.size(); ++i) {
            planes[i].low = planes[i].high = planes[i].nearness = static_cast<float>(1 + random.real(0, 0.05));
            planes[i].id = static_cast<std::uint32_t>(2 * (10 + i) + 1);
        }
        std::sort(planes.begin(), planes.end(), [](const SpanPlane& a, const SpanPlane& b) { return a.id < b.id; });
        std::vector<std::uint32_t> first;
        do {
            for (const TileKernels* kernels : all_kernels()) {
                SampleTile tile;
                tile.reset(0, 0, kColumns, 1, 2);
                SampleView view = view_of(tile);
                std::vector<Contest> contests(64);
                std::uint32_t contest_count = 0;
                view.level = 0.004f;
                view.level_per_nearness = seed % 2 == 0 ? 0.02f : 0.0f;
                view.contests = contests.data();
                view.contest_count = &contest_count;
                view.contest_capacity = static_cast<std::uint32_t>(contests.size());
                for (const SpanPlane& plane : planes) kernels->draw.span(view, 0, 0, kColumns, plane);
                const std::vector<std::uint32_t> ids(tile.ids.begin(), tile.ids.begin() + kColumns);
                if (first.empty()) first = ids;
                ASSERT_EQ(ids, first) << kernels->name << " seed " << seed;
            }
        } while (std::next_permutation(planes.begin(), planes.end(),
                                       [](const SpanPlane& a, const SpanPlane& b) { return a.id < b.id; }));
        ((first[0] & 1) != 0 ? plain : level) += 1;
    }
    EXPECT_GT(plain, 100);
    EXPECT_GT(level, 100);
}

/// Losers that are farther than the last one of interest, or as near with a larger id, are not
/// noted; the winner is no longer plain all the same.
TEST(TileKernels, LosersBehindTheLastOneAreNotNoted) {
    constexpr int kColumns = 8;
    const std::vector<float> nearness(kColumns, 1.0f);
    for (const TileKernels* kernels : all_kernels()) {
        for (const auto& [loser, id, is_noted] : {std::tuple(1.01f, 40u, true), std::tuple(1.0f, 20u, true),
                                                  std::tuple(1.0f, 22u, false), std::tuple(0.99f, 4u, false)}) {
            for (const bool loser_is_first : {false, true}) {
                SampleTile tile;
                tile.reset(0, 0, kColumns, 1, 2);
                std::vector<Contest> contests(64);
                std::uint32_t contest_count = 0;
                // Samples without a last one note all.
                std::vector<float> last(tile.ids.size(), -std::numeric_limits<float>::infinity());
                std::copy(nearness.begin(), nearness.end() - 1, last.begin());
                const std::vector<std::uint32_t> last_ids(tile.ids.size(), 21);
                SampleView view = view_of(tile);
                view.level = 0.1f;
                view.contests = contests.data();
                view.contest_count = &contest_count;
                view.contest_capacity = static_cast<std::uint32_t>(contests.size());
                view.last_nearness = last.data();
                view.last_ids = last_ids.data();
                const auto plane_of = [](float z, std::uint32_t plane_id) {
                    return SpanPlane{0, 0, z, 0, 0, z, z, plane_id};
                };
                const SpanPlane far = plane_of(loser, id), near = plane_of(1.05f, 31);
                kernels->draw.span(view, 0, 0, kColumns, loser_is_first ? far : near);
                kernels->draw.span(view, 0, 0, kColumns, loser_is_first ? near : far);
                ASSERT_EQ(contest_count, is_noted ? 8u : 1u) << kernels->name << " " << loser << " " << id;
                for (std::uint32_t i = 0; i < contest_count; ++i) {
                    EXPECT_EQ(contests[i].loser, id);
                    EXPECT_EQ(contests[i].nearness, loser);
                    EXPECT_EQ(contests[i].sample, is_noted ? i : 7u);
                }
                for (int i = 0; i < kColumns; ++i) EXPECT_EQ(tile.ids[static_cast<std::size_t>(i)], 30u);
            }
        }
    }
}

TEST(TileKernels, EdgesThatMayBeLinesAreFound) {
    Random random(11);
    const Facing facings[] = {edge_on, clockwise, counterclockwise, off_screen};
    for (const TileKernels* kernels : all_kernels()) {
        constexpr std::uint32_t kCount = 999;
        std::vector<std::uint8_t> facing(kCount + ScreenMesh::kPadding), sharp(kCount), found(kCount, 77);
        std::vector<std::uint32_t> partners(3 * kCount);
        for (std::uint32_t t = 0; t < kCount; ++t) {
            // Mostly one way and smooth, or none would be plain.
            facing[t] = facings[random.integer(0, 9) == 0 ? random.integer(0, 3) : t < kCount / 2 ? 1 : 2];
            sharp[t] = static_cast<std::uint8_t>(random.integer(0, 4) == 0 ? random.integer(0, 15) : 0);
            const int half = t < kCount / 2 ? 0 : static_cast<int>(kCount / 2 + 1);
            for (std::uint32_t k = 0; k < 3; ++k) {
                partners[3 * t + k] =
                    static_cast<std::uint32_t>(3 * (half + random.integer(0, 490)) + random.integer(0, 2));
            }
        }
        ScreenMesh mesh;
        mesh.facing = facing.data();
        mesh.sharp = sharp.data();
        mesh.partners = partners.data();
        kernels->cull.find_line_edges(mesh, 3, kCount - 7, found.data());
        int plain = 0, sharp_ones = 0;
        for (std::uint32_t t = 0; t < kCount; ++t) {
            const bool has_side = facing[t] == clockwise || facing[t] == counterclockwise;
            unsigned expected = has_side ? sharp[t] & ~7u : 0;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const bool turns = facing[partners[3 * t + k] / 3] != facing[t], is_sharp = (sharp[t] >> k & 1) != 0;
                if (!has_side || turns || is_sharp) expected |= 1u << k;
                sharp_ones += is_sharp ? 1 : 0;
            }
            const bool is_asked = t >= 3 && t < kCount - 7;
            ASSERT_EQ(found[t], is_asked ? expected : 77) << kernels->name << " triangle " << t;
            plain += expected == 0 ? 1 : 0;
        }
        EXPECT_GT(plain, 100);
        EXPECT_GT(sharp_ones, 100);
    }
}

/// A triangle is listed if it may be nearer than the least number of a block that it touches, and only then.
TEST(TileKernels, NearerTrianglesAreFound) {
    Random random(9);
    constexpr int kColumns = 7, kRows = 5;
    for (int round = 0; round < 40; ++round) {
        std::vector<float> least(BlockTable::kSize, std::numeric_limits<float>::infinity());
        const auto least_of = [&](std::uint32_t column, std::uint32_t row) -> float& {
            return least[row * BlockTable::kPitch + column];
        };
        for (std::uint32_t row = 0; row < kRows; ++row) {
            for (std::uint32_t column = 0; column < kColumns; ++column) {
                if (random.integer(0, 2) == 0) least_of(column, row) = static_cast<float>(random.integer(0, 9));
            }
        }
        const float level = 0.25f * static_cast<float>(random.integer(0, 4)),
                    per_nearness = 0.125f * static_cast<float>(random.integer(0, 2));
        std::vector<TileTriangle> triangles(97);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            struct Range {
                std::uint32_t first, last;
            };
            const auto range = [&](int count) {
                const int first = random.integer(0, count - 1);
                const int more = random.integer(0, 5) == 0 ? 3 : random.integer(0, 1);
                return Range{static_cast<std::uint32_t>(first),
                             static_cast<std::uint32_t>(std::min(count - 1, first + more))};
            };
            const Range columns = range(kColumns), rows = range(kRows);
            TileTriangle& t = triangles[i];
            t.triangle = 1000 + i;
            t.highest = static_cast<float>(random.integer(0, 9));
            t.blocks = TileTriangle::pack(columns.first, columns.last, rows.first, rows.last);
            bool is_nearer = false;
            for (std::uint32_t row = rows.first; row <= rows.last; ++row) {
                for (std::uint32_t column = columns.first; column <= columns.last; ++column) {
                    is_nearer = is_nearer || t.highest + (t.highest * per_nearness + level) >= least_of(column, row);
                }
            }
            if (is_nearer) expected.push_back(t.triangle);
        }
        for (const TileKernels* kernels : all_kernels()) {
            kernels->blocks.combine(kColumns, kRows, least.data());
            std::vector<std::uint32_t> found(triangles.size());
            found.resize(kernels->blocks.find_nearer(least.data(), level, per_nearness, triangles.data(),
                                                     triangles.size(), found.data()));
            EXPECT_EQ(found, expected) << kernels->name << " round " << round;
        }
    }
}

/// Whether a stroke covers a sample of the picture, or rounding decides.
enum class Covers { no, yes, unsure };
Covers covers(const PenStroke& s, double x, double y) {
    const double dx = s.to[0] - s.from[0], dy = s.to[1] - s.from[1], square = dx * dx + dy * dy;
    const double along = square > 0 ? std::clamp(((x - s.from[0]) * dx + (y - s.from[1]) * dy) / square, 0.0, 1.0) : 0;
    const double beyond = std::hypot(x - s.from[0] - along * dx, y - s.from[1] - along * dy) - s.radius;
    if (std::abs(beyond) < 1e-6) return Covers::unsure;
    return beyond < 0 ? Covers::yes : Covers::no;
}

TEST(TileKernels, StrokesCoverWhatIsNear) {
    constexpr std::size_t kRows = kStrokeRows;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const std::int32_t width = random.integer(1, 14), height = random.integer(1, 5), stride = (width + 7) / 8 * 8;
        const std::int32_t x0 = random.integer(-100, 100), y0 = random.integer(-100, 100);
        PenStroke s{};
        s.from[0] = x0 + random.real(-2, width + 1);
        s.from[1] = y0 + random.real(-2, height + 1);
        const int kind = random.integer(0, 4);
        const double turn = kind == 0   ? 0.7853981634 * random.integer(0, 7)
                            : kind == 1 ? 3.1415926536 * random.integer(0, 1) + random.real(-0.07, 0.07)
                                        : random.real(0, 6.28);
        const double length = random.integer(0, 4) == 0 ? 0 : random.real(0, random.integer(0, 1) == 0 ? 1 : 12);
        s.to[0] = s.from[0] + std::cos(turn) * length;
        s.to[1] = s.from[1] + std::sin(turn) * length;
        s.radius = random.real(0.1, 2);
        const bool in_sets = is_level(s.to[0] - s.from[0], s.to[1] - s.from[1]);
        const auto pixels = static_cast<std::size_t>(stride * height) + kRoomBehindMasks;
        std::vector<std::uint32_t> before(kRows * pixels), expected;
        for (std::uint32_t& rows : before) rows = 0x80001000u;  // is kept
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<std::uint32_t> masks = before;
            std::vector<std::uint8_t> touched(pixels, 0);
            kernels->stroke.draw(s, {masks.data(), touched.data(), x0, y0, width, height, stride});
            for (std::size_t i = 0; i < pixels; ++i) {
                const auto column = static_cast<int>(i) % stride, row = static_cast<int>(i) / stride;
                bool is_any = false, may_be_any = false;
                for (std::size_t r = 0; r < kRows; ++r) {
                    const std::uint32_t bits = masks[kRows * i + r];
                    if (column >= width || row >= height) {
                        ASSERT_EQ(bits, 0x80001000u) << kernels->name << " seed " << seed;
                        continue;
                    }
                    const double y = y0 + row + (static_cast<double>(r) + 0.5) / kStrokeRows;
                    const double shift = stroke_row_shift(kStrokeRows * (y0 + row) + static_cast<int>(r));
                    for (std::size_t c = 0; c < kStrokeColumns; ++c) {
                        const double down = in_sets ? kStrokeColumnShifts[c % kStrokeColumnSets] / kStrokeRows : 0;
                        const Covers wanted =
                            covers(s, x0 + column + (static_cast<double>(c) + 0.5 + shift) / kStrokeColumns, y + down);
                        is_any = is_any || wanted == Covers::yes;
                        may_be_any = may_be_any || wanted != Covers::no;
                        if (wanted == Covers::unsure) continue;
                        const std::uint32_t bit = wanted == Covers::yes ? 1 : 0x80001000u >> c & 1u;
                        ASSERT_EQ(bits >> c & 1u, bit) << kernels->name << " seed " << seed << ", pixel " << column
                                                       << "," << row << ", sample " << c << "," << r;
                    }
                }
                if (is_any != may_be_any) continue;
                ASSERT_EQ(touched[i], is_any ? 1 : 0) << kernels->name << " seed " << seed;
            }
            if (expected.empty()) expected = masks;
            ASSERT_EQ(masks, expected) << kernels->name << " seed " << seed;
        }
    }
}

TEST(TileKernels, AllInstructionSetsGiveTheSameBits) {
    const std::vector<const TileKernels*> kernels = all_kernels();
    Random random(3);
    ScreenTransform t{};
    for (auto& column : t.to_view) {
        for (double& v : column) v = random.real(-1, 1);
    }
    for (auto& column : t.view_to_world) {
        for (double& v : column) v = random.real(-1, 1);
    }
    t.focal_px = 700;
    t.x_scale = 0.75;
    t.center_x = 320;
    t.center_y = 240;
    t.near_distance = 0.1;
    t.guard_band_px = 65536;
    std::vector<float> positions;
    for (int i = 0; i < 3 * 999; ++i) positions.push_back(static_cast<float>(random.real(-2, 2)));
    for (const bool orthographic : {false, true}) {
        t.orthographic = orthographic;
        std::vector<std::vector<ScreenVertex>> vertices(kernels.size());
        std::vector<std::vector<TriangleGeometry>> geometries(kernels.size());
        std::vector<std::uint32_t> corners(999), numbers(333);
        std::iota(corners.begin(), corners.end(), 0u);
        std::iota(numbers.begin(), numbers.end(), 0u);
        std::vector<std::uint8_t> facing(333, clockwise);
        ScreenMesh mesh;
        mesh.corners = corners.data();
        mesh.facing = facing.data();
        for (std::size_t i = 0; i < kernels.size(); ++i) {
            vertices[i].resize(999);
            geometries[i].resize(333);
            kernels[i]->project.vertices(t, positions.data(), 999, vertices[i].data());
            kernels[i]->fill.geometries(t, positions.data(), mesh, numbers.data(), 333, geometries[i].data());
        }
        int seen = 0;
        for (const ScreenVertex& v : vertices[0]) seen += v.x != ScreenVertex::kOffScreen;
        for (std::size_t k = 1; k < kernels.size(); ++k) {
            for (std::size_t i = 0; i < 999; ++i) {
                ASSERT_EQ(vertices[0][i].x, vertices[k][i].x) << kernels[k]->name;
                ASSERT_EQ(vertices[0][i].y, vertices[k][i].y) << kernels[k]->name;
                ASSERT_EQ(vertices[0][i].nearness, vertices[k][i].nearness) << kernels[k]->name;
            }
            EXPECT_EQ(std::memcmp(geometries[0].data(), geometries[k].data(), 333 * sizeof(TriangleGeometry)), 0)
                << kernels[k]->name;
        }
        EXPECT_GT(seen, 100);
    }
    std::uint32_t rows[16], hidden[16];
    int expected = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        rows[i] = random.bits();
        hidden[i] = random.bits();
        expected += std::popcount(rows[i] & ~hidden[i]);
    }
    for (const TileKernels* set : kernels) {
        EXPECT_EQ(set->stroke.count_bits(rows, hidden), expected);
        std::uint32_t onto[16];
        std::copy_n(hidden, 16, onto);
        EXPECT_EQ(set->stroke.add_bits(rows, onto), expected);
        for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(onto[i], rows[i] | hidden[i]);
        EXPECT_EQ(set->stroke.add_bits(rows, onto), 0);
    }
}

TEST(TileKernels, FindPairsOfSurfacesThatAreNotPlainOrNotLevel) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        SampleTile tile;
        tile.reset(0, 0, random.integer(1, 40), random.integer(1, 20), 4);
        const int surfaces = random.integer(2, 12);
        for (std::size_t i = 0; i < tile.ids.size(); ++i) {  // the padding as well
            const int surface = random.integer(0, surfaces);
            if (surface == 0) continue;
            tile.ids[i] =
                static_cast<std::uint32_t>(2 * surface) | static_cast<std::uint32_t>(random.integer(0, 3) > 0);
            tile.nearness[i] = static_cast<float>(random.integer(0, 8));
        }
        SampleView view = view_of(tile);
        view.level = 0.5f;
        view.level_per_nearness = 0.25f;
        const auto is_pair = [&](std::size_t a, std::size_t b) {
            if (tile.ids[a] >> 1 == tile.ids[b] >> 1) return false;
            const float low = std::min(tile.nearness[a], tile.nearness[b]),
                        high = std::max(tile.nearness[a], tile.nearness[b]);
            return (tile.ids[a] & tile.ids[b] & 1) == 0 || !(high - low <= 0.25f * high + 0.5f);
        };
        std::vector<std::array<int, 3>> expected;
        for (int row = 0; row < tile.rows; ++row) {
            for (int column = 0; column < tile.columns; ++column) {
                const std::size_t at = tile.index(column, row);
                if (column + 1 < tile.columns && is_pair(at, at + 1)) expected.push_back({row, column, 0});
                const std::size_t below = at + static_cast<std::size_t>(tile.stride);
                if (row + 1 < tile.rows && is_pair(at, below)) expected.push_back({row, column, 1});
            }
        }
        for (const TileKernels* kernels : all_kernels()) {
            std::vector<SamplePair> pairs(2 * tile.ids.size() + kRoomBehindPairs);
            pairs.resize(kernels->walk.find_pairs(view, pairs.data()));
            std::vector<std::array<int, 3>> found;
            for (const SamplePair& p : pairs) found.push_back({p.row(), p.column(), p.down()});
            std::sort(found.begin(), found.end());
            EXPECT_EQ(found, expected) << kernels->name << ", seed " << seed;
        }
    }
}

}  // namespace
}  // namespace burin
