// Variables of lines have the values that geometry gives them, on scenes simple enough to say which.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "mesh/shapes.h"
#include "tests/support/shaded_scene.h"

namespace burin {
namespace {

using namespace test;
using V = Variable;

/// A sheet that asks for all that can be known.
std::string all_of(const std::string& classes, const std::string& head = "") {
    return head + sheet_of(classes,
                           "width = \"=1 + 0 * (t + facing + gap + s_world + PO.x + N2.x + light + rand_chain)\"",
                           "qi = [0, 255]\nselect = \"qi + transmission >= 0\"");
}

constexpr const char* kTurnedBox = R"(
[camera]
eye = [3, 2.5, 6]
target = [0.2, 0.1, 0]
fov = 40
[[object]]
name = "box"
shape = "box"
size = [1, 2, 1.5]
scale = [2, 1, 0.5]
rotate = [10, 30, 20]
translate = [0.3, -0.2, 0.1]
)";

TEST(LineColumns, PlacesAndDepthsAreThoseOfTheProjection) {
    for (const std::string projection : {"", "projection = \"orthographic\"\nheight = 4\n"}) {
        std::string text = kTurnedBox;
        text.insert(text.find("[[object]]"), projection);
        const ShadedScene scene(text, all_of(R"("crease", "silhouette")"));
        const Frame frame = scene.frame(scene.whole());
        const Projection& p = frame.surfaces.projection;
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        const glm::dmat4 to_world(frame.camera.to_world), from_world = glm::inverse(to_world);
        const glm::dvec3 eye(to_world[3]);
        std::size_t count = 0;
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece& piece) {
            ++count;
            const glm::dvec2 place = columns.place(sample);
            EXPECT_FLOAT_EQ(columns.at(V::x, sample), static_cast<float>(place.x));
            EXPECT_FLOAT_EQ(columns.at(V::y, sample), static_cast<float>(place.y));
            // The position is seen at the place, at the depth, and lies on the box: one of its coordinates in the
            // object, before it was scaled, is that of a face, and on an edge two are.
            const glm::dvec3 position = columns.triple(V::P, sample);
            const glm::dvec3 view(from_world * glm::dvec4(position, 1));
            const double depth = static_cast<double>(columns.at(V::depth, sample));
            EXPECT_LT(glm::distance(p.to_pixel(view), place), 1e-3);
            EXPECT_NEAR(-view.z, depth, 1e-4 * depth);
            const double distance = projection.empty() ? glm::distance(position, eye) : depth;
            EXPECT_NEAR(static_cast<double>(columns.at(V::distance, sample)), distance, 1e-4 * depth);
            EXPECT_NEAR(static_cast<double>(columns.at(V::px_size, sample)),
                        projection.empty() ? depth / p.focal_px : 4.0 / 160, 1e-6);
            if (glm::distance(piece.from, piece.to) < 1) return;
            const glm::dvec3 in_object = glm::abs(columns.triple(V::PO, sample)) / glm::dvec3(0.5, 1, 0.75);
            int on_faces = 0;
            for (int k = 0; k < 3; ++k) {
                EXPECT_LT(in_object[k], 1.03);
                on_faces += std::abs(in_object[k] - 1) < 0.03;
            }
            EXPECT_GE(on_faces, 2);
        });
        EXPECT_GT(count, 100u);
    }
}

/// Both normals of a crease are those of the box's faces, and the lines' class says which variables are 0.
TEST(LineColumns, NormalsOfABoxAreThoseOfItsFaces) {
    const ShadedScene scene(kTurnedBox, all_of(R"("crease", "silhouette")"));
    const Frame frame = scene.frame(scene.whole());
    const FoundLines lines = scene.found();
    const ColumnsOfLines columns(lines);
    std::vector<glm::dvec3> normals;
    const SurfaceSet& surfaces = frame.surfaces;
    for (std::uint32_t t = 0; t < surfaces.instances[0].mesh->triangles.size(); ++t)
        normals.push_back(glm::dmat3(frame.camera.to_world) * surfaces.view_normal({0, t}));
    std::size_t creases = 0, contours = 0;
    columns.each([&](const LineSample& sample, const LineRun& run, const LinePiece& piece) {
        if (run.is_hidden || glm::distance(piece.from, piece.to) < 1) return;
        const glm::dvec3 n = columns.triple(V::N, sample), n2 = columns.triple(V::N2, sample);
        const glm::dvec3 to_eye = glm::normalize(glm::dvec3(frame.camera.to_world[3]) - columns.triple(V::P, sample));
        const auto is_of_face = [&](const glm::dvec3& v) {
            double most = -1;
            for (const glm::dvec3& face : normals) most = std::max(most, std::abs(glm::dot(face, v)));
            return most > 1 - 1e-5;
        };
        EXPECT_NEAR(glm::length(n), 1, 1e-5);
        EXPECT_TRUE(is_of_face(n));
        EXPECT_NEAR(static_cast<double>(columns.at(V::facing, sample)), std::max(glm::dot(n, to_eye), 0.0), 1e-4);
        EXPECT_EQ(columns.at(V::convex, sample), 1);
        EXPECT_NEAR(columns.at(V::dihedral, sample), 90, 0.01);  // the scale is along the edges
        EXPECT_EQ(columns.at(V::object, sample), 1);
        if (piece.occludes) {
            ++contours;
            EXPECT_EQ(columns.at(V::object2, sample), 0);
            EXPECT_TRUE(std::isinf(columns.at(V::gap, sample)));
            EXPECT_TRUE(std::isinf(columns.at(V::gap_px, sample)));
            EXPECT_EQ(n2, glm::dvec3(0));
            EXPECT_EQ(columns.at(V::facing2, sample), 0);
        } else {
            ++creases;
            EXPECT_TRUE(is_of_face(n2));
            EXPECT_LT(std::abs(glm::dot(n, n2)), 1e-4);
            EXPECT_EQ(columns.at(V::object2, sample), 1);
            EXPECT_EQ(columns.at(V::gap, sample), 0);
            EXPECT_NEAR(static_cast<double>(columns.at(V::facing2, sample)), glm::dot(n2, to_eye), 1e-4);
            EXPECT_LE(columns.at(V::facing2, sample), columns.at(V::facing, sample) + 0.02f);
        }
    });
    EXPECT_GT(creases, 20u);
    EXPECT_GT(contours, 20u);
}

/// A box before a wall: how far behind its outline the wall is, and whose it is.
TEST(LineColumns, TheGapIsTheWayToWhatIsSeenBehind) {
    for (const std::string projection : {"", "projection = \"orthographic\"\nheight = 4\n"}) {
        const ShadedScene scene("[camera]\neye = [0.7, 0.4, 6]\ntarget = [0, 0, 0]\nfov = 40\n" + projection + R"(
[[material]]
name = "red"
color = [0.8, 0.1, 0.2]
[[material]]
name = "blue"
color = [0.1, 0.2, 0.9]
[[object]]
name = "box"
shape = "box"
material = "red"
[[object]]
name = "wall"
shape = "box"
size = [40, 40, 0.1]
translate = [0, 0, -2.05]
material = "blue"
)",
                                all_of(R"("silhouette")"));
        const Frame frame = scene.frame(scene.whole());
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        const glm::dmat4 to_world(frame.camera.to_world);
        const Projection& p = frame.surfaces.projection;
        std::size_t count = 0;
        columns.each([&](const LineSample& sample, const LineRun& run, const LinePiece&) {
            if (run.is_hidden || columns.at(V::object, sample) != 1) return;
            ++count;
            EXPECT_EQ(columns.at(V::object2, sample), 2);
            EXPECT_EQ(columns.at(V::material, sample), 1);
            EXPECT_EQ(columns.at(V::material2, sample), 2);
            EXPECT_FLOAT_EQ(columns.at(V::C, sample, 0), 0.8f);
            EXPECT_FLOAT_EQ(columns.at(V::C2, sample, 2), 0.9f);
            // Along the ray, the wall's front is the plane z = -2.
            glm::dvec3 origin, direction;
            p.view_ray(columns.place(sample), origin, direction);
            const glm::dvec3 from(to_world * glm::dvec4(origin, 1)), way(glm::dmat3(to_world) * direction);
            const double wall = (-2 - from.z) / way.z, depth = static_cast<double>(columns.at(V::depth, sample));
            EXPECT_NEAR(static_cast<double>(columns.at(V::gap, sample)), wall - depth, 2e-3);
            EXPECT_NEAR(static_cast<double>(columns.at(V::gap_px, sample)),
                        static_cast<double>(columns.at(V::gap, sample)) / p.pixel_size(depth), 1e-2);
            EXPECT_NEAR(columns.triple(V::N2, sample).z, 1, 1e-5);
        });
        EXPECT_GT(count, 50u);
    }
}

TEST(LineColumns, ConvexTellsOuterEdgesFromInnerOnes) {
    // A step: its upper edge sticks out, its lower one goes inwards. Seen from above and in front.
    const auto soup = soup_of({{0, 0, 0},
                               {80, 0, 0},
                               {0, 20, -20},
                               {80, 20, -20},
                               {0, 20, -50},
                               {80, 20, -50},
                               {0, 60, -50},
                               {80, 60, -50},
                               {0, 60, -90},
                               {80, 60, -90}},
                              {{0, 1, 3, 2}, {2, 3, 5, 4}, {4, 5, 7, 6}, {6, 7, 9, 8}});
    for (const bool turned : {false, true}) {
        auto moved = transformed(soup, [](glm::dvec3 p) {
            return glm::dvec3(20 + p.x, 30 + 0.9 * p.y - 0.436 * p.z, 0.436 * p.y + 0.9 * p.z);
        });
        if (turned) {  // the side to which polygons are wound does not matter
            std::vector<std::vector<std::uint32_t>> polygons;
            for (std::size_t i = 0; i < moved.polygon_count(); ++i) {
                const auto own = moved.polygon(i);
                polygons.emplace_back(own.rbegin(), own.rend());
            }
            moved = soup_of(moved.positions, polygons);
        }
        const ShadedScene scene({moved}, pixel_camera(120, 160), all_of(R"("crease")"), 120, 160);
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        std::set<std::pair<int, int>> found;
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
            const double y = 160 - static_cast<double>(columns.at(V::y, sample));
            const int edge = std::abs(y - (30 + 18 + 8.72)) < 2   ? 1
                             : std::abs(y - (30 + 18 + 21.8)) < 2 ? 2
                             : std::abs(y - (30 + 54 + 21.8)) < 2 ? 3
                                                                  : 0;
            found.insert({edge, static_cast<int>(columns.at(V::convex, sample))});
        });
        EXPECT_EQ(found, (std::set<std::pair<int, int>>{{1, 1}, {2, -1}, {3, 1}})) << turned;
    }
}

/// Smooth surfaces: contours are at right angles to the line of sight, polygons' lines have the ball's normal.
TEST(LineColumns, NormalsOfABallAreThoseOfTheBall) {
    const ShadedScene scene(R"(
[camera]
eye = [0, 1, 5]
fov = 30
[[object]]
shape = "sphere"
radius = 1
segments = 96
rings = 48
)",
                            all_of(R"("silhouette", "polygon")"));
    const FoundLines lines = scene.found();
    const ColumnsOfLines columns(lines);
    std::size_t polygons = 0, contours = 0;
    columns.each([&](const LineSample& sample, const LineRun& run, const LinePiece& piece) {
        if (run.is_hidden || glm::distance(piece.from, piece.to) < 1) return;
        const glm::dvec3 n = columns.triple(V::N, sample), p = glm::normalize(columns.triple(V::P, sample));
        EXPECT_EQ(columns.at(V::dihedral, sample) == 0, piece.occludes);
        if (piece.occludes) {
            ++contours;
            EXPECT_NEAR(static_cast<double>(columns.at(V::facing, sample)), 0, 1e-3);
            EXPECT_GT(glm::dot(n, p), 0.995);
        } else {
            ++polygons;
            // At the rim, edges of a polygon are seen that the ball itself would hide.
            EXPECT_GT(glm::dot(n, p), columns.at(V::facing, sample) > 0.3f ? 0.9995 : 0.9979);
            EXPECT_EQ(columns.triple(V::N2, sample), n);
        }
    });
    EXPECT_GT(polygons, 1000u);
    EXPECT_GT(contours, 50u);
}

TEST(LineColumns, LightIsFromWhereTheSheetSays) {
    // A plane that faces the camera: N = (0, 0, 1) in camera space.
    const std::string plane = "[camera]\neye = [0, 0, 5]\n[[object]]\nshape = \"box\"\n";
    for (const auto& [light, expected] : {std::pair{"light = [0, 0, 1]\n", 1.0},
                                          {"light = [0, 3, 4]\n", 0.8},
                                          {"light = [0, 0, -1]\n", 0.0},
                                          {"", 1.0}}) {
        const ShadedScene scene(plane, all_of(R"("silhouette")", light));
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        columns.each([&](const LineSample& sample, const LineRun& run, const LinePiece&) {
            if (run.is_hidden) return;
            const double facing = static_cast<double>(columns.at(V::facing, sample));
            EXPECT_NEAR(static_cast<double>(columns.at(V::light, sample)), *light ? expected : facing, 1e-5) << light;
        });
    }
}

TEST(LineColumns, DirectionsAreCounterClockwiseFromLevel) {
    for (int deg = 0; deg < 180; deg += 7) {
        const double a = deg * std::numbers::pi / 180;
        const glm::dvec3 way(std::cos(a), std::sin(a), 0), across(-way.y, way.x, 0), middle(60, 50, 0);
        const glm::dvec3 p = middle - 30.0 * way, q = middle + 30.0 * way;
        const ShadedScene scene(
            {soup_of({p, q, q + 9.0 * across + glm::dvec3(0, 0, -9), p + 9.0 * across + glm::dvec3(0, 0, -9),
                      q - 9.0 * across + glm::dvec3(0, 0, -9), p - 9.0 * across + glm::dvec3(0, 0, -9)},
                     {{0, 1, 2, 3}, {1, 0, 5, 4}})},
            pixel_camera(120, 100), all_of(R"("crease")"), 120, 100);
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece& piece) {
            if (glm::distance(piece.from, piece.to) < 2) return;
            const double found = static_cast<double>(columns.at(V::direction, sample));
            EXPECT_LT(std::min(std::abs(found - deg), 180 - std::abs(found - deg)), 1) << deg;
            EXPECT_GE(found, 0);
            EXPECT_LT(found, 180);
        });
    }
}

/// A straight crease of 90 px, hidden from 30 to 50 px by a plate.
TEST(LineColumns, WaysAlongChainsCountWhatIsHidden) {
    const auto crease = soup_of({{10, 50, 0}, {100, 50, 0}, {100, 59, -9}, {10, 59, -9}, {100, 41, -9}, {10, 41, -9}},
                                {{0, 1, 2, 3}, {1, 0, 5, 4}});
    const auto plate = soup_of({{40, 20, 20}, {60, 20, 20}, {60, 80, 20}, {40, 80, 20}}, {{0, 1, 2, 3}});
    const ShadedScene scene({crease, plate}, pixel_camera(120, 100), all_of(R"("crease")"), 120, 100);
    const FoundLines lines = scene.found();
    ASSERT_EQ(lines.runs.runs.size(), 3u);
    const ColumnsOfLines columns(lines);
    columns.each([&](const LineSample& sample, const LineRun& run, const LinePiece&) {
        const double s = static_cast<double>(columns.at(V::x, sample)) - 10;
        EXPECT_NEAR(columns.at(V::s, sample), s, 0.01);
        EXPECT_NEAR(columns.at(V::length, sample), 90, 0.01);
        EXPECT_NEAR(columns.at(V::t, sample), s / 90, 1e-4);
        EXPECT_NEAR(columns.at(V::s_world, sample), s, 0.01);
        EXPECT_EQ(columns.at(V::closed, sample), 0);
        EXPECT_EQ(columns.at(V::qi, sample), run.is_hidden ? 1 : 0);
        const double begin = s < 30 ? 0 : s < 50 ? 30 : 50, end = s < 30 ? 30 : s < 50 ? 50 : 90;
        EXPECT_NEAR(columns.at(V::run_s, sample), s - begin, 0.3);
        EXPECT_NEAR(columns.at(V::run_length, sample), end - begin, 0.5);
        const double to_end = static_cast<double>(columns.at(V::end_distance, sample));
        if (begin == 0) {
            EXPECT_NEAR(to_end, s, 0.01);
        } else if (end == 90) {
            EXPECT_NEAR(to_end, 90 - s, 0.01);
        } else {
            EXPECT_TRUE(std::isinf(to_end));
        }
    });
}

TEST(LineColumns, SurfacesInFrontAreCountedAndLetLightThrough) {
    const std::string text = R"(
[camera]
projection = "orthographic"
height = 4
eye = [0, 0, 5]
[[material]]
name = "glass"
opacity = 0.25
[[object]]
name = "behind"
shape = "box"
size = [3, 0.4, 0.4]
rotate = [45, 0, 0]
translate = [0, 0.1, -2]
[[object]]
name = "pane"
shape = "plane"
size = [1, 3]
rotate = [90, 0, 0]
material = "glass"
[[object]]
name = "plate"
shape = "plane"
size = [0.5, 3]
rotate = [90, 0, 0]
translate = [1.1, 0, 1]
)";
    const ShadedScene scene(text, all_of(R"("crease")"));
    const FoundLines lines = scene.found();
    const ColumnsOfLines columns(lines);
    std::set<std::pair<int, float>> found[3];
    columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
        if (columns.at(V::object, sample) != 1 || std::abs(columns.at(V::y, sample) - 76) > 2) return;
        const double x = (static_cast<double>(columns.at(V::x, sample)) - 100) / 40;
        const int where = std::abs(x) < 0.45 ? 1 : std::abs(x - 1.1) < 0.2 ? 2 : std::abs(x + 1) < 0.3 ? 0 : -1;
        if (where < 0) return;
        found[where].insert(
            {static_cast<int>(columns.at(V::qi, sample)), std::round(columns.at(V::transmission, sample) * 100)});
    });
    EXPECT_TRUE(found[0].contains({0, 100.0f}));
    EXPECT_TRUE(found[1].contains({0, 75.0f}));
    EXPECT_TRUE(found[2].contains({1, 100.0f}));
}

/// Random numbers belong to objects and chains, wherever these stand in the file and however they are seen.
TEST(LineColumns, RandomNumbersStayWithTheirObjects) {
    const std::string a = "[[object]]\nname = \"a\"\nshape = \"box\"\n",
                      b = "[[object]]\nname = \"b\"\nshape = \"box\"\ntranslate = [2, 0, 0]\n",
                      camera = "[camera]\neye = [3, 2, 7]\nfov = 50\n",
                      other = "[camera]\neye = [3.1, 2.4, 6.5]\nfov = 50\n";
    using Numbers = std::set<std::tuple<std::string, float, float>>;
    const auto numbers = [](const std::string& text, std::uint32_t seed, std::uint32_t copy) {
        const ShadedScene scene(text, sheet_of(R"("crease")", "width = \"=1 + rand_chain\"", "qi = [0, 255]"));
        const FoundLines lines = scene.found();
        const ColumnsOfLines columns(lines);
        Numbers all;
        columns.each([&](const LineSample& sample, const LineRun&, const LinePiece&) {
            const SampleVariant variant{seed, copy, "all"};
            const auto object = static_cast<std::size_t>(columns.at(V::object, sample));
            const float of_object = columns.at(V::rand_object, sample, 0, variant),
                        of_chain = columns.at(V::rand_chain, sample, 0, variant);
            for (const float v : {of_object, of_chain}) EXPECT_TRUE(v >= 0 && v < 1);
            all.insert({lines.objects[object - 1].name, of_object, of_chain});
        });
        return all;
    };
    const Numbers one = numbers(camera + a + b, 0, 0);
    EXPECT_EQ(one, numbers(camera + b + a, 0, 0));
    EXPECT_EQ(one, numbers(other + a + b, 0, 0));
    EXPECT_NE(one, numbers(camera + a + b, 1, 0));
    EXPECT_NE(one, numbers(camera + a + b, 0, 1));
    // Edges that meet three at a corner are chains of their own: all have other numbers.
    EXPECT_EQ(one.size(), 24u);
    std::set<float> objects, chains;
    for (const auto& [name, object, chain] : one) {
        objects.insert(object);
        chains.insert(chain);
    }
    EXPECT_EQ(objects.size(), 2u);
    EXPECT_EQ(chains.size(), 24u);
}

TEST(LineColumns, FramesHaveTheirTime) {
    ShadedScene scene("[[object]]\nshape = \"box\"\n", all_of(R"("silhouette")"));
    scene.scene().frame.number = 12;
    scene.scene().frame.fps = 8;
    const FoundLines lines = scene.found();
    const ColumnsOfLines columns(lines);
    const LineSample sample{0, 0, 0.5};
    EXPECT_EQ(columns.at(V::frame, sample), 12);
    EXPECT_EQ(columns.at(V::time, sample), 1.5);
    EXPECT_EQ(columns.at(V::width_px, sample), 200);
    EXPECT_EQ(columns.at(V::height_px, sample), 160);
    EXPECT_EQ(columns.at(V::copy, sample, 0, {0, 3, ""}), 3);
}

}  // namespace
}  // namespace burin
