// What is near the ends of runs is found however many lines there are, and by any number of threads.

#include "lines/run_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/random.h"

namespace burin {
namespace {

/// A picture with room beside the lines that are looked at.
constexpr PixelRect kPicture{0, 0, 700, 300};

Projection parallel_projection() {
    Projection projection;
    projection.orthographic = true;
    return projection;
}

class Lines {
  public:
    /// Adds a run of one straight piece.
    void add(glm::dvec2 from, glm::dvec2 to, float nearness, bool occludes, bool is_hidden) {
        RunPiece piece;
        piece.piece.from = from;
        piece.piece.to = to;
        piece.piece.line = LineId::of_edge(static_cast<std::uint32_t>(runs.runs.size() / 2), 0);  // shared by two runs
        piece.piece.nearness_from = piece.piece.nearness_to = nearness;
        piece.piece.occludes = occludes;
        piece.piece.invisibility = is_hidden ? 1 : 0;
        piece.at_to_px = glm::distance(from, to);
        LineRun run;
        run.first = runs.pieces.size();
        run.count = 1;
        run.is_hidden = is_hidden;
        runs.pieces.push_back(piece);
        runs.runs.push_back(run);
    }
    void add_random(test::Random& random, glm::dvec2 low, glm::dvec2 high, int count, double longest_px) {
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 from(random.real(low.x, high.x), random.real(low.y, high.y));
            const double angle = random.real(0, 6.3), length = random.real(2.1, longest_px);
            add(from, from + length * glm::dvec2(std::cos(angle), std::sin(angle)),
                static_cast<float>(random.real(0, 9)), random.integer(0, 3) == 0, random.integer(0, 3) == 0);
        }
    }
    void find_ends(int threads = 1) { find_run_ends(runs, {}, parallel_projection(), kPicture, threads); }

    LineRuns runs;
};

void expect_equal(const LineRun& a, const LineRun& b) {
    EXPECT_EQ(a.ends, b.ends);
    EXPECT_EQ(a.gaps_px, b.gaps_px);
    EXPECT_EQ(a.onward_gaps_px, b.onward_gaps_px);
}

double distance_to(const LinePiece& piece, glm::dvec2 p) {
    const glm::dvec2 way = piece.to - piece.from;
    return glm::distance(p,
                         piece.from + way * std::clamp(glm::dot(p - piece.from, way) / glm::dot(way, way), 0.0, 1.0));
}

/// An edge that joins a corner and comes towards the eye hides nothing there, however its pieces are divided.
TEST(RunEnds, EdgesOfACornerDoNotHideEachOther) {
    for (const double first_px : {0.3, 1.0, 5.0}) {
        for (const bool is_joined : {true, false}) {
            Lines lines;
            lines.add({60, 100}, {100, 100}, 0, false, false);
            // Two pixels' widths nearer for each pixel; what is not joined begins so near.
            const double depth = is_joined ? 0 : -20;
            const double ends[] = {0, first_px, 11, 40};
            for (int i = 0; i < 3; ++i) {
                RunPiece piece;
                piece.piece.from = {100, 100 + ends[i]};
                piece.piece.to = {100, 100 + ends[i + 1]};
                piece.piece.line = LineId::of_edge(7, 0);
                piece.piece.nearness_from = static_cast<float>(2 * ends[i] - depth);
                piece.piece.nearness_to = static_cast<float>(2 * ends[i + 1] - depth);
                piece.piece.occludes = true;
                piece.at_from_px = ends[i];
                piece.at_to_px = ends[i + 1];
                lines.runs.pieces.push_back(piece);
            }
            LineRun run;
            run.first = 1;
            run.count = 3;
            lines.runs.runs.push_back(run);
            lines.find_ends();
            const LineRun& level = lines.runs.runs[0];
            EXPECT_EQ(level.ends[1], is_joined ? RunEnd::corner : RunEnd::occluded) << first_px;
            EXPECT_EQ(level.onward_gaps_px[1], is_joined ? kFarthestGapPx : 0) << first_px;
        }
    }
}

/// A hair on a longer line of its class is left out; one by itself, beside the line, or of another class is not.
TEST(RunEnds, HairsOnLongerLinesAreLeftOut) {
    Lines lines;
    lines.add({100, 100}, {200, 100}, 0, false, false);
    lines.add({150, 100.1}, {150.001, 100.1}, 0, false, false);
    for (const glm::dvec2 place : {glm::dvec2(150, 102), glm::dvec2(20, 20)})
        lines.add(place, place + glm::dvec2(0.001, 0), 0, false, false);
    lines.add({150, 100}, {150.001, 100}, 0, false, false);
    lines.runs.pieces.back().piece.drawn_as = LineClass::crease;
    lines.add({150, 100}, {150.001, 100}, 0, false, true);
    lines.add({150, 100}, {150.2, 100}, 0, false, false);  // no hair
    leave_out_hairs(lines.runs, kPicture);
    std::vector<double> begin;
    for (const LineRun& run : lines.runs.runs) {
        ASSERT_EQ(run.count, 1u);
        begin.push_back(lines.runs.pieces[run.first].piece.from.y);
    }
    EXPECT_EQ(begin, (std::vector<double>{100, 102, 20, 100, 100, 100}));
    EXPECT_EQ(lines.runs.pieces.size(), 6u);
}

class RandomLines : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomLines, HaveTheGapsToTheNearestOthers) {
    test::Random random(GetParam());
    Lines lines;
    lines.add_random(random, {100, 100}, {200, 200}, random.integer(2, 400), random.real(3, 90));
    lines.find_ends();
    for (std::size_t i = 0; i < lines.runs.runs.size(); ++i) {
        const LinePiece& own = lines.runs.pieces[i].piece;
        for (const std::size_t which : {0u, 1u}) {
            double nearest = 1e9;
            for (std::size_t k = 0; k < lines.runs.pieces.size(); ++k) {
                const bool counts = lines.runs.runs[i].is_hidden || !lines.runs.runs[k].is_hidden;
                if (k != i && counts)
                    nearest =
                        std::min(nearest, distance_to(lines.runs.pieces[k].piece, which == 0 ? own.from : own.to));
            }
            const double gap = std::clamp(nearest - 0.5, 0.0, static_cast<double>(kFarthestGapPx));
            EXPECT_NEAR(static_cast<double>(lines.runs.runs[i].gaps_px[which]), gap, 1e-5)
                << "seed " << GetParam() << " run " << i << " end " << which;
        }
    }
}

/// A crowd elsewhere, which makes cells smaller, changes nothing, and neither do threads.
TEST_P(RandomLines, AreMetByWhatIsNearAlone) {
    test::Random random(GetParam());
    Lines lines;
    lines.add_random(random, {100, 100}, {200, 200}, random.integer(2, 400), random.real(3, 90));
    Lines crowded = lines;
    crowded.add_random(random, {380, 20}, {680, 280}, 40000, 4);
    lines.find_ends();
    crowded.find_ends(3);
    int onward = 0;
    for (std::size_t i = 0; i < lines.runs.runs.size(); ++i) {
        SCOPED_TRACE("seed " + std::to_string(GetParam()) + " run " + std::to_string(i));
        expect_equal(lines.runs.runs[i], crowded.runs.runs[i]);
        for (const float gap : lines.runs.runs[i].onward_gaps_px) onward += gap > 0 && gap < kFarthestGapPx ? 1 : 0;
    }
    if (lines.runs.runs.size() > 200) {
        EXPECT_GT(onward, 0);
    }
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomLines, testing::Range<std::uint64_t>(0, 12));

}  // namespace
}  // namespace burin
