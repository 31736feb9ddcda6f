#include "mesh/subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/build_meshes.h"
#include "mesh/model.h"
#include "mesh/shapes.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::soup_of;

PolygonMesh cage_of(std::vector<glm::vec3> positions, const test::Polygons& polygons) {
    PolygonMesh mesh;
    mesh.positions = std::move(positions);
    const bool triangles = std::all_of(polygons.begin(), polygons.end(), [](const auto& p) { return p.size() == 3; });
    for (const auto& polygon : polygons) {
        mesh.corners.insert(mesh.corners.end(), polygon.begin(), polygon.end());
        if (!triangles) mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
    return mesh;
}

PolygonMesh tetrahedron() {
    return cage_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

PolygonMesh icosahedron() {
    const float g = static_cast<float>(std::numbers::phi);
    return cage_of({{-1, g, 0},
                    {1, g, 0},
                    {-1, -g, 0},
                    {1, -g, 0},
                    {0, -1, g},
                    {0, 1, g},
                    {0, -1, -g},
                    {0, 1, -g},
                    {g, 0, -1},
                    {g, 0, 1},
                    {-g, 0, -1},
                    {-g, 0, 1}},
                   {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
}

PolygonMesh unit_cube() {
    const PolygonSoup box = make_box({1, 1, 1});
    PolygonMesh mesh;
    for (const glm::dvec3& p : box.positions) mesh.positions.emplace_back(p);
    mesh.corners = box.corners;
    mesh.ends = box.polygon_ends;
    return mesh;
}

bool has_vertex(const PolygonMesh& mesh, const glm::dvec3& p) {
    return std::any_of(mesh.positions.begin(), mesh.positions.end(),
                       [&](const glm::vec3& v) { return glm::distance(glm::dvec3(v), p) < 1e-6; });
}

glm::dvec3 centroid(const PolygonMesh& mesh, std::size_t polygon) {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t v : mesh.polygon(polygon)) sum += glm::dvec3(mesh.positions[v]);
    return sum / static_cast<double>(mesh.polygon(polygon).size());
}

testing::AssertionResult refuses(const PolygonMesh& mesh, SubdivisionScheme scheme, int levels,
                                 std::initializer_list<std::string_view> parts) {
    return test::refuses(
        [&](const std::string& name) { subdivide(mesh, scheme, levels, name.substr(8, name.size() - 9)); },
        "object 'cage'", parts);
}

TEST(LoopSubdivision, MakesFourTrianglesOfOne) {
    const PolygonMesh mesh = subdivide(tetrahedron(), SubdivisionScheme::loop, 1, "t");
    EXPECT_EQ(mesh.polygon_count(), 16u);
    EXPECT_EQ(mesh.positions.size(), 4u + 6);
    EXPECT_TRUE(mesh.ends.empty());
    // At valence 3, Loop's beta is 3/16: a vertex goes to 7/16 V + 3/16 (sum of its neighbours). Here
    // the neighbours add up to -V, which gives V/4. An edge's point is 3/8 (A + B) + 1/8 (C + D); here
    // C + D = -(A + B), which gives (A + B)/4.
    EXPECT_TRUE(has_vertex(mesh, {0.25, 0.25, 0.25}));
    EXPECT_TRUE(has_vertex(mesh, {-0.25, 0.25, -0.25}));
    EXPECT_TRUE(has_vertex(mesh, {0.5, 0, 0}));
    EXPECT_TRUE(has_vertex(mesh, {0, 0, -0.5}));
    for (int levels = 0; levels < 5; ++levels) {
        const PolygonMesh finer = subdivide(icosahedron(), SubdivisionScheme::loop, levels, "i");
        const std::size_t faces = std::size_t{20} << (2 * levels);
        EXPECT_EQ(finer.polygon_count(), faces);
        EXPECT_EQ(finer.positions.size(), faces / 2 + 2) << "as Euler says";
    }
}

TEST(LoopSubdivision, AnIcosahedronBecomesNearlyASphere) {
    const PolygonMesh mesh = subdivide(icosahedron(), SubdivisionScheme::automatic, 4, "i");
    float nearest = 1e9f, farthest = 0;
    for (const glm::vec3& p : mesh.positions) {
        nearest = std::min(nearest, glm::length(p));
        farthest = std::max(farthest, glm::length(p));
    }
    EXPECT_LT(farthest / nearest, 1.02f);
    EXPECT_GT(nearest, 1.3f) << "of 1.9 at the start";
}

TEST(LoopSubdivision, ChildrenHaveTheMaterialOfTheirParent) {
    PolygonMesh cage = icosahedron();
    for (std::uint32_t i = 0; i < 20; ++i) cage.polygon_material.push_back(100 + i);
    const PolygonMesh mesh = subdivide(cage, SubdivisionScheme::loop, 3, "i");
    ASSERT_EQ(mesh.polygon_material.size(), mesh.polygon_count());
    for (std::size_t i = 0; i < mesh.polygon_count(); ++i) {
        // By symmetry a child stays in the cone of its parent: that with the nearest centre.
        std::size_t parent = 0;
        for (std::size_t k = 1; k < 20; ++k) {
            if (glm::dot(centroid(mesh, i), centroid(cage, k)) > glm::dot(centroid(mesh, i), centroid(cage, parent)))
                parent = k;
        }
        ASSERT_EQ(mesh.polygon_material[i], cage.polygon_material[parent]) << i;
    }
    EXPECT_TRUE(subdivide(icosahedron(), SubdivisionScheme::loop, 1, "i").polygon_material.empty());
}

TEST(LoopSubdivision, VerticesMayHaveManyNeighbours) {
    // Two cones of 200 triangles on a common rim.
    constexpr std::uint32_t kSides = 200;
    std::vector<glm::vec3> positions{{0, 0, 1}, {0, 0, -1}};
    test::Polygons polygons;
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kSides;
        positions.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
        polygons.push_back({0, 2 + i, 2 + (i + 1) % kSides});
        polygons.push_back({1, 2 + (i + 1) % kSides, 2 + i});
    }
    const PolygonMesh mesh = subdivide(cage_of(positions, polygons), SubdivisionScheme::loop, 1, "cones");
    EXPECT_EQ(mesh.polygon_count(), 8 * kSides);
    // The apex keeps a share of (3/8 + cos(2 pi/n)/4)^2 + 3/8 (Loop 1987); its neighbours have z = 0.
    const double c = 3.0 / 8 + std::cos(2 * std::numbers::pi / kSides) / 4;
    EXPECT_TRUE(has_vertex(mesh, {0, 0, c * c + 3.0 / 8}));
    EXPECT_TRUE(has_vertex(mesh, {0, 0, -(c * c + 3.0 / 8)}));
    for (const glm::vec3& p : mesh.positions) ASSERT_LE(glm::length(p), 1.0001f);
}

TEST(LoopSubdivision, TheBorderDependsOnTheBorderAlone) {
    // Two patches with one border and different insides stay joined.
    const auto patch = [](float height) {
        return subdivide(cage_of({{0, 0, 0}, {4, 0, 0}, {4, 4, 1}, {0, 4, 0}, {2, 2, height}},
                                 {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}),
                         SubdivisionScheme::loop, 3, "p");
    };
    const PolygonMesh low = patch(0), high = patch(9);
    const auto border_positions = [](const PolygonMesh& mesh) {
        Mesh m;
        m.positions = mesh.positions;
        for (std::size_t i = 0; i < mesh.polygon_count(); ++i)
            m.triangles.push_back({mesh.polygon(i)[0], mesh.polygon(i)[1], mesh.polygon(i)[2]});
        const auto next = test::link_edges_by_map(m.triangles);
        std::vector<std::array<float, 3>> result;
        for (HalfEdge h = 0; h < next.size(); ++h) {
            const glm::vec3 p = mesh.positions[m.triangles[h / 3][h % 3]];
            if (next[h] == h) result.push_back({p.x, p.y, p.z});
        }
        std::sort(result.begin(), result.end());
        return result;
    };
    EXPECT_EQ(border_positions(low).size(), 4u * 8);
    EXPECT_EQ(border_positions(low), border_positions(high));
}

TEST(CatmullClark, OneStepOfTheCube) {
    const PolygonMesh mesh = subdivide(unit_cube(), SubdivisionScheme::automatic, 1, "cube");
    EXPECT_EQ(mesh.polygon_count(), 24u);
    EXPECT_EQ(mesh.positions.size(), 8u + 12 + 6);
    for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(mesh.polygon(i).size(), 4u);
    // A vertex V of valence n goes to F/n + 2 E/n + (n - 3) V/n, where F is the mean of its faces'
    // points and E the mean of its edges' middles. At V = (1,1,1)/2: F = (1,1,1)/6 and E = (1,1,1)/3, so
    // that it goes to (1,1,1) (1/6 + 2/3)/3 = 5/18 (1,1,1) = 5/9 V.
    EXPECT_TRUE(has_vertex(mesh, glm::dvec3(5.0 / 18)));
    EXPECT_TRUE(has_vertex(mesh, {5.0 / 18, -5.0 / 18, 5.0 / 18}));
    // An edge's point is the mean of its two ends and its two faces' points.
    EXPECT_TRUE(has_vertex(mesh, {0.375, 0.375, 0}));
    EXPECT_TRUE(has_vertex(mesh, {0, -0.375, 0.375}));
    EXPECT_TRUE(has_vertex(mesh, {0.5, 0, 0}));
    for (int levels = 0; levels < 5; ++levels) {
        const PolygonMesh finer = subdivide(unit_cube(), SubdivisionScheme::catmull_clark, levels, "cube");
        EXPECT_EQ(finer.polygon_count(), std::size_t{6} << (2 * levels));
        EXPECT_EQ(finer.positions.size(), finer.polygon_count() + 2) << "as Euler says";
    }
}

TEST(CatmullClark, APolygonOfNCornersGivesN) {
    // A prism of five sides, cut at the top into triangles: 5 + 5 * 4 + 5 * 3 corners.
    std::vector<glm::vec3> positions;
    test::Polygons polygons(1);
    for (std::uint32_t i = 0; i < 5; ++i) {
        const float angle = 0.4f * std::numbers::pi_v<float> * static_cast<float>(i);
        positions.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
        positions.emplace_back(std::cos(angle), std::sin(angle), 1.0f);
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % 5);
        polygons[0].insert(polygons[0].begin(), a);
        polygons.push_back({a, b, b + 1, a + 1});
        polygons.push_back({a + 1, b + 1, 10});
    }
    positions.emplace_back(0, 0, 1.5f);
    PolygonMesh cage = cage_of(positions, polygons);
    for (std::uint32_t i = 0; i < 11; ++i) cage.polygon_material.push_back(i);
    const PolygonMesh mesh = subdivide(cage, SubdivisionScheme::automatic, 1, "prism");
    EXPECT_EQ(mesh.polygon_count(), 40u);
    for (std::uint32_t i = 0; i < 11; ++i) {
        EXPECT_EQ(std::count(mesh.polygon_material.begin(), mesh.polygon_material.end(), i),
                  i == 0 ? 5 : (i % 2 == 1 ? 4 : 3))
            << i;
    }
    for (std::size_t i = 0; i < 40; ++i) {
        // A child has its parent's middle as a corner.
        const glm::dvec3 middle = centroid(cage, mesh.polygon_material[i]);
        const auto corners = mesh.polygon(i);
        EXPECT_TRUE(std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
            return glm::distance(glm::dvec3(mesh.positions[v]), middle) < 1e-6;
        }));
    }
}

TEST(CatmullClark, MarksStayAlongTheirEdge) {
    for (const SubdivisionScheme scheme : {SubdivisionScheme::catmull_clark, SubdivisionScheme::loop}) {
        PolygonMesh cage = scheme == SubdivisionScheme::loop ? tetrahedron() : unit_cube();
        // The cube's edge from (1,1,-1)/2 to (1,1,1)/2; of the tetrahedron, from (1,1,1) to (1,-1,-1).
        cage.marked_edges = {scheme == SubdivisionScheme::loop ? std::array{0u, 1u} : std::array{7u, 3u}, {1, 1}};
        cage.marked_edges.pop_back();
        for (int levels = 0; levels < 5; ++levels) {
            const PolygonMesh mesh = subdivide(cage, scheme, levels, "marked");
            ASSERT_EQ(mesh.marked_edges.size(), std::size_t{1} << levels);
            std::vector<int> uses(mesh.positions.size(), 0);
            for (const auto& edge : mesh.marked_edges) {
                for (const std::uint32_t v : edge) {
                    ++uses[v];
                    // By symmetry the curve stays in a plane.
                    const glm::vec3 p = mesh.positions[v];
                    if (scheme == SubdivisionScheme::loop) {
                        ASSERT_NEAR(p.y, p.z, 1e-6f);
                        ASSERT_GT(p.x, 0);
                    } else {
                        ASSERT_NEAR(p.x, p.y, 1e-6f);
                        ASSERT_GT(p.x, 0);
                    }
                }
            }
            // One chain: two ends, all others in between.
            EXPECT_EQ(std::count(uses.begin(), uses.end(), 1), 2);
            EXPECT_EQ(std::count(uses.begin(), uses.end(), 2), (1 << levels) - 1);
        }
    }
}

TEST(CatmullClark, StraightBordersOfAFlatGridStayStraight) {
    const PolygonSoup plane = make_plane(4, 2, 4, 2);
    MeshOptions options;
    options.subdivision_levels = 2;
    const std::vector<Mesh> meshes = build_meshes(plane, options);
    const Mesh& mesh = meshes.at(0);
    EXPECT_EQ(mesh.polygon_count, 8u * 16);
    EXPECT_EQ(count_edges(mesh).border, 12u * 4);
    for (const glm::vec3& p : mesh.positions) {
        ASSERT_EQ(p.y, 0);
        ASSERT_LE(std::abs(p.x), 2);
        ASSERT_LE(std::abs(p.z), 1);
    }
    int on_side = 0;  // only the four corners are rounded off
    for (const BorderIndex::Segment& s : mesh.borders.segments()) {
        on_side += (std::abs(s.a.x) == 2 && s.a.x == s.b.x) || (std::abs(s.a.z) == 1 && s.a.z == s.b.z);
    }
    EXPECT_GE(on_side, 48 - 4 * 8);
}

TEST(Subdivide, SurfacesThatAreNotTwoManifoldAreRefused) {
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {1, 1, 1}};
    for (const auto scheme : {SubdivisionScheme::loop, SubdivisionScheme::catmull_clark}) {
        EXPECT_TRUE(
            refuses(cage_of(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), scheme, 1, {"polygon 2 ", "two-manifold"}))
            << "three at an edge";
        EXPECT_TRUE(refuses(cage_of(points, {{0, 1, 2}, {0, 1, 3}}), scheme, 1, {"polygon 1 ", "wound against"}))
            << "inconsistent winding";
        EXPECT_TRUE(refuses(cage_of(points, {{0, 1, 2}, {0, 3, 4}}), scheme, 1, {"only at a vertex"}))
            << "two fans at a vertex";
        EXPECT_TRUE(refuses(cage_of(points, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}}), scheme, 1, {"polygon 3 "}))
            << "a fan at a closed vertex";
    }
    EXPECT_TRUE(refuses(cage_of(points, {{0, 1, 2, 0, 3}}), SubdivisionScheme::catmull_clark, 1,
                        {"polygon 0 has a corner twice"}));
    EXPECT_TRUE(refuses(cage_of(points, {{1, 2, 4}, {0, 1, 2, 5, 1, 3}}), SubdivisionScheme::catmull_clark, 1,
                        {"polygon 1 has a corner twice"}));
    EXPECT_NO_THROW(subdivide(cage_of(points, {{0, 1, 2}, {1, 0, 3}}), SubdivisionScheme::loop, 1, "good"));
}

TEST(Subdivide, TwoClosedSurfacesMayNotTouchAtAVertex) {
    // Two tetrahedra with a common apex, in any order of their faces.
    const std::vector<glm::vec3> points{{0, 0, 0},  {1, 0, 1},   {-1, 1, 1},  {-1, -1, 1},
                                        {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}};
    const test::Polygons a{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}, b{{0, 5, 4}, {0, 6, 5}, {0, 4, 6}, {4, 5, 6}};
    test::Polygons mixed, in_turn = a;
    in_turn.insert(in_turn.end(), b.begin(), b.end());
    for (std::size_t i = 0; i < 4; ++i) {
        mixed.push_back(a[i]);
        mixed.push_back(b[i]);
    }
    EXPECT_TRUE(refuses(cage_of(points, in_turn), SubdivisionScheme::loop, 1, {"two-manifold"}));
    EXPECT_TRUE(refuses(cage_of(points, mixed), SubdivisionScheme::loop, 1, {"two-manifold"}));
}

TEST(Subdivide, LoopNeedsTriangles) {
    EXPECT_TRUE(refuses(unit_cube(), SubdivisionScheme::loop, 1, {"Loop subdivision needs triangles"}));
    PolygonMesh listed = tetrahedron();
    listed.ends = {3, 6, 9, 12};  // triangles, though listed with their ends
    EXPECT_EQ(subdivide(listed, SubdivisionScheme::automatic, 1, "t").polygon_count(), 16u);
    EXPECT_EQ(subdivide(tetrahedron(), SubdivisionScheme::catmull_clark, 1, "t").polygon_count(), 12u);
}

TEST(Subdivide, TooManyPolygonsAreRefusedBeforeTheWork) {
    EXPECT_TRUE(
        refuses(tetrahedron(), SubdivisionScheme::loop, 14, {"14 subdivisions give more than 268 million polygons"}));
    EXPECT_TRUE(refuses(unit_cube(), SubdivisionScheme::catmull_clark, 1000000000, {"more than 268 million"}));
    // 4 * 4^13 = 2^28 is the most: one polygon more is too many.
    PolygonMesh five =
        cage_of(std::vector<glm::vec3>(15), {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}, {12, 13, 14}});
    EXPECT_TRUE(refuses(five, SubdivisionScheme::loop, 13, {"more than 268 million"}));
}

TEST(Subdivide, AnySurfaceIsSubdividedOrRefused) {
    int done = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        test::Random random(seed);
        // Some faces of a closed surface, or any polygons at all.
        const PolygonMesh whole = seed % 3 == 0 ? unit_cube() : icosahedron();
        test::Polygons polygons;
        for (std::size_t i = 0; i < whole.polygon_count(); ++i) {
            if (random.integer(0, 2) > 0) polygons.emplace_back(whole.polygon(i).begin(), whole.polygon(i).end());
        }
        for (int i = seed % 4 == 3 ? random.integer(1, 4) : 0; i > 0; --i) {
            polygons.emplace_back(static_cast<std::size_t>(random.integer(3, 6)));
            for (auto& v : polygons.back())
                v = static_cast<std::uint32_t>(random.integer(0, static_cast<int>(whole.positions.size()) - 1));
        }
        const PolygonMesh cage = cage_of(whole.positions, polygons);
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (const auto& polygon : polygons) {
            for (std::size_t k = 0; k < polygon.size(); ++k)
                edges.insert(std::minmax(polygon[k], polygon[(k + 1) % polygon.size()]));
        }
        const bool loop = cage.ends.empty() && seed % 2 == 0;
        const auto scheme = loop ? SubdivisionScheme::loop : SubdivisionScheme::catmull_clark;
        try {
            const PolygonMesh mesh = subdivide(cage, scheme, 1, "any");
            ASSERT_EQ(mesh.polygon_count(), loop ? 4 * polygons.size() : cage.corners.size()) << "seed " << seed;
            ASSERT_EQ(mesh.positions.size(), cage.positions.size() + edges.size() + (loop ? 0 : polygons.size()))
                << "seed " << seed;
            for (const glm::vec3& p : mesh.positions) ASSERT_LE(glm::length(p), 2) << "seed " << seed;
            ASSERT_NO_THROW(subdivide(mesh, scheme, 1, "again")) << "seed " << seed;
            ++done;
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(done, 400) << "the test must reach both answers";
    EXPECT_GT(refused, 400);
}

TEST(Subdivide, ReadModelNamesTheFileOfASurfaceItCannotSubdivide) {
    const test::TemporaryFolder folder;
    MeshOptions options;
    options.subdivision_levels = 1;
    EXPECT_TRUE(
        test::refuses([&](const std::string& path) { read_model(path, options); },
                      folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no thing\nf 1 2 3\nf 1 2 4\n"),
                      {"object 'thing': polygon 1 "}));
}

TEST(Subdivide, MeshesAreBuiltOfTheSmallPolygons) {
    PolygonSoup soup = make_box({2, 2, 2});
    soup.polygon_material = {0, 1, 2, 3, 4, 5};
    soup.marked_edges = {{7, 3}};
    MeshOptions options;
    options.subdivision_levels = 2;
    const Mesh mesh = build_meshes(soup, options).at(0);
    EXPECT_EQ(mesh.polygon_count, 96u);
    EXPECT_EQ(mesh.triangles.size(), 192u);
    EXPECT_EQ(mesh.polygon_material.size(), 96u);
    EXPECT_EQ(mesh.repairs.input_polygons, 6u);
    EXPECT_EQ(count_edges(mesh).marked, 4u);
    EXPECT_EQ(count_edges(mesh).edges, 192u);
    const test::Winding winding = test::winding_of(mesh);
    EXPECT_EQ(winding.opposite, 192 * 3 / 2);
    EXPECT_GT(test::volume_of(mesh), 0);
    for (std::uint32_t t = 0; t < 192; ++t) {
        // -X +X -Y +Y -Z +Z: the material tells the side.
        const auto& [a, b, c] = mesh.triangles[t];
        const glm::dvec3 middle = mesh.position(a) + mesh.position(b) + mesh.position(c);
        const std::uint32_t material = mesh.material_of(t);
        const double along = middle[static_cast<int>(material / 2)] * (material % 2 == 1 ? 1 : -1);
        for (int axis = 0; axis < 3; ++axis) EXPECT_GE(along, std::abs(middle[axis]) - 1e-6);
    }
}

}  // namespace
}  // namespace burin
