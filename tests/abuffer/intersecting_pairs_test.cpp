// Hidden intersections: the pairs of triangles that are searched once for all views, and what hides lines.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <tuple>

#include "abuffer/edges/box_tree.h"
#include "abuffer/edges/intersecting_pairs.h"
#include "abuffer/hidden_pass.h"
#include "abuffer/screen/triangle_bins.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"

namespace burin::intersecting_pairs_test {
namespace {

using namespace test;

using Point = glm::dvec3;  // whole numbers, so small that all that follows is exact
using Points = std::array<Point, 3>;

double volume(const Points& t, const Point& p) { return glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), p - t[0]); }

/// On which sides of the edges of a triangle the line from p to q passes, exactly: -1, 0 or 1 where all agree, else 2.
int passage(const Points& t, const Point& p, const Point& q) {
    int low = 1, high = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double v = volume({p, q, t[k]}, t[(k + 1) % 3]);
        const int sign = v > 0 ? 1 : v < 0 ? -1 : 0;
        low = std::min(low, sign);
        high = std::max(high, sign);
    }
    return low * high < 0 ? 2 : low + high == 0 ? 0 : high > 0 ? (low > 0 ? 1 : 0) : (high < 0 ? -1 : 0);
}

/// Whether an edge of one passes through the inside of the other.
bool pass_through(const Points& a, const Points& b) {
    for (const auto& [plane, edges] : {std::pair(a, b), std::pair(b, a)}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Point &p = edges[k], &q = edges[(k + 1) % 3];
            const double at_p = volume(plane, p), at_q = volume(plane, q);
            const bool is_cut = (at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0);
            if (is_cut && std::abs(passage(plane, p, q)) == 1) return true;
        }
    }
    return false;
}

/// Whether they have any point in common.
bool meet(const Points& a, const Points& b) {
    for (const auto& [plane, edges] : {std::pair(a, b), std::pair(b, a)}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Point &p = edges[k], &q = edges[(k + 1) % 3];
            const double at_p = volume(plane, p), at_q = volume(plane, q);
            if ((at_p > 0 && at_q > 0) || (at_p < 0 && at_q < 0)) continue;
            if ((at_p == 0 && at_q == 0) || passage(plane, p, q) != 2) return true;
        }
    }
    return false;
}

TEST(IntersectionTest, IsTrueOfTrianglesThatPassThroughEachOtherAndOfNoneThatAreApart) {
    int passing = 0, apart = 0, touching = 0;
    for (std::uint64_t trial = 0; trial < 20000; ++trial) {
        Random random(trial);
        const int size = random.integer(2, 40);
        Points points[2];
        std::vector<glm::dvec3> positions;
        for (Points& t : points) {
            for (Point& p : t) {
                p = {random.integer(-size, size), random.integer(-size, size), random.integer(-size, size)};
                positions.push_back(p);
            }
        }
        const bool is_flat =
            volume(points[0], points[0][0] + glm::cross(points[0][1] - points[0][0], points[0][2] - points[0][0])) ==
                0 ||
            volume(points[1], points[1][0] + glm::cross(points[1][1] - points[1][0], points[1][2] - points[1][0])) == 0;
        if (is_flat) continue;
        const Scene scene = scene_of({soup_of(positions, {{0, 1, 2}, {3, 4, 5}})});
        ASSERT_EQ(scene.meshes[0].triangles.size(), 2u);
        const bool may = IntersectionTest(scene).may_intersect({0, 0}, {0, 1});
        if (pass_through(points[0], points[1])) {
            ++passing;
            ASSERT_TRUE(may) << "trial " << trial;
        } else if (!meet(points[0], points[1])) {
            ++apart;
            ASSERT_FALSE(may) << "trial " << trial;
        } else {
            ++touching;
        }
    }
    EXPECT_GT(passing, 3000);
    EXPECT_GT(apart, 3000);
    EXPECT_GT(touching, 20);
}

TEST(IntersectionTest, SeesATipThatSinglePrecisionDoesNot) {
    Scene scene = scene_of({soup_of({{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}, {{0, 1, 2}}),
                            soup_of({{0, 0, 1}, {-1, 0, -1}, {1, 0, -1}}, {{0, 1, 2}})});
    scene.objects[1].to_world = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 1e-10));
    EXPECT_TRUE(IntersectionTest(scene).may_intersect({0, 0}, {1, 0}));
}

/// Objects of loose triangles and closed surfaces, small and large, in and beside each other.
Scene tangle(Random& random) {
    std::vector<PolygonSoup> objects;
    const int count = random.integer(1, 5);
    for (int i = 0; i < count; ++i) {
        PolygonSoup soup;
        const double size = std::pow(10.0, random.real(-2, 0.7));
        switch (random.integer(0, 3)) {
            case 0:
                soup = make_torus(size, 0.4 * size, random.integer(5, 30), random.integer(4, 20));
                break;
            case 1:
                soup = make_box(glm::dvec3(random.real(0.5, 1), random.real(0.5, 1), random.real(0.01, 1)) * size);
                break;
            case 2:
                soup = make_plane(size, size, random.integer(1, 9), random.integer(1, 9));
                break;
            default:
                for (std::uint32_t t = 0; t < static_cast<std::uint32_t>(random.integer(1, 60)); ++t) {
                    const glm::dvec3 center = random.in_box(0.7 * size);
                    for (int k = 0; k < 3; ++k)
                        soup.positions.push_back(center + random.direction() * random.real(0, size));
                    soup.add_polygon(std::vector<std::uint32_t>{3 * t, 3 * t + 1, 3 * t + 2});
                }
        }
        objects.push_back(std::move(soup));
    }
    Scene scene = scene_of(std::move(objects));
    const std::size_t given = scene.objects.size();
    for (std::size_t i = 0; i < given + 2; ++i) {
        if (i >= given) scene.objects.push_back(scene.objects[i - given]);
        scene.objects[i].to_world =
            glm::rotate(glm::translate(glm::dmat4(1.0), random.in_box(0.6)), random.real(0, 6), random.direction());
    }
    return scene;
}

TEST(IntersectingPairs, AreAllThatMayIntersect) {
    std::size_t total = 0;
    for (std::uint64_t trial = 0; trial < 40; ++trial) {
        Random random(trial);
        const Scene scene = tangle(random);
        const IntersectionTest test(scene);
        std::vector<SurfacePair> expected;
        std::vector<SurfaceId> all;
        for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
            const auto count = static_cast<std::uint32_t>(scene.meshes[scene.objects[o].mesh].triangles.size());
            for (std::uint32_t t = 0; t < count; ++t) all.push_back({o, t});
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto& a = scene.meshes[scene.objects[all[i].instance].mesh].triangles[all[i].triangle];
            for (std::size_t k = i + 1; k < all.size(); ++k) {
                const auto& b = scene.meshes[scene.objects[all[k].instance].mesh].triangles[all[k].triangle];
                const bool is_connected =
                    all[i].instance == all[k].instance && std::any_of(a.begin(), a.end(), [&](std::uint32_t v) {
                        return std::count(b.begin(), b.end(), v) > 0;
                    });
                if (!is_connected && test.may_intersect(all[i], all[k])) expected.push_back({all[i], all[k]});
            }
        }
        total += expected.size();
        for (const TileKernels* kernels : {&baseline_kernels(), &best_kernels()}) {
            const auto found = find_intersecting_pairs(scene, *kernels, trial % 2 == 0 ? 1 : 3);
            ASSERT_TRUE(found.has_value());
            ASSERT_EQ(*found, expected) << "trial " << trial << ", " << all.size() << " triangles";
        }
    }
    EXPECT_GT(total, 1000u);
}

TEST(IntersectingPairs, NeedNoTriangles) {
    const auto pairs = find_intersecting_pairs(scene_of({soup_of({{0, 0, 0}}, {})}), best_kernels(), 1);
    ASSERT_TRUE(pairs.has_value());
    EXPECT_TRUE(pairs->empty());
}

TEST(IntersectingPairs, AreLeftToTheViewWhereSinglePrecisionEnds) {
    Scene scene = scene_of({make_box({1, 1, 1}), make_box({1, 1, 1})});
    for (SceneObject& o : scene.objects) o.to_world = glm::scale(glm::dmat4(1.0), glm::dvec3(1e40));
    EXPECT_FALSE(find_intersecting_pairs(scene, best_kernels(), 1).has_value());
}

/// Long facets around a slanted axis: the boxes of all overlap, and hardly any intersect.
Scene slanted_facets(std::uint32_t count) {
    PolygonSoup soup;
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 1, 1)), u = glm::normalize(glm::dvec3(1, -1, 0)),
                     v = glm::cross(axis, u);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double a = 6.283185307179586 * i / count;
        const glm::dvec3 around = std::cos(a) * u + std::sin(a) * v;
        soup.positions.push_back(0.3 * around - axis);
        soup.positions.push_back(0.3 * around + axis);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        soup.add_polygon(std::vector<std::uint32_t>{2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    }
    Scene scene = scene_of({soup});
    scene.lines.style.hidden.style = HiddenStyle::solid;
    return scene;
}

TEST(IntersectingPairs, AreLeftToTheViewWhereAllBoxesOverlap) {
    Scene few = slanted_facets(100), many = slanted_facets(3000);
    EXPECT_TRUE(prepare_for_abuffer(few, 1).intersecting_pairs.has_value());
    for (const int threads : {1, 2, 3}) {
        EXPECT_FALSE(prepare_for_abuffer(many, threads).intersecting_pairs.has_value());
    }
}

TEST(BoxTree, FindsEachPairOnce) {
    for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 63u, 65u, 600u, 5000u}) {
        Random random(count);
        std::vector<ScreenBox> boxes(count);
        for (ScreenBox& b : boxes) {
            const auto range = [&](float& low, float& high) {
                low = static_cast<float>(random.real(0, 1));
                high = low + static_cast<float>(random.real(0, random.integer(0, 9) == 0 ? 0.5 : 0.05));
            };
            range(b.x0, b.x1);
            range(b.y0, b.y1);
            range(b.low, b.high);
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> expected, found;
        for (std::uint32_t i = 0; i < count; ++i) {
            for (std::uint32_t k = i + 1; k < count; ++k) {
                const ScreenBox &a = boxes[i], &b = boxes[k];
                if (a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1 && a.low < b.high && b.low < a.high)
                    expected.push_back({i, k});
            }
        }
        const BoxTree tree(boxes, best_kernels(), 2);
        const auto tasks = tree.tasks();
        ASSERT_TRUE(tasks.has_value());
        for (const BoxTree::NodePair& task : *tasks) {
            tree.for_leaf_pairs(task, [&](std::uint32_t a, std::uint32_t b, std::uint64_t overlapping) {
                BoxTree::for_bits(overlapping, [&](std::uint32_t i, std::uint32_t k) {
                    found.push_back(std::minmax({tree.order()[a + i], tree.order()[b + k]}));
                });
            });
        }
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected) << count << " boxes";
    }
}

constexpr int kWidth = 200, kHeight = 160;

constexpr PixelRect kWhole{0, 0, kWidth, kHeight};

Image draw(const Scene& scene, const Camera& camera, PixelRect crop = kWhole, int threads = 2,
           const PreparedScene* prepared = nullptr) {
    const Frame frame = make_frame(scene, camera, kWidth, kHeight, crop, prepared);
    Film film({0, 0, kWidth, kHeight}, crop, LayerSet{true, true, true, true, true, true, true, true},
              frame.criteria.classes);
    RunOptions options;
    options.threads = threads;
    render_abuffer(frame, options, film);
    return film.image();
}

/// Some cameras are between the objects.
Camera camera_for(Random& random) {
    const double distance = random.integer(0, 2) == 0 ? 0.3 : 4;
    return perspective_camera(distance * random.direction(), random.in_box(0.1), random.real(25, 60));
}

TEST(IntersectingPairs, ChangeNoPicture) {
    double hidden = 0;
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
        Random random(trial);
        Scene scene = tangle(random);
        scene.lines.style.hidden.style = trial % 3 == 0 ? HiddenStyle::dashed : HiddenStyle::solid;
        scene.lines.classes = trial % 2 == 0 ? LineClassSet(LineClass::intersection) : LineClassSet::all();
        if (trial % 5 == 0) scene.materials[0].opacity = 0.5f;
        const Camera camera = camera_for(random);
        const Image without = draw(scene, camera);
        const PreparedScene prepared = prepare_for_abuffer(scene, 2);
        ASSERT_TRUE(prepared.intersecting_pairs.has_value());
        const Image with = draw(scene, camera, kWhole, 2, &prepared);
        ASSERT_TRUE(same_bits(without, with)) << "trial " << trial;
        const Channel* const channel = with.find("lines_hidden.A");
        ASSERT_NE(channel, nullptr);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) hidden += with.value(*channel, x, y);
        }
    }
    EXPECT_GT(hidden, 10000);
}

/// The lines of a scene with what is in front of them.
struct Found {
    std::vector<WholeLine> lines;
    std::vector<LinePart> pieces;

    Found(const Scene& scene, const Camera& camera, int threads, const PreparedScene* prepared = nullptr) {
        const Frame frame = make_frame(scene, camera, kWidth, kHeight, kWhole, prepared);
        ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), threads);
        const TriangleBins bins(screen, frame.crop, 4, best_kernels(), threads);
        HiddenPass pass(frame, screen, best_kernels(), threads);
        find_all(pass, frame);
        lines = pass.lines();
        pieces = pass.parts();
        const auto key = [](const LinePart& p) { return std::tuple(p.line, p.begin, p.end); };
        std::sort(pieces.begin(), pieces.end(), [&](const LinePart& a, const LinePart& b) { return key(a) < key(b); });
    }
};

TEST(IntersectingPairs, GiveTheSameLinesAndPieces) {
    std::size_t intersections = 0, cut = 0;
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
        Random random(trial);
        Scene scene = tangle(random);
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Camera camera = camera_for(random);
        const Found without(scene, camera, 2);
        const PreparedScene prepared = prepare_for_abuffer(scene, 2);
        const Found with(scene, camera, 3, &prepared);
        ASSERT_EQ(with.lines.size(), without.lines.size()) << "trial " << trial;
        for (std::size_t i = 0; i < with.lines.size(); ++i) {
            const WholeLine &a = with.lines[i], &b = without.lines[i];
            ASSERT_TRUE(a.from == b.from && a.to == b.to && a.owners == b.owners && a.nodes == b.nodes &&
                        a.drawn_as == b.drawn_as)
                << "trial " << trial << ", line " << i;
            if (a.drawn_as != LineClass::intersection) continue;
            ++intersections;
            const Frame frame = make_frame(scene, camera, kWidth, kHeight, {0, 0, kWidth, kHeight});
            const ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
            for (const std::uint32_t owner : a.owners) {
                for (const ScreenVertex& v : screen.triangle(screen.surface_of(owner)).corners)
                    cut += v.x == ScreenVertex::kOffScreen;
            }
        }
        ASSERT_EQ(with.pieces.size(), without.pieces.size()) << "trial " << trial;
        for (std::size_t i = 0; i < with.pieces.size(); ++i) {
            const LinePart &a = with.pieces[i], &b = without.pieces[i];
            ASSERT_TRUE(a.line == b.line && a.begin == b.begin && a.end == b.end && a.invisibility == b.invisibility)
                << "trial " << trial << ", piece " << i;
        }
    }
    EXPECT_GT(intersections, 1000u);
    EXPECT_GT(cut, 50u);
}

/// Folded sheets whose folds lie about in the plane of a wall, some steep and some flat to the eye.
Scene folds_in_walls(Random& random) {
    std::vector<PolygonSoup> objects{
        transformed(make_plane(4, 4, 3, 3), [](glm::dvec3 p) { return glm::dvec3(p.x, p.z, 0); })};
    for (int i = 0; i < 12; ++i) {
        const auto near = [&](double z) { return glm::dvec3(random.real(-1.8, 1.8), random.real(-1.8, 1.8), z); };
        const double off = std::pow(10.0, random.real(-6, -2));
        const auto in_wall = [&] { return near(random.real(-off, off)); };
        objects.push_back(soup_of({in_wall(), in_wall(), near(random.real(0.01, 1)), near(random.real(-1, -0.01))},
                                  {{0, 1, 2}, {1, 0, 3}}));
    }
    return scene_of(std::move(objects));
}

TEST(IntersectingPairs, GiveTheSameLinesWhereFoldsLieInPlanes) {
    std::size_t intersections = 0;
    for (std::uint64_t trial = 0; trial < 200; ++trial) {
        Random random(trial);
        Scene scene = folds_in_walls(random);
        scene.lines.style.hidden.style = HiddenStyle::solid;
        const Camera camera = perspective_camera(random.real(3, 12) * random.direction(), {0, 0, 0}, 40);
        const Found without(scene, camera, 2);
        const PreparedScene prepared = prepare_for_abuffer(scene, 2);
        const Found with(scene, camera, 1, &prepared);
        ASSERT_EQ(with.lines.size(), without.lines.size()) << "trial " << trial;
        for (std::size_t i = 0; i < with.lines.size(); ++i) {
            ASSERT_TRUE(with.lines[i].from == without.lines[i].from && with.lines[i].to == without.lines[i].to)
                << "trial " << trial;
            intersections += with.lines[i].drawn_as == LineClass::intersection;
        }
    }
    EXPECT_GT(intersections, 1000u);
}

/// Where a line, behind a wall all along, also goes behind a narrower wall; with many triangles around it or few.
double second_wall_begins_at(double x, bool has_many, int crop_x0) {
    const auto wall = [](double x0, double y0, double x1, double y1, double z) {
        return soup_of({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2, 3}});
    };
    std::vector<PolygonSoup> objects{wall(-5, -5, 105, 105, 50), wall(x, 20, 90, 90, 40), wall(5, 50, 95, 80, 0)};
    if (has_many) {
        objects.push_back(
            transformed(make_plane(60, 40, 40, 40), [](glm::dvec3 p) { return glm::dvec3(p.x + 50, p.z + 60, 70); }));
    }
    Scene scene = scene_of(std::move(objects));
    scene.lines.style.hidden.style = HiddenStyle::solid;
    scene.lines.classes = LineClassSet::all();
    const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {crop_x0, 0, 100, 100});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const TriangleBins bins(screen, {0, 0, 100, 100}, 4, best_kernels(), 1);
    HiddenPass pass(frame, screen, best_kernels(), 1);
    find_all(pass, frame);
    const int before = has_many ? 2 : 1;
    for (const LinePart& p : pass.parts()) {
        const WholeLine& line = pass.lines()[p.line];
        if (line.from.y != 50 * 256 || line.to.y != 50 * 256 || p.invisibility != before + 1) continue;
        const double at = glm::mix(line.from.x, line.to.x, line.from.x < line.to.x ? p.begin : p.end) / 256;
        if (std::abs(at - x) < 0.5) return at;
    }
    return -1;
}

TEST(HiddenLines, WhereOneGoesBehindAWallHangsOnNoCellNorTile) {
    // Just behind a border of cells, or of tiles if these began at the crop.
    for (const double x : {40 + 1.0 / 64, 48 + 1.0 / 64, 36 + 1.0 / 64, 41.5}) {
        for (const bool has_many : {false, true}) {
            for (int crop_x0 = 0; crop_x0 < 32; ++crop_x0) {
                EXPECT_NEAR(second_wall_begins_at(x, has_many, crop_x0), x, 1e-6) << has_many << ' ' << crop_x0;
            }
        }
    }
}

TEST(IntersectingPairs, AreNotMadeWhereNobodyAsksForThem) {
    Random random(1);
    Scene scene = tangle(random);
    EXPECT_FALSE(prepare_for_abuffer(scene, 1).intersecting_pairs.has_value());
    scene.lines.style.hidden.style = HiddenStyle::solid;
    EXPECT_FALSE(prepare_for_abuffer(scene, 1, true).intersecting_pairs.has_value());
    scene.lines.classes = LineClass::silhouette;
    EXPECT_FALSE(prepare_for_abuffer(scene, 1).intersecting_pairs.has_value());
    scene.lines.classes = LineClass::intersection;
    EXPECT_TRUE(prepare_for_abuffer(scene, 1).intersecting_pairs.has_value());
}

TEST(HiddenLines, ACropIsThatPartOfTheWhole) {
    for (std::uint64_t trial = 0; trial < 40; ++trial) {
        Random random(trial);
        Scene scene = tangle(random);
        scene.lines.style.hidden.style = trial % 2 == 0 ? HiddenStyle::dashed : HiddenStyle::solid;
        if (trial % 5 == 0) scene.materials[0].opacity = 0.5f;
        const Camera camera = camera_for(random);
        PreparedScene prepared;
        if (trial % 3 == 0) prepared = prepare_for_abuffer(scene, 2);
        const Image whole = draw(scene, camera, kWhole, 2, &prepared);
        const int x0 = random.integer(0, kWidth - 20), y0 = random.integer(0, kHeight - 20);
        const PixelRect crop{x0, y0, random.integer(x0 + 1, kWidth), random.integer(y0 + 1, kHeight)};
        const Image part = draw(scene, camera, crop, 2, &prepared);
        for (const std::string name : {"lines.A", "lines_hidden.A", "R"}) {
            const Channel *const in_whole = whole.find(name), *const in_part = part.find(name);
            ASSERT_TRUE(in_whole != nullptr && in_part != nullptr) << name;
            for (int y = crop.y0; y < crop.y1; ++y) {
                for (int x = crop.x0; x < crop.x1; ++x) {
                    ASSERT_EQ(part.value(*in_part, x - crop.x0, y - crop.y0), whole.value(*in_whole, x, y))
                        << "trial " << trial << ", " << name << " at " << x << ',' << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace burin::intersecting_pairs_test
