#include "mesh/build_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <string>

#include "mesh/readers.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Polygons;
using test::Random;
using test::soup_of;

const std::vector<glm::dvec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

Mesh build_one(const PolygonSoup& soup) {
    std::vector<Mesh> meshes = build_meshes(soup, {});
    EXPECT_EQ(meshes.size(), 1u);
    test::expect_consistent(meshes.front(), "the mesh");
    return meshes.front();
}

TEST(BuildMeshes, VerticesWithEqualCoordinatesAreOne) {
    const Mesh mesh = build_one(
        soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, 0.0, -0.0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}));
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.repairs.welded_vertices, 2u);
    EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_FALSE(std::signbit(mesh.positions[0].x));
}

TEST(BuildMeshes, NearlyEqualCoordinatesAreNotWelded) {
    const double next = std::nextafter(1.0f, 2.0f);
    EXPECT_EQ(build_one(soup_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {next, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {3, 2, 4}}))
                  .positions.size(),
              5u);
    // Below single precision they are equal.
    EXPECT_EQ(
        build_one(soup_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1 + 1e-12, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {3, 2, 4}}))
            .positions.size(),
        4u);
}

TEST(BuildMeshes, ObjectsAreNotWeldedToEachOther) {
    PolygonSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 0}},
                               {{0, 1, 2}, {3, 4, 5}, {3, 4, 6}, {0, 2, 1}});
    soup.object_names = {"a", "b"};
    soup.polygon_object = {0, 1, 0, 1};
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 2u);
    for (const Mesh& mesh : meshes) {
        test::expect_consistent(mesh, mesh.name);
        EXPECT_EQ(mesh.positions.size(), 4u);
        EXPECT_EQ(mesh.triangles.size(), 2u);
        EXPECT_EQ(mesh.repairs.welded_vertices, 2u) << "vertices 0 and 3, and 2 and 4, of each object";
    }
    soup.polygon_object = {0, 1, 1, 0};  // now each object has its own copies
    const std::vector<Mesh> apart = build_meshes(soup, {});
    EXPECT_EQ(apart[0].repairs.welded_vertices, 0u);
    EXPECT_EQ(apart[1].repairs.welded_vertices, 1u) << "vertices 5 and 6";
    EXPECT_EQ(apart[0].repairs.duplicate_polygons, 1u);
    EXPECT_EQ(apart[1].repairs.duplicate_polygons, 1u);
}

TEST(BuildMeshes, RepeatedCornersInARowCollapse) {
    const Mesh mesh =
        build_one(soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}},
                          {{0, 0, 1, 2}, {0, 2, 3, 3, 0, 0}, {0, 1, 4, 3}, {0, 1, 0, 1}, {2, 2, 2}, {0, 1}, {}}));
    EXPECT_EQ(mesh.repairs.input_polygons, 7u);
    EXPECT_EQ(mesh.repairs.input_triangles, 2u + 4 + 2 + 2 + 1);
    EXPECT_EQ(mesh.repairs.degenerate_polygons, 4u);
    EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
    EXPECT_TRUE(mesh.triangle_polygon.empty()) << "all that is left are triangles";
}

TEST(BuildMeshes, SpikesCollapse) {
    for (const Polygons& polygons : {Polygons{{0, 1, 2, 4, 2, 3}},
                                     {{4, 0, 1, 2, 3, 0}},
                                     {{0, 1, 2, 3, 0, 4}},
                                     {{3, 4, 5, 4, 3, 0, 1, 2}},
                                     {{5, 4, 0, 1, 2, 3, 0, 4}}}) {
        const Mesh mesh =
            build_one(soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 1}, {6, 5, 7}}, polygons));
        EXPECT_EQ(mesh.positions.size(), 4u);
        EXPECT_EQ(mesh.triangles.size(), 2u);
        EXPECT_EQ(count_edges(mesh).border, 4u);
    }
    const Mesh flat = build_one(soup_of(kSquare, {{0, 1, 2, 1}, {0, 1, 0, 2}, {1, 0, 2, 0, 3, 0}}));
    EXPECT_EQ(flat.repairs.degenerate_polygons, 3u);
}

TEST(BuildMeshes, PolygonsWithoutAreaAreDropped) {
    const std::vector<glm::dvec3> line{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {4, 8, 12}, {0, 0, 1}};
    const Mesh mesh = build_one(soup_of(line, {{0, 1, 2}, {0, 1, 2, 3}, {0, 3, 1, 2, 1}, {2, 0, 1}, {0, 1, 4}}));
    EXPECT_EQ(mesh.repairs.degenerate_polygons, 4u);
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.positions.size(), 3u) << "vertices of dropped polygons are left out";
    // A figure of eight has area on both sides, though its area vector is zero.
    const Mesh eight = build_one(soup_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}));
    EXPECT_EQ(eight.repairs.degenerate_polygons, 0u);
    EXPECT_EQ(eight.triangles.size(), 2u);
    // Slim is not flat.
    EXPECT_EQ(build_one(soup_of({{0, 0, 0}, {1000, 1e-30, 0}, {2000, 0, 0}}, {{0, 1, 2}})).triangles.size(), 1u);
}

TEST(BuildMeshes, DuplicatesAreDroppedWhateverTheirWindingAndStart) {
    const std::vector<glm::dvec3> heptagon{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {3, 2, 0}, {2, 3, 0}, {1, 3, 0}, {0, 2, 0}};
    for (std::uint32_t n = 3; n <= 7; ++n) {
        std::vector<std::uint32_t> polygon(n);
        std::iota(polygon.begin(), polygon.end(), 0u);
        for (const bool reversed : {false, true}) {
            for (std::uint32_t first = 0; first < n; ++first) {
                std::vector<std::uint32_t> other = polygon;
                std::rotate(other.begin(), other.begin() + first, other.end());
                if (reversed) std::reverse(other.begin(), other.end());
                for (const bool swapped : {false, true}) {
                    const Mesh mesh =
                        build_one(soup_of(heptagon, swapped ? Polygons{other, polygon} : Polygons{polygon, other}));
                    ASSERT_EQ(mesh.repairs.duplicate_polygons, 1u) << n << ' ' << first << ' ' << reversed;
                    ASSERT_EQ(mesh.polygon_count, 1u);
                    ASSERT_EQ(mesh.triangles.size(), n - 2);
                    ASSERT_EQ(mesh.triangles[0], build_one(soup_of(heptagon, {swapped ? other : polygon})).triangles[0])
                        << "the first one stays";
                }
            }
        }
    }
}

TEST(BuildMeshes, TheSameCornersInAnotherOrderAreAnotherPolygon) {
    const Mesh mesh = build_one(soup_of(kSquare, {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 1, 3}}));
    EXPECT_EQ(mesh.repairs.duplicate_polygons, 0u);
    EXPECT_EQ(mesh.polygon_count, 3u);
    const Mesh overlap = build_one(soup_of(kSquare, {{0, 1, 2, 3}, {0, 1, 2}, {1, 2, 3}}));
    EXPECT_EQ(overlap.repairs.duplicate_polygons, 0u);
}

TEST(BuildMeshes, DuplicatesAfterWeldingAreFoundAmongMany) {
    std::vector<glm::dvec3> positions;
    Polygons polygons;
    // A book of 100 pages around one edge, twice, with new vertices each time, then single pages.
    for (const int copies : {0, 1, 2}) {
        for (int i = 0; i < 100; i += copies == 2 ? 10 : 1) {
            const auto v = static_cast<std::uint32_t>(positions.size());
            positions.insert(positions.end(), {{0, 0, 0}, {0, 0, 1}, {std::cos(0.06 * i), std::sin(0.06 * i), 0}});
            polygons.push_back(copies == 1 ? std::vector<std::uint32_t>{v, v + 2, v + 1}
                                           : std::vector<std::uint32_t>{v + 1, v + 2, v});
        }
    }
    const Mesh mesh = build_one(soup_of(positions, polygons));
    EXPECT_EQ(mesh.repairs.duplicate_polygons, 110u);
    EXPECT_EQ(mesh.triangles.size(), 100u);
    EXPECT_EQ(mesh.positions.size(), 102u);
    EXPECT_EQ(count_edges(mesh).non_manifold, 1u);
    EXPECT_EQ(count_edges(mesh).edges, 201u);
}

std::vector<int> without_spikes(std::vector<int> corners) {
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < corners.size() && corners.size() > 1 && !changed; ++i) {
            const std::size_t next = (i + 1) % corners.size(), after = (i + 2) % corners.size();
            changed = corners[i] == corners[next] || corners[i] == corners[after];
            if (changed) corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(next));
        }
    }
    return corners;
}

/// What lies between two passes of an edge in the same direction.
std::optional<std::vector<int>> cut_off_piece(std::vector<int>& corners) {
    for (std::size_t j = 0; j < corners.size(); ++j) {
        for (std::size_t i = 0; i < j; ++i) {
            if (corners[i] != corners[j] || corners[i + 1] != corners[(j + 1) % corners.size()]) continue;
            const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(i),
                       end = corners.begin() + static_cast<std::ptrdiff_t>(j);
            const std::vector<int> piece(begin, end);
            corners.erase(begin, end);
            return piece;
        }
    }
    return std::nullopt;
}

/// Twins of the library's decisions, made in the most obvious way.
TEST(BuildMeshes, AgreesWithObviousRepairsOnRandomPolygons) {
    for (std::uint64_t seed = 0; seed < 1500; ++seed) {
        Random random(seed);
        std::vector<glm::dvec3> positions(static_cast<std::size_t>(random.integer(3, 30)));
        for (auto& p : positions) p = glm::floor(random.in_box(seed % 3 == 0 ? 1.0 : 2.0));
        Polygons polygons;
        for (int i = random.integer(1, 60); i > 0; --i) {
            std::vector<std::uint32_t> polygon(static_cast<std::size_t>(seed % 2 == 0 ? 3 : random.integer(0, 7)));
            for (auto& v : polygon)
                v = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(positions.size()) - 1));
            polygons.push_back(polygon);
        }
        const Mesh mesh = build_one(soup_of(positions, polygons));

        std::uint64_t degenerate = 0, duplicate = 0;
        std::vector<std::vector<int>> pieces;
        std::vector<std::multiset<std::pair<int, int>>> kept;
        for (const auto& polygon : polygons) {
            std::vector<int> corners;  // numbers of the first vertex at the place
            for (const std::uint32_t v : polygon) {
                corners.push_back(
                    static_cast<int>(std::find(positions.begin(), positions.end(), positions[v]) - positions.begin()));
            }
            pieces.push_back(without_spikes(corners));
        }
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            while (const auto piece = cut_off_piece(pieces[i])) pieces.push_back(without_spikes(*piece));
            pieces[i] = without_spikes(pieces[i]);
        }
        for (const std::vector<int>& corners : pieces) {
            bool has_area = false;
            for (const int a : corners) {
                for (const int b : corners) {
                    const auto at = [&](int v) { return positions[static_cast<std::size_t>(v)]; };
                    has_area =
                        has_area || glm::cross(at(a) - at(corners[0]), at(b) - at(corners[0])) != glm::dvec3(0.0);
                }
            }
            if (corners.size() < 3 || !has_area) {
                ++degenerate;
                continue;
            }
            std::multiset<std::pair<int, int>> edges;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                edges.insert(std::minmax(corners[i], corners[(i + 1) % corners.size()]));
            }
            const bool is_known = std::find(kept.begin(), kept.end(), edges) != kept.end();
            duplicate += is_known;
            if (!is_known) kept.push_back(edges);
        }
        ASSERT_EQ(mesh.repairs.degenerate_polygons, degenerate) << "seed " << seed;
        ASSERT_EQ(mesh.repairs.duplicate_polygons, duplicate) << "seed " << seed;
        ASSERT_FALSE(testing::Test::HasFatalFailure()) << "seed " << seed;
    }
}

TEST(BuildMeshes, ModelsFarFromZeroKeepTheirDetails) {
    // 20 steps of a thousandth, five million units away: single precision alone has steps of 0.5.
    test::ByteWriter body;
    std::vector<glm::dvec3> expected;
    for (int i = 0; i < 21; ++i) {
        for (const double y : {-4e6, -4e6 + 0.02}) expected.emplace_back(5e6 + 1e-3 * i, y, 6e6 + 1e-3 * (i % 2));
    }
    for (const glm::dvec3& p : expected) body.add<double>({p.x, p.y, p.z});
    body.add<double>({0, 0, 0});  // a vertex that no polygon uses
    for (int i = 0; i < 20; ++i)
        body.add<std::uint8_t>({4}).add<std::int32_t>({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    const test::TemporaryFolder folder;
    const PolygonSoup soup =
        read_ply(folder.write("far.ply",
                              "ply\nformat binary_little_endian 1.0\nelement vertex 43\nproperty double x\nproperty "
                              "double y\nproperty double z\n"
                              "element face 20\nproperty list uchar int vertex_indices\nend_header\n" +
                                  body.bytes()));
    const Mesh mesh = build_one(soup);
    ASSERT_EQ(mesh.positions.size(), expected.size());
    EXPECT_EQ(mesh.polygon_count, 20u);
    EXPECT_EQ(count_edges(mesh).border, 42u);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) {
            const auto near = [&](const glm::dvec3& p) { return glm::distance(p, mesh.position(v)) < 2e-9; };
            EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), near));
        }
    }
}

TEST(BuildMeshes, NearZeroCoordinatesKeepTheirValues) {
    const Mesh mesh = build_one(soup_of({{15.1, 15.3, 15.7}, {19.1, 15.3, 15.7}, {15.1, 19.3, 15.7}}, {{0, 1, 2}}));
    EXPECT_EQ(mesh.origin, glm::dvec3(0.0));
    EXPECT_EQ(mesh.positions[0], glm::vec3(15.1f, 15.3f, 15.7f));
}

// Not farther than 16 half sizes, or just farther; a vertex that no triangle uses tells nothing.
TEST(BuildMeshes, TheOriginMovesWhereTheModelIsFarFromIt) {
    for (const double distance : {15.0, 17.0}) {
        const glm::dvec3 at(2 * distance, 0, 0);
        const Mesh mesh = build_one(
            soup_of({at + glm::dvec3(-2, 0, 0), at + glm::dvec3(2, 0, 0), at + glm::dvec3(0, 1, 0), {-900, 0, 0}},
                    {{0, 1, 2}}));
        EXPECT_EQ(mesh.origin.x, distance > 16 ? at.x : 0.0) << distance;
    }
}

TEST(BuildMeshes, TrianglesKnowTheirPolygon) {
    const Mesh mesh = build_one(soup_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {0, 0, 5}},
                                        {{0, 1, 5}, {0, 1, 2, 3, 4}, {0, 5, 4}, {1, 2, 3, 5}}));
    EXPECT_EQ(mesh.polygon_count, 4u);
    EXPECT_EQ(mesh.triangle_polygon, (std::vector<std::uint32_t>{0, 1, 1, 1, 2, 3, 3}));
    EXPECT_EQ(mesh.polygon_normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.polygon_area_vector(2), glm::dvec3(0, 0, 1));
    EXPECT_EQ(mesh.polygon_normals[0], glm::vec3(0, -1, 0));
    const Mesh triangles = build_one(soup_of(kSquare, {{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(triangles.polygon_area_vector(0), glm::dvec3(0, 0, 1));
    EXPECT_EQ(triangles.polygon_of(1), 1u);
}

TEST(BuildMeshes, MaterialsStayWithTheirPolygons) {
    PolygonSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                               {{0, 1, 1}, {0, 1, 2, 3}, {0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}});
    soup.polygon_material = {5, 3, 9, 0, 4};
    const Mesh mesh = build_one(soup);
    EXPECT_EQ(mesh.polygon_material, (std::vector<std::uint32_t>{3, 0, 4}));
    EXPECT_EQ(mesh.material_of(1), 3u);
    EXPECT_EQ(mesh.material_of(3), 4u);
    soup.polygon_material = {5, 0, 9, 0, 0};
    EXPECT_TRUE(build_one(soup).polygon_material.empty()) << "all have material 0";
    EXPECT_EQ(build_one(soup).material_of(0), 0u);
}

TEST(BuildMeshes, MarksFindTheirEdgesAfterWelding) {
    PolygonSoup soup =
        soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}, {3, 4, 5}});
    soup.marked_edges = {
        {4, 0}, {5, 3}, {1, 5}, {6, 0}, {0, 3}};  // loose: 1-5, to a vertex without polygon; of no length
    const Mesh mesh = build_one(soup);
    EXPECT_EQ(count_edges(mesh).marked, 4u);
    EXPECT_EQ(count_edges(mesh).loose, 2u);
    EXPECT_EQ(mesh.marked, (std::vector<bool>{false, false, true, true, false, true}));
    EXPECT_TRUE(mesh.is_marked(2));
    soup.marked_edges.clear();
    EXPECT_TRUE(build_one(soup).marked.empty());
    EXPECT_FALSE(build_one(soup).is_marked(2));
}

TEST(BuildMeshes, MarksBelongToAllObjectsWithTheEdge) {
    PolygonSoup soup =
        soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {4, 5, 3}, {0, 1, 3}});
    soup.object_names = {"a", "b", "c"};
    soup.polygon_object = {0, 1, 2};
    soup.marked_edges = {{0, 2}};
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    EXPECT_EQ(count_edges(meshes[0]).marked, 1u);
    EXPECT_EQ(count_edges(meshes[1]).marked, 1u);
    EXPECT_EQ(count_edges(meshes[2]).marked, 0u);
}

TEST(BuildMeshes, AMarkedDiagonalIsCountedThoughItIsNoEdgeOfAPolygon) {
    PolygonSoup soup = soup_of(kSquare, {{0, 1, 2, 3}});
    EXPECT_EQ(count_edges(build_one(soup)).marked, 0u);
    soup.marked_edges = {
        {0, 1}, {0, 2}, {1, 3}};  // one of the diagonals cuts the square, the other one is a loose line
    const EdgeCounts counts = count_edges(build_one(soup));
    EXPECT_EQ(counts.marked, 3u);
    EXPECT_EQ(counts.loose, 1u);
    EXPECT_EQ(counts.edges, 4u);
}

TEST(BuildMeshes, ObjectsComeInOrderAndMayBeEmpty) {
    PolygonSoup soup = soup_of(kSquare, {{0, 1, 2}, {0, 1, 1}, {0, 2, 3}});
    soup.object_names = {"nothing", "last", "flat", "first"};
    soup.polygon_object = {3, 2, 1};
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 3u) << "one per object that has polygons";
    EXPECT_EQ(meshes[0].name, "last");
    EXPECT_EQ(meshes[1].name, "flat");
    EXPECT_EQ(meshes[2].name, "first");
    EXPECT_TRUE(meshes[1].triangles.empty() && meshes[1].positions.empty());
    EXPECT_EQ(meshes[1].repairs.degenerate_polygons, 1u);
    EXPECT_TRUE(build_meshes(PolygonSoup{}, {}).empty());
    EXPECT_TRUE(build_meshes(soup_of(kSquare, {}), {}).empty());
}

TEST(BuildMeshes, EmptyMeshesStayEmptyWhenSubdivided) {
    MeshOptions options;
    options.subdivision_levels = 2;
    const std::vector<Mesh> meshes = build_meshes(soup_of(kSquare, {{0, 1, 1}}), options);
    ASSERT_EQ(meshes.size(), 1u);
    EXPECT_TRUE(meshes[0].triangles.empty());
}

TEST(BuildMeshes, ManyTrianglesAroundOneEdgeComeToAnEnd) {
    // Pages of a book, closed at their outer corners, so that there are no borders.
    constexpr std::uint32_t kPages = 100000;
    PolygonSoup soup;
    soup.positions = {{0, 0, 0}, {0, 0, 1}};
    for (std::uint32_t i = 0; i < kPages; ++i) {
        const double angle = 2 * std::numbers::pi * i / kPages;
        soup.positions.emplace_back(std::cos(angle), std::sin(angle), 0.5);
        const std::uint32_t v = 2 + i, w = 2 + (i + 1) % kPages;
        soup.corners.insert(soup.corners.end(), {0, 1, v, 0, v, w, 1, v, w});
    }
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 1u);
    EXPECT_EQ(meshes[0].repairs.duplicate_polygons, 0u);
    const EdgeCounts edges = count_edges(meshes[0]);
    EXPECT_EQ(edges.non_manifold, 2 * kPages + 1);
    EXPECT_EQ(edges.border, 0u);
    EXPECT_EQ(edges.edges, 3 * kPages + 1);
}

TEST(BuildMeshes, ManyMarksInManyObjectsComeToAnEnd) {
    PolygonSoup soup;
    for (std::uint32_t i = 0; i < 100000; ++i) {
        soup.positions.insert(soup.positions.end(), {{i, 0, 0}, {i, 1, 0}, {i, 0, 1}});
        soup.corners.insert(soup.corners.end(), {3 * i, 3 * i + 1, 3 * i + 2});
        soup.polygon_object.push_back(i);
        soup.object_names.push_back(std::to_string(i));
        soup.marked_edges.push_back({3 * i + 1, 3 * i});
    }
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 100000u);
    for (const Mesh& mesh : meshes) ASSERT_EQ(mesh.marked, (std::vector<bool>{true, false, false}));
}

TEST(BuildMeshes, LargeAndSmallCoordinatesGiveFiniteNormals) {
    for (const double size : {1e-44, 1e-30, 1e-3, 1e20, 1e30}) {
        const Mesh mesh =
            build_one(soup_of({{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}, {0.5 * size, 2 * size, 0}},
                              {{0, 1, 2, 3}, {3, 2, 4}}));
        EXPECT_EQ(mesh.triangles.size(), 3u) << size;
        EXPECT_EQ(mesh.polygon_normals[0], glm::vec3(0, 0, 1)) << size;
        EXPECT_EQ(count_edges(mesh).seam, 0u);
    }
}

TEST(CountEdges, LeavesOutTheDiagonalsOfPolygons) {
    const Mesh mesh = build_one(soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 1}},
                                        {{0, 1, 2, 3}, {1, 4, 5, 2}, {1, 2, 6}}));
    const EdgeCounts counts = count_edges(mesh);
    EXPECT_EQ(counts.edges, 3u + 3 + 2 + 1);
    EXPECT_EQ(counts.border, 8u);
    EXPECT_EQ(counts.non_manifold, 1u);
    EXPECT_EQ(counts.marked, 0u);
    EXPECT_EQ(count_edges(Mesh{}).edges, 0u);
}

}  // namespace
}  // namespace burin
