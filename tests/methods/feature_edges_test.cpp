// Which mesh edges are lines in a view.

#include "methods/feature_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesh/shapes.h"
#include "methods/projected_polygon.h"
#include "tests/support/drawing.h"

namespace burin::feature_edges_test {
namespace {

using namespace test;

struct Edges {
    Frame frame;
    FeatureEdges features;
    Edges(const Scene& scene, const Camera& camera, int threads = 1)
        : frame(make_frame(scene, camera, 100, 100, {0, 0, 100, 100})), features(frame, threads) {}

    /// Half-edges of outlines with a class.
    int count(LineClass c, std::uint32_t instance = 0) const {
        int found = 0;
        const PolygonOutlines& outlines = features.outlines(instance);
        for (std::uint32_t p = 0; p < outlines.polygon_count(); ++p) {
            for (const HalfEdge h : outlines.outline(p)) found += classes(h, instance).has(c);
        }
        return found;
    }
    LineClassSet classes(HalfEdge h, std::uint32_t instance = 0) const {
        return features.classes({instance, h / 3}, h % 3);
    }
    const Mesh& mesh() const { return *frame.surfaces.instances[0].mesh; }
};

Scene with_all_classes(std::vector<PolygonSoup> soups) {
    Scene scene = scene_of(std::move(soups));
    scene.lines.classes = LineClassSet::all();
    return scene;
}

TEST(FeatureEdges, OfABox) {
    const Scene scene = with_all_classes({make_box({1, 1, 1})});
    const Edges e(scene, perspective_camera({2, 1.5, 3}, {0, 0, 0}));
    EXPECT_EQ(e.count(LineClass::silhouette), 2 * 6) << "each from both of its polygons";
    EXPECT_EQ(e.count(LineClass::crease), 2 * 12);
    EXPECT_EQ(e.count(LineClass::polygon), 2 * 12);
    EXPECT_EQ(e.count(LineClass::border), 0);
    EXPECT_EQ(e.count(LineClass::mark) + e.count(LineClass::material), 0);
    for (HalfEdge h = 0; h < e.mesh().next_on_edge.size(); ++h) {
        EXPECT_EQ(e.classes(h), e.classes(e.mesh().next_on_edge[h])) << "both sides agree";
        if (PolygonOutlines::across_diagonal(e.mesh(), h) != kNoHalfEdge) {
            EXPECT_TRUE(e.classes(h).empty()) << "a diagonal";
        }
    }
}

TEST(FeatureEdges, OnlyRequestedOnesCount) {
    Scene scene = scene_of({make_box({1, 1, 1})});
    scene.lines.classes = LineClass::crease;
    const Edges e(scene, perspective_camera({2, 1.5, 3}, {0, 0, 0}));
    EXPECT_EQ(e.count(LineClass::crease), 24);
    EXPECT_EQ(e.count(LineClass::silhouette) + e.count(LineClass::polygon), 0);
}

TEST(FeatureEdges, ContoursOfClosedMeshesAreClosed) {
    // At every vertex an even number of contour edges meet; also with polygons that are not flat,
    // seen along their planes, and wound the other way.
    for (const PolygonSoup& soup : {make_sphere(0.5, 24, 13), make_torus(0.5, 0.2, 24, 11), make_box({1, 1, 1})}) {
        PolygonSoup turned = soup;
        std::reverse(turned.corners.begin(), turned.corners.begin() + turned.polygon_ends[0]);
        for (const PolygonSoup& s : {soup, turned}) {
            const Scene scene = with_all_classes({s});
            for (const glm::dvec3 eye : {glm::dvec3(2, 1.5, 3), glm::dvec3(0, 0, 4), glm::dvec3(0, 3, 0.001)}) {
                const Edges e(scene, perspective_camera(eye, {0, 0, 0}));
                const Mesh& mesh = e.mesh();
                std::set<std::pair<std::uint32_t, std::uint32_t>> contour;
                for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
                    if (!e.classes(h).has(LineClass::silhouette)) continue;
                    const auto& t = mesh.triangles[h / 3];
                    const std::uint32_t a = t[h % 3], b = t[(h % 3 + 1) % 3];
                    contour.emplace(std::min(a, b), std::max(a, b));
                }
                std::vector<int> met(mesh.positions.size());
                for (const auto& [a, b] : contour) {
                    ++met[a];
                    ++met[b];
                }
                EXPECT_GE(contour.size(), 4u);
                for (const int n : met) EXPECT_EQ(n % 2, 0);
            }
        }
    }
}

TEST(FeatureEdges, BordersAndSeams) {
    // Two patches that are not stitched: half a millimetre of nothing between them is a seam.
    const auto sheet = [](double x0, double x1) {
        return std::vector<glm::dvec3>{{x0, 20, 0}, {x1, 20, 0}, {x1, 80, 0}, {x0, 80, 0}};
    };
    auto points = sheet(20, 50);
    for (const glm::dvec3& p : sheet(50.0005, 80)) points.push_back(p);
    const Scene scene = with_all_classes({soup_of(points, {{0, 1, 2, 3}, {4, 5, 6, 7}})});
    const Edges e(scene, pixel_camera(100, 100));
    EXPECT_EQ(e.count(LineClass::border), 6);
    EXPECT_EQ(e.count(LineClass::polygon), 2) << "the seam, from both sides";
    EXPECT_EQ(e.count(LineClass::silhouette), 0);
    EXPECT_EQ(e.count(LineClass::crease), 0);
}

TEST(FeatureEdges, SliversMakeNoContours) {
    // A flat sheet with a triangle in it that is turned over by rounding.
    const Scene scene =
        with_all_classes({soup_of({{20, 20, 0}, {80, 20, 0}, {80, 80, 0}, {20, 80, 0}, {50, 20.0001, 0}, {50, 50, 0}},
                                  {{0, 1, 4}, {4, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 0, 5}, {0, 4, 5}})});
    PolygonSoup folded = soup_of({{20, 20, 0}, {80, 20, 0}, {50, 19.9999, 0}, {50, 50, 0}, {50, -10, 0}},
                                 {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}, {4, 1, 2}});
    EXPECT_EQ(Edges(scene, pixel_camera(100, 100)).count(LineClass::silhouette), 0);
    // Wound as if the sliver lay the other way round.
    std::swap(folded.corners[4], folded.corners[5]);
    const Scene turned = with_all_classes({folded});
    EXPECT_EQ(Edges(turned, pixel_camera(100, 100)).count(LineClass::silhouette), 0);
}

TEST(FeatureEdges, DoNotDependOnTheNumberOfThreads) {
    const Scene scene = with_all_classes({make_teapot(6), make_torus(0.5, 0.2, 24, 11)});
    const Camera camera = perspective_camera({4, 3, 6}, {0, 1, 0});
    const Edges one(scene, camera, 1), four(scene, camera, 4);
    for (std::uint32_t i = 0; i < 2; ++i) {
        for (HalfEdge h = 0; h < scene.meshes[i].next_on_edge.size(); ++h) {
            ASSERT_EQ(one.classes(h, i), four.classes(h, i));
        }
    }
}

TEST(PolygonOutline, RunsAroundConcavePolygons) {
    const Scene scene = scene_of({soup_of(
        {{20, 20, 0}, {80, 20, 0}, {80, 45, 0}, {45, 45, 0}, {45, 80, 0}, {20, 80, 0}, {90, 20, 0}, {90, 45, 0}},
        {{0, 1, 2, 3, 4, 5}, {1, 6, 7, 2}})});
    const Mesh& mesh = scene.meshes[0];
    const PolygonOutlines outlines(mesh);
    ASSERT_EQ(outlines.polygon_count(), 2u);
    EXPECT_EQ(outlines.triangles(0).size(), 4u);
    for (std::uint32_t p = 0; p < 2; ++p) {
        const auto outline = outlines.outline(p);
        ASSERT_EQ(outline.size(), p == 0 ? 6u : 4u);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const HalfEdge h = outline[i], next = outline[(i + 1) % outline.size()];
            EXPECT_EQ(mesh.triangles[h / 3][(h % 3 + 1) % 3], mesh.triangles[next / 3][next % 3]);
        }
    }
}

TEST(ProjectedPolygon, SharesItsEdgesToTheBit) {
    // Also where the near plane cuts them.
    Scene scene = with_all_classes({make_torus(3, 0.7, 40, 11)});
    for (const glm::dvec3 eye : {glm::dvec3(9, 5, 3), glm::dvec3(3.1, 0.2, 0.3)}) {
        const Edges e(scene, perspective_camera(eye, {0, 0, 0}));
        const DepthRange depth = DepthRange::fitted(e.frame);
        std::map<HalfEdge, ProjectedEdge> edges;
        ProjectedPolygon polygon;
        for (std::uint32_t p = 0; p < e.mesh().polygon_count; ++p) {
            project_polygon(e.frame, e.features, depth, 0, p, polygon);
            for (const ProjectedEdge& edge : polygon.edges) edges[edge.half_edge] = edge;
            for (const ProjectedTriangle& t : polygon.triangles) {
                for (const ProjectedCorner& c : t.corners) {
                    EXPECT_GE(c.z, 0);
                    EXPECT_LE(c.z, 1);
                }
            }
        }
        EXPECT_GT(edges.size(), 400u);
        for (const auto& [h, edge] : edges) {
            const ProjectedEdge& other = edges.at(e.mesh().next_on_edge[h]);
            EXPECT_EQ(edge.from.pixel, other.from.pixel);
            EXPECT_EQ(edge.to.pixel, other.to.pixel);
            EXPECT_EQ(edge.from.z, other.from.z);
            EXPECT_NE(edge.runs_with_outline, other.runs_with_outline) << "wound consistently";
        }
    }
}

}  // namespace
}  // namespace burin::feature_edges_test
