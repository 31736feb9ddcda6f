// Scenes become vector drawings.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "output/paths/arc.h"
#include "output/paths/make_paths.h"
#include "output/paths/simplify.h"
#include "output/svg.h"
#include "scene/plain_sheet.h"
#include "tests/support/rough_sphere.h"
#include "tests/support/shaded_scene.h"

namespace burin {
namespace {

using namespace test;

constexpr int kWidth = 240, kHeight = 180;
constexpr const char* kPlain =
    "style_version = 1\n[[set]]\nname='visible'\nstyle='ink'\nclasses=['silhouette','crease','intersection','border']\n"
    "[[set]]\nname='hidden'\nstyle='behind'\nqi=[1,255]\nclasses=['silhouette','crease','intersection','border']\n"
    "[style.ink]\nwidth=1\n[style.behind]\nwidth=0.5\ndash=[4,3]\n";

VectorDrawing drawing_of(ShadedScene& scene, const VectorOptions& given = {}, int threads = 1,
                         bool cuts_dashes = false) {
    scene.scene().names_lines = true;
    const FoundLines found = scene.found(threads);
    const Frame frame = scene.frame(scene.whole());
    std::vector<std::string> notes;
    VectorOptions options = given;
    if (options.crop == PixelRect{}) options.crop = scene.whole();
    VectorStats stats;
    return vector_drawing_of(ink_lines(found, *frame.sheet, threads, notes, {true, cuts_dashes}), found, options,
                             stats);
}

std::vector<glm::dvec2> flattened(const VectorDrawing& drawing, const VectorPath& path) {
    std::vector<glm::dvec2> points = {path.start};
    for (const PathStep& step : drawing.steps_of(path)) {
        std::vector<PathStep> parts = {step};
        if (step.kind == PathStep::Kind::arc) parts = cubics_of_arc(points.back(), step);
        for (const PathStep& part : parts) {
            const glm::dvec2 from = points.back();
            for (int i = 1; i <= 24; ++i) {
                const double t = i / 24.0, s = 1 - t;
                points.push_back(part.kind == PathStep::Kind::line
                                     ? glm::mix(from, part.to, t)
                                     : from * (s * s * s) + part.a * (3 * s * s * t) + part.b * (3 * s * t * t) +
                                           part.to * (t * t * t));
            }
        }
    }
    return points;
}

/// Of a sheet that alone draws what is found, ends of lines are looked at only where it reads them, and nothing else
/// becomes of it.
TEST(VectorDrawings, NeedEndsOnlyWhereTheyAreRead) {
    constexpr std::pair<const char*, bool> kStyles[] = {
        {"width = 1\ndash = [4, 3]", false},
        {"width = 3\ntaper = { start = 6, end = 6 }", true},
        {"width = 3\ntaper = { start = 6, end = 6, at = \"all\" }", false},
        {"width = 1\novershoot = 5", true},
        {"width = \"=1 + min(end_distance, 9) / 9\"", true},
        {"width = 1\nopacity = \"=t\"", false},
    };
    for (const auto& [style, reads_ends] : kStyles) {
        SCOPED_TRACE(style);
        Random random(4);
        std::vector<PolygonSoup> objects = {rough_sphere(random, 24, 0.4), make_box({1.1, 0.7, 0.9})};
        Camera camera;
        camera.to_world[3] = glm::dvec4(0, 0, 6, 1);
        const std::string sheet =
            "style_version = 1\n[[set]]\nname = 'all'\nstyle = 'ink'\nqi = [0, 255]\n"
            "classes = ['silhouette', 'crease', 'border']\n[style.ink]\n" +
            std::string(style) + "\n";
        ShadedScene scene(std::move(objects), camera, sheet.c_str(), kWidth, kHeight);
        scene.scene().names_lines = true;
        const std::string expected = svg_of(drawing_of(scene));
        scene.scene().draws_one_sheet = true;
        EXPECT_EQ(svg_of(drawing_of(scene)), expected);
        const FoundLines found = scene.found();
        const bool knows_ends = std::any_of(found.runs.runs.begin(), found.runs.runs.end(), [](const LineRun& run) {
            return run.ends[0] != RunEnd::free || run.gaps_px[0] < kFarthestGapPx;
        });
        EXPECT_EQ(knows_ends, reads_ends);
    }
}

/// How far it is, is told while paths are made.
TEST(VectorDrawings, TellProgress) {
    Random random(2);
    std::vector<PolygonSoup> objects = {rough_sphere(random, 24, 0.4), make_box({1.1, 0.7, 0.9})};
    Camera camera;
    camera.to_world[3] = glm::dvec4(0, 0, 6, 1);
    ShadedScene scene(std::move(objects), camera, kPlain, kWidth, kHeight);
    std::vector<double> told;
    Progress progress([&](double part) { told.push_back(part); }, std::chrono::milliseconds(0));
    VectorOptions options;
    options.progress = &progress;
    drawing_of(scene, options);
    ASSERT_GT(told.size(), 10u);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_GT(told.back(), 0.75);
}

std::string scene_with(const std::string& camera, const std::string& objects) {
    return "[camera]\n" + camera + "\n" + objects;
}

/// Every visible piece is covered by a path, and every path lies on pieces: within the tolerance, the sag of chords,
/// and what cleaning may take.
TEST(VectorDrawings, CoverAllPiecesAndNothingElse) {
    for (int trial = 0; trial < 6; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        std::vector<PolygonSoup> objects;
        for (int i = 0; i < 4; ++i) {
            PolygonSoup soup = i % 2 == 0 ? rough_sphere(random, 24, 0.4) : make_box({1.1, 0.7, 0.9});
            const glm::dvec3 to = random.in_box(0.9);
            for (glm::dvec3& p : soup.positions) p += to;
            objects.push_back(std::move(soup));
        }
        Camera camera;
        camera.to_world[3] = glm::dvec4(0, 0, 6, 1);
        ShadedScene scene(std::move(objects), camera, kPlain, kWidth, kHeight);
        const FoundLines found = scene.found();
        const VectorDrawing drawing = drawing_of(scene);
        for (const bool is_hidden : {false, true}) {
            std::vector<std::pair<glm::dvec2, glm::dvec2>> pieces, parts;
            for (const LineRun& run : found.runs.runs) {
                for (const RunPiece& p : found.runs.pieces_of(run)) {
                    if (p.piece.is_hidden() == is_hidden) pieces.emplace_back(p.piece.from, p.piece.to);
                }
            }
            for (const VectorGroup& group : drawing.groups) {
                // What is right behind visible lines is left out of hidden ones.
                if (group.is_hidden && !is_hidden) continue;
                for (const VectorPath& path : drawing.paths_of(group)) {
                    const auto points = flattened(drawing, path);
                    for (std::size_t i = 0; i + 1 < points.size(); ++i) parts.emplace_back(points[i], points[i + 1]);
                }
            }
            ASSERT_GT(parts.size(), 50u);
            const auto distance = [](glm::dvec2 p, const auto& lines) {
                double least = 1e9;
                for (const auto& [from, to] : lines) least = std::min(least, distance_to_part(p, from, to));
                return least;
            };
            double missed = 0, false_px = 0;
            for (const auto& [from, to] : pieces) missed = std::max(missed, distance(0.5 * (from + to), parts));
            for (const VectorGroup& group : drawing.groups) {
                if (group.is_hidden != is_hidden) continue;
                for (const VectorPath& path : drawing.paths_of(group)) {
                    for (const glm::dvec2 p : flattened(drawing, path))
                        false_px = std::max(false_px, distance(p, pieces));
                }
            }
            // A crumb is covered by ink of 1 pixel, not by a path; a hidden one has another line within a pixel.
            EXPECT_LT(missed, is_hidden ? 1.06 : 0.56) << trial;
            EXPECT_LT(false_px, 0.02 + 0.05 + 1.0 / 16 + 0.01) << trial;
        }
    }
}

TEST(VectorDrawings, ABoxHasClosedOutline) {
    const std::string scene = scene_with("eye=[3,2,4]\ntarget=[0,0,0]\n", "[[object]]\nshape='box'\nname='a box'\n");
    ShadedScene box(scene, sheet_of("'silhouette','crease'", "width=1"), kWidth, kHeight);
    const VectorDrawing drawing = drawing_of(box);
    ASSERT_EQ(drawing.groups.size(), 2u);
    std::size_t closed = 0;
    for (const VectorPath& path : drawing.paths) {
        if (!path.is_closed) continue;
        ++closed;
        EXPECT_EQ(path.step_count, 6u);
        EXPECT_EQ(drawing.steps_of(path).back().to, path.start);
    }
    EXPECT_EQ(closed, 1u);
    // Three creases meet in a corner: two of them are one path at most.
    EXPECT_LE(drawing.paths.size(), 4u);
}

/// Where four edges meet, each line goes on, whatever way it runs: one path leads from border to border.
TEST(VectorDrawings, LinesOfANetAreNotCutWhereTheyCross) {
    for (std::uint64_t trial = 0; trial < 40; ++trial) {
        Random random(trial);
        glm::dvec3 towards_eye = random.direction();
        towards_eye.y = std::abs(towards_eye.y) + 0.4;
        if (trial % 4 == 0) towards_eye.x = 0;  // lines along rows of pixels
        const glm::dvec3 eye = 8.0 * glm::normalize(towards_eye);
        const std::string camera = "eye=[" + std::to_string(eye.x) + "," + std::to_string(eye.y) + "," +
                                   std::to_string(eye.z) + "]\ntarget=[0,0,0]\n";
        const std::string net = "[[object]]\nshape='plane'\nsize=[3,3]\ncolumns=7\nrows=5\n";
        ShadedScene scene(scene_with(camera, net), sheet_of("'border','polygon'", "width=1"), kWidth, kHeight);
        const VectorDrawing drawing = drawing_of(scene);
        EXPECT_EQ(drawing.paths.size(), 6u + 4u + 1u) << trial;
    }
}

/// A plate ends just before a place where four edges meet: they end at its border, and do not go on to one another.
TEST(VectorDrawings, LinesEndAtWhatHidesTheirCorner) {
    constexpr double kPx = 0.02;
    int ends = 0;
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
        Random random(trial);
        const double hidden_px = random.real(0.02, 0.4), turn_deg = random.real(0, 360), turn = glm::radians(turn_deg);
        const glm::dvec2 corner_px(random.real(-0.5, 0.5), random.real(-0.5, 0.5));
        const glm::dvec2 inwards(std::cos(turn), -std::sin(turn));  // from the border into the plate
        const auto plane = [](const char* name, double size, int parts, double turned_deg, glm::dvec2 at_px, double y) {
            const glm::dvec2 at = kPx * at_px;
            return "[[object]]\nshape='plane'\nname='" + std::string(name) + "'\nsize=[" + std::to_string(size) + "," +
                   std::to_string(size) + "]\ncolumns=" + std::to_string(parts) + "\nrows=" + std::to_string(parts) +
                   "\nrotate=[0," + std::to_string(turned_deg) + ",0]\ntranslate=[" + std::to_string(at.x) + "," +
                   std::to_string(y) + "," + std::to_string(at.y) + "]\n";
        };
        const std::string camera = "eye=[0,10,0]\ntarget=[0,0,0]\nup=[0,0,-1]\nheight=" + std::to_string(kHeight * kPx);
        const std::string net = plane("net", 3, 2, random.real(0, 90), corner_px, 0);
        const std::string plate = plane("plate", 2, 1, turn_deg, corner_px + (50 - hidden_px) * inwards, 1);
        ShadedScene scene(scene_with(camera, net + plate), sheet_of("'border','polygon'", "width=1"), kWidth, kHeight);
        const VectorDrawing drawing = drawing_of(scene);
        for (const VectorPath& path : drawing.paths) {
            if (path.object == 0 || drawing.objects[path.object - 1] != "net") continue;
            for (const glm::dvec2& p : flattened(drawing, path)) {
                const glm::dvec2 from_corner = p - 0.5 * glm::dvec2(kWidth, kHeight) - corner_px;
                const double behind_px = glm::dot(from_corner, inwards) + hidden_px;
                if (glm::length(from_corner) > 10) continue;
                EXPECT_LT(behind_px, 0.03) << trial;
                ends += std::abs(behind_px) < 0.03;
            }
        }
    }
    EXPECT_GT(ends, 150);
}

TEST(VectorDrawings, PartsOfOneEdgeHaveOneName) {
    // A wall in front of the middle of a long box.
    const std::string scene = scene_with("eye=[0,1.5,8]\ntarget=[0,0,0]\n",
                                         "[[object]]\nshape='box'\nname='long'\nsize=[6,0.5,0.5]\n"
                                         "[[object]]\nshape='box'\nname='wall'\nsize=[1,3,0.2]\ntranslate=[0,0,2]\n");
    ShadedScene shaded(scene, kPlain, kWidth, kHeight);
    const VectorDrawing drawing = drawing_of(shaded);
    std::set<std::uint64_t> visible, hidden;
    for (const VectorGroup& group : drawing.groups) {
        for (const VectorPath& path : drawing.paths_of(group)) {
            if (path.object == 0 || drawing.objects[path.object - 1] != "long") continue;
            for (const std::uint64_t edge : drawing.edges_of(path)) (group.is_hidden ? hidden : visible).insert(edge);
        }
    }
    std::vector<std::uint64_t> both;
    std::set_intersection(visible.begin(), visible.end(), hidden.begin(), hidden.end(), std::back_inserter(both));
    EXPECT_GE(both.size(), 2u);
}

/// A path along many edges names some of them, and always those that go on behind a surface.
TEST(VectorDrawings, PathsOfManyEdgesNameTheirEnds) {
    // Lines of a grid, whose edges differ in name, pass below a slab from side to side.
    const std::string scene =
        scene_with("eye=[2,6,4]\ntarget=[0,0,0]\n",
                   "[[object]]\nshape='plane'\nname='grid'\nsize=[4,4]\ncolumns=50\nrows=50\n"
                   "[[object]]\nshape='box'\nname='slab'\nsize=[2.6,0.1,2.6]\ntranslate=[0.013,0.5,0]\n");
    std::string sheet = sheet_of("'polygon','border'", "width=1");
    sheet += "[[set]]\nname='hidden'\nstyle='behind'\nqi=[1,255]\nclasses=['polygon']\n[style.behind]\nwidth=0.5\n";
    ShadedScene shaded(scene, sheet, 3 * kWidth, 3 * kHeight);
    const VectorDrawing drawing = drawing_of(shaded);
    std::set<std::uint64_t> visible;
    std::vector<std::set<std::uint64_t>> hidden;
    for (const VectorGroup& group : drawing.groups) {
        for (const VectorPath& path : drawing.paths_of(group)) {
            if (path.object == 0 || drawing.objects[path.object - 1] != "grid") continue;
            const auto names = drawing.edges_of(path);
            EXPECT_LE(names.size(), kMostEdgeNames);
            EXPECT_TRUE(path.unnamed_edges == 0 || names.size() >= kMostEdgeNames - 2);
            if (!group.is_hidden) {
                visible.insert(names.begin(), names.end());
            } else if (path.unnamed_edges > 0) {
                hidden.emplace_back(names.begin(), names.end());
            }
        }
    }
    ASSERT_GE(hidden.size(), 50u);
    // At either side of the slab, but where a line is hidden from one edge on and not within it.
    std::ptrdiff_t both = 0;
    for (const std::set<std::uint64_t>& names : hidden) {
        const auto count = std::count_if(names.begin(), names.end(), [&](auto name) { return visible.contains(name); });
        EXPECT_GE(count, 1);
        both += count >= 2 ? 1 : 0;
    }
    EXPECT_GE(both, static_cast<std::ptrdiff_t>(hidden.size()) * 9 / 10);
    EXPECT_NE(svg_of(drawing).find("data-edge-count=\""), std::string::npos);
}

/// Names stay where the camera moves and objects come in another order.
TEST(VectorDrawings, NamesOfEdgesAreStable) {
    const std::string a = "[[object]]\nshape='box'\nname='a'\n",
                      b = "[[object]]\nshape='box'\nname='b'\ntranslate=[2,0,0]\n";
    const auto names = [&](const std::string& camera, const std::string& objects) {
        ShadedScene scene(scene_with(camera, objects), sheet_of("'silhouette','crease'", "width=1"), kWidth, kHeight);
        const VectorDrawing drawing = drawing_of(scene);
        return std::set<std::uint64_t>(drawing.edges.begin(), drawing.edges.end());
    };
    const auto first = names("eye=[3,2,6]\ntarget=[1,0,0]\n", a + b);
    EXPECT_EQ(first, names("eye=[3,2,6]\ntarget=[1,0,0]\n", b + a));
    EXPECT_EQ(first, names("eye=[3.1,2.1,6]\ntarget=[1,0,0]\n", a + b));
}

TEST(VectorDrawings, ThreadsChangeNothing) {
    for (const char* const style : {"technical", "pencil", "comic"}) {
        SceneDescription description = read_scene_file(BURIN_SOURCE_FOLDER "/scenes/still_life.toml", {},
                                                       BURIN_SOURCE_FOLDER "/styles/" + std::string(style) + ".toml");
        ShadedScene scene(std::move(description), kWidth, kHeight);
        const std::string one = svg_of(drawing_of(scene, {}, 1)), three = svg_of(drawing_of(scene, {}, 3));
        EXPECT_GT(one.size(), 5000u);
        EXPECT_TRUE(one == three) << style;
    }
}

TEST(VectorDrawings, AnEmptyOneIsAValidFile) {
    const std::string scene = scene_with("eye=[0,0,-5]\ntarget=[0,0,-9]\n", "[[object]]\nshape='box'\n");
    ShadedScene shaded(scene, kPlain, kWidth, kHeight);
    VectorDrawing drawing = drawing_of(shaded);
    EXPECT_TRUE(drawing.paths.empty());
    const std::string text = svg_of(drawing);
    EXPECT_NE(text.find("<svg "), std::string::npos);
    EXPECT_TRUE(text.ends_with("</svg>\n"));
}

TEST(VectorDrawings, NamesAreEscaped) {
    const std::string scene =
        scene_with("eye=[3,2,4]\ntarget=[0,0,0]\n", "[[object]]\nshape='box'\nname=\"<b> & \\\"🦊\\\" \\n\"\n");
    ShadedScene shaded(scene, sheet_of("'silhouette','crease'", "width=1"), kWidth, kHeight);
    const VectorDrawing by_class = drawing_of(shaded);
    EXPECT_NE(svg_of(by_class).find("data-object=\"&lt;b&gt; &amp; &quot;🦊&quot; &#10;\""), std::string::npos);
    VectorOptions options;
    options.grouping = VectorGrouping::object;
    EXPECT_NE(svg_of(drawing_of(shaded, options)).find("inkscape:label=\"&lt;b&gt; &amp; &quot;🦊&quot; &#10;\""),
              std::string::npos);
    EXPECT_EQ(svg_of(by_class, {false}).find("data-"), std::string::npos);
}

/// Layers of hidden lines by how many surfaces are in front.
TEST(VectorDrawings, HiddenLinesHaveLayersByInvisibility) {
    const std::string scene = scene_with("eye=[0.4,0.3,8]\ntarget=[0,0,0]\n",
                                         "[[object]]\nshape='box'\nname='far'\ntranslate=[0,0,-3]\n"
                                         "[[object]]\nshape='plane'\nname='near'\nsize=[4,4]\nrotate=[90,0,0]\n");
    ShadedScene shaded(scene, kPlain, kWidth, kHeight);
    VectorOptions options;
    options.grouping = VectorGrouping::invisibility;
    const std::string text = svg_of(drawing_of(shaded, options));
    const std::size_t two = text.find("\"3 hidden 2\""), one = text.find("\"2 hidden 1\""),
                      none = text.find("\"1 visible\"");
    EXPECT_NE(two, std::string::npos);
    EXPECT_LT(two, one);
    EXPECT_LT(one, none);
}

/// The look of [lines] as a sheet finds and draws what [lines] does.
TEST(PlainSheet, DrawsWhatLinesSay) {
    for (const char* const name : {"still_life", "crossing"}) {
        const std::string path = BURIN_SOURCE_FOLDER "/scenes/" + std::string(name) + ".toml";
        const std::vector<Override> looks = {{"lines.hidden.style", "\"solid\""},
                                             {"lines.hidden.width", "2"},
                                             {"lines.colors.crease", "\"#ff0000\""},
                                             {"lines.width", "1.5"}};
        ShadedScene plain(read_scene_file(path, looks), kWidth, kHeight);
        ShadedScene styled(read_scene_file(path, looks), kWidth, kHeight);
        styled.scene().sheet = std::make_shared<const StyleSheet>(plain_sheet(styled.scene().lines));
        Frame frame = plain.frame(plain.whole());
        frame.needs.whole_picture = true;  // sheets look for edges that another one covers, too
        const Image a = plain.draw(frame), b = styled.draw();
        double off = 0, ink = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                for (const char* const channel : {"lines.R", "lines.A", "lines_hidden.A"})
                    off += std::abs(value_at(a, channel, x, y) - value_at(b, channel, x, y));
                ink += value_at(a, "lines.A", x, y);
            }
        }
        EXPECT_LT(off, 0.002 * ink) << name;
    }
}

}  // namespace
}  // namespace burin
