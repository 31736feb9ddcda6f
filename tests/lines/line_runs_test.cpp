// Runs hold every drawn piece once, in the order of the line, and depend on nothing but the lines.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "mesh/shapes.h"
#include "tests/support/random.h"
#include "tests/support/shaded_scene.h"

namespace burin {
namespace {

using namespace test;

std::string all_classes() {
    std::string list;
    for (const std::string_view name : kLineClassNames)
        list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    return list;
}
const std::string kAllClasses = all_classes();
/// Sets that look for all lines, as runs with ends, hidden ones as well.
const std::string kAll = sheet_of(kAllClasses, "width = \"=1 + t\"", "qi = [0, 255]");
const std::string kVisible = sheet_of(kAllClasses, "width = \"=1 + t\"");
const std::string kCreases = sheet_of(R"("crease")", "width = \"=1 + t\"");

/// Boxes, balls, rings and loose triangles, turned and placed at random; they pass through each other.
std::vector<PolygonSoup> random_objects(std::uint64_t seed) {
    Random random(seed);
    std::vector<PolygonSoup> objects;
    for (int i = random.integer(2, 6); i > 0; --i) {
        const double size = random.real(15, 55);
        PolygonSoup soup;
        switch (random.integer(0, 4)) {
            case 0:
                soup = make_box(glm::dvec3(size));
                break;
            case 1:
                soup = make_sphere(0.5 * size, 12, 8);
                break;
            case 2:
                soup = make_torus(0.5 * size, 0.15 * size, 14, 8);
                break;
            case 3:
                soup = make_cylinder(0.3 * size, 0.2 * size, size, 12);
                break;
            default:
                soup = soup_of({{-size, -size, 0}, {size, -size, 3}, {0, size, 0}}, {{0, 1, 2}});
        }
        const glm::dvec3 axis = random.direction(),
                         place(random.real(10, 110), random.real(10, 90), random.real(-40, 40));
        const double turn = random.real(0, 6);
        objects.push_back(transformed(soup, [&](glm::dvec3 p) {
            const double c = std::cos(turn), s = std::sin(turn);
            return place + p * c + glm::cross(axis, p) * s + axis * (glm::dot(axis, p) * (1 - c));
        }));
    }
    return objects;
}
ShadedScene random_scene(std::uint64_t seed, const std::string& sheet) {
    return {random_objects(seed), pixel_camera(120, 100), sheet, 120, 100};
}

/// A piece without its direction: what it must have in common with a found one.
using Key = std::tuple<double, double, double, double, std::uint64_t, int, int, float, float>;
Key key_of(LinePiece p) {
    if (std::tie(p.to.x, p.to.y) < std::tie(p.from.x, p.from.y)) {
        std::swap(p.from, p.to);
        std::swap(p.nearness_from, p.nearness_to);
        p.front_on_left = !p.front_on_left;
    }
    return {p.from.x,
            p.from.y,
            p.to.x,
            p.to.y,
            p.line.bits,
            p.invisibility * 256 + p.transmission,
            p.occludes ? 1 + p.front_on_left : 0,
            p.nearness_from,
            p.nearness_to};
}

LineDrawing drawing_of(const Frame& frame) {
    Film film({0, 0, frame.width, frame.height}, frame.crop, LayerSet{}, frame.criteria.classes);
    RunOptions options;
    options.threads = 1;
    return find_drawing(frame, options, film);
}

class Runs : public ::testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Random, Runs, ::testing::Range<std::uint64_t>(0, 12));

TEST_P(Runs, HaveEachDrawnPieceOnce) {
    const ShadedScene scene = random_scene(GetParam(), kAll);
    const Frame frame = scene.frame(scene.whole());
    std::vector<Key> wanted, found;
    const LineDrawing drawing = drawing_of(frame);
    for (const auto& lists : {drawing.visible(), drawing.behind()}) {
        for (const auto& list : lists) {
            for (const LinePiece& p : list) {
                if (p.is_drawn && p.from != p.to) wanted.push_back(key_of(p));
            }
        }
    }
    const FoundLines lines = scene.found();
    std::size_t next = 0;
    for (const LineRun& run : lines.runs.runs) {
        EXPECT_EQ(run.first, next);  // no gaps, no piece twice
        EXPECT_GT(run.count, 0u);
        next = run.first + run.count;
    }
    EXPECT_EQ(next, lines.runs.pieces.size());
    for (const RunPiece& p : lines.runs.pieces) found.push_back(key_of(p.piece));
    std::sort(wanted.begin(), wanted.end());
    std::sort(found.begin(), found.end());
    EXPECT_GT(found.size(), 100u);
    // A short piece beside longer ones of its line may be missing.
    std::vector<Key> missing;
    std::set_difference(wanted.begin(), wanted.end(), found.begin(), found.end(), std::back_inserter(missing));
    EXPECT_EQ(found.size() + missing.size(), wanted.size());
    EXPECT_LE(missing.size(), wanted.size() / 50);
    for (const Key& key : missing)
        EXPECT_LT(std::hypot(std::get<2>(key) - std::get<0>(key), std::get<3>(key) - std::get<1>(key)), 1);
}

TEST_P(Runs, FollowTheirLine) {
    const ShadedScene scene = random_scene(GetParam(), kAll);
    const FoundLines lines = scene.found();
    for (const LineRun& run : lines.runs.runs) {
        const auto pieces = lines.runs.pieces_of(run);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const RunPiece& p = pieces[i];
            EXPECT_EQ(p.piece.is_hidden(), run.is_hidden);
            EXPECT_LE(p.at_from_px, p.at_to_px);
            // Where several lines meet within the distance of two samples, parts of them run askew.
            const double length = glm::distance(p.piece.from, p.piece.to);
            EXPECT_NEAR(p.at_to_px - p.at_from_px, length, length < 1 ? 0.5 : 0.03);
            EXPECT_GE(p.at_from_px, -0.5);
            EXPECT_LE(p.at_to_px, (run.chain_is_closed ? 2 : 1) * run.chain_length_px + 0.5);
            if (i == 0) continue;
            // Edges are sampled anew in each tile, so that parts of one overlap or gape by a part of a pixel.
            EXPECT_GT(p.at_to_px, pieces[i - 1].at_to_px - 1e-9);
            EXPECT_LE(p.at_from_px, pieces[i - 1].at_to_px + 0.5);
            EXPECT_GE(p.at_from_px, pieces[i - 1].at_from_px - 0.1);
            EXPECT_LE(glm::distance(pieces[i - 1].piece.to, p.piece.from), 1) << i << " of " << pieces.size();
        }
        if (run.is_closed) {
            EXPECT_LE(glm::distance(pieces.front().piece.from, pieces.back().piece.to), 0.75);
            EXPECT_NEAR(lines.runs.length_px(run), run.chain_length_px, 1);
        }
    }
}

// Of an edge that meets another polygon's for a part of it, only the rest is a line in every view. What is found along
// the other part, where the two gape on a large picture, stands along itself: the engine's fins have such edges.
TEST(RunsOfSeams, StayWithinTheirChains) {
    const ShadedScene scene(read_scene_file(std::string(BURIN_SOURCE_FOLDER) + "/scenes/engine.toml", {}), kVisible,
                            5760, 3240);
    const FoundLines lines = scene.found({3500, 1200, 3700, 1420}, 2);
    EXPECT_GT(lines.runs.runs.size(), 10u);
    for (const LineRun& run : lines.runs.runs) {
        if (run.chain_is_closed) continue;
        for (const RunPiece& p : lines.runs.pieces_of(run)) {
            // Pieces may cross the end of the part.
            const double length = glm::distance(p.piece.from, p.piece.to);
            EXPECT_GE(p.at_from_px, -0.5 - 0.5 * length);
            EXPECT_LE(p.at_to_px, run.chain_length_px + 0.5 + 0.5 * length);
        }
    }
}

/// What can be said of runs without saying in which order they are and how their pieces are cut.
std::vector<std::array<std::int64_t, 9>> content(const FoundLines& lines) {
    std::vector<std::array<std::int64_t, 9>> all;
    for (const LineRun& run : lines.runs.runs) {
        const auto pieces = lines.runs.pieces_of(run);
        const auto rounded = [](double v) { return std::llround(v * 1000); };
        const RunPiece &first = pieces.front(), &last = pieces.back();
        all.push_back(
            {rounded(first.piece.from.x), rounded(first.piece.from.y), rounded(last.piece.to.x),
             rounded(last.piece.to.y), rounded(first.at_from_px), rounded(last.at_to_px),
             static_cast<int>(run.ends[0]) * 16 + static_cast<int>(run.ends[1]) * 4 + run.is_closed * 2 + run.is_hidden,
             static_cast<std::int64_t>(run.chain_place), rounded(run.chain_length_px)});
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST_P(Runs, DoNotDependOnTheOrderOfPolygonsAndObjects) {
    std::vector<PolygonSoup> objects = random_objects(GetParam());
    const ShadedScene scene(objects, pixel_camera(120, 100), kAll, 120, 100);
    Random random(GetParam());
    for (PolygonSoup& soup : objects) {
        std::vector<std::vector<std::uint32_t>> polygons;
        for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
            const auto p = soup.polygon(i);
            polygons.emplace_back(p.begin(), p.end());
        }
        for (std::size_t i = polygons.size(); i > 1; --i)
            std::swap(polygons[i - 1], polygons[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
        soup = soup_of(soup.positions, polygons);
    }
    const ShadedScene shuffled(objects, pixel_camera(120, 100), kAll, 120, 100);
    const auto a = content(scene.found()), b = content(shuffled.found());
    ASSERT_EQ(a.size(), b.size());
    EXPECT_TRUE(a == b) << "run " << std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin();
}

TEST_P(Runs, DoNotDependOnThreadsAndCrops) {
    const ShadedScene scene = random_scene(GetParam(), kAll);
    const auto content_one = content(scene.found(1));
    EXPECT_TRUE(content_one == content(scene.found(3)));
    EXPECT_TRUE(content_one == content(scene.found({31, 20, 70, 77}, 2)));
}

/// The runs that have a piece near a place, and which of their ends are there.
std::vector<RunEnd> ends_near(const FoundLines& lines, glm::dvec2 place, bool is_hidden = false,
                              double reach_px = 1.5) {
    std::vector<RunEnd> ends;
    for (const LineRun& run : lines.runs.runs) {
        if (run.is_hidden != is_hidden) continue;
        const auto pieces = lines.runs.pieces_of(run);
        if (glm::distance(pieces.front().piece.from, place) < reach_px) ends.push_back(run.ends[0]);
        if (glm::distance(pieces.back().piece.to, place) < reach_px) ends.push_back(run.ends[1]);
    }
    return ends;
}

PolygonSoup rectangle(double x0, double y0, double x1, double y1, double z) {
    return soup_of({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2, 3}});
}
/// A strip folded along its middle, whose crease from (x0, y) to (x1, y) is the one line of that class.
PolygonSoup folded(double x0, double x1, double y, double z) {
    return soup_of(
        {{x0, y, z}, {x1, y, z}, {x1, y + 9, z - 9}, {x0, y + 9, z - 9}, {x1, y - 9, z - 9}, {x0, y - 9, z - 9}},
        {{0, 1, 2, 3}, {1, 0, 5, 4}});
}

TEST(RunEnds, SayWhatStopsALine) {
    // A crease from x = 20 to the frame, behind a plate at x = 60 to 80. y runs up in the scene.
    for (const bool looks_for_hidden : {false, true}) {
        for (const bool draws_borders : {false, true}) {
            const std::string classes = draws_borders ? R"("crease", "border")" : R"("crease")";
            const ShadedScene scene({folded(20.3, 300, 50.4, 0), rectangle(60, 30, 80, 70, 30)}, pixel_camera(120, 100),
                                    sheet_of(classes, "width = \"=1 + t\"", looks_for_hidden ? "qi = [0, 255]" : ""),
                                    120, 100);
            const FoundLines lines = scene.found();
            SCOPED_TRACE(std::to_string(looks_for_hidden) + std::to_string(draws_borders));
            const double y = 100 - 50.4;
            // At x = 20.3 borders go on, if they are drawn.
            for (const RunEnd end : ends_near(lines, {20.3, y}))
                EXPECT_EQ(end, draws_borders ? RunEnd::corner : RunEnd::free);
            EXPECT_EQ(ends_near(lines, {60, y}), std::vector{RunEnd::occluded});
            EXPECT_EQ(ends_near(lines, {80, y}), std::vector{RunEnd::occluded});
            std::size_t frames = 0;
            for (const LineRun& run : lines.runs.runs)
                frames += static_cast<std::size_t>(std::count(run.ends.begin(), run.ends.end(), RunEnd::frame));
            EXPECT_EQ(frames, draws_borders ? 3u : 1u);
            EXPECT_EQ(ends_near(lines, {60, y}, true).size(), looks_for_hidden ? 1u : 0u);
        }
    }
}

/// A line that goes around a body is not free where it leaves the visible side, whatever else is drawn.
TEST(RunEnds, OfALineAroundABodyAreOccludedAtTheContour) {
    for (const std::string set : {"", "qi = [0, 255]"}) {
        for (const std::string classes : {R"("crease")", R"("crease", "silhouette")"}) {
            // A cylinder's lower rim, seen from above: its front half is seen. The upper one is a loop.
            const ShadedScene scene({transformed(make_cylinder(30, 30, 40, 48),
                                                 [](glm::dvec3 p) {
                                                     return glm::dvec3(60 + p.x, 50 + 0.8 * p.y - 0.6 * p.z,
                                                                       0.6 * p.y + 0.8 * p.z);
                                                 })},
                                    pixel_camera(120, 100), sheet_of(classes, "width = \"=1 + t\"", set), 120, 100);
            const FoundLines lines = scene.found();
            std::size_t loops = 0, occluded = 0;
            for (const LineRun& run : lines.runs.runs) {
                if (run.is_hidden || run.chain_place == 0) continue;
                loops += run.is_closed;
                if (!run.is_closed)
                    occluded +=
                        static_cast<std::size_t>(std::count(run.ends.begin(), run.ends.end(), RunEnd::occluded));
                EXPECT_TRUE(run.chain_is_closed);
            }
            EXPECT_EQ(loops, 1u) << set << classes;
            EXPECT_EQ(occluded, 2u) << set << classes;
        }
    }
}

/// A contour has no chain beyond what is seen of it: only the nearer surface's own contour tells why it ends.
TEST(RunEnds, OfAContourBehindAnotherObjectAreOccluded) {
    const auto ball_at = [](double x, double z) {
        return transformed(make_sphere(25, 64, 32), [=](glm::dvec3 p) { return glm::dvec3(x, 50, z) + p; });
    };
    const ShadedScene scene({ball_at(45, 0), ball_at(75, 80)}, pixel_camera(120, 100),
                            sheet_of(R"("silhouette")", "width = \"=1 + t\""), 120, 100);
    const FoundLines lines = scene.found();
    int loops = 0, arcs = 0;
    for (const LineRun& run : lines.runs.runs) {
        if (lines.runs.length_px(run) < 8) continue;
        (run.is_closed ? loops : arcs) += 1;
        if (run.is_closed) continue;
        EXPECT_EQ(run.ends, (std::array{RunEnd::occluded, RunEnd::occluded}));
    }
    EXPECT_EQ(loops, 1);
    EXPECT_EQ(arcs, 1);
}

/// Seen from a side, the inner contour of a ring ends at cusps: nothing stops it there.
TEST(RunEnds, AreFreeAtCusps) {
    for (const std::string contours : {"mesh", "smooth"}) {
        ShadedScene scene({transformed(make_torus(40, 15, 96, 48),
                                       [](glm::dvec3 p) {
                                           return glm::dvec3(100 + p.x, 80 + 0.954 * p.y - 0.3 * p.z,
                                                             0.3 * p.y + 0.954 * p.z);
                                       })},
                          pixel_camera(200, 160), sheet_of(R"("silhouette")", "width = \"=1 + t\""), 200, 160);
        scene.scene().lines.contours = contours == "smooth" ? Contours::smooth : Contours::mesh;
        const FoundLines lines = scene.found();
        int arcs = 0, loops = 0, free_ends = 0;
        for (const LineRun& run : lines.runs.runs) {
            if (lines.runs.length_px(run) < 8) continue;
            (run.is_closed ? loops : arcs) += 1;
            if (!run.is_closed)
                free_ends += static_cast<int>(std::count(run.ends.begin(), run.ends.end(), RunEnd::free));
        }
        EXPECT_EQ(loops, 1) << contours;  // the outline is one line, over all triangles
        if (contours == "mesh") {
            EXPECT_EQ(free_ends, 2);
        }
        EXPECT_EQ(arcs, 1) << contours;
    }
}

/// The gaps at the end of the run that begins near a place, (0: its nearest to anything, 1: onward).
std::array<float, 2> gaps_from(const FoundLines& lines, glm::dvec2 begin) {
    for (const LineRun& run : lines.runs.runs) {
        const auto pieces = lines.runs.pieces_of(run);
        if (glm::distance(pieces.front().piece.from, begin) < 1) return {run.gaps_px[1], run.onward_gaps_px[1]};
        if (glm::distance(pieces.back().piece.to, begin) < 1) return {run.gaps_px[0], run.onward_gaps_px[0]};
    }
    ADD_FAILURE() << "no run begins at " << begin.x << ", " << begin.y;
    return {};
}

TEST(RunEnds, KnowHowFarIsWhatMayStopThem) {
    const auto turned = [](PolygonSoup soup) {
        return transformed(soup, [](glm::dvec3 p) { return glm::dvec3(p.y, p.x, p.z); });
    };
    // Each crease ends at x = 60. What is after it: another that goes on, so many pixels farther; or one across it.
    for (const double gap : {1.0, 3.0, 9.0, 14.0, 40.0}) {
        const ShadedScene scene({folded(20, 60, 80, 0), folded(60 + gap, 110, 80, 0), folded(20, 60, 40, 0),
                                 turned(folded(20, 60, 60 + gap, 0))},
                                pixel_camera(120, 100), kCreases, 120, 100);
        const FoundLines lines = scene.found();
        const double expected = std::min(gap - 0.5, static_cast<double>(kFarthestGapPx));
        const auto [ahead, onward] = gaps_from(lines, {20, 20});
        EXPECT_NEAR(static_cast<double>(ahead), expected, 0.02) << gap;
        EXPECT_NEAR(static_cast<double>(onward), expected, 0.02) << gap;
        const auto [across, onward_across] = gaps_from(lines, {20, 60});
        EXPECT_NEAR(static_cast<double>(across), expected, 0.02) << gap;
        EXPECT_EQ(onward_across, kFarthestGapPx) << gap;
    }
}

TEST_P(Runs, OfContoursHaveTheSurfaceOnTheirLeft) {
    const ShadedScene scene = random_scene(GetParam(), kAll);
    const LineRuns runs = scene.found().runs;
    for (const LineRun& run : runs.runs) {
        if (run.chain_place != 0) continue;
        double on_left = 0;
        for (const RunPiece& p : runs.pieces_of(run)) {
            if (p.piece.occludes) on_left += (p.piece.front_on_left ? 1 : -1) * glm::distance(p.piece.from, p.piece.to);
        }
        EXPECT_GE(on_left, 0) << "seed " << GetParam();
    }
}

}  // namespace
}  // namespace burin
