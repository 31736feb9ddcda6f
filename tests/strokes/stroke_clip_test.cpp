#include "strokes/stroke_clip.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/random.h"

namespace burin::stroke_clip_test {
namespace {

using test::Random;

constexpr int kSize = 40;

std::vector<ClipPiece> random_pieces(Random& random) {
    std::vector<ClipPiece> pieces(static_cast<std::size_t>(random.integer(1, 30)));
    for (ClipPiece& p : pieces) {
        p.from = {random.real(-8, kSize + 8), random.real(-8, kSize + 8)};
        const double length = random.integer(0, 6) == 0 ? 0 : std::pow(2.0, random.real(-6, 5));
        const double angle =
            random.integer(0, 4) == 0 ? 0.7853981633974483 * random.integer(0, 7) : random.real(0, 6.3);
        p.to = p.from + length * glm::dvec2(std::cos(angle), std::sin(angle));
        if (random.integer(0, 5) == 0) p.to.y = p.from.y;
        p.depth_from_px = random.real(0, 30);
        p.depth_to_px = p.depth_from_px + random.real(-3, 3);
        p.occludes = random.integer(0, 3) > 0;
        p.front_on_left = random.integer(0, 1) == 0;
    }
    return pieces;
}

std::vector<const ClipPiece*> boundaries_of(const std::vector<ClipPiece>& pieces) {
    std::vector<const ClipPiece*> boundaries;
    for (const ClipPiece& p : pieces) {
        if (p.occludes) boundaries.push_back(&p);
    }
    return boundaries;
}

StrokeSide random_side(Random& random) {
    return std::array{StrokeSide::both, StrokeSide::inside,
                      StrokeSide::outside}[static_cast<std::size_t>(random.integer(0, 2))];
}

int count(const StrokeMask& mask) {
    int bits = 0;
    for (const std::uint32_t row : mask.rows) bits += std::popcount(row);
    return bits;
}

TEST(StrokeClipper, HangsOnNoRectangle) {
    std::int64_t covered = 0;
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial);
        const std::vector<ClipPiece> pieces = random_pieces(random);
        const std::vector<const ClipPiece*> boundaries = boundaries_of(pieces);
        const double radius_px = std::pow(2.0, random.real(-2, 4));
        const StrokeSide side = random_side(random);
        StrokeClipper whole, part;
        StrokeCanvas on_whole, on_part;
        const int x0 = random.integer(0, 30), y0 = random.integer(0, 30), width = random.integer(1, kSize - x0),
                  height = random.integer(1, kSize - y0);
        whole.reset(0, 0, kSize, kSize);
        on_whole.reset(0, 0, kSize, kSize);
        part.reset(x0, y0, width, height);
        whole.set_boundaries(boundaries);
        part.set_boundaries(boundaries);
        on_part.reset(x0, y0, width, height);
        for (const ClipPiece& p : pieces) {
            whole.draw(p, radius_px, side, on_whole);
            part.draw(p, radius_px, side, on_part);
        }
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                ASSERT_EQ(on_part.at(x, y).rows, on_whole.at(x0 + x, y0 + y).rows)
                    << "trial " << trial << " at " << x << ',' << y;
                covered += count(on_part.at(x, y));
            }
        }
    }
    EXPECT_GT(covered, 1000000);
}

TEST(StrokeClipper, ManyStrokesAreTheUnionOfEach) {
    int full = 0;
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
        Random random(trial);
        const std::vector<ClipPiece> pieces = random_pieces(random);
        const std::vector<const ClipPiece*> boundaries = boundaries_of(pieces);
        const double radius_px = std::pow(2.0, random.real(1, 5));
        const StrokeSide side = random_side(random);
        StrokeClipper clipper;
        clipper.reset(0, 0, kSize, kSize);
        clipper.set_boundaries(boundaries);
        StrokeCanvas all, expected, one;
        all.reset(0, 0, kSize, kSize);
        expected.reset(0, 0, kSize, kSize);
        for (const ClipPiece& p : pieces) {
            clipper.draw(p, radius_px, side, all);
            one.reset(0, 0, kSize, kSize);
            clipper.draw(p, radius_px, side, one);
            for (int y = 0; y < kSize; ++y) {
                for (int x = 0; x < kSize; ++x) {
                    if (one.is_touched(x, y)) expected.add(x, y, one.at(x, y));
                }
            }
        }
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                ASSERT_EQ(all.at(x, y).rows, expected.at(x, y).rows) << "trial " << trial << " at " << x << ',' << y;
                full += all.is_full(x, y);
            }
        }
    }
    EXPECT_GT(full, 10000);
}

/// A pen that becomes narrower along a piece.
PenCone cone_along(const ClipPiece& piece, double radius_px, bool body_only) {
    PenCone cone{{piece.from.x, piece.from.y}, {piece.to.x, piece.to.y}, radius_px, 0.8 * radius_px};
    cone.body_only = body_only;
    return cone;
}

TEST(StrokeClipper, ListsWhatItDraws) {
    int listed = 0, whole = 0, cut = 0;
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial);
        const std::vector<ClipPiece> pieces = random_pieces(random);
        const std::vector<const ClipPiece*> boundaries = boundaries_of(pieces);
        const double radius_px = std::pow(2.0, random.real(-2, 4));
        const StrokeSide side = random_side(random);
        StrokeClipper clipper;
        clipper.reset(0, 0, kSize, kSize);
        clipper.set_boundaries(boundaries);
        std::vector<StrokeClipper::CutPixel> pixels;
        for (const ClipPiece& p : pieces) {
            const PenCone cone = cone_along(p, radius_px, random.integer(0, 1) == 0);
            StrokeCanvas drawn, from_list, pen;
            for (StrokeCanvas* c : {&drawn, &from_list, &pen}) c->reset(0, 0, kSize, kSize);
            clipper.draw(p, cone, side, drawn);
            pixels.clear();
            clipper.list(p, cone, side, pixels);
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                from_list.add(pixels[i].column, pixels[i].row, pixels[i].mask);
                ASSERT_TRUE(i == 0 || std::pair(pixels[i - 1].row, pixels[i - 1].column) <
                                          std::pair(pixels[i].row, pixels[i].column))
                    << "row by row, each pixel once";
            }
            listed += static_cast<int>(pixels.size());
            // Where no boundary may cut it, nothing is cut off.
            pen.draw(cone);
            const bool may_cut = clipper.may_cut(p, radius_px, side);
            bool is_cut = false;
            for (int y = 0; y < kSize; ++y) {
                for (int x = 0; x < kSize; ++x) {
                    ASSERT_EQ(from_list.at(x, y).rows, drawn.at(x, y).rows) << "trial " << trial;
                    is_cut = is_cut || drawn.at(x, y).rows != pen.at(x, y).rows;
                }
            }
            ASSERT_TRUE(may_cut || !is_cut) << "trial " << trial;
            whole += !may_cut;
            cut += is_cut;
        }
    }
    EXPECT_GT(listed, 100000);
    EXPECT_GT(whole, 500);
    EXPECT_GT(cut, 500);
}

// Boundaries are found by place where there are many: others farther away change nothing.
TEST(StrokeClipper, FarBoundariesChangeNothing) {
    std::int64_t cut = 0;
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial);
        const std::vector<ClipPiece> pieces = random_pieces(random);
        std::vector<const ClipPiece*> boundaries = boundaries_of(pieces);
        std::vector<ClipPiece> far(60);
        for (ClipPiece& p : far) {
            p.from = {random.real(-900, 900), random.real(150, 900)};
            p.to = p.from + glm::dvec2(random.real(-20, 20), random.real(-20, 20));
            p.occludes = true;
        }
        const double radius_px = std::pow(2.0, random.real(-2, 6));
        const StrokeSide side = random_side(random);
        StrokeClipper few, many;
        StrokeCanvas on_few, on_many;
        for (StrokeClipper* clipper : {&few, &many}) {
            if (clipper == &many) {
                for (const ClipPiece& p : far) boundaries.push_back(&p);
            }
            StrokeCanvas& canvas = clipper == &few ? on_few : on_many;
            canvas.reset(0, 0, kSize, kSize);
            clipper->reset(0, 0, kSize, kSize);
            clipper->set_boundaries(boundaries);
            for (const ClipPiece& p : pieces) clipper->draw(p, radius_px, side, canvas);
        }
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                ASSERT_EQ(on_few.at(x, y).rows, on_many.at(x, y).rows) << "trial " << trial << " at " << x << ',' << y;
                cut += count(on_few.at(x, y)) < 512;
            }
        }
    }
    EXPECT_GT(cut, 100000);
}

// Sheets side by side, all of which a wide stroke on the inside of each reaches: it is compared with those near it.
TEST(StrokeClipper, IsLinearInTheStrokesOnOneSide) {
    const auto comparisons = [](int count) {
        std::vector<ClipPiece> pieces;
        for (int i = -count; i < count; ++i) {
            for (const bool is_right : {false, true}) {
                ClipPiece p;
                p.from = {4.0 * i + (is_right ? 3 : 0) + 20.5, 5};
                p.to = p.from + glm::dvec2(0, 30);
                p.occludes = true;
                p.front_on_left = is_right == (p.to.y < p.from.y);
                pieces.push_back(p);
            }
        }
        const std::vector<const ClipPiece*> boundaries = boundaries_of(pieces);
        StrokeClipper clipper;
        StrokeCanvas canvas;
        clipper.reset(0, 0, kSize, kSize);
        canvas.reset(0, 0, kSize, kSize);
        clipper.set_boundaries(boundaries);
        for (const ClipPiece& p : pieces) clipper.draw(p, 512, StrokeSide::inside, canvas);
        return clipper.comparison_count();
    };
    const std::uint64_t few = comparisons(30), many = comparisons(120);
    EXPECT_GT(few, 0u);
    EXPECT_LT(many, 5 * few);
}

TEST(StrokeClipper, ADotIsCutOffAsAVeryShortStroke) {
    int cut = 0;
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
        Random random(trial);
        ClipPiece dot;
        dot.from = dot.to = {random.real(15, 25), random.real(15, 25)};
        dot.depth_from_px = dot.depth_to_px = 20;
        ClipPiece stroke = dot;
        stroke.to.x += 1e-7;
        ClipPiece edge;  // of a nearer surface
        const double angle = random.real(0, 6.3), away = random.real(-4, 4);
        const glm::dvec2 along(std::cos(angle), std::sin(angle));
        edge.from = dot.from + away * glm::dvec2(-along.y, along.x) - 30.0 * along;
        edge.to = edge.from + 60.0 * along;
        edge.occludes = true;
        edge.front_on_left = random.integer(0, 1) == 0;
        const std::vector<const ClipPiece*> boundaries{&edge};
        int bits[2] = {};
        for (const ClipPiece* p : {&dot, &stroke}) {
            StrokeClipper clipper;
            StrokeCanvas canvas;
            clipper.reset(0, 0, kSize, kSize);
            clipper.set_boundaries(boundaries);
            canvas.reset(0, 0, kSize, kSize);
            clipper.draw(*p, 5, StrokeSide::both, canvas);
            for (int y = 0; y < kSize; ++y) {
                for (int x = 0; x < kSize; ++x) bits[p == &stroke] += count(canvas.at(x, y));
            }
        }
        EXPECT_GT(bits[0], 1000) << "trial " << trial;
        EXPECT_NEAR(bits[0], bits[1], 20) << "trial " << trial;
        cut += bits[0] < 38000;
    }
    EXPECT_GT(cut, 50);
}

}  // namespace
}  // namespace burin::stroke_clip_test
