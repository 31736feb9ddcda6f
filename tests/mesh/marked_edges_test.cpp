// Edges that files mark: of polygons, and lines that no polygon has.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "mesh/build_meshes.h"
#include "mesh/model.h"
#include "mesh/readers.h"
#include "mesh/stitch_cracks.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::soup_of;

const std::vector<glm::dvec3> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

/// Both ends of a mesh's loose edges, in any order.
using Ends = std::pair<glm::vec3, glm::vec3>;
std::vector<Ends> loose_lines(const Mesh& mesh) {
    std::vector<Ends> lines;
    for (const auto& [a, b] : mesh.loose_edges) lines.emplace_back(mesh.positions[a], mesh.positions[b]);
    return lines;
}
bool has_line(const Mesh& mesh, glm::vec3 a, glm::vec3 b) {
    const std::vector<Ends> lines = loose_lines(mesh);
    return std::any_of(lines.begin(), lines.end(), [&](const Ends& e) { return e == Ends(a, b) || e == Ends(b, a); });
}

TEST(MarkedEdges, ThoseOfNoPolygonAreLoose) {
    std::vector<glm::dvec3> positions = kSquare;
    positions.insert(positions.end(), {{5, 0, 0}, {5, 2, 0}, {1, 0, 0}, {5, 0, 0}});  // the last two are there already
    PolygonSoup soup = soup_of(positions, {{0, 1, 2, 3}});
    soup.marked_edges = {{1, 0}, {6, 4}, {4, 5}, {5, 7}, {4, 7}, {2, 3}};
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 1u);
    const Mesh& mesh = meshes[0];
    EXPECT_EQ(mesh.positions.size(), 6u);
    ASSERT_EQ(mesh.loose_edges.size(), 2u) << "there and back is one, and one has no length";
    EXPECT_TRUE(has_line(mesh, {1, 0, 0}, {5, 0, 0}));
    EXPECT_TRUE(has_line(mesh, {5, 0, 0}, {5, 2, 0}));
    const EdgeCounts counts = count_edges(mesh);
    EXPECT_EQ(counts.marked, 4u);
    EXPECT_EQ(counts.loose, 2u);
    EXPECT_EQ(counts.edges, 4u);
    EXPECT_TRUE(mesh.is_loose(mesh.loose_number(1)));
    EXPECT_FALSE(mesh.is_loose(5));
    EXPECT_EQ(mesh.loose_edge(mesh.loose_number(1)), mesh.loose_edges[1]);
}

// A diagonal that does not cut its polygon, and edges of polygons that are dropped.
TEST(MarkedEdges, BesidePolygonsAreLoose) {
    PolygonSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {4, 0, 0}, {7, 0, 0}},
                               {{0, 1, 2, 3}, {4, 5, 6}});
    soup.marked_edges = {{0, 2}, {1, 3}, {4, 5}};
    const Mesh mesh = build_meshes(soup, {})[0];
    EXPECT_EQ(mesh.loose_edges.size(), 2u);
    EXPECT_TRUE(has_line(mesh, {2, 0, 0}, {4, 0, 0}));
    EXPECT_NE(has_line(mesh, {0, 0, 0}, {1, 1, 0}), has_line(mesh, {1, 0, 0}, {0, 1, 0}));
}

TEST(MarkedEdges, AreLooseInTheirObject) {
    std::vector<glm::dvec3> positions = kSquare;
    positions.insert(positions.end(), {{5, 0, 0}, {5, 2, 0}, {9, 9, 9}});
    PolygonSoup soup = soup_of(positions, {{0, 1, 2}, {0, 2, 3}});
    soup.object_names = {"nothing", "lines first", "polygon", "lines between", "other polygon", "lines last"};
    soup.polygon_object = {2, 4};
    soup.marked_edges = {{4, 5}, {0, 4}, {5, 6}, {0, 1}, {4, 5}, {4, 6}};
    soup.marked_edge_object = {3, 2, 5, 1, 5, 1};
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 5u);
    const std::vector<std::string> names{"lines first", "polygon", "lines between", "other polygon", "lines last"};
    const std::vector<std::size_t> counts{1, 1, 1, 0, 2};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(meshes[i].name, names[i]);
        EXPECT_EQ(meshes[i].loose_edges.size(), counts[i]) << names[i];
    }
    EXPECT_EQ(count_edges(meshes[1]).marked, 2u) << "one of another object is its polygon's";
    EXPECT_TRUE(has_line(meshes[0], {5, 0, 0}, {9, 9, 9}));
    EXPECT_TRUE(has_line(meshes[1], {0, 0, 0}, {5, 0, 0}));
}

TEST(MarkedEdges, SubdivisionLeavesLooseEdgesAsTheyAre) {
    PolygonSoup soup = soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {3, 3, 3}}, {{0, 1, 2, 3}});
    soup.marked_edges = {{0, 2}, {0, 4}, {0, 1}};
    MeshOptions options;
    options.subdivision_levels = 2;
    const Mesh mesh = build_meshes(soup, options)[0];
    EXPECT_EQ(mesh.loose_edges.size(), 2u);
    EXPECT_TRUE(has_line(mesh, {0, 0, 0}, {1, 1, 0}));
    EXPECT_TRUE(has_line(mesh, {0, 0, 0}, {3, 3, 3}));
    EXPECT_EQ(count_edges(mesh).marked, 2u + 4u);
}

TEST(MarkedEdges, FarAwayTheyAreAsExactAsPolygons) {
    PolygonSoup soup = soup_of({{1e7, 0, 0}, {1e7 + 0.125, 0.5, 0}, {0, 0, 0}}, {});
    soup.marked_edges = {{0, 1}};
    const std::vector<Mesh> meshes = build_meshes(soup, {});
    ASSERT_EQ(meshes.size(), 1u);
    const auto [a, b] = meshes[0].loose_edges.at(0);
    EXPECT_EQ(glm::abs(meshes[0].position(a) - meshes[0].position(b)), glm::dvec3(0.125, 0.5, 0));
}

TEST(MarkedEdges, ClosedCracksKeepThem) {
    // Two squares with a narrow gap between them, and a line from one of the corners there.
    const double gap = 1.0 / 64;
    std::vector<glm::dvec3> positions = kSquare;
    for (const glm::dvec3& p : kSquare) positions.push_back(p + glm::dvec3(1 + gap, 0, 0));
    positions.push_back({0.5, 3, 1});
    PolygonSoup soup = soup_of(positions, {{0, 1, 2, 3}, {4, 5, 6, 7}});
    soup.marked_edges = {{7, 8}, {2, 8}, {8, 0}};
    const Mesh mesh = build_meshes(soup, {})[0];
    ASSERT_EQ(mesh.loose_edges.size(), 3u);
    const auto stitched = stitch_cracks(
        mesh, [](const glm::dvec3&) { return 0.1; }, 2);
    ASSERT_TRUE(stitched);
    EXPECT_EQ(stitched->loose_edges.size(), 3u);
    EXPECT_TRUE(has_line(*stitched, {0.5, 3, 1}, {1 + gap / 2, 1, 0}));
    EXPECT_TRUE(has_line(*stitched, {0.5, 3, 1}, {0, 0, 0}));
}

class MarkedEdgesOfFiles : public testing::Test {
  protected:
    test::TemporaryFolder folder_;
};

TEST_F(MarkedEdgesOfFiles, LinesOfObjBelongToTheObjectOfTheirPlace) {
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2\no a\nf 1 2 3\nl 3 1\ng x\nl -1 -2 -3\no b\nv 9 9 9\nl 1 "
        "4\no a\nl 2 4\n";
    for (const std::size_t piece_size : {text.size(), std::size_t{1}, std::size_t{9}}) {
        const PolygonSoup soup = read_obj_text("lines.obj", text, 2, piece_size);
        EXPECT_EQ(soup.object_names, (std::vector<std::string>{"lines", "a", "b"}));
        EXPECT_EQ(soup.marked_edges.size(), 6u);
        EXPECT_EQ(soup.marked_edge_object, (std::vector<std::uint32_t>{0, 1, 1, 1, 2, 1}));
    }
    const PolygonSoup groups = read_obj_text("lines.obj", "v 0 0 0\nv 1 0 0\ng x\nl 1 2\ng y\nl 2 1\n", 1, 100);
    EXPECT_EQ(groups.marked_edge_object, (std::vector<std::uint32_t>{1, 2}));
}

TEST_F(MarkedEdgesOfFiles, AFileMayHaveNothingElse) {
    const Model obj = read_model(folder_.write("lines.obj", "v 0 0 0\nv 1 0 0\nv 1 1 7\nl 1 2 3\n"), {});
    ASSERT_EQ(obj.objects.size(), 1u);
    EXPECT_EQ(obj.meshes[0].loose_edges.size(), 2u);
    EXPECT_TRUE(obj.meshes[0].triangles.empty());
    const Model ply =
        read_model(folder_.write("lines.ply",
                                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                                 "y\nproperty float z\n"
                                 "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n"
                                 "0 0 0\n1 0 0\n1 1 7\n0 1\n1 2\n"),
                   {});
    ASSERT_EQ(ply.objects.size(), 1u);
    EXPECT_EQ(ply.meshes[0].loose_edges.size(), 2u);
    EXPECT_THROW(read_model(folder_.write("dot.obj", "v 0 0 0\nv 0 0 0\nl 1 2\nl 1\n"), {}), InputError);
}

}  // namespace
}  // namespace burin
