// What method gbuffer draws on minimal scenes: what it gets right, and what it is known to get wrong.
//
// Orthographic, world units are pixels, y down; depth z in [0, 1] stands for 256 pixels.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "mesh/shapes.h"
#include "methods/gbuffer.h"
#include "tests/support/drawing.h"

namespace burin {
namespace {

using namespace test;

constexpr int kSize = 256;
constexpr double kDepthPx = 256;

glm::dvec3 at(double x, double y, double z) { return {x, kSize - y, -kDepthPx * z}; }

/// A polygon from (x, y, z) corners as above.
PolygonSoup polygon(const std::vector<glm::dvec3>& corners) {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> numbers;
    for (const glm::dvec3& c : corners) {
        numbers.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(at(c.x, c.y, c.z));
    }
    return soup_of(positions, {numbers});
}

PolygonSoup square(double x0, double y0, double x1, double y1, double z) {
    return polygon({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
}

/// Two soups as one object.
PolygonSoup together(PolygonSoup a, const PolygonSoup& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    for (const glm::dvec3& p : b.positions) a.positions.push_back(p);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < b.positions.size(); ++i) numbers.push_back(first + i);
    a.add_polygon(numbers);  // b is a single polygon
    return a;
}

constexpr GBufferOperator kFirst = GBufferOperator::first, kProfile = GBufferOperator::profile,
                          kInternal = GBufferOperator::internal, kId = GBufferOperator::id,
                          kSobel = GBufferOperator::sobel, kRoberts = GBufferOperator::roberts,
                          kSecond = GBufferOperator::second, kNormal = GBufferOperator::normal;

Scene scene_with(std::vector<PolygonSoup> objects, std::initializer_list<GBufferOperator> operators,
                 LineClassSet classes = kDefaultLineClasses) {
    Scene scene = scene_of(std::move(objects));
    scene.gbuffer.operators = GBufferOperatorSet::of(operators);
    scene.lines.classes = classes;
    return scene;
}

Drawing draw(const Scene& scene, int threads = 2) {
    return Drawing(scene, pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize}, threads, render_gbuffer);
}

/// Line coverage of pixels [x0, x1) of row 128, with nothing else drawn.
std::vector<double> row_alone(const Scene& scene, int x0, int x1) {
    const Drawing d(scene, pixel_camera(kSize, kSize), kSize, kSize, {x0, 128, x1, 129}, 1, render_gbuffer);
    return d.coverage();
}

/// Line coverage of pixels [x0, x1) of a row.
std::vector<double> row(const Drawing& d, int y, int x0, int x1) {
    std::vector<double> values;
    for (int x = x0; x < x1; ++x) values.push_back(d.line(x, y));
    return values;
}

std::set<double> levels(const Drawing& d) {
    const std::vector<double> all = d.coverage();
    return {all.begin(), all.end()};
}

std::vector<PolygonSoup> step_scene() {
    return {square(-50, -50, 300, 300, 0.6), square(-50, -50, 100.37, 300, 0.3)};
}

TEST(Step, IsALineTwoPixelsWideAndAliased) {
    for (const auto& operators : {std::initializer_list<GBufferOperator>{kProfile}, {kSobel}, {kId}, {kFirst},
                                  {GBufferOperator::hertzmann}, {GBufferOperator::decaudin},
                                  {kProfile, kInternal, kId}}) {
        const Drawing d = draw(scene_with(step_scene(), operators));
        // The last sample in front is at 99.5, the first behind at 100.5.
        EXPECT_EQ(row(d, 128, 97, 104), (std::vector<double>{0, 0, 1, 1, 0, 0, 0}));
        EXPECT_EQ(levels(d), (std::set<double>{0, 1}));
    }
    const Drawing roberts = draw(scene_with(step_scene(), {kRoberts}));
    EXPECT_EQ(row(roberts, 128, 97, 104), (std::vector<double>{0, 0, 1, 0, 0, 0, 0}));
}

TEST(Step, IsFourPixelsWideWithoutTheGate) {
    Scene scene = scene_with(step_scene(), {kProfile});
    scene.gbuffer.gate = false;
    EXPECT_EQ(row(draw(scene), 128, 97, 104), (std::vector<double>{0, 1, 1, 1, 1, 0, 0}));
}

TEST(Step, IsOneOfTheClassItsOperatorStandsFor) {
    const Drawing profile = draw(scene_with(step_scene(), {kProfile}, LineClassSet::all()));
    EXPECT_GT(profile.sum(LineClass::silhouette), 500);
    EXPECT_EQ(profile.sum(LineClass::silhouette), profile.sum("lines.A"));
    const Drawing ids = draw(scene_with(step_scene(), {kId}, LineClassSet::all()));
    EXPECT_EQ(ids.sum(LineClass::object), ids.sum("lines.A"));  // no image of numbers knows a step from a contact
    const Drawing polygons = draw(scene_with(step_scene(), {kId}, LineClass::polygon));
    EXPECT_EQ(polygons.sum(LineClass::polygon), ids.sum(LineClass::object));
    EXPECT_EQ(draw(scene_with(step_scene(), {kProfile}, LineClass::crease)).sum("lines.A"), 0);
}

TEST(Step, SupersampledHasTheWidthAskedForAndMoreLevels) {
    for (const int s : {2, 4, 8}) {
        for (const double width_px : {1.0, 2.0, 5.0}) {
            Scene scene = scene_with(step_scene(), {kProfile}, LineClass::silhouette);
            scene.gbuffer.supersample = s;
            scene.lines.style.width_px = width_px;
            const std::vector<double> values = row_alone(scene, 90, 110);
            double sum = 0, moment = 0;
            for (std::size_t i = 0; i < values.size(); ++i) {
                sum += values[i];
                moment += values[i] * (90.5 + static_cast<double>(i));
            }
            EXPECT_NEAR(sum, width_px, 1e-3) << s;
            EXPECT_NEAR(moment / sum, 100.37, 0.51 / s) << s;  // the step between two samples
            scene.gbuffer.dilate = false;
            const std::vector<double> thin = row_alone(scene, 90, 110);
            EXPECT_NEAR(std::accumulate(thin.begin(), thin.end(), 0.0), 2.0 / s, 1e-3);
        }
    }
}

TEST(Flat, StepsBelowTheLimitsFade) {
    // One object, equal normals; the gap is 0.001 of the depth range, 0.256 px. The profile varies by
    // half of that. The second-order differential, though, answers with the whole gap over k_e.
    const PolygonSoup one = together(square(-50, -50, 300, 300, 0.501), square(60, 60, 200, 200, 0.5));
    EXPECT_NEAR(draw(scene_with({one}, {kProfile})).line(59, 128), 0.064, 0.001);
    EXPECT_NEAR(draw(scene_with({one}, {kInternal})).line(59, 128), 0.512, 0.001);
    for (const GBufferOperator o : {kSobel, kRoberts, kNormal, kId, GBufferOperator::hertzmann}) {
        EXPECT_EQ(draw(scene_with({one}, {o})).sum("lines.A"), 0);
    }
    // Another polygon number is all that sets it apart.
    const Drawing polygons = draw(scene_with({one}, {kId}, LineClass::polygon));
    EXPECT_EQ(row(polygons, 128, 57, 62), (std::vector<double>{0, 0, 1, 1, 0}));
}

TEST(Flat, IsLostInAnEightBitDepthBuffer) {
    // Depth from the squares to the background behind them: 256.256 px in 255 codes. Both squares fall
    // on code 0.
    const PolygonSoup one = together(square(-50, -50, 300, 300, 0.501), square(60, 60, 200, 200, 0.5));
    Scene scene = scene_with({one}, {kProfile, kInternal, kSecond, kFirst});
    scene.gbuffer.depth_bits = 8;
    EXPECT_EQ(draw(scene).sum("lines.A"), 0);
    scene.gbuffer.depth_bits = 24;
    EXPECT_GT(draw(scene).sum("lines.A"), 100);
}

TEST(Grazing, FloorFillsWithFalseLinesOnlyByAbsoluteDepth) {
    // A floor at 2 degrees: depth grows by 28.6 px a pixel.
    const double slope = 1 / std::tan(2 * std::numbers::pi / 180) / kDepthPx;
    const PolygonSoup floor = polygon({{-50, 200, 0.1}, {300, 200, 0.1}, {300, 100, 0.1 + 100 * slope}, {-50, 100, 0.1 + 100 * slope}});
    for (const GBufferOperator o : {kFirst, kSobel, GBufferOperator::hertzmann}) {
        const Drawing d = draw(scene_with({floor}, {o}));
        EXPECT_EQ(d.line(128, 150), 1);
        EXPECT_EQ(d.line(31, 117), 1);
    }
    for (const GBufferOperator o : {kProfile, kSecond, kInternal, kNormal, kRoberts, GBufferOperator::decaudin}) {
        const Drawing d = draw(scene_with({floor}, {o}));
        double inside = 0;
        for (int y = 104; y < 196; ++y) {
            for (const double value : row(d, y, 0, kSize)) inside += value;
        }
        EXPECT_LT(inside, 1e-6);
    }
}

/// Share of the surface of a ball that lines cover, without the two pixels at its outline.
double blackened(double radius_px, GBufferOperator o, double crease_angle_deg) {
    const PolygonSoup ball = transformed(make_sphere(radius_px, 64, 32), [](glm::dvec3 p) { return p + at(128.2, 128.3, 0.5); });
    Scene scene = scene_with({ball}, {o});
    scene.lines.crease_angle_deg = crease_angle_deg;
    const Drawing d = draw(scene);
    double black = 0, all = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (glm::distance(glm::dvec2(x + 0.5, y + 0.5), glm::dvec2(128.2, 128.3)) > radius_px - 2) continue;
            black += d.line(x, y);
            ++all;
        }
    }
    return black / all;
}

TEST(Curvature, OfSmallBallsIsTakenForCreases) {
    EXPECT_GT(blackened(6, kInternal, 40), 0.6);
    EXPECT_LT(blackened(60, kInternal, 40), 0.3);
    EXPECT_GT(blackened(6, kNormal, 20), 0.6);
    EXPECT_LT(blackened(60, kNormal, 20), 0.02);
}

TEST(ThinBar, AppearsAndVanishesAsItMoves) {
    int present = 0;
    for (int i = 0; i < 32; ++i) {
        const double x = 100 + i / 32.0;
        const auto values = row_alone(scene_with({square(x, 50, x + 0.3, 200, 0.5)}, {kProfile}), 90, 110);
        const double sum = std::accumulate(values.begin(), values.end(), 0.0);
        EXPECT_TRUE(sum == 0 || sum == 2) << i;  // the columns beside it, or nothing
        present += sum > 0;
    }
    EXPECT_NEAR(present, 0.3 * 32, 1.5);  // as often as a sample lies in the bar
}

TEST(Cut, OfALineByAnEdgeInFrontIsAliased) {
    for (const double angle_deg : {5.0, 17.0, 40.0}) {
        const double t = std::tan(angle_deg * std::numbers::pi / 180);
        const PolygonSoup left = polygon({{-50, -50, 0.6}, {128, -50, 0.6}, {128, 300, 0.6}, {-50, 300, 0.6}});
        const PolygonSoup right = polygon({{128, -50, 0.6}, {300, -50, 0.6}, {300, 300, 0.6}, {128, 300, 0.6}});
        const PolygonSoup cover = polygon({{-50, 128 - 178 * t, 0.2}, {300, 128 + 172 * t, 0.2}, {300, 400, 0.2}, {-50, 400, 0.2}});
        EXPECT_EQ(levels(draw(scene_with({left, right, cover}, {kId}))), (std::set<double>{0, 1})) << angle_deg;
    }
}

TEST(SteepFaces, HaveLinesWithoutGaps) {
    // A square split by a line of slope 0.37, on a plane that falls by b per pixel.
    for (const double b : {0.0, 1e-4, -1e-3, 1e-2, -1e-2}) {
        const double side = b == 0 ? 200 : std::min(200.0, 0.8 / std::abs(b));
        const double x0 = 128 - side / 2, y0 = x0, x1 = x0 + side, y1 = x1;
        const auto z = [&](double y) { return 0.5 + b * (y - 128); };
        const double ya = 128 - 0.37 * side / 2, yb = 128 + 0.37 * side / 2;
        PolygonSoup soup = together(polygon({{x0, y0, z(y0)}, {x1, y0, z(y0)}, {x1, yb, z(yb)}, {x0, ya, z(ya)}}),
                                    polygon({{x0, ya, z(ya)}, {x1, yb, z(yb)}, {x1, y1, z(y1)}, {x0, y1, z(y1)}}));
        const Drawing d = draw(scene_with({soup}, {kId}, LineClass::polygon));
        EXPECT_EQ(d.drawn_share({x0, ya}, {x1, yb}), 1) << b;
    }
}

TEST(HiddenLines, DoNotLeakThroughSurfacesHoweverClose) {
    for (const double gap : {1e-6, 1e-4, 1e-2, 1e-1}) {
        PolygonSoup grid = transformed(make_plane(240, 240, 12, 12), [](glm::dvec3 p) { return at(128 + p.x, 128 + p.z, 0.5); });
        const Drawing d = draw(scene_with({grid, square(60, 60, 200, 200, 0.5 - gap)}, {kId, kProfile, kInternal}, LineClassSet::all()));
        double inside = 0;
        for (int y = 63; y < 197; ++y) {
            for (const double value : row(d, y, 63, 197)) inside += value;
        }
        EXPECT_EQ(inside, 0) << gap;
        EXPECT_GT(d.line(48, 30), 0);  // the grid beside it is there
    }
}

TEST(Intersections, AreBendsOfDepthOrBordersOfNumbers) {
    const auto turned = [](double sign) {
        return polygon({{20, 50, 0.5 - 0.1 * sign}, {236, 50, 0.5 + 0.1 * sign}, {236, 200, 0.5 + 0.1 * sign}, {20, 200, 0.5 - 0.1 * sign}});
    };
    const Drawing bend = draw(scene_with({turned(1), turned(-1)}, {kInternal}, LineClass::crease | LineClass::intersection));
    EXPECT_GT(bend.drawn_share({128, 50}, {128, 200}), 0.99);
    EXPECT_EQ(bend.sum(LineClass::intersection), 0);  // what it is called is another matter
    const Drawing border = draw(scene_with({turned(1), turned(-1)}, {kId}, LineClass::object));
    EXPECT_GT(border.drawn_share({128, 50}, {128, 200}), 0.99);
}

TEST(Width, DependsOnTheAngleOfTheLine) {
    const auto width_at = [](double angle_deg) {
        const double a = angle_deg * std::numbers::pi / 180;
        const glm::dvec2 along(std::cos(a), std::sin(a)), across(-along.y, along.x), middle(128.3, 128.1);
        const auto corner = [&](double u, double v) {
            const glm::dvec2 p = middle + u * along + v * across;
            return glm::dvec3(p, 0.3);
        };
        const PolygonSoup half = polygon({corner(-400, 0), corner(400, 0), corner(400, 400), corner(-400, 400)});
        const Drawing d = draw(scene_with({square(-400, -400, 700, 700, 0.6), half}, {kId}));
        double sum = 0;
        for (int y = 28; y < 228; ++y) {
            for (const double value : row(d, y, 28, 228)) sum += value;
        }
        return sum / (200 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a))));
    };
    EXPECT_NEAR(width_at(0), 2, 0.01);
    EXPECT_NEAR(width_at(90), 2, 0.01);
    EXPECT_GT(width_at(45), 1.9);  // 8 neighbours: 3 diagonals of 0.71
    EXPECT_GT(width_at(26), 2.2);
}

TEST(DenseMesh, TurnsSolid) {
    const PolygonSoup grid = transformed(make_plane(150, 150, 100, 100), [](glm::dvec3 p) { return at(128 + p.x, 128 + p.z, 0.5); });
    const Drawing d = draw(scene_with({grid}, {kId}, LineClass::polygon));
    for (const double value : row(d, 128, 60, 196)) EXPECT_EQ(value, 1);
}

TEST(Concave, PolygonsHaveTheirOutlineAndNoDiagonals) {
    const PolygonSoup shape = polygon({{50, 50, 0.5}, {200, 50, 0.5}, {200, 120, 0.5}, {120, 120, 0.5}, {120, 200, 0.5}, {50, 200, 0.5}});
    const Drawing d = draw(scene_with({shape}, {kId, kProfile}, LineClassSet::all()));
    EXPECT_EQ(d.drawn_share({50, 50}, {200, 50}), 1);
    EXPECT_EQ(d.drawn_share({200, 120}, {120, 120}), 1);
    EXPECT_EQ(d.drawn_share({120, 120}, {120, 200}), 1);
    for (int y = 53; y < 117; ++y) {
        for (const double value : row(d, y, 53, 197)) EXPECT_EQ(value, 0);
    }
}

std::vector<PolygonSoup> busy_scene() {
    const auto placed = [](PolygonSoup soup, glm::dvec3 p) {
        return transformed(std::move(soup), [p](glm::dvec3 v) { return glm::dvec3(0.8 * v.x - 0.6 * v.z, v.y, 0.6 * v.x + 0.8 * v.z) + p; });
    };
    return {placed(make_box({90, 70, 80}), at(90, 100, 0.5)), placed(make_torus(50, 20, 40, 20), at(150, 150, 0.5)),
            placed(make_sphere(40, 24, 12), at(180, 90, 0.6))};
}

Scene busy_with_everything() {
    Scene scene = scene_of(busy_scene());
    for (int o = 0; o < kGBufferOperatorCount; ++o) scene.gbuffer.operators.add(static_cast<GBufferOperator>(o));
    scene.lines.classes = LineClassSet::all();
    scene.lines.style.width_px = 1.7;
    scene.surfaces.shading = SurfaceShading::lambert;
    scene.gbuffer.supersample = 2;
    scene.gbuffer.smooth = true;
    scene.gbuffer.contours = ContourField::y;
    scene.gbuffer.cross_hatching = ContourField::x;
    scene.gbuffer.contour_step = 8;
    scene.gbuffer.hatching = true;
    return scene;
}

TEST(Bits, DoNotDependOnThreadsOrCrops) {
    const Scene scene = busy_with_everything();
    const Camera camera = pixel_camera(kSize, kSize);
    const Drawing all = draw(scene, 1);
    EXPECT_TRUE(same_bits(all.image(), draw(scene, 3).image()));
    const PixelRect crop{37, 61, 203, 190};
    const Drawing part(scene, camera, kSize, kSize, crop, 2, render_gbuffer);
    for (const Channel& c : part.image().channels()) {
        for (int y = 0; y < part.height(); ++y) {
            for (int x = 0; x < part.width(); ++x) {
                ASSERT_EQ(part.at(c.name, x, y), all.at(c.name, x + crop.x0, y + crop.y0)) << c.name << " " << x << "," << y;
            }
        }
    }
}

TEST(Bits, DoNotDependOnTheOrderOfObjects) {
    std::vector<PolygonSoup> objects = busy_scene();
    const Drawing forth = draw(scene_with(objects, {kProfile, kInternal, kId}));
    std::reverse(objects.begin(), objects.end());
    EXPECT_EQ(forth.coverage(), draw(scene_with(objects, {kProfile, kInternal, kId})).coverage());
}

TEST(Layers, CoveragesAddUpAndLinesLieOverSurfaces) {
    const Drawing d = draw(busy_with_everything());
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            double sum = 0;
            for (int c = 0; c < kLineClassCount; ++c) sum += d.line(static_cast<LineClass>(c), x, y);
            ASSERT_NEAR(sum, d.line(x, y), 0.004);
            ASSERT_GE(d.line(x, y), 0);
            ASSERT_LE(d.line(x, y), 1);
            ASSERT_LE(d.at("A", x, y), 1);
            ASSERT_GE(d.at("A", x, y), d.line(x, y) - 0.001);
        }
    }
}

TEST(Layers, DepthNormalsAndNumbersAreThoseOfMethodPatel) {
    // Patel's masks have their middle sample beside the pixel's centre; away from borders they agree.
    const Scene scene = scene_with(busy_scene(), {kProfile});
    const Drawing ours = draw(scene), patels(scene, pixel_camera(kSize, kSize), kSize, kSize);
    int equal = 0, all = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            ++all;
            if (ours.at("id.polygon", x, y) != patels.at("id.polygon", x, y)) continue;
            ++equal;
            const double z = ours.at("Z", x, y);  // perhaps of another triangle of the same polygon
            ASSERT_EQ(std::isinf(z), ours.at("id.polygon", x, y) == 0);
            ASSERT_TRUE(std::isinf(z) ? std::isinf(patels.at("Z", x, y)) : std::abs(z - patels.at("Z", x, y)) < 0.1);
            for (const char* channel : {"N.X", "N.Y", "N.Z", "id.object", "id.material"}) {
                ASSERT_EQ(ours.at(channel, x, y), patels.at(channel, x, y)) << channel << " " << x << "," << y;
            }
        }
    }
    EXPECT_GT(equal, 0.95 * all);
}

TEST(Perspective, SlopesAreTangentsAtTheReferenceDistance) {
    // Two planes that meet in a vertical ridge at the reference distance, each turned by 20 degrees: depth bends
    // by 2 tan 20 px in one column, or by half in two.
    const double t = std::tan(20 * std::numbers::pi / 180);
    const PolygonSoup roof = soup_of({{0, -1, 0}, {0, 1, 0}, {1, 1, -t}, {1, -1, -t}, {-1, 1, -t}, {-1, -1, -t}}, {{0, 1, 2, 3}, {0, 1, 4, 5}});
    Scene scene = scene_with({roof}, {kSecond}, LineClass::crease);
    scene.gbuffer.reference_distance = 5;
    scene.gbuffer.crease_limit = 4 * t;
    scene.gbuffer.dilate = false;
    const Drawing d(scene, perspective_camera({0, 0, 5}, {0, 0, 0}, 15), kSize, kSize, {0, 0, kSize, kSize}, 2, render_gbuffer);
    const std::vector<double> values = row(d, 128, 120, 136);
    EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.0), 2 * t / (4 * t), 0.02);
}

TEST(Hatching, IsDarkerWhereTheSurfaceTurnsAway) {
    const PolygonSoup ball = transformed(make_sphere(100, 128, 64), [](glm::dvec3 p) { return p + at(128, 128, 0.5); });
    Scene scene = scene_with({ball}, {kProfile});
    scene.gbuffer.contours = ContourField::y;
    scene.gbuffer.contour_step = 5;
    scene.gbuffer.contour_width_px = 4;
    const auto ink = [&](int x0, int x1) {
        const Drawing d = draw(scene);
        double sum = 0;
        for (int y = 100; y < 156; ++y) {
            for (int x = x0; x < x1; ++x) sum += 1 - d.at("surface.G", x, y);
        }
        return sum / (56 * (x1 - x0));
    };
    EXPECT_NEAR(ink(120, 136), 0.8, 0.03);  // contours: 4 of 5 px
    EXPECT_EQ(draw(scene).sum("lines.A"), draw(scene_with({ball}, {kProfile})).sum("lines.A"));  // no lines
    scene.gbuffer.hatching = true;
    EXPECT_LT(ink(120, 136), 0.1);
    EXPECT_GT(ink(210, 216), 0.25);
}

}  // namespace
}  // namespace burin
