// Steps from strokes to paths, one by one, and their text.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/interrupt.h"
#include "output/path_data.h"
#include "output/paths/chain_paths.h"
#include "output/paths/clean_paths.h"
#include "output/paths/clip_line.h"
#include "output/paths/cut_halos.h"
#include "output/paths/merge_strokes.h"
#include "output/paths/outline.h"
#include "output/xml_text.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using Points = std::vector<glm::dvec2>;
constexpr PixelRect kArea{0, 0, 400, 300};

/// Lines of one style that may be changed before they are joined or cleaned.
class Lines {
  public:
    Lines() { lines_.styles.emplace_back(); }
    PathLine& add(const Points& points, std::uint64_t edge = 1) {
        PathLine line;
        line.first_point = lines_.points.size();
        line.point_count = points.size();
        line.is_closed = points.size() > 2 && points.front() == points.back();
        line.first_edge = lines_.edges.size();
        line.edge_count = 1;
        line.chain = lines_.lines.size();
        lines_.edges.push_back(edge);
        lines_.points.insert(lines_.points.end(), points.begin(), points.end());
        lines_.lines.push_back(line);
        return lines_.lines.back();
    }
    PathLines& all() { return lines_; }
    PathLines chained() const { return chained_paths(lines_); }
    PathLines cleaned() const { return cleaned_paths(lines_, kArea); }

  private:
    PathLines lines_;
};

Points points_of(const PathLines& lines, std::size_t i) {
    const auto points = lines.points_of(lines.lines[i]);
    return {points.begin(), points.end()};
}

TEST(ChainPaths, ABoxIsOneClosedPath) {
    Lines lines;
    lines.add({{10, 10}, {50, 10}}, 1);
    lines.add({{50, 40}, {50, 10}}, 2);
    lines.add({{10, 40}, {50, 40}}, 3);
    lines.add({{10, 10}, {10, 40}}, 4);
    const PathLines chained = lines.chained();
    ASSERT_EQ(chained.lines.size(), 1u);
    EXPECT_TRUE(chained.lines[0].is_closed);
    EXPECT_EQ(points_of(chained, 0), (Points{{10, 10}, {50, 10}, {50, 40}, {10, 40}, {10, 10}}));
    EXPECT_EQ(chained.lines[0].edge_count, 4u);
}

TEST(ChainPaths, WhereThreeMeetTheStraightestGoOn) {
    Lines lines;
    lines.add({{0, 20}, {20, 20}});
    lines.add({{20, 20}, {40, 21}}, 2);
    lines.add({{20, 20}, {21, 40}}, 3);
    const PathLines chained = lines.chained();
    ASSERT_EQ(chained.lines.size(), 2u);
    EXPECT_EQ(points_of(chained, 0), (Points{{0, 20}, {20, 20}, {40, 21}}));
}

TEST(ChainPaths, WhereThreeMeetPartsOfOneEdgeGoOnFirst) {
    Lines lines;
    lines.add({{0, 20}, {20, 20}}, 7);
    lines.add({{20, 20}, {40, 20}}, 8);
    lines.add({{20, 20}, {38, 26}}, 7);
    const PathLines chained = lines.chained();
    ASSERT_EQ(chained.lines.size(), 2u);
    EXPECT_EQ(points_of(chained, 0), (Points{{0, 20}, {20, 20}, {38, 26}}));
}

TEST(ChainPaths, OtherKindsAndObjectsStayApart) {
    for (int what = 0; what < 4; ++what) {
        Lines lines;
        lines.add({{0, 20}, {20, 20}});
        PathLine& other = lines.add({{20, 20}, {40, 20}});
        if (what == 0) other.object = 5;
        if (what == 1) other.kind.order.is_hidden = true;
        if (what == 2) other.kind.order.drawn_as = LineClass::crease;
        if (what == 3) other.kind.order.set = 2;
        EXPECT_EQ(lines.chained().lines.size(), 2u) << what;
    }
}

TEST(ChainPaths, DashesGoOnWhereTheirPatternDoes) {
    for (const float phase : {2.0f, 4.0f}) {
        Lines lines;
        lines.all().styles[0].dash_px = {5, 4};
        lines.add({{0, 20}, {20, 20}});  // 20 = 2 * 9 + 2
        lines.add({{20, 20}, {40, 20}}).dash_phase_px = phase;
        EXPECT_EQ(lines.chained().lines.size(), phase == 2 ? 1u : 2u);
    }
}

/// What is shorter than a pixel goes on in the nearest line of its kind that ends close by.
TEST(ChainPaths, CrumbsGoOnOverSmallGaps) {
    for (int what = 0; what < 5; ++what) {
        Lines lines;
        lines.add({{0, 20}, {20, 20}});
        PathLine& crumb = lines.add({{20.2, 20}, {what == 1 ? 23 : 20.8, 20.1}}, 2);
        if (what == 2) crumb.kind.order.drawn_as = LineClass::crease;
        if (what == 3) {  // ends close by, but they go on in each other
            for (const glm::dvec2 to : {glm::dvec2(20, 0), glm::dvec2(20, 40), glm::dvec2(40, 20)})
                lines.add({{20, 20}, to});
        }
        const PathLines chained = chained_paths(lines.all(), what != 4);
        EXPECT_EQ(chained.lines.size(), what == 0 ? 1u : what == 3 ? 3u : 2u) << what;
    }
}

/// Many lines between few places: each of them is in one path, once.
TEST(ChainPaths, AllLinesAreInPathsOnce) {
    test::Random random(3);
    Lines lines;
    double length = 0;
    for (int i = 0; i < 300; ++i) {
        const auto place = [&] { return glm::dvec2(random.integer(0, 5) * 20, random.integer(0, 5) * 20); };
        const Points part = {place(), place()};
        if (part[0] == part[1]) continue;
        lines.add(part);
        length += glm::distance(part[0], part[1]);
    }
    const PathLines chained = lines.chained();
    EXPECT_LT(chained.lines.size(), 250u);
    for (std::size_t i = 0; i < chained.lines.size(); ++i) {
        const Points points = points_of(chained, i);
        for (std::size_t k = 1; k < points.size(); ++k) length -= glm::distance(points[k - 1], points[k]);
    }
    EXPECT_NEAR(length, 0, 1e-6);
}

TEST(CleanPaths, CrumbsGoWhereLongerInkCoversThem) {
    Lines lines;
    lines.add({{10, 20}, {90, 20}});
    lines.add({{30, 20.2}, {30.4, 20.4}});  // covered
    lines.add({{30, 22}, {30.4, 22.2}});    // by itself
    const PathLines cleaned = lines.cleaned();
    ASSERT_EQ(cleaned.lines.size(), 2u);
    EXPECT_EQ(points_of(cleaned, 1).front().y, 22);
}

TEST(CleanPaths, WhatRunsAlongAnotherLineIsCutOut) {
    Lines lines;
    lines.add({{10, 20}, {90, 20}});
    lines.add({{20, 40}, {30, 20.1}, {60, 20.1}, {70, 40}});
    const PathLines cleaned = lines.cleaned();
    ASSERT_EQ(cleaned.lines.size(), 3u);
    EXPECT_EQ(points_of(cleaned, 0).size(), 2u);
    for (const std::size_t i : {1u, 2u}) {
        const Points points = points_of(cleaned, i);
        for (const glm::dvec2 p : points) EXPECT_TRUE(p.x < 31 || p.x > 59) << p.x;
    }
}

TEST(CleanPaths, CrossingsAndShortMeetingsStay) {
    Lines lines;
    lines.add({{10, 20}, {90, 20}});
    lines.add({{20, 10}, {30, 30}});
    lines.add({{50, 10}, {51, 20}, {52, 20}, {53, 30}});
    const PathLines cleaned = lines.cleaned();
    EXPECT_EQ(cleaned.lines.size(), 3u);
    EXPECT_EQ(cleaned.points, lines.all().points);
}

/// A thin line over a wide one, a translucent one, and one of other colour above: none of them may go.
TEST(CleanPaths, OnlyInkThatCoversTakesThePlaceOfOther) {
    for (int what = 0; what < 4; ++what) {
        Lines lines;
        lines.all().styles.push_back(lines.all().styles[0]);
        VectorStyle& upper = lines.all().styles[1];
        if (what == 0) upper.width_px = 0.5f;
        if (what == 1) upper.opacity = 0.5f;
        if (what == 2) upper.dash_px = {3, 3};
        PathLine& lower = lines.add({{10, 20}, {80, 20}});
        lower.kind.order.is_hidden = true;
        lines.add({{10, 20}, {90, 20}}).kind.style = 1;
        EXPECT_EQ(lines.cleaned().lines.size(), what == 3 ? 1u : 2u) << what;
    }
}

/// Lines with a pattern are drawn once, too: those of one style, wherever theirs begins, and of one pattern and colour.
TEST(CleanPaths, DashesAreDrawnOnce) {
    for (int what = 0; what < 7; ++what) {
        Lines lines;
        lines.all().styles[0].dash_px = {8, 4};
        if (what == 4) lines.all().styles[0].opacity = 0.6f;
        lines.all().styles.push_back(lines.all().styles[0]);
        VectorStyle& upper = lines.all().styles[1];
        if (what == 2) upper.dash_px = {8, 5};
        if (what == 3) upper.color = {1, 0, 0};
        if (what == 5) upper.opacity = 0.6f;
        if (what == 6) upper.dash_px = {8.2f, 4.1f};  // stretched to fit its line
        lines.add({{10, 20}, {90, 20}}).kind.style = 1;
        PathLine& lower = lines.add({{40, 20.1}, {70, 20.1}, {70, 60}});
        lower.dash_phase_px = 5;
        lower.object = 2;
        if (what == 0) lower.kind.style = 1;
        const PathLines cleaned = lines.cleaned();
        ASSERT_EQ(cleaned.lines.size(), 2u);
        double length = 0;
        const Points rest = points_of(cleaned, 1);
        for (std::size_t k = 1; k < rest.size(); ++k) length += glm::distance(rest[k - 1], rest[k]);
        EXPECT_NEAR(length, what < 2 || what == 4 || what == 6 ? 39.9 : 69.9, 0.5) << what;
        // Its pattern is where it was.
        EXPECT_NEAR(cleaned.lines[1].dash_phase_px, std::fmod(5 + 69.9 - length, 12), 1e-3) << what;
    }
}

TEST(CleanPaths, CrumbsOfDashedLinesGo) {
    for (const bool is_dashed : {false, true}) {
        Lines lines;
        lines.all().styles[0].width_px = 0.4f;
        if (is_dashed) lines.all().styles[0].dash_px = {8, 4};
        lines.add({{10, 20}, {90, 20}});
        lines.add({{90, 20}, {90.4, 20}});  // goes on
        lines.all().styles.push_back(lines.all().styles[0]);
        if (is_dashed) lines.all().styles[1].dash_px = {0, 0.0001f};
        lines.add({{50, 20}, {50.00001, 20}}).kind.style = 1;
        lines.add({{30, 20}, {30.00001, 20}});  // nothing
        lines.add({{30, 22}, {30.00001, 22}});  // a dot by itself
        EXPECT_EQ(lines.cleaned().lines.size(), is_dashed ? 2u : 3u);
    }
}

/// The lower edge of a thin plate, whose dashes would blur the upper one: hidden lines go where ink touches ink.
TEST(CleanPaths, HiddenLinesBesideOthersGo) {
    for (int what = 0; what < 6; ++what) {
        Lines lines;
        lines.all().styles[0].width_px = 3;
        lines.all().styles.push_back(lines.all().styles[0]);
        lines.all().styles[1].width_px = 1.5f;
        lines.all().styles[1].dash_px = {18, 4.5f};
        const double touch_px = what < 3 ? 2.25 : 1.5;
        const double off = touch_px + (what % 3 == 1 ? 0.1 : -0.1);
        PathLine& upper = lines.add({{10, 20}, {90, 20}});
        if (what >= 3) upper.kind.style = 1, upper.kind.order.is_hidden = true;
        PathLine& lower = lines.add({{20, 20 + off}, {80, 20 + off}});
        lower.kind.style = 1;
        lower.kind.order.is_hidden = what != 2;
        if (what == 5) lines.all().lines[0].kind.order.is_hidden = lines.all().lines[1].kind.order.is_hidden = false;
        EXPECT_EQ(lines.cleaned().lines.size(), what % 3 == 0 ? 1u : 2u) << what;
    }
}

/// Hidden lines leave no specks: neither beside other lines, nor of a chain that has longer parts, nor with dashes.
TEST(CleanPaths, CrumbsOfHiddenLinesGo) {
    for (const bool is_hidden : {false, true}) {
        Lines lines;
        lines.all().styles.push_back(lines.all().styles[0]);
        lines.all().styles[1].dash_px = {8, 4};
        const auto add = [&](glm::dvec2 at, double length) -> PathLine& {
            PathLine& line = lines.add({at, at + glm::dvec2(length, 0)});
            line.kind.order.is_hidden = is_hidden;
            line.chain = 100 + lines.all().lines.size();
            return line;
        };
        add({10, 20}, 80);
        add({30, 20.9}, 0.6);               // beside it
        add({95, 20}, 0.6).chain = 101;     // of its chain
        add({30, 60}, 0.6).kind.style = 1;  // no dash
        add({30, 80}, 0.6);                 // by itself
        add({60, 80}, 0.3);
        EXPECT_EQ(lines.cleaned().lines.size(), is_hidden ? 3u : 6u);
    }
}

/// Adds a straight stroke.
void add_stroke(InkedLines& lines, glm::dvec2 from, glm::dvec2 to, float width_px, float nearness) {
    InkStroke stroke;
    stroke.first_point = lines.points.size();
    stroke.point_count = 2;
    stroke.chain = InkStroke::chain_of(static_cast<std::uint32_t>(lines.strokes.size()), 0);
    for (const glm::dvec2 place : {from, to}) {
        InkPoint p;
        p.place = place;
        p.width_px = width_px;
        p.nearness = nearness;
        lines.points.push_back(p);
    }
    lines.strokes.push_back(stroke);
    lines.origins.emplace_back();
}

TEST(CutHalos, LinesFarBehindEndBesideThem) {
    for (const float halo_px : {3.0f, 0.0f, 800.0f}) {
        InkedLines lines;
        add_stroke(lines, {10, 50}, {90, 50}, 2, 1);
        lines.strokes[0].halo_px = halo_px;
        add_stroke(lines, {40, 10}, {40, 90}, 1, 0.5f);
        add_stroke(lines, {60, 10}, {60, 90}, 1, 1);  // not behind
        Projection projection;
        projection.focal_px = 1000;
        const InkedLines cut = with_halos_cut(lines, projection, kArea);
        if (halo_px == 800) {  // all of it is erased
            EXPECT_EQ(cut.strokes.size(), 2u);
            continue;
        }
        ASSERT_EQ(cut.strokes.size(), halo_px > 0 ? 4u : 3u);
        ASSERT_EQ(cut.origins.size(), cut.strokes.size());
        if (halo_px == 0) continue;
        // Half the pen in front, the halo, and the round end.
        EXPECT_NEAR(cut.points_of(cut.strokes[1]).back().place.y, 45.5, 0.02);
        EXPECT_NEAR(cut.points_of(cut.strokes[2]).front().place.y, 54.5, 0.02);
        EXPECT_EQ(cut.points_of(cut.strokes[2]).front().width_px, 1);
    }
}

/// Between two halos there are lines, no dots.
TEST(CutHalos, LeaveNoDots) {
    // Of what is between, each halo takes 5 pixels; the pen is 2 wide.
    for (const double apart : {10.5, 11.9, 12.1, 14.0}) {
        InkedLines lines;
        for (const double x : {40.0, 40 + apart}) {
            add_stroke(lines, {x, 10}, {x, 90}, 2, 1);
            lines.strokes.back().halo_px = 3;
        }
        add_stroke(lines, {10, 50}, {90, 50}, 2, 0.5f);
        Projection projection;
        projection.focal_px = 1000;
        EXPECT_EQ(with_halos_cut(lines, projection, kArea).strokes.size(), apart > 12 ? 5u : 4u) << apart;
    }
}

/// A line that two sets draw, one over the other, is not behind itself, whatever rounding says of its depth.
TEST(CutHalos, OtherStrokesOfTheLineStay) {
    InkedLines lines;
    add_stroke(lines, {10, 50}, {90, 50}, 6, 1);
    lines.strokes[0].halo_px = 3;
    lines.strokes[0].halo_depth_px = {0, 10};
    add_stroke(lines, {10, 50}, {90, 50}, 3, 0.99f);
    lines.strokes[1].order.set = 1;
    lines.strokes[1].chain = lines.strokes[0].chain;
    Projection projection;
    projection.focal_px = 1000;
    const InkedLines cut = with_halos_cut(lines, projection, kArea);
    ASSERT_EQ(cut.strokes.size(), 2u);
    EXPECT_EQ(cut.points_of(cut.strokes[1]).back().place.x, 90);
}

TEST(ClipLine, LeavesWhatIsInside) {
    const Points line = {{-10, 5}, {20, 5}, {20, 30}, {5, 30}, {5, 8}};
    const auto parts = clipped_line(line, {0, 0}, {30, 20});
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].points, (Points{{0, 5}, {20, 5}, {20, 20}}));
    EXPECT_EQ(parts[0].begin_px, 10);
    EXPECT_EQ(parts[1].points, (Points{{5, 20}, {5, 8}}));
    EXPECT_EQ(parts[1].begin_px, 30 + 25 + 15 + 10);
    EXPECT_TRUE(clipped_line(Points{{-5, -5}, {-5, 50}}, {0, 0}, {30, 20}).empty());
}

TEST(MergeStrokes, ARunOfOtherWidthsIsOneStroke) {
    for (const bool is_one_width : {false, true}) {
        InkedLines lines;
        add_stroke(lines, {10, 50}, {30, 50}, 2, 1);
        add_stroke(lines, {30, 50}, {50, 52}, is_one_width ? 2 : 1, 1);
        add_stroke(lines, {50, 52}, {70, 54}, 2, 1);
        for (InkStroke& stroke : lines.strokes) stroke.chain = 4;
        add_stroke(lines, {70, 54}, {90, 50}, 1, 1);  // another run
        const InkedLines merged = with_runs_merged(lines);
        EXPECT_EQ(merged.strokes.size(), is_one_width ? 4u : 2u);
        EXPECT_EQ(merged.points.size(), 8u);
    }
}

TEST(Paths, EachStepCanBeStopped) {
    Lines lines;
    lines.add({{10, 20}, {90, 20}});
    lines.add({{90, 20}, {90, 60}});
    InkedLines strokes;
    add_stroke(strokes, {10, 50}, {90, 50}, 2, 1);
    strokes.strokes[0].halo_px = 3;
    const Projection projection;
    const StopFlag flag(true);
    const StopScope scope(flag);
    EXPECT_THROW(with_runs_merged(strokes), Interrupted);
    EXPECT_THROW(with_halos_cut(strokes, projection, kArea), Interrupted);
    EXPECT_THROW(path_lines_of(strokes, VectorGrouping::line_class, kArea), Interrupted);
    EXPECT_THROW(lines.chained(), Interrupted);
    EXPECT_THROW(lines.cleaned(), Interrupted);
}

TEST(Outline, IsAroundEachPointOfTheStroke) {
    test::Random random(5);
    for (int trial = 0; trial < 40; ++trial) {
        std::vector<InkPoint> stroke;
        glm::dvec2 place(100, 100);
        double angle = random.real(0, 6);
        for (int i = 0; i < 20; ++i) {
            InkPoint p;
            p.place = place;
            p.width_px = static_cast<float>(random.real(0.5, 4));
            stroke.push_back(p);
            angle += random.real(-0.4, 0.4);
            place += random.real(4, 8) * glm::dvec2(std::cos(angle), std::sin(angle));
        }
        Points outline;
        add_outline(stroke, true, false, outline);
        ASSERT_GT(outline.size(), 20u);
        EXPECT_EQ(outline.front(), outline.back());
        const auto winding = [&](glm::dvec2 p) {
            double turns = 0;
            for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
                const glm::dvec2 a = outline[i] - p, b = outline[i + 1] - p;
                turns += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
            }
            return std::lround(turns / 6.283185307);
        };
        for (const InkPoint& p : stroke) {
            for (int k = 0; k < 8; ++k) {
                const glm::dvec2 way(std::cos(k * 0.785), std::sin(k * 0.785));
                EXPECT_NE(winding(p.place + way * (0.5 * static_cast<double>(p.width_px) - 0.05)), 0) << trial;
            }
        }
    }
}

TEST(PathData, NumbersAreShort) {
    EXPECT_EQ(text_of_hundredths(0), "0");
    EXPECT_EQ(text_of_hundredths(-50), "-.5");
    EXPECT_EQ(text_of_hundredths(1205), "12.05");
    EXPECT_EQ(text_of_hundredths(-1200), "-12");
    EXPECT_EQ(short_number(508), "508");
    EXPECT_EQ(short_number(-0.00001), "0");
    EXPECT_EQ(short_number(0.30000001), "0.3");
}

/// Errors of rounding do not add up along a path.
TEST(PathData, EndsWhereThePathEnds) {
    VectorPath path;
    path.start = {0.004, 0.004};
    std::vector<PathStep> steps;
    for (int i = 1; i <= 1000; ++i) {
        PathStep step;
        step.to = {0.004 + 0.333 * i, 0.004};
        steps.push_back(step);
    }
    const std::string text = path_data(path, steps);
    ASSERT_EQ(text.substr(0, 5), "M0 0l");
    double x = 0;
    std::string number;
    bool is_x = true;
    for (const char c : text.substr(5) + " ") {
        if ((c == ' ' || c == '-') && !number.empty()) {
            if (is_x) x += std::stod(number);
            is_x = !is_x;
            number.clear();
        }
        if (c != ' ') number += c;
    }
    EXPECT_NEAR(x, 333.004, 0.005);
}

TEST(XmlText, SaysAllNames) {
    EXPECT_EQ(xml_text("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;'");
    EXPECT_EQ(xml_text("Größe 🦊\n\t"), "Größe 🦊&#10;&#9;");
    EXPECT_EQ(xml_text(std::string("a\x01\x7f") + '\0'), "a\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
    EXPECT_EQ(xml_text("\xff\xc3(\xed\xa0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD(\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
}

}  // namespace
}  // namespace burin
