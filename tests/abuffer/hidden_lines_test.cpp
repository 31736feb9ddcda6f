#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "abuffer/hiding/pieces_behind.h"
#include "mesh/shapes.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::hidden_lines_test {
namespace {

using namespace test;

TEST(HiddenLines, ACubeShowsNineEdgesAndHidesThree) {
    for (const bool orthographic : {false, true}) {
        for (std::uint64_t trial = 0; trial < 40; ++trial) {
            Random random(trial);
            glm::dvec3 direction = glm::abs(random.direction()) + 0.15;
            direction = glm::normalize(direction) * (random.bits() % 2 ? 1.0 : -1.0);
            const Camera camera =
                orthographic ? ortho_camera(6.0 * direction, 2.5) : perspective_camera(6.0 * direction, {0, 0, 0}, 25);
            const Scene scene = scene_of({make_box({1, 1, 1})});
            const Layers layers(scene, camera);
            ASSERT_EQ(layers.pass.lines().size(), 12u);
            // The corner farthest from the eye has the three hidden edges.
            const glm::dvec3 corner = -0.5 * glm::sign(direction);
            double expected = 0;
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 other = corner;
                other[axis] = -other[axis];
                expected +=
                    glm::distance(pixel_of(layers.frame, camera, corner), pixel_of(layers.frame, camera, other));
            }
            EXPECT_NEAR(layers.hidden_px(1), expected, 0.75) << trial;
            EXPECT_NEAR(layers.all_hidden_px(), layers.hidden_px(1), 1e-9) << trial;
            std::map<std::uint32_t, double> share;
            for (const LinePart& p : layers.pass.parts()) share[p.line] += p.end - p.begin;
            EXPECT_EQ(share.size(), 3u) << trial;
        }
    }
}

// Seen along its diagonal, as in an isometric view, hidden edges lie behind the edges and diagonals of what hides them:
// each triangle there hides half of such a line's width, and together they hide it.
TEST(HiddenLines, OfACubeSeenAlongItsDiagonal) {
    const PolygonSoup plain = make_box({1, 1, 1});
    for (const glm::dvec3 direction : {glm::dvec3(1, 1, 1), {-1, 1, 1}, {1, -0.8, 1}, {1, 0.998, 1}, {1, 1, -1.02}}) {
        for (int first = 0; first < 8; ++first) {  // corners of the polygons, and whether they run backwards
            PolygonSoup box;
            box.positions = plain.positions;
            for (std::size_t i = 0; i < plain.polygon_count(); ++i) {
                std::vector<std::uint32_t> corners(plain.polygon(i).begin(), plain.polygon(i).end());
                std::rotate(corners.begin(), corners.begin() + first % 4, corners.end());
                if (first >= 4) std::reverse(corners.begin(), corners.end());
                box.add_polygon(corners);
            }
            for (const Camera& camera :
                 {ortho_camera(6.0 * direction, 2.5), perspective_camera(6.0 * direction, {0, 0, 0}, 20)}) {
                const Layers layers(scene_of({box}), camera);
                double expected = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    glm::dvec3 corner = -0.5 * glm::sign(direction);
                    const glm::dvec2 from = pixel_of(layers.frame, camera, corner);
                    corner[axis] = -corner[axis];
                    expected += glm::distance(from, pixel_of(layers.frame, camera, corner));
                }
                EXPECT_NEAR(layers.hidden_px(1), expected, 0.75)
                    << direction.x << ' ' << direction.y << ' ' << direction.z << ' ' << first;
            }
        }
    }
}

/// Triangles of which nothing else asked before, all in one tile.
TEST(HiddenLines, TwoTrianglesPassThroughEachOtherBehindAThird) {
    const glm::dvec3 eye(0, 0, 60), a[3] = {{-1, -1, 0}, {1, -1, 0.1}, {0, 1, 0}},
                                    b[3] = {{0, -0.7, -1}, {0.1, -0.7, 1}, {0, 0.6, 0.2}};
    Scene scene = scene_of({soup_of({a[0], a[1], a[2], b[0], b[1], b[2], {-3, -3, 1.5}, {3, -3, 1.5}, {0, 4, 1.5}},
                                    {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}})});
    scene.lines.classes = LineClass::intersection;
    scene.lines.style.hidden.style = HiddenStyle::solid;
    const Layers layers(scene, perspective_camera(eye, {0, 0, 0}), 1);
    // The edges of b pass through the plane of a at the ends of the line.
    const glm::dvec3 normal = glm::cross(a[1] - a[0], a[2] - a[0]);
    std::vector<glm::dvec2> ends;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = b[k], q = b[(k + 1) % 3];
        const double at_p = glm::dot(normal, p - a[0]), at_q = glm::dot(normal, q - a[0]);
        if (at_p * at_q >= 0) continue;
        ends.push_back(layers.frame.surfaces.projection.to_pixel(glm::mix(p, q, at_p / (at_p - at_q)) - eye));
    }
    ASSERT_EQ(ends.size(), 2u);
    ASSERT_EQ(layers.pass.lines().size(), 1u);
    const WholeLine& line = layers.pass.lines()[0];
    const glm::dvec2 from = line.from / 256.0, to = line.to / 256.0;
    EXPECT_LT(std::min(glm::distance(from, ends[0]) + glm::distance(to, ends[1]),
                       glm::distance(from, ends[1]) + glm::distance(to, ends[0])),
              0.1);
    EXPECT_NEAR(layers.hidden_px(1), glm::distance(ends[0], ends[1]), 0.1);
}

/// Behind one plate or two, a line looks the same.
TEST(HiddenLines, AreOneStrokeBehindHoweverManyLayers) {
    const auto plate = [](double x0, double x1, double y, double z) {
        return soup_of({{x0, -y, z}, {x1, -y, z}, {x1, y, z}, {x0, y, z}}, {{0, 1, 2, 3}});
    };
    Scene scene = scene_of({plate(-1.7, 1.7, 0.3, 0), plate(-1.5, 0.2, 0.5, 0.5), plate(-0.3, 0.6, 0.7, 1),
                            plate(0.9, 1.3, 0.5, 0.5), plate(1.1, 1.5, 0.7, 1)});
    scene.lines.style.hidden.style = HiddenStyle::solid;
    const Layers layers(scene, ortho_camera({0, 0, 10}, 4), 1);
    const double length = layers.all_hidden_px();
    EXPECT_GT(layers.hidden_px(1), 100);
    EXPECT_GT(layers.hidden_px(2), 50);
    HiddenPass pass(layers.frame, layers.screen, best_kernels(), 1);
    find_all(pass, layers.frame);
    const std::vector<LinePiece> pieces =
        pieces_behind(pass.lines(), pass.parts(), layers.frame.needs, layers.frame.surfaces.farthest_nearness);
    const auto is_at_tile = [](glm::dvec2 p) {
        const auto is_border = [](double v) { return std::abs(v - 32 * std::round(v / 32)) < 1e-6; };
        return is_border(p.x) || is_border(p.y);
    };
    double sum = 0;
    int ends_within = 0, met_within = 0;
    for (const LinePiece& s : pieces) {
        EXPECT_TRUE(s.is_hidden());
        sum += glm::distance(s.from, s.to);
        if (is_at_tile(s.to)) continue;
        ++ends_within;
        for (const LinePiece& other : pieces) {
            const glm::dvec2 own = s.to - s.from, next = other.to - other.from;
            const bool goes_on = glm::dot(own, next) > 0.99 * glm::length(own) * glm::length(next);
            met_within += goes_on && glm::distance(s.to, other.from) < 1e-6 ? 1 : 0;
        }
    }
    EXPECT_NEAR(sum, length, 1e-6);
    EXPECT_GT(ends_within, 4);
    EXPECT_EQ(met_within, 0);
}

TEST(HiddenLines, ACubeInACube) {
    const Scene scene = scene_of({make_box({2, 2, 2}), make_box({1, 1, 1})});
    for (const Camera& camera : {ortho_camera({4, 3, 5}, 5), perspective_camera({5, 4, 7}, {0, 0, 0})}) {
        const Layers layers(scene, camera);
        ASSERT_EQ(layers.pass.lines().size(), 24u);
        // Behind the outer faces: nine edges of the inner cube; behind its own, too: the other three.
        // The outer cube's three are in part behind its faces and in part behind the inner cube's two walls.
        std::map<std::uint32_t, std::map<int, double>> of_line;
        for (const LinePart& p : layers.pass.parts()) {
            of_line[p.line][p.invisibility] += p.end - p.begin;
        }
        int once = 0, twice = 0, outer = 0;
        for (const auto& [line, shares] : of_line) {
            const bool is_outer = layers.pass.lines()[line].owners[0] < 12;
            if (is_outer) {
                ++outer;
                double total = 0;
                for (const auto& [qi, share] : shares) {
                    EXPECT_TRUE(qi == 1 || qi == 3) << qi;
                    total += share;
                }
                EXPECT_NEAR(total, 1, 0.01);
                continue;
            }
            const auto most = std::max_element(shares.begin(), shares.end(),
                                               [](const auto& a, const auto& b) { return a.second < b.second; });
            EXPECT_NEAR(most->second, 1, 0.01);
            once += most->first == 1;
            twice += most->first == 2;
        }
        EXPECT_EQ(outer, 3);
        EXPECT_EQ(once, 9);
        EXPECT_EQ(twice, 3);
    }
}

/// Counts by rays, in view space and by brute force.
class RayCounter {
  public:
    explicit RayCounter(const Frame& frame) : frame_(frame) {
        const SurfaceSet& surfaces = frame.surfaces;
        for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
            const Mesh& mesh = *surfaces.instances[i].mesh;
            for (const auto& t : mesh.triangles) {
                triangles_.push_back({i, t, surfaces.view_position(i, t[0]), surfaces.view_position(i, t[1]),
                                      surfaces.view_position(i, t[2])});
            }
        }
    }
    /// How many triangles, but those with both vertices, the ray through `pixel` meets before `distance`;
    /// -1 if one is met close to there.
    int count(glm::dvec2 pixel, double distance, std::uint32_t instance, std::uint32_t a, std::uint32_t b) const {
        const double close = 0.5 * frame_.surfaces.projection.pixel_size(distance);
        glm::dvec3 origin, ray;
        frame_.surfaces.projection.view_ray(pixel, origin, ray);
        int found = 0;
        for (const Triangle& t : triangles_) {
            const auto has = [&](std::uint32_t v) {
                return t.corners[0] == v || t.corners[1] == v || t.corners[2] == v;
            };
            if (t.instance == instance && has(a) && has(b)) continue;
            const glm::dvec3 e1 = t.b - t.a, e2 = t.c - t.a, n = glm::cross(ray, e2);
            const double det = glm::dot(e1, n);
            if (std::abs(det) < 1e-14) continue;
            const double u = glm::dot(origin - t.a, n) / det;
            const glm::dvec3 q = glm::cross(origin - t.a, e1);
            const double v = glm::dot(ray, q) / det;
            if (u < 0 || v < 0 || u + v > 1) continue;
            const double met = glm::dot(e2, q) / det;
            if (std::abs(met - distance) < close) return -1;
            found += met > 0 && met < distance;
        }
        return found;
    }

  private:
    struct Triangle {
        std::uint32_t instance;
        std::array<std::uint32_t, 3> corners;
        glm::dvec3 a, b, c;
    };
    const Frame& frame_;
    std::vector<Triangle> triangles_;
};

Scene random_scene(Random& random) {
    std::vector<PolygonSoup> objects;
    const int count = random.integer(3, 6);
    for (int i = 0; i < count; ++i) {
        PolygonSoup soup;
        switch (random.integer(0, 3)) {
            case 0:
                soup = make_box({random.real(0.3, 1.2), random.real(0.3, 1.2), random.real(0.3, 1.2)});
                break;
            case 1:
                soup = make_sphere(random.real(0.2, 0.7), 12, 7);
                break;
            case 2:
                soup = make_torus(0.5, 0.2, 14, 9);
                break;
            default:
                soup = make_plane(1.5, 1.2, 3, 2);
        }
        const glm::dvec3 axis = random.direction(), by = random.in_box(0.8);
        const double angle = random.real(0, 6);
        objects.push_back(transformed(std::move(soup), [&](glm::dvec3 p) {
            return by + p * std::cos(angle) + glm::cross(axis, p) * std::sin(angle) +
                   axis * (glm::dot(axis, p) * (1 - std::cos(angle)));
        }));
    }
    return scene_of(std::move(objects));
}

TEST(HiddenLines, InvisibilityIsWhatRaysCount) {
    int certain = 0, hidden = 0, unclear = 0;
    for (std::uint64_t trial = 0; trial < 24; ++trial) {
        Random random(trial);
        const Scene scene = random_scene(random);
        const glm::dvec3 eye = 6.0 * random.direction();
        // Every fourth camera stands between the objects: some are behind it.
        const Camera camera = trial % 4 == 0   ? perspective_camera(0.15 * eye, {0.1, 0, 0}, 70)
                              : trial % 2 == 0 ? perspective_camera(eye, {0, 0, 0})
                                               : ortho_camera(eye, 3.5);
        const Layers layers(scene, camera);
        const RayCounter rays(layers.frame);
        const SurfaceSet& surfaces = layers.frame.surfaces;
        for (std::uint32_t l = 0; l < layers.pass.lines().size(); ++l) {
            const WholeLine& line = layers.pass.lines()[l];
            if (line.nodes[0] == WholeLine::kNoNode || line.nodes[1] == WholeLine::kNoNode || line.nodes[0] >> 63)
                continue;
            const auto instance = static_cast<std::uint32_t>(line.nodes[0] >> 32);
            const auto a = static_cast<std::uint32_t>(line.nodes[0]), b = static_cast<std::uint32_t>(line.nodes[1]);
            const glm::dvec3 p = surfaces.view_position(instance, a), q = surfaces.view_position(instance, b);
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 at = glm::mix(p, q, random.real(0.02, 0.98));
                const glm::dvec2 pixel = surfaces.projection.to_pixel(at);
                if (pixel.x < 1 || pixel.y < 1 || pixel.x > kSize - 1 || pixel.y > kSize - 1) continue;
                const int expected = rays.count(pixel, -at.z, instance, a, b);
                bool is_clear = expected >= 0;
                for (int k = 0; k < 8; ++k) {
                    const glm::dvec2 beside = 0.2 * glm::dvec2(std::cos(k * 0.785 + 0.1), std::sin(k * 0.785 + 0.1));
                    is_clear = is_clear && rays.count(pixel + beside, -at.z, instance, a, b) == expected;
                }
                unclear += !is_clear;
                if (!is_clear) continue;
                const glm::dvec2 along = line.to - line.from;
                const double t = glm::dot(pixel * 256.0 - line.from, along) / glm::dot(along, along);
                ++certain;
                hidden += expected > 0;
                ASSERT_EQ(layers.invisibility(l, t), expected)
                    << "trial " << trial << " at " << pixel.x << "," << pixel.y;
            }
        }
    }
    EXPECT_GT(certain, 3000);
    EXPECT_GT(hidden, 1000);
    EXPECT_LT(unclear, certain / 5);
}

/// A wall in front of two sheets that pass through each other, in world units that are pixels.
Scene crossing_behind_wall() {
    const auto sheet = [](double inset, double slope) {
        const double l = 40 + inset, r = 200 - inset, z = slope * (80 - inset);
        return soup_of({{l, l, -z}, {r, l, z}, {r, r, z}, {l, r, -z}}, {{0, 1, 2, 3}});
    };
    return scene_of({soup_of({{20, 20, 100}, {220, 20, 100}, {220, 140, 100}, {20, 140, 100}}, {{0, 1, 2, 3}}),
                     sheet(0, 0.625), sheet(20, -0.625)});
}

TEST(HiddenLines, SheetsThatCrossBehindAWall) {
    const Scene scene = crossing_behind_wall();
    const Layers layers(scene, pixel_camera(kSize, kSize));
    // The wall hides y = 60 to 140 of the crossing, which runs along x = 120.
    EXPECT_NEAR(layers.hidden_px(1, LineClass::intersection), 80, 0.3);
    EXPECT_NEAR(layers.hidden_px(2, LineClass::intersection), 0, 1e-9);
    for (const LinePart& p : layers.pass.parts()) {
        const WholeLine& line = layers.pass.lines()[p.line];
        if (line.drawn_as != LineClass::intersection) continue;
        EXPECT_NEAR(line.from.x / 256, 120, 0.01);
        EXPECT_NEAR(line.to.x / 256, 120, 0.01);
    }
    // The inner sheet's lower and right border are behind the outer sheet and the wall.
    EXPECT_NEAR(layers.hidden_px(2, LineClass::border), 60 + 80, 0.5);
    // The wall hides the outer sheet's lower border and parts of its sides, and of the inner sheet's the rest
    // of the lower and the left border; where the wall has ended, the outer sheet hides the inner one's.
    EXPECT_NEAR(layers.hidden_px(1, LineClass::border), (160 + 100 + 100) + (60 + 80) + (40 + 60), 0.5);
}

/// Length of all lines in which surfaces pass through each other, seen or not; found tile by tile and for the whole
/// scene.
double intersections_px(const Scene& scene, const Camera& camera) {
    PreparedScene prepared;
    const auto length = [&] {
        const Layers layers(scene, camera, 2, &prepared);
        double sum = 0;
        for (const WholeLine& line : layers.pass.lines()) {
            if (line.classes.has(LineClass::intersection)) sum += line.length_px();
        }
        return sum;
    };
    const double by_tile = length();
    prepared.intersecting_pairs = find_intersecting_pairs(scene, best_kernels(), 1);
    EXPECT_NEAR(length(), by_tile, 1e-6);
    return by_tile;
}

// A ball sunk by half, a wall on the lines of a grid: each triangle at such an edge is on one side only.
TEST(HiddenLines, SurfacesThatPassThroughEachOtherAlongEdges) {
    const Camera camera = perspective_camera({3, 3, 4}, {0, 0, 0}, 30);
    const PolygonSoup ball = make_sphere(0.8, 24, 12), table = make_plane(3, 3, 1, 1), grid = make_plane(3, 3, 6, 6);
    const PolygonSoup bar = moved(make_box({0.5, 1, 2}), {0.25, 0, 0});
    for (const PolygonSoup& sheet : {table, grid}) {
        for (const PolygonSoup& body : {ball, bar}) {
            const double expected = intersections_px(scene_of({sheet, moved(body, {0.013, 0.021, 0.017})}), camera);
            for (const double height : {0.0, 1e-9, -1e-6, 1e-4, 0.002}) {
                const PolygonSoup raised = moved(body, {0, height, 0});
                for (const bool is_one_object : {false, true}) {
                    for (const bool is_first : {false, true}) {
                        std::vector<PolygonSoup> soups =
                            is_first ? std::vector{raised, sheet} : std::vector{sheet, raised};
                        if (is_one_object) soups = {joined(soups)};
                        EXPECT_NEAR(intersections_px(scene_of(soups), camera), expected, 0.04 * expected)
                            << height << is_one_object << is_first;
                    }
                }
            }
        }
    }
}

TEST(HiddenLines, WhatOnlyTouchesDoesNotPassThrough) {
    const Camera camera = perspective_camera({3, 3, 4}, {0, 0, 0}, 30);
    const PolygonSoup lying =
        transformed(make_cylinder(0.5, 0.5, 2, 12), [](glm::dvec3 p) { return glm::dvec3(p.y, p.x + 0.5, p.z); });
    for (const PolygonSoup& sheet : {make_plane(3, 3, 1, 1), make_plane(3, 3, 6, 6)}) {
        for (const PolygonSoup& body :
             {lying, moved(make_box({1, 1, 1}), {0, 0.5, 0}), moved(make_box({1, 1, 1}), {0.1, -0.5, 0.1})}) {
            EXPECT_EQ(intersections_px(scene_of({sheet, body}), camera), 0);
            EXPECT_EQ(intersections_px(scene_of({joined({sheet, body})}), camera), 0);
        }
    }
}

TEST(HiddenLines, GoToTheirOwnChannels) {
    Scene scene = crossing_behind_wall();
    scene.lines.style.hidden.color = {0.5f, 0.25f, 0.0f};
    scene.lines.style.hidden.style = HiddenStyle::solid;
    const Image image = draw(scene, pixel_camera(kSize, kSize));
    // World y runs up: the crossing is hidden in rows 100 to 180 of the picture.
    for (const int y : {110, 150, 175}) {
        EXPECT_NEAR(value(image, "lines_hidden.A", 119, y) + value(image, "lines_hidden.A", 120, y), 1, 0.02);
        EXPECT_NEAR(value(image, "lines_hidden.G", 120, y), 0.25 * value(image, "lines_hidden.A", 120, y), 1e-3);
        EXPECT_EQ(value(image, "lines.A", 120, y), 0);
        const double a = value(image, "lines_hidden.A", 120, y);
        EXPECT_NEAR(value(image, "G", 120, y), 1 - a + 0.25 * a, 2e-3) << "white paper below";
    }
    EXPECT_GT(value(image, "lines.A", 120, 70), 0.4) << "above the wall the crossing is visible";
    EXPECT_EQ(value(image, "lines_hidden.A", 120, 70), 0);
}

TEST(HiddenLines, ChangeNothingThatIsVisible) {
    Random random(7);
    Scene scene = random_scene(random);
    const Camera camera = perspective_camera({4, 3, 5}, {0, 0, 0});
    const Image without = draw(scene, camera);
    for (const HiddenStyle style : {HiddenStyle::solid, HiddenStyle::dashed}) {
        scene.lines.style.hidden.style = style;
        const Image with = draw(scene, camera);
        EXPECT_GT(sum(with, "lines_hidden.A"), 200);
        EXPECT_EQ(sum(without, "lines_hidden.A"), 0);
        for (const Channel& c : without.channels()) {
            if (c.name.size() == 1 && c.name != "Z") continue;  // R G B A
            if (c.name.starts_with("lines_hidden")) continue;
            EXPECT_EQ(c.bytes, with.find(c.name)->bytes) << c.name;
        }
        // Beauty is as before wherever visible ink is full.
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (value(without, "lines.A", x, y) < 1) continue;
                ASSERT_EQ(value(without, "R", x, y), value(with, "R", x, y)) << x << "," << y;
            }
        }
    }
}

TEST(HiddenLines, EqualForAnyNumberOfThreadsAndAnyCrop) {
    Random random(3);
    Scene scene = random_scene(random);
    scene.materials[1].opacity = 0.5f;
    scene.lines.style.hidden.style = HiddenStyle::dashed;
    const Camera camera = perspective_camera({4, 3, 5}, {0, 0, 0});
    const Image one = draw(scene, camera, 1);
    for (int threads = 2; threads <= 8; ++threads) EXPECT_TRUE(same_bits(one, draw(scene, camera, threads)));
}

TEST(HiddenLines, DashesRunOnAroundCornersOfAPolyline) {
    // A wall hides a sheet whose border consists of many short edges.
    Scene scene =
        scene_of({soup_of({{5, 5, 100}, {235, 5, 100}, {235, 235, 100}, {5, 235, 100}}, {{0, 1, 2, 3}}),
                  moved(transformed(make_plane(180, 100, 23, 1), [](glm::dvec3 p) { return glm::dvec3(p.x, p.z, 0); }),
                        {120, 120.5, 0})});
    scene.lines.style.hidden.style = HiddenStyle::dashed;
    scene.lines.style.hidden.dash_px = {{10, 6}};
    const Image image = draw(scene, pixel_camera(kSize, kSize));
    const int row = 69;                // y = 240 - 170.5
    std::vector<double> starts, ends;  // of dashes, where the coverage passes one half
    double before = value(image, "lines_hidden.A", 39, row);
    for (int x = 40; x < 200; ++x) {
        const double here = value(image, "lines_hidden.A", x, row);
        if (before < 0.5 && here >= 0.5) starts.push_back(x);
        if (before >= 0.5 && here < 0.5) ends.push_back(x);
        before = here;
    }
    ASSERT_GE(starts.size(), 8u);
    for (std::size_t i = 1; i < starts.size(); ++i) EXPECT_NEAR(starts[i] - starts[i - 1], 16, 1);
    const std::size_t skip = ends[0] < starts[0] ? 1 : 0;
    for (std::size_t i = 0; i + skip < ends.size() && i < starts.size(); ++i)
        EXPECT_NEAR(ends[i + skip] - starts[i], 10, 1.01);
}

TEST(HiddenLines, DashesHangOnNoOrder) {
    const PolygonSoup given = make_torus(0.6, 0.25, 12, 6);
    PolygonSoup turned;
    turned.positions = given.positions;
    turned.object_names = given.object_names;
    for (std::size_t p = given.polygon_count(); p-- > 0;) turned.add_polygon(given.polygon(p));
    const auto drawn = [](const PolygonSoup& soup) {
        Scene scene = scene_of({soup});
        scene.lines.crease_angle_deg = 20;
        scene.lines.style.hidden.style = HiddenStyle::dashed;
        return draw(scene, perspective_camera({0.4, 1.6, 2.1}, {0, 0, 0}));
    };
    const Image a = drawn(given), b = drawn(turned);
    EXPECT_GT(sum(a, "lines_hidden.A"), 100);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x)
            ASSERT_EQ(value(a, "lines_hidden.A", x, y), value(b, "lines_hidden.A", x, y)) << x << ' ' << y;
    }
}

TEST(HiddenLines, OpenMeshesShowTheirInsides) {
    // A box without its front: from the front, no line of it is hidden.
    const Scene scene =
        scene_of({soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                          {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}})});
    const Layers layers(scene, perspective_camera({0.5, 0.5, 5}, {0.5, 0.5, 0}, 25));
    EXPECT_EQ(layers.pass.lines().size(), 12u);
    EXPECT_NEAR(layers.all_hidden_px(), 0, 0.01);
}

}  // namespace
}  // namespace burin::hidden_lines_test
