// What each line class means, on scenes where the answer is known.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::classes_test {
namespace {

using namespace test;

glm::dvec2 pixel_of(const Camera& camera, int width, int height, const glm::dvec3& world) {
    const Projection p = camera.projection(width, height, 0);
    return p.to_pixel(glm::dvec3(camera.to_view() * glm::dvec4(world, 1)));
}

/// A rectangle in the plane z = const of the pixel camera.
PolygonSoup rectangle(double x0, double y0, double x1, double y1, double z) {
    return soup_of({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2, 3}});
}

TEST(Cube, ShowsExactlyNineEdges) {
    constexpr int kSize = 200;
    const PolygonSoup box = make_box({1, 1, 1});
    for (const glm::dvec3 eye : {glm::dvec3(2, 1.5, 3), glm::dvec3(-3, 2, 1.2), glm::dvec3(1.4, -2.2, -3)}) {
        const Camera camera = perspective_camera(eye, {0, 0, 0});
        for (const LineClassSet classes :
             {kDefaultLineClasses, LineClassSet(LineClass::polygon), LineClassSet(LineClass::crease)}) {
            Scene scene = scene_of({box});
            scene.lines.classes = classes;
            const Drawing drawing(scene, camera, kSize, kSize);
            int shown = 0, hidden = 0;
            for (int i = 0; i < 8; ++i) {
                for (const int bit : {1, 2, 4}) {
                    if ((i & bit) != 0) continue;
                    const glm::dvec2 a = pixel_of(camera, kSize, kSize, box.positions[static_cast<std::size_t>(i)]);
                    const glm::dvec2 b =
                        pixel_of(camera, kSize, kSize, box.positions[static_cast<std::size_t>(i | bit)]);
                    const double share = drawing.drawn_share(a, b, 6);
                    shown += share > 0.99;
                    hidden += share < 0.15;  // other edges may cross it in the picture
                }
            }
            EXPECT_EQ(shown, 9) << to_string(classes);
            EXPECT_EQ(hidden, 3) << to_string(classes);
        }
    }
}

TEST(Cube, OutlineIsSilhouetteAndTheThreeInnerEdgesAreCreases) {
    const Drawing d(scene_of({make_box({1, 1, 1})}), perspective_camera({2, 1.5, 3}, {0, 0, 0}), 200, 200);
    EXPECT_GT(d.sum(LineClass::silhouette), 1.5 * d.sum(LineClass::crease));
    EXPECT_GT(d.sum(LineClass::crease), 100);
    EXPECT_EQ(d.sum(LineClass::border), 0);
    EXPECT_EQ(d.sum(LineClass::intersection), 0);
}

TEST(SmoothClosedSurface, HasASilhouetteAndNothingElse) {
    for (const PolygonSoup& soup : {make_sphere(0.5, 48, 24), make_torus(0.5, 0.2, 64, 32)}) {
        const Drawing d(scene_of({soup}), perspective_camera({1, 2, 2.5}, {0, 0, 0}), 160, 160);
        EXPECT_GT(d.sum(LineClass::silhouette), 100);
        for (const LineClass c : {LineClass::border, LineClass::crease, LineClass::intersection, LineClass::object}) {
            EXPECT_EQ(d.sum(c), 0) << name_of(c);
        }
    }
}

TEST(OpenSheet, EndsInABorder) {
    const Drawing d(scene_of({rectangle(20.3, 20.3, 80.3, 60.3, 0)}), pixel_camera(100, 100), 100, 100);
    EXPECT_EQ(d.sum(LineClass::silhouette), 0);
    // Perimeter 200 px, 1 px wide; corners of a city-block stroke miss a little.
    EXPECT_NEAR(d.sum(LineClass::border), 200, 3);
}

TEST(CrossingQuads, GiveOneIntersectionOfTheAnalyticLength) {
    // Two rectangles turned by +-45 degrees about the vertical axis x = 50; they cross along it.
    const auto turned = [](double sign) {
        return soup_of({{20, 20, sign * -30}, {80, 20, sign * 30}, {80, 75, sign * 30}, {20, 75, sign * -30}},
                       {{0, 1, 2, 3}});
    };
    for (const bool one_object : {false, true}) {
        PolygonSoup a = turned(1), b = turned(-1);
        std::vector<PolygonSoup> objects = {a, b};
        if (one_object) {
            for (const glm::dvec3& p : b.positions) a.positions.push_back(p);
            a.add_polygon(std::vector<std::uint32_t>{4, 5, 6, 7});
            objects = {a};
        }
        const Drawing d(scene_of(objects), pixel_camera(100, 100), 100, 100);
        EXPECT_NEAR(d.sum(LineClass::intersection), 55, 1.5) << one_object;
        EXPECT_GT(d.drawn_share({50, 27}, {50, 78}), 0.999);
        EXPECT_EQ(d.sum(LineClass::crease), 0);
        EXPECT_EQ(d.sum(LineClass::object), 0);
    }
}

TEST(Crease, DependsOnTheAngleAlone) {
    // Two rectangles that meet at x = 50 at a dihedral angle; seen from the front.
    for (const double angle_deg : {10.0, 39.0, 41.0, 80.0}) {
        const double rise = 30 * std::tan(glm::radians(angle_deg / 2));
        const PolygonSoup roof =
            soup_of({{20, 20, -rise}, {50, 20, 0}, {80, 20, -rise}, {80, 80, -rise}, {50, 80, 0}, {20, 80, -rise}},
                    {{0, 1, 4, 5}, {1, 2, 3, 4}});
        const Drawing d(scene_of({roof}), pixel_camera(100, 100), 100, 100);
        EXPECT_NEAR(d.sum(LineClass::crease), angle_deg > 40 ? 59 : 0, 2) << angle_deg;
        // Winding means nothing: turn one of the two around.
        PolygonSoup turned = roof;
        std::swap(turned.corners[5], turned.corners[7]);
        const Drawing e(scene_of({turned}), pixel_camera(100, 100), 100, 100);
        EXPECT_EQ(e.sum(LineClass::crease), d.sum(LineClass::crease)) << angle_deg;
    }
}

TEST(Seam, BetweenUnstitchedPatchesIsNoBorder) {
    // A plane in two patches with different points along the common boundary x = 50.
    const PolygonSoup patches = soup_of({{20, 20, 0},
                                         {50, 20, 0},
                                         {50, 50, 0},
                                         {50, 80, 0},
                                         {20, 80, 0},
                                         {50, 35, 0},
                                         {50, 65, 0},
                                         {80, 20, 0},
                                         {80, 80, 0}},
                                        {{0, 1, 2, 3, 4}, {1, 7, 8, 3, 6, 5}});
    const Drawing d(scene_of({patches}), pixel_camera(100, 100), 100, 100);
    EXPECT_EQ(d.drawn_share({50, 23}, {50, 77}), 0);
    EXPECT_NEAR(d.sum(LineClass::border), 240, 4);
}

TEST(Seam, StaysInvisibleWhenItGapes) {
    for (const double gap : {0.001, 0.02, 0.1, 0.4}) {
        const PolygonSoup patches = soup_of({{20, 20, 0},
                                             {50, 20, 0},
                                             {50, 80, 0},
                                             {20, 80, 0},
                                             {50 + gap, 20, 0},
                                             {80, 20, 0},
                                             {80, 80, 0},
                                             {50 + gap, 80, 0}},
                                            {{0, 1, 2, 3}, {4, 5, 6, 7}});
        for (double shift = 0; shift < 1; shift += 0.0625) {
            const PolygonSoup moved = transformed(patches, [&](glm::dvec3 p) { return p + glm::dvec3(shift, 0.3, 0); });
            const Drawing d(scene_of({moved}), pixel_camera(100, 100), 100, 100);
            EXPECT_EQ(d.drawn_share({50 + shift, 25}, {50 + shift, 75}), 0) << "gap " << gap << ", shift " << shift;
        }
    }
}

TEST(Seam, WhereTheSurfaceTurnsAwayIsASilhouette) {
    // A sheet, and a second one from its right border back below it, that has a vertex more there.
    const PolygonSoup soup = soup_of(
        {{10, 10, 0}, {50, 10, 0}, {50, 50, 0}, {10, 50, 0}, {50, 30, 0}, {30, 10, -40}, {30, 30, -40}, {30, 50, -40}},
        {{0, 1, 2, 3}, {1, 5, 6, 4}, {4, 6, 7, 2}});
    for (const RenderFunction method : {render_patel, render_abuffer}) {
        const Drawing d(scene_of({soup}), pixel_camera(60, 60), 60, 60, {0, 0, 60, 60}, 1, method);
        for (int y = 14; y < 46; ++y) {
            double silhouette = 0, border = 0;
            for (int x = 47; x < 53; ++x) {
                silhouette += d.line(LineClass::silhouette, x, y);
                border += d.line(LineClass::border, x, y);
            }
            EXPECT_NEAR(silhouette, 1, 0.05) << y;
            EXPECT_EQ(border, 0) << y;
        }
        EXPECT_GT(d.sum(LineClass::border), 110);
    }
}

TEST(Seam, WithAnAngleIsACrease) {
    const PolygonSoup patches = soup_of({{20, 20, -30},
                                         {50, 20, 0},
                                         {50, 80, 0},
                                         {20, 80, -30},
                                         {50, 19.9, 0},
                                         {80, 19.9, -30},
                                         {80, 80, -30},
                                         {50, 80.1, 0}},
                                        {{0, 1, 2, 3}, {4, 5, 6, 7}});
    const Drawing d(scene_of({patches}), pixel_camera(100, 100), 100, 100);
    EXPECT_GT(d.drawn_share({50.01, 22}, {50.01, 78}), 0.999);
    EXPECT_NEAR(d.sum(LineClass::crease), 60, 2);
}

TEST(TJunction, InAFlatSurfaceShowsNothing) {
    // The edge of the left rectangle has a vertex of the right ones in its middle, slightly off.
    for (const double off : {0.0, 0.003, -0.003, 0.05, -0.05}) {
        const PolygonSoup patches = soup_of({{20, 20, 0},
                                             {50, 20, 0},
                                             {50, 80, 0},
                                             {20, 80, 0},
                                             {80, 20, 0},
                                             {80, 51, 0},
                                             {50 + off, 51, 0},
                                             {80, 80, 0}},
                                            {{0, 1, 2, 3}, {1, 4, 5, 6}, {6, 5, 7, 2}});
        const Drawing d(scene_of({patches}), pixel_camera(100, 100), 100, 100);
        EXPECT_EQ(d.drawn_share({50.01, 24}, {50.01, 76}), 0) << off;
        EXPECT_EQ(d.drawn_share({53, 49}, {77, 49}), 0) << off;
    }
}

TEST(Slivers, InAFlatSurfaceShowNothing) {
    // A row of triangles thinner than any sample, folded over by rounding, between two rectangles.
    std::vector<glm::dvec3> p = {{20, 20, 0}, {50, 20, 0}, {50, 80, 0}, {20, 80, 0}, {80, 20, 0}, {80, 80, 0}};
    std::vector<std::vector<std::uint32_t>> polygons = {{0, 1, 2, 3}};
    p.emplace_back(50.0001, 50, 0.0001);
    p.emplace_back(49.9999, 35, -0.0001);
    polygons.push_back({1, 6, 2});
    polygons.push_back({1, 7, 6});
    polygons.push_back({1, 4, 5, 2, 6, 7});
    const Drawing d(scene_of({soup_of(p, polygons)}), pixel_camera(100, 100), 100, 100);
    EXPECT_EQ(d.drawn_share({50, 24}, {50, 76}), 0);
    EXPECT_EQ(d.sum(LineClass::crease), 0);
}

TEST(NonManifoldEdge, LetsTheVisibleSurfaceGoOn) {
    // A flat sheet with a fin behind it, on the same edge.
    const PolygonSoup sheet = soup_of(
        {{20, 20, 0}, {50, 20, 0}, {50, 80, 0}, {20, 80, 0}, {80, 20, 0}, {80, 80, 0}, {55, 20, -40}, {55, 80, -40}},
        {{0, 1, 2, 3}, {1, 4, 5, 2}, {1, 6, 7, 2}});
    const Drawing d(scene_of({sheet}), pixel_camera(100, 100), 100, 100);
    EXPECT_EQ(d.drawn_share({50, 24}, {50, 76}), 0);
    EXPECT_NEAR(d.sum(LineClass::border), 240, 4);
}

TEST(ObjectLine, SeparatesObjectsInContact) {
    const Drawing d(scene_of({rectangle(20.2, 20.2, 50.2, 80.2, 0), rectangle(50.2, 20.2, 80.2, 80.2, 0)}),
                    pixel_camera(100, 100), 100, 100);
    EXPECT_NEAR(d.sum(LineClass::object), 59, 2);
    // And a small one lying on a large one.
    const Drawing e(scene_of({rectangle(10.2, 10.2, 90.2, 90.2, 0), rectangle(30.2, 30.2, 70.2, 70.2, 0.01)}),
                    pixel_camera(100, 100), 100, 100);
    EXPECT_NEAR(e.sum(LineClass::object), 160, 3);
}

TEST(MaterialLine, SeparatesMaterialsOfOneObject) {
    PolygonSoup sheet = soup_of({{20, 20, 0}, {50, 20, 0}, {50, 80, 0}, {20, 80, 0}, {80, 20, 0}, {80, 80, 0}},
                                {{0, 1, 2, 3}, {1, 4, 5, 2}});
    sheet.materials = {Material{.name = "a"}, Material{.name = "b"}};
    sheet.polygon_material = {0, 1};
    Scene scene = scene_of({sheet});
    scene.lines.classes = LineClassSet::all();
    const Drawing d(scene, pixel_camera(100, 100), 100, 100);
    EXPECT_NEAR(d.sum(LineClass::material), 59, 2);
    EXPECT_EQ(d.sum(LineClass::polygon), 0) << "material comes before polygon";
    scene.lines.classes = LineClass::polygon;
    const Drawing e(scene, pixel_camera(100, 100), 100, 100);
    EXPECT_NEAR(e.sum(LineClass::polygon), 60, 2);
}

TEST(PolygonLine, IsNeverATriangulationDiagonal) {
    Scene scene = scene_of({make_plane(80, 80, 4, 4)});
    scene.lines.classes = LineClass::polygon;
    Camera camera;
    camera.orthographic = true;
    camera.height = 100;
    camera.to_world = glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0.13, 10, 0.17, 1);  // from above
    const Drawing d(scene, camera, 100, 100);
    EXPECT_NEAR(d.sum(LineClass::polygon), 6 * 80 - 9, 4);  // three lines each way, crossing nine times
}

TEST(ConcavePolygon, IsOneSurface) {
    const PolygonSoup l_shape =
        soup_of({{20, 20, 0}, {80, 20, 0}, {80, 45, 0}, {45, 45, 0}, {45, 80, 0}, {20, 80, 0}}, {{0, 1, 2, 3, 4, 5}});
    Scene scene = scene_of({l_shape});
    scene.lines.classes = LineClassSet::all();
    const Drawing d(scene, pixel_camera(100, 100), 100, 100);
    EXPECT_NEAR(d.sum("lines.A"), 240, 5);
    EXPECT_EQ(d.sum("lines.A"), d.sum(LineClass::border));
    EXPECT_EQ(d.line(70, 30), 0);
    EXPECT_EQ(d.at("id.polygon", 30, 70), 1);
    EXPECT_EQ(d.at("id.polygon", 70, 30), 0) << "the notch is empty";
}

TEST(Marks, AreDrawnWhereTheFileSaysSo) {
    PolygonSoup sheet = soup_of({{20, 20, 0}, {50, 20, 0}, {50, 80, 0}, {20, 80, 0}, {80, 20, 0}, {80, 80, 0}},
                                {{0, 1, 2, 3}, {1, 4, 5, 2}});
    sheet.marked_edges = {{2, 1}};
    Scene scene = scene_of({sheet});
    scene.lines.classes = LineClass::mark;
    const Drawing d(scene, pixel_camera(100, 100), 100, 100);
    EXPECT_NEAR(d.sum(LineClass::mark), 60, 2);
}

TEST(HiddenSurfaces, ShowNoLines) {
    // Three sheets behind each other: only the front one and what stands out are drawn.
    const Drawing d(scene_of({rectangle(10.2, 10.2, 60.2, 60.2, 30), rectangle(20.2, 20.2, 50.2, 50.2, 20),
                              rectangle(30.2, 30.2, 90.2, 90.2, 10)}),
                    pixel_camera(100, 100), 100, 100);
    EXPECT_EQ(d.drawn_share({20.2, 79.8}, {50.2, 79.8}), 0) << "the middle one is hidden";
    EXPECT_EQ(d.drawn_share({30.2, 69.8}, {58, 69.8}), 0) << "hidden part of the rear one";
    EXPECT_GT(d.drawn_share({62, 69.8}, {90.2, 69.8}), 0.99) << "visible part of the rear one";
    EXPECT_NEAR(d.sum("lines.A"), 200 + 240 - 60, 5);
}

TEST(FlatStep, IsDrawnByItsOwnersHoweverSmall) {
    // Parallel faces with the same normal and nearly the same depth: what depth maps miss.
    for (const double step : {1e-3, 0.1, 1.0, 50.0}) {
        const Drawing d(scene_of({rectangle(10.2, 10.2, 90.2, 90.2, 0), rectangle(30.2, 30.2, 70.2, 70.2, step)}),
                        pixel_camera(100, 100), 100, 100);
        EXPECT_GT(d.drawn_share({30.2, 69.8}, {70.2, 69.8}), 0.99) << step;
    }
}

/// Nor is what lies behind it drawn, however near: in files it comes before or after.
TEST(FlatStep, HidesWhatLiesBehind) {
    for (const double step : {1e-3, 0.01, 0.1, 1.0}) {
        for (const bool is_front_first : {false, true}) {
            std::vector<PolygonSoup> sheets{rectangle(10.2, 10.2, 60.2, 60.2, 0),
                                            rectangle(30.2, 30.2, 90.2, 90.2, step)};
            if (is_front_first) std::swap(sheets[0], sheets[1]);
            for (const RenderFunction render : {render_patel, render_abuffer}) {
                const Drawing d(scene_of(sheets), pixel_camera(100, 100), 100, 100, {0, 0, 100, 100}, 1, render);
                EXPECT_EQ(d.drawn_share({34, 39.8}, {60.2, 39.8}), 0) << step << is_front_first;
                EXPECT_EQ(d.drawn_share({60.2, 66}, {60.2, 39.8}), 0) << step << is_front_first;
                EXPECT_GT(d.drawn_share({30.2, 69.8}, {90.2, 69.8}), 0.99) << step << is_front_first;
                EXPECT_GT(d.drawn_share({30.2, 69.8}, {30.2, 9.8}), 0.99) << step << is_front_first;
            }
        }
    }
}

// Boxes with common faces, in one mesh: nothing passes through anything. On their edges, what lies within the solid is
// level with what is seen.
TEST(TouchingBoxes, HaveNoIntersections) {
    const glm::dvec3 middles[] = {{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}, {0, 1, 0.25}, {1.5, -1, 0.2}};
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons;
    for (const glm::dvec3& middle : middles) {
        const PolygonSoup box = make_box({1, 1, 1});
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const glm::dvec3& p : box.positions) positions.push_back(p + middle);
        for (std::size_t k = 0; k < box.polygon_count(); ++k) {
            polygons.emplace_back();
            for (const std::uint32_t v : box.polygon(k)) polygons.back().push_back(first + v);
        }
    }
    const Scene scene = scene_of({soup_of(positions, polygons)});
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        CameraSettings settings;
        settings.direction = seed == 0 ? glm::dvec3(-0.7, -0.5, 0.6) : random.direction();
        const Camera camera = resolve_camera(settings, scene_points(scene), 4.0 / 3);
        const Drawing d(scene, camera, 400, 300, {0, 0, 400, 300}, 1, render_abuffer);
        EXPECT_EQ(d.sum(LineClass::intersection), 0) << "seed " << seed;
    }
}

TEST(GrazingFloor, HasNoFalseLines) {
    PolygonSoup floor = make_plane(400, 400, 40, 40);
    Camera camera = perspective_camera({0, 3, 60}, {0, 0, 0});  // under 3 degrees
    const Drawing d(scene_of({floor}), camera, 200, 100);
    EXPECT_EQ(d.sum(LineClass::silhouette), 0);
    EXPECT_EQ(d.sum(LineClass::crease), 0);
    for (int y = 75; y < 95; ++y) {
        for (int x = 60; x < 140; ++x) ASSERT_EQ(d.line(x, y), 0) << x << "," << y;
    }
}

TEST(CoincidentFaces, DoNotFight) {
    // Two objects are the same rectangle in the same place, tessellated differently.
    PolygonSoup one = rectangle(20.2, 20.2, 80.2, 80.2, 0);
    PolygonSoup other = soup_of({{20.2, 20.2, 0}, {80.2, 20.2, 0}, {80.2, 80.2, 0}, {20.2, 80.2, 0}, {47, 53, 0}},
                                {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const auto tilt = [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, 0.7 * p.x - 0.4 * p.y); };
    Scene scene = scene_of({transformed(one, tilt), transformed(other, tilt)});
    const Drawing d(scene, pixel_camera(100, 100), 100, 100);
    for (int y = 25; y < 75; ++y) {
        for (int x = 25; x < 75; ++x) {
            ASSERT_EQ(d.line(x, y), 0) << x << "," << y;
            ASSERT_EQ(d.at("id.object", x, y), 1) << x << "," << y;
        }
    }
}

/// A flat label on a turned box, as files have them: their planes differ by what coordinates were rounded. It is seen
/// as a whole, or not at all.
TEST(CoincidentFaces, DoNotFightWhenRounded) {
    int hidden = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        Random random(seed);
        const glm::dmat3 turned(glm::rotate(glm::dmat4(1.0), random.real(0, 3), random.direction()));
        const double unit = seed % 2 == 0 ? 1e-5 : 1e-4;
        const auto rounded = [&](glm::dvec3 p) { return glm::round(turned * p / unit) * unit; };
        PolygonSoup box = transformed(make_box({1, 1, 1}), rounded);
        const PolygonSoup label = transformed(
            soup_of({{0.5, -0.3, -0.2}, {0.5, 0.4, -0.1}, {0.5, 0.35, 0.3}, {0.5, -0.3, 0.25}}, {{0, 1, 2, 3}}),
            rounded);
        const Camera camera = perspective_camera(turned * glm::dvec3(3, 0.6, 0.8), {0, 0, 0});
        for (const int samples : {0, 4}) {
            const auto draw = [&](std::vector<PolygonSoup> objects) {
                Scene scene = scene_of(std::move(objects));
                if (samples > 0) scene.abuffer.samples = samples;
                return Drawing(scene, camera, 300, 225, {0, 0, 300, 225}, 2, render_abuffer);
            };
            const Drawing d = draw({box, label});
            EXPECT_EQ(d.sum(LineClass::intersection), 0) << "seed " << seed << ", samples " << samples;
            const double outline = draw({label}).sum(LineClass::border),
                         drawn = d.sum(LineClass::object) + d.sum(LineClass::border);
            EXPECT_NEAR(drawn, drawn > 0 ? outline : 0, 0.02 * outline) << "seed " << seed << ", samples " << samples;
            hidden += drawn > 0 ? 0 : 1;
        }
    }
    EXPECT_GT(hidden, 10);
}

TEST(TwoSided, WindingChangesNothing) {
    PolygonSoup box = make_box({1, 1, 1});
    PolygonSoup turned = box;
    std::reverse(turned.corners.begin(), turned.corners.begin() + 4);
    std::reverse(turned.corners.begin() + 12, turned.corners.begin() + 16);
    const Camera camera = perspective_camera({2, 1.5, 3}, {0, 0, 0});
    const Drawing a(scene_of({box}), camera, 120, 120), b(scene_of({turned}), camera, 120, 120);
    EXPECT_EQ(a.coverage(), b.coverage());
}

}  // namespace
}  // namespace burin::classes_test
