// What method gbuffer draws on minimal scenes: what it gets right, and what it is known to get
// wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "mesh/shapes.h"
#include "methods/gbuffer/gbuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/minimal_scenes.h"

namespace burin::gbuffer_scenes_test {
namespace {

using namespace test;

constexpr int kSize = 256;

constexpr GBufferOperator kFirst = GBufferOperator::first, kProfile = GBufferOperator::profile,
                          kInternal = GBufferOperator::internal, kId = GBufferOperator::id,
                          kSobel = GBufferOperator::sobel, kRoberts = GBufferOperator::roberts,
                          kSecond = GBufferOperator::second, kNormal = GBufferOperator::normal,
                          kDecaudin = GBufferOperator::decaudin, kHertzmann = GBufferOperator::hertzmann;

/// A minimal scene's scene, to be drawn with these operators.
Scene with(MinimalScene minimal, std::initializer_list<GBufferOperator> operators,
           LineClassSet classes = kDefaultLineClasses) {
    minimal.scene.gbuffer.operators = GBufferOperatorSet::of(operators);
    minimal.scene.lines.classes = classes;
    return std::move(minimal.scene);
}

Scene with(std::vector<PolygonSoup> objects, std::initializer_list<GBufferOperator> operators,
           LineClassSet classes = kDefaultLineClasses) {
    MinimalScene minimal;
    minimal.scene = scene_of(std::move(objects));
    return with(std::move(minimal), operators, classes);
}

Drawing draw(const Scene& scene, int threads = 2) {
    return Drawing(scene, pixel_camera(kSize, kSize), kSize, kSize, {0, 0, kSize, kSize}, threads, render_gbuffer);
}

/// Line coverage of pixels [x0, x1) of row 128, with nothing else drawn.
std::vector<double> row(const Scene& scene, int x0, int x1) {
    const Drawing d(scene, pixel_camera(kSize, kSize), kSize, kSize, {x0, 128, x1, 129}, 1, render_gbuffer);
    return d.coverage();
}

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// All line coverage within a rectangle.
double sum_within(const Drawing& d, PixelRect rect) {
    double sum = 0;
    for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) sum += d.line(x, y);
    }
    return sum;
}

std::set<double> levels(const Drawing& d) {
    const std::vector<double> all = d.coverage();
    return {all.begin(), all.end()};
}

glm::dvec3 at(double x, double y, double z = 0) { return {x, kSize - y, z}; }

/// A polygon from corners in pixels, y down.
PolygonSoup polygon(const std::vector<glm::dvec3>& corners) {
    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t> numbers;
    for (const glm::dvec3& c : corners) {
        numbers.push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(at(c.x, c.y, c.z));
    }
    return soup_of(positions, {numbers});
}

// ---- S-STEP: a square before a wall; its left edge at 100.37, between samples 99.5 and 100.5 ----

TEST(Step, IsALineTwoPixelsWideAndAliased) {
    for (const auto& operators : {std::initializer_list<GBufferOperator>{kProfile},
                                  {kSobel},
                                  {kId},
                                  {kFirst},
                                  {kHertzmann},
                                  {kDecaudin},
                                  {kProfile, kInternal, kId}}) {
        const Scene scene = with(scene_step(), operators);
        EXPECT_EQ(row(scene, 97, 104), (std::vector<double>{0, 0, 1, 1, 0, 0, 0}));
        EXPECT_EQ(levels(draw(scene)), (std::set<double>{0, 1}));
    }
    EXPECT_EQ(row(with(scene_step(), {kRoberts}), 97, 104), (std::vector<double>{0, 0, 1, 0, 0, 0, 0}));
}

TEST(Step, IsFourPixelsWideWithoutTheGate) {
    Scene scene = with(scene_step(), {kProfile});
    scene.gbuffer.gate = false;
    EXPECT_EQ(row(scene, 97, 104), (std::vector<double>{0, 1, 1, 1, 1, 0, 0}));
}

TEST(Step, IsOneOfTheClassItsOperatorStandsFor) {
    const Drawing profile = draw(with(scene_step(), {kProfile}, LineClassSet::all()));
    EXPECT_GT(profile.sum(LineClass::silhouette), 500);
    EXPECT_EQ(profile.sum(LineClass::silhouette), profile.sum("lines.A"));
    const Drawing ids = draw(with(scene_step(), {kId}, LineClassSet::all()));
    EXPECT_EQ(ids.sum(LineClass::object),
              ids.sum("lines.A"));  // numbers do not tell a step from a contact
    EXPECT_EQ(draw(with(scene_step(), {kId}, LineClass::polygon)).sum(LineClass::polygon), ids.sum(LineClass::object));
    EXPECT_EQ(draw(with(scene_step(), {kProfile}, LineClass::crease)).sum("lines.A"), 0);
}

TEST(Step, SupersampledHasTheWidthAskedFor) {
    for (const int s : {2, 4, 8}) {
        for (const double width_px : {1.0, 2.0, 5.0}) {
            Scene scene = with(scene_step(), {kProfile}, LineClass::silhouette);
            scene.gbuffer.supersample = s;
            scene.lines.style.width_px = width_px;
            const std::vector<double> values = row(scene, 90, 110);
            double moment = 0;
            for (std::size_t i = 0; i < values.size(); ++i) moment += values[i] * (90.5 + static_cast<double>(i));
            EXPECT_NEAR(sum_of(values), width_px, 1e-3) << s;
            EXPECT_NEAR(moment / width_px, 100.37, 0.51 / s) << s;  // the step between two samples
            scene.gbuffer.dilate = false;
            EXPECT_NEAR(sum_of(row(scene, 90, 110)), 2.0 / s, 1e-3);
        }
    }
}

TEST(Silhouettes, HaveTheirFullWidthAndTwoLevels) {
    const MinimalScene sil = scene_sil();
    const Drawing d = draw(with(sil, {kProfile}));
    EXPECT_EQ(levels(d), (std::set<double>{0, 1}));
    double columns = 0;  // or rows, whichever a side crosses more of; two samples in each
    for (const ScreenSegment& s : sil.lines) columns += std::max(std::abs(s.a.x - s.b.x), std::abs(s.a.y - s.b.y));
    EXPECT_NEAR(d.sum("lines.A"), 2 * columns, 6);
}

// ---- S-FLAT: a square 0.256 px before another one, of equal normals ----

TEST(Flat, StepsBelowTheLimitsFade) {
    // The profile varies by half of the gap. The second-order differential, though, answers with
    // the whole gap over k_e.
    EXPECT_NEAR(row(with(scene_flat(), {kProfile}, LineClass::silhouette), 79, 80)[0], 0.064, 0.001);
    EXPECT_NEAR(row(with(scene_flat(), {kInternal}, LineClass::crease), 79, 80)[0], 0.512, 0.001);
    for (const GBufferOperator o : {kSobel, kRoberts, kNormal, kHertzmann}) {
        const LineClassSet classes = LineClass::silhouette | LineClass::crease;
        EXPECT_EQ(sum_of(row(with(scene_flat(), {o}, classes), 70, 90)), 0);
    }
    // Another number is all that sets it apart.
    EXPECT_EQ(row(with(scene_flat(), {kId}), 77, 82), (std::vector<double>{0, 0, 1, 1, 0}));
}

TEST(Flat, IsLostInAnEightBitDepthBuffer) {
    // From the nearest point to the background 256.256 px in 255 codes: both squares get code 0.
    Scene scene = with(scene_flat(), {kProfile, kInternal, kSecond, kFirst}, LineClass::silhouette | LineClass::crease);
    scene.gbuffer.depth_bits = 8;
    EXPECT_EQ(sum_of(row(scene, 70, 90)), 0);
    scene.gbuffer.depth_bits = 24;
    EXPECT_GT(sum_of(row(scene, 70, 90)), 1);
}

TEST(Composition, DarkensWhatIsLeftOrTakesTheStrongest) {
    // Profile .064 and internal edge .512, as above.
    Scene scene = with(scene_flat(), {kProfile, kInternal}, LineClass::silhouette | LineClass::crease);
    EXPECT_NEAR(row(scene, 79, 80)[0], 1 - (1 - 0.064) * (1 - 0.512), 0.001);
    scene.gbuffer.composition = LineComposition::maximum;
    EXPECT_NEAR(row(scene, 79, 80)[0], 0.512, 0.001);
}

// ---- false lines ----

TEST(Grazing, FloorFillsWithFalseLinesOnlyByAbsoluteDepth) {
    // 2 degrees: depth grows by 28.6 px a pixel. The floor begins and ends 28 pixels from the
    // border.
    const PixelRect inside{32, 32, 224, 224};
    const auto black = [&](GBufferOperator o) {
        const Scene scene = with(scene_graze(), {o});
        const Drawing d(scene, scene_graze().camera, kSize, kSize, {0, 0, kSize, kSize}, 2, render_gbuffer);
        return sum_within(d, inside);
    };
    for (const GBufferOperator o : {kFirst, kSobel, kHertzmann}) EXPECT_EQ(black(o), 192 * 192);
    for (const GBufferOperator o : {kProfile, kSecond, kInternal, kNormal, kRoberts, kDecaudin}) {
        EXPECT_LT(black(o), 0.1) << static_cast<int>(o);
    }
}

/// Share of a ball that lines cover, without the two pixels at its outline.
double blackened(const Scene& scene, glm::dvec2 middle, double radius_px) {
    const Drawing d = draw(scene);
    double black = 0, all = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            if (glm::distance(glm::dvec2(x + 0.5, y + 0.5), middle) > radius_px - 2) continue;
            black += d.line(x, y);
            ++all;
        }
    }
    return black / all;
}

TEST(Curvature, OfSmallBallsIsTakenForCreases) {
    const auto small = [](GBufferOperator o, double crease_angle_deg) {
        Scene scene = with(scene_curv(), {o});
        scene.lines.crease_angle_deg = crease_angle_deg;
        return blackened(scene, {20.3 + 3 * 30.7, 20.6 + 4 * 30.4}, 6);
    };
    const auto large = [](GBufferOperator o, double crease_angle_deg) {
        const glm::dvec2 middle(128.2, 128.3);
        Scene scene =
            with({transformed(make_sphere(60, 64, 32), [&](glm::dvec3 p) { return p + at(middle.x, middle.y); })}, {o});
        scene.lines.crease_angle_deg = crease_angle_deg;
        return blackened(scene, middle, 60);
    };
    EXPECT_GT(small(kInternal, 40), 0.6);
    EXPECT_LT(large(kInternal, 40), 0.3);
    EXPECT_GT(small(kNormal, 20), 0.6);
    EXPECT_LT(large(kNormal, 20), 0.02);
    EXPECT_LT(small(kNormal, 40), 0.4);  // at the default angle much of the ball survives
}

TEST(DenseMesh, TurnsSolid) {
    const Drawing d = draw(with(scene_dense(), {kId}, LineClass::polygon));
    EXPECT_EQ(sum_within(d, {60, 60, 196, 196}), 136 * 136);
}

// ---- what the samples miss ----

TEST(ThinBar, AppearsAndVanishesAsItMoves) {
    int present = 0;
    for (int i = 0; i < 32; ++i) {
        const double sum = sum_of(row(with(scene_thin(i / 32.0), {kProfile}), 120, 140));
        EXPECT_TRUE(sum == 0 || sum == 2) << i;  // nothing, or the columns beside it: in it g is 0
        present += sum > 0;
    }
    EXPECT_NEAR(present, 0.3 * 32, 1.5);  // as often as a sample lies in the bar
}

TEST(Cut, OfALineByAnEdgeInFrontIsAliased) {
    for (const double angle_deg : {5.0, 17.0, 40.0}) {
        EXPECT_EQ(levels(draw(with(scene_cut(angle_deg), {kId}, LineClassSet::all()))), (std::set<double>{0, 1}));
    }
}

TEST(Width, DependsOnTheAngleOfTheLine) {
    const auto width_at = [](double angle_deg, GBufferOperator o, int neighbours) {
        const double a = angle_deg * std::numbers::pi / 180;
        const glm::dvec2 along(std::cos(a), std::sin(a)), across(-along.y, along.x);
        const auto corner = [&](double u, double v) {
            return glm::dvec3(glm::dvec2(128.3, 128.1) + u * along + v * across, 0);
        };
        Scene scene = with({polygon({corner(-400, 0), corner(400, 0), corner(400, 400), corner(-400, 400)})}, {o});
        scene.gbuffer.id_neighbours = neighbours;
        const Drawing d = draw(scene);
        const double length = 200 / std::max(std::abs(along.x), std::abs(along.y));
        return sum_within(d, {28, 28, 228, 228}) / length;
    };
    for (const double angle_deg : {0.0, 10.0, 26.0, 45.0, 90.0}) {
        const double c = std::cos(angle_deg * std::numbers::pi / 180), s = std::sin(angle_deg * std::numbers::pi / 180);
        EXPECT_NEAR(width_at(angle_deg, kId, 8), 2 * (c + s), 0.03) << angle_deg;
        EXPECT_NEAR(width_at(angle_deg, kId, 4), 2 * std::max(c, s), 0.03) << angle_deg;
        EXPECT_NEAR(width_at(angle_deg, kProfile, 8), 2 * std::max(c, s), 0.03) << angle_deg;
        EXPECT_NEAR(width_at(angle_deg, kRoberts, 8), c + s, 0.03) << angle_deg;
    }
}

// ---- what it gets right ----

TEST(SteepFaces, HaveLinesWithoutGaps) {
    for (const double b : {1e-4, -1e-3, 1e-2, -1e-2}) {
        const MinimalScene slope = scene_slope(b);
        const Drawing d = draw(with(slope, {kId}, LineClass::polygon));
        EXPECT_EQ(d.drawn_share(slope.lines[0].a, slope.lines[0].b), 1) << b;
    }
}

TEST(HiddenLines, DoNotLeakThroughSurfacesHoweverClose) {
    for (const double gap : {1e-6, 1e-4, 1e-2, 1e-1}) {
        EXPECT_EQ(draw(with(scene_gap(gap), {kId, kProfile, kInternal}, LineClassSet::all())).sum("lines.A"), 0) << gap;
    }
    // One ball within another, and the back of a wedge: their numbers are never seen.
    EXPECT_EQ(draw(with(scene_sphere(), {kId}, LineClass::object)).sum("lines.A"), 0);
    EXPECT_EQ(draw(with(scene_back(), {kId}, LineClass::object)).sum("lines.A"), 0);
}

TEST(Intersections, AreBendsOfDepthOrBordersOfNumbers) {
    const MinimalScene crossing = scene_intersect();
    const glm::dvec2 a = crossing.lines[0].a, b = crossing.lines[0].b;
    const Drawing bend = draw(with(crossing, {kInternal}, LineClass::crease | LineClass::intersection));
    EXPECT_GT(bend.drawn_share(a, b), 0.99);
    EXPECT_EQ(bend.sum(LineClass::intersection), 0);  // what it is called is another matter
    EXPECT_GT(draw(with(crossing, {kId}, LineClass::object)).drawn_share(a, b), 0.99);
}

TEST(Concave, PolygonsHaveTheirOutlineAndNoDiagonals) {
    const MinimalScene shape = scene_concave();
    const Drawing d = draw(with(shape, {kId, kProfile}, LineClassSet::all()));
    for (const ScreenSegment& s : shape.lines) EXPECT_EQ(d.drawn_share(s.a, s.b), 1);
    EXPECT_EQ(sum_within(d, {44, 44, 117, 211}), 0);
    EXPECT_EQ(sum_within(d, {44, 134, 207, 211}), 0);
}

TEST(Winding, AndOrderOfDrawingDoNotMatter) {
    EXPECT_EQ(draw(with(scene_pair(true), {kId}, LineClass::polygon)).coverage(),
              draw(with(scene_pair(false), {kId}, LineClass::polygon)).coverage());
}

std::vector<PolygonSoup> busy_scene() {
    const auto placed = [](PolygonSoup soup, glm::dvec3 p) {
        return transformed(std::move(soup), [p](glm::dvec3 v) {
            return glm::dvec3(0.8 * v.x - 0.6 * v.z, v.y, 0.6 * v.x + 0.8 * v.z) + p;
        });
    };
    return {placed(make_box({90, 70, 80}), at(90, 100)), placed(make_torus(50, 20, 40, 20), at(150, 150)),
            placed(make_sphere(40, 24, 12), at(180, 90, -20))};
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
                ASSERT_EQ(part.at(c.name, x, y), all.at(c.name, x + crop.x0, y + crop.y0))
                    << c.name << " " << x << "," << y;
            }
        }
    }
}

TEST(Bits, DoNotDependOnTheOrderOfObjects) {
    std::vector<PolygonSoup> objects = busy_scene();
    const Drawing forth = draw(with(objects, {kProfile, kInternal, kId}));
    std::reverse(objects.begin(), objects.end());
    EXPECT_EQ(forth.coverage(), draw(with(objects, {kProfile, kInternal, kId})).coverage());
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
    // Patel's masks have their middle sample beside the pixel's centre; away from borders they
    // agree.
    const Scene scene = with(busy_scene(), {kProfile});
    const Drawing ours = draw(scene), patels(scene, pixel_camera(kSize, kSize), kSize, kSize);
    int equal = 0, all = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            ++all;
            if (ours.at("id.polygon", x, y) != patels.at("id.polygon", x, y)) continue;
            ++equal;
            const double z = ours.at("Z", x, y), object = ours.at("id.object", x, y);
            ASSERT_EQ(std::isinf(z), object == 0);
            ASSERT_EQ(std::isinf(patels.at("Z", x, y)), object == 0);
            if (object == 1) {  // the box, whose polygons are flat
                ASSERT_NEAR(z, patels.at("Z", x, y), 0.1);
            }
            for (const char* channel : {"N.X", "N.Y", "N.Z", "id.object", "id.material"}) {
                ASSERT_EQ(ours.at(channel, x, y), patels.at(channel, x, y)) << channel << " " << x << "," << y;
            }
        }
    }
    EXPECT_GT(equal, 0.95 * all);
}

TEST(Perspective, SlopesAreTangentsAtTheReferenceDistance) {
    // Two planes that meet in a vertical ridge at the reference distance, each turned by 20
    // degrees: depth bends by 2 tan 20 px in one column, or by half in two.
    const double t = std::tan(20 * std::numbers::pi / 180);
    const PolygonSoup roof = soup_of({{0, -1, 0}, {0, 1, 0}, {1, 1, -t}, {1, -1, -t}, {-1, 1, -t}, {-1, -1, -t}},
                                     {{0, 1, 2, 3}, {0, 1, 4, 5}});
    Scene scene = with({roof}, {kSecond}, LineClass::crease);
    scene.gbuffer.reference_distance = 5;
    scene.gbuffer.crease_limit = 4 * t;
    scene.gbuffer.dilate = false;
    const Drawing d(scene, perspective_camera({0, 0, 5}, {0, 0, 0}, 15), kSize, kSize, {0, 0, kSize, kSize}, 2,
                    render_gbuffer);
    EXPECT_NEAR(sum_within(d, {120, 128, 136, 129}), 2 * t / (4 * t), 0.02);
}

TEST(Hatching, IsDarkerWhereTheSurfaceTurnsAway) {
    const PolygonSoup ball = transformed(make_sphere(100, 128, 64), [](glm::dvec3 p) { return p + at(128, 128); });
    Scene scene = with({ball}, {kProfile});
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
    EXPECT_NEAR(ink(120, 136), 0.8, 0.03);                                                 // contours: 4 of 5 px
    EXPECT_EQ(draw(scene).sum("lines.A"), draw(with({ball}, {kProfile})).sum("lines.A"));  // no lines
    scene.gbuffer.hatching = true;
    EXPECT_LT(ink(120, 136), 0.1);
    EXPECT_GT(ink(210, 216), 0.25);
}

}  // namespace
}  // namespace burin::gbuffer_scenes_test
