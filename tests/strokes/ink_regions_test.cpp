// Strokes over each other, beside a list of strokes for each sample.

#include "strokes/ink_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "strokes/ink_segment.h"
#include "tests/strokes/ink_picture.h"
#include "tests/support/random.h"

namespace burin::ink_regions_test {
namespace {

using namespace test;

constexpr int kSize = 64;

/// Many strokes of constant ink, each a chain of its own.
InkPicture random_strokes(std::uint64_t seed, int count) {
    Random random(seed);
    InkPicture picture(kSize, kSize);
    picture.paper = {0.25f, 0.5f, 0.75f, 1.0f};
    if (seed % 2 == 1) picture.paper *= 0.5f;
    const auto place = [&] { return glm::dvec2(random.real(-5, kSize + 5), random.real(-5, kSize + 5)); };
    for (int i = 0; i < count; ++i) {
        const float opacity = random.integer(0, 2) == 0 ? 1.0f : static_cast<float>(random.real(0.05, 0.95));
        InkPoint a = InkPicture::point(place(), static_cast<float>(random.real(1, 8)), opacity,
                                       {static_cast<float>(random.real(0, 1)), static_cast<float>(random.real(0, 1)),
                                        static_cast<float>(random.real(0, 1))});
        InkPoint b = a;
        b.place = place();
        a.nearness = b.nearness = static_cast<float>(-random.integer(1, 1000));
        InkStroke& stroke = picture.add({a, b});
        stroke.order.below = random.integer(-1, 1);
        stroke.order.is_hidden = random.integer(0, 3) == 0;
        stroke.order.drawn_as = random.integer(0, 1) == 0 ? LineClass::border : LineClass::crease;
        stroke.blend = random.integer(0, 4) == 0 ? InkBlend::multiply : InkBlend::over;
    }
    return picture;
}

/// The same, sample by sample, back to front, over what is below.
class SampleLists {
  public:
    explicit SampleLists(const InkedLines& lines) : lines_(lines), order_(lines.strokes.size()) {
        for (const InkStroke& stroke : lines.strokes) {
            StrokeCanvas& canvas = canvases_.emplace_back();
            canvas.reset(0, 0, kSize, kSize);
            const auto points = lines.points_of(stroke);
            canvas.draw(points[0].place, points[1].place, 0.5 * static_cast<double>(points[0].width_px));
        }
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return key(a) > key(b); });
    }

    template <typename Choose>
    glm::dvec4 over(int x, int y, glm::dvec4 below, const Choose& choose) const {
        glm::dvec4 sum(0.0);
        for (int row = 0; row < 16; ++row) {
            for (int column = 0; column < 32; ++column) {
                glm::dvec4 at = below;
                for (const std::size_t i : order_) {
                    if (!choose(lines_.strokes[i])) continue;
                    if ((canvases_[i].at(x, y).rows[static_cast<std::size_t>(row)] >> column & 1) == 0) continue;
                    const InkPoint& ink = lines_.points_of(lines_.strokes[i])[0];
                    const glm::dvec4 own(glm::dvec3(ink.color), 1.0);
                    const double alpha = static_cast<double>(ink.opacity);
                    if (lines_.strokes[i].blend == InkBlend::multiply) {
                        const glm::dvec4 both(glm::dvec3(at) * glm::dvec3(own), at.a);
                        at = at * (1 - alpha) + alpha * (both + (1 - at.a) * own);
                    } else {
                        at = at * (1 - alpha) + alpha * own;
                    }
                }
                sum += at;
            }
        }
        return sum / 512.0;
    }

  private:
    std::tuple<InkOrder, float, std::uint64_t> key(std::size_t i) const {
        const InkStroke& stroke = lines_.strokes[i];
        return {stroke.order, -lines_.points_of(stroke)[0].nearness, stroke.chain};
    }
    const InkedLines& lines_;
    std::vector<StrokeCanvas> canvases_;
    std::vector<std::size_t> order_;
};

TEST(InkRegions, AreWhatListsOfEachSampleSay) {
    double largest = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const InkPicture picture = random_strokes(seed, seed < 4 ? 20 : 250);
        const Image image = picture.draw();
        const SampleLists lists(picture.lines);
        Random random(seed);
        for (int trial = 0; trial < 250; ++trial) {
            const int x = random.integer(0, kSize - 1), y = random.integer(0, kSize - 1);
            const auto expect = [&](const std::string& layer, glm::dvec4 below, const auto& choose) {
                const glm::dvec4 real = lists.over(x, y, below, choose);
                for (int c = 0; c < 4; ++c) {
                    const double off = std::abs(at(image, layer + "RGBA"[c], x, y) - real[c]);
                    largest = std::max(largest, off);
                    ASSERT_LT(off, 0.004) << layer << "RGBA"[c] << " " << x << "," << y << " seed " << seed;
                }
            };
            expect("", glm::dvec4(picture.paper), [](const InkStroke&) { return true; });
            expect("lines.", glm::dvec4(0.0), [](const InkStroke& s) { return !s.order.is_hidden; });
            expect("lines_hidden.", glm::dvec4(0.0), [](const InkStroke& s) { return s.order.is_hidden; });
        }
    }
    RecordProperty("largest_error", std::to_string(largest));
}

/// Up to eight regions nothing is lost.
TEST(InkRegions, AreExactWhereTheyAreFew) {
    Random random(3);
    InkRegions regions(best_kernels(), false);
    for (int trial = 0; trial < 200; ++trial) {
        std::array<StrokeMask, 3> masks;
        std::array<InkSpot, 3> spots;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::uint32_t& row : masks[i].rows) row = random.bits();
            spots[i] = {
                &masks[i], {static_cast<float>(random.real(0, 1)), 0, 0}, static_cast<float>(random.real(0, 1))};
        }
        regions.reset();
        for (const InkSpot& spot : spots) regions.lay_below(spot);
        double color = 0, left = 0;
        for (std::size_t row = 0; row < 16; ++row) {
            for (int column = 0; column < 32; ++column) {
                double through = 1;
                for (const InkSpot& spot : spots) {
                    if ((spot.mask->rows[row] >> column & 1) == 0) continue;
                    color += through * static_cast<double>(spot.alpha * spot.color.r);
                    through *= 1 - static_cast<double>(spot.alpha);
                }
                left += through;
            }
        }
        const InkStack mean = regions.mean();
        ASSERT_NEAR(mean.color.r, color / 512, 1e-6);
        ASSERT_NEAR(mean.left, left / 512, 1e-6);
        int samples = 0;
        regions.for_regions([&](const StrokeMask&, int count, const InkStack&) { samples += count; });
        ASSERT_EQ(samples, 512);
    }
}

/// For filters, samples keep their own ink, opaque ones of different colours too.
TEST(InkRegions, InPlaceEachSampleHasWhatLiesOnIt) {
    Random random(4);
    InkRegions regions(best_kernels(), true);
    for (int trial = 0; trial < 200; ++trial) {
        std::array<StrokeMask, 5> masks;
        std::array<InkSpot, 5> spots;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            for (std::uint32_t& row : masks[i].rows) row = random.bits();
            const double alpha = i % 2 == 0 ? 1 : random.real(0, 1);
            spots[i] = {&masks[i], {static_cast<float>(random.real(0, 1)), 0, 0}, static_cast<float>(alpha)};
        }
        regions.reset();
        for (const InkSpot& spot : spots) regions.lay_below(spot);
        regions.for_regions([&](const StrokeMask& mask, int, const InkStack& stack) {
            for (std::size_t row = 0; row < 16; ++row) {
                for (int column = 0; column < 32; ++column) {
                    if ((mask.rows[row] >> column & 1) == 0) continue;
                    double color = 0, through = 1;
                    for (const InkSpot& spot : spots) {
                        if ((spot.mask->rows[row] >> column & 1) == 0) continue;
                        color += through * static_cast<double>(spot.alpha * spot.color.r);
                        through *= 1 - static_cast<double>(spot.alpha);
                    }
                    ASSERT_NEAR(stack.color.r, color, 1e-6);
                    ASSERT_NEAR(stack.left, through, 1e-6);
                }
            }
        });
    }
}

/// Thin opaque strokes cover the same part of a sample: one below another, as thin, is not seen.
TEST(InkRegions, SharesOfASampleLieOnEachOther) {
    StrokeMask all;
    for (std::uint32_t& row : all.rows) row = ~0u;
    InkSpot thin{&all, {1, 0, 0}, 0.25f, true}, thick{&all, {0, 1, 0}, 0.5f, true};
    InkStack stack;
    stack.lay_below(thin);
    stack.lay_below(thin);
    EXPECT_FLOAT_EQ(stack.left, 0.75f);
    stack.lay_below(thick);
    EXPECT_FLOAT_EQ(stack.left, 0.5f);
    EXPECT_FLOAT_EQ(stack.color.r, 0.25f);
    EXPECT_FLOAT_EQ(stack.color.g, 0.25f);
}

}  // namespace
}  // namespace burin::ink_regions_test
