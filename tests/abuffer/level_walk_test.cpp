// surely_goes_on() against walk_to_end(), which projects and cuts triangles one by one.

#include "abuffer/edges/level_walk.h"

#include <gtest/gtest.h>

#include <vector>

#include "abuffer/screen/triangle_bins.h"
#include "tests/support/drawing.h"
#include "tests/support/rough_sphere.h"
#include "tests/support/terraces.h"

namespace burin::level_walk_test {
namespace {

using namespace test;

constexpr int kSize = 90;

struct Counts {
    int told = 0, others = 0;
};

/// From all edges of two triangles, outwards over each of them.
void compare(Random& random, const Scene& scene, const Camera& camera, Counts& counts) {
    const Frame frame = make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
    const TriangleBins bins(screen, frame.crop, 2, best_kernels(), 1);  // finds out which way triangles face
    for (std::uint32_t instance = 0; instance < frame.surfaces.instances.size(); ++instance) {
        const ScreenMesh& mesh = screen.mesh(instance);
        for (HalfEdge h = 0; h < 3 * mesh.triangle_count; ++h) {
            const HalfEdge g = mesh.partners[h], first = h - h % 3;
            const std::uint8_t facing = mesh.facing[h / 3];
            if (g == h || mesh.partners[g] != h || (facing != clockwise && facing != counterclockwise)) continue;
            const auto place = [&](HalfEdge k) {
                const ScreenVertex& v = mesh.vertices[mesh.corners[first + (h + k) % 3]];
                return glm::dvec2(v.x, v.y);
            };
            const glm::dvec2 a = place(0), b = place(1), middle = 0.5 * (a + b);
            if (a == b) continue;
            glm::dvec2 out = glm::normalize(glm::dvec2(b.y - a.y, a.x - b.x));
            if (glm::dot(out, place(2) - a) > 0) out = -out;
            const double distance = random.real(2, 64);
            if (!surely_goes_on(screen, instance, h, middle, out, distance)) {
                ++counts.others;
                continue;
            }
            ++counts.told;
            const glm::dvec2 past = distance * out;
            const SurfaceWalk walk =
                walk_to_end(frame.surfaces, {instance, h / 3}, (middle - past) / 256.0, (middle + past) / 256.0,
                            frame.criteria, 96, screen.sharp_edges(instance));
            ASSERT_EQ(walk.end, WalkEnd::arrived) << "half-edge " << h << " distance " << distance;
        }
    }
}

TEST(LevelWalk, FoldsAreNeverWalkedOver) {
    Counts counts;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::vector<PolygonSoup> objects;
        objects.push_back(rough_sphere(random, random.integer(20, 260), random.real(0, 8)));
        objects.push_back(make_cylinder(0.6, 0.6, 6, random.integer(10, 400)));
        const glm::dvec3 eye = random.direction() * random.real(2.0, 9.0);
        compare(random, scene_of(std::move(objects)), perspective_camera(eye, {0, 0, 0}), counts);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.told, 50000);
    EXPECT_GT(counts.others, 50000);
}

/// Terraces seen from the front: walls that are edge-on to within snapping, or exactly.
TEST(LevelWalk, WallsSeenEdgeOn) {
    Counts counts;
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Terraces terraces(random, 0.3);
        compare(random, scene_of({std::move(terraces.soup)}), terraces.camera, counts);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.told, 10000);
    EXPECT_GT(counts.others, 10000);
}

}  // namespace
}  // namespace burin::level_walk_test
