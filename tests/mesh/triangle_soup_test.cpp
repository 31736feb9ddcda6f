// Soups of nothing but triangles take short ways through build_meshes. Whatever comes out must be
// what comes out of the general way, which a soup takes whose polygon ends are listed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesh/build_meshes.h"
#include "mesh/duplicate_polygons.h"
#include "mesh/edge_links.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

/// Triangles between few places of a grid: equal vertices, no area, duplicates, crowded edges.
PolygonSoup random_triangles(Random& random) {
    PolygonSoup soup;
    soup.object_names = {"soup"};
    soup.materials = {Material{}};
    const double far = random.integer(0, 3) == 0 ? 1000 : 0;
    const int grid = random.integer(1, 3);
    soup.positions.resize(static_cast<std::size_t>(random.integer(1, 80)));
    for (glm::dvec3& p : soup.positions) {
        p = {far + random.integer(0, grid), 0.1 * random.integer(0, grid), -random.integer(0, grid)};
    }
    const int last = static_cast<int>(soup.positions.size()) - 1;
    soup.corners.resize(static_cast<std::size_t>(3 * random.integer(1, 100)));
    for (std::uint32_t& v : soup.corners) v = static_cast<std::uint32_t>(random.integer(0, last));
    return soup;
}

void expect_equal(const Mesh& a, const Mesh& b, std::uint64_t seed) {
    ASSERT_EQ(a.name, b.name);
    ASSERT_EQ(a.origin, b.origin) << "seed " << seed;
    ASSERT_EQ(a.positions, b.positions) << "seed " << seed;
    ASSERT_EQ(a.triangles, b.triangles) << "seed " << seed;
    ASSERT_EQ(a.polygon_count, b.polygon_count) << "seed " << seed;
    ASSERT_EQ(a.next_on_edge, b.next_on_edge) << "seed " << seed;
    ASSERT_EQ(a.borders.segments().size(), b.borders.segments().size()) << "seed " << seed;
    ASSERT_EQ(a.repairs.input_polygons, b.repairs.input_polygons) << "seed " << seed;
    ASSERT_EQ(a.repairs.input_triangles, b.repairs.input_triangles) << "seed " << seed;
    ASSERT_EQ(a.repairs.degenerate_polygons, b.repairs.degenerate_polygons) << "seed " << seed;
    ASSERT_EQ(a.repairs.duplicate_polygons, b.repairs.duplicate_polygons) << "seed " << seed;
    ASSERT_EQ(a.repairs.welded_vertices, b.repairs.welded_vertices) << "seed " << seed;
}

TEST(TriangleSoup, BuildsWhatTheGeneralWayBuilds) {
    int degenerate = 0, duplicate = 0, welded = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const PolygonSoup soup = random_triangles(random);
        PolygonSoup listed = soup;
        for (std::size_t end = 3; end <= soup.corners.size(); end += 3) {
            listed.polygon_ends.push_back(static_cast<std::uint32_t>(end));
        }
        const std::vector<Mesh> fast = build_meshes(soup, {}), general = build_meshes(listed, {});
        ASSERT_EQ(fast.size(), 1u);
        ASSERT_EQ(general.size(), 1u);
        expect_equal(fast[0], general[0], seed);
        if (HasFatalFailure()) return;
        test::expect_consistent(fast[0], "seed " + std::to_string(seed));
        degenerate += fast[0].repairs.degenerate_polygons > 0;
        duplicate += fast[0].repairs.duplicate_polygons > 0;
        welded += fast[0].repairs.welded_vertices > 0;
    }
    EXPECT_GT(std::min({degenerate, duplicate, welded}), 100) << "all of it must happen";
}

TEST(TriangleSoup, FindsTheDuplicatesThatASetFinds) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const bool is_crowded = seed % 4 == 0;  // all on one edge: a long ring
        const int last = random.integer(3, is_crowded ? 60 : 12);
        Mesh mesh;
        std::set<std::set<std::uint32_t>> seen;
        std::vector<std::uint32_t> expected;
        for (int i = 0; i < 100; ++i) {
            std::array<std::uint32_t, 3> t{0, 1, 0};
            for (std::size_t k = is_crowded ? 2 : 0; k < 3; ++k)
                t[k] = static_cast<std::uint32_t>(random.integer(0, last));
            const std::set<std::uint32_t> corners(t.begin(), t.end());
            if (corners.size() < 3) continue;
            std::rotate(t.begin(), t.begin() + random.integer(0, 2), t.end());
            if (!seen.insert(corners).second) expected.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
            mesh.triangles.push_back(t);
        }
        mesh.polygon_count = static_cast<std::uint32_t>(mesh.triangles.size());
        mesh.next_on_edge = link_edges(mesh.triangles, static_cast<std::size_t>(last) + 1);
        ASSERT_EQ(find_duplicates({}, mesh), expected) << "seed " << seed;
    }
}

}  // namespace
}  // namespace burin
