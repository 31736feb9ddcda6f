// Walls that are seen edge-on make outlines.

#include <gtest/gtest.h>

#include <cmath>

#include "methods/abuffer.h"
#include "tests/support/drawing.h"

namespace burin::walls_test {
namespace {

using namespace test;

// Two plates with a wall between them, seen from above. The wall may be undercut; if it leans towards the eye it is a
// surface.
TEST(Wall, SeenEdgeOnIsAnOutline) {
    const glm::dvec2 a(40.3, 10.1), b(60.7, 90.1), out = glm::normalize(glm::dvec2(b.y - a.y, a.x - b.x));
    const auto step = [&](double lean) {
        const glm::dvec2 a0 = a + lean * out, b0 = b + lean * out;
        return soup_of(
            {{10, 10.1, 30}, {a, 30}, {b, 30}, {10, 90.1, 30}, {a0, 0}, {b0, 0}, {95, 10.1, 0}, {95, 90.1, 0}},
            {{0, 1, 2, 3}, {1, 4, 5, 2}, {4, 6, 7, 5}});
    };
    const auto drawn_share = [&](double lean, RenderFunction render) {
        Scene scene = scene_of({step(lean)});
        scene.lines.classes = LineClass::silhouette;
        scene.abuffer.samples = 2;  // decisions of samples alone
        const Drawing d(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100}, 1, render);
        return d.drawn_share({a.x, 100 - a.y}, {b.x, 100 - b.y});
    };
    for (const RenderFunction render : {render_patel, render_abuffer}) {
        for (const double lean : {-2.0, -0.1, -0.01, -1e-6, 0.0, 1e-6})
            EXPECT_GT(drawn_share(lean, render), 0.99) << lean;
        for (const double lean : {0.1, 2.0}) EXPECT_EQ(drawn_share(lean, render), 0) << lean;
    }
}

// The view moves, and a wall turns by far less than corners are snapped by: its outline goes once and does not come
// back.
TEST(Wall, PassesTheEdgeOnPositionOnce) {
    constexpr int kFrames = 40;
    for (const double angle_deg : {-22.0, 8.0, 72.0}) {
        const glm::dvec2 along(std::cos(glm::radians(angle_deg)), std::sin(glm::radians(angle_deg))),
            out(along.y, -along.x);
        const glm::dvec2 a(40.3, 50.1), b = a + 40.0 * along;
        for (const int samples : {0, 2}) {
            int changes = 0;
            bool was_drawn = true;
            for (int frame = 0; frame < kFrames; ++frame) {
                const glm::dvec2 moved(frame / 32.0, frame / 45.0), lean = (frame - 0.6 * kFrames) / (32.0 * 256) * out;
                const auto at = [&](glm::dvec2 p, double z) { return glm::dvec3(p + moved, z); };
                // A triangle between what lies above its longest side, and a valley that begins at its foot.
                Scene scene = scene_of(
                    {soup_of({at(a, 30), at(b, 30), at(a - 30.0 * out, 30), at(b - 30.0 * out, 30),
                              at(glm::mix(a, b, 0.37) + lean, 0), at(a + 30.0 * out, 30), at(b + 30.0 * out, 30)},
                             {{2, 0, 1, 3}, {0, 4, 1}, {0, 5, 4}, {4, 5, 6}, {4, 6, 1}})});
                scene.lines.classes = LineClass::silhouette;
                scene.lines.crease_angle_deg = 150;  // no edge is sharp
                if (samples != 0) scene.abuffer.samples = samples;
                const Drawing d(scene, pixel_camera(120, 120), 120, 120, {0, 0, 120, 120}, 1, render_abuffer);
                const glm::dvec2 from = a + moved, to = b + moved;
                const double share = d.drawn_share({from.x, 120 - from.y}, {to.x, 120 - to.y}, 6);
                changes += (share > 0.5) != was_drawn ? 1 : 0;
                was_drawn = share > 0.5;
            }
            EXPECT_EQ(changes, 1) << angle_deg << ", " << samples << " samples";
        }
    }
}

// A fillet ends on a boss like that: no edge is sharp, and the wall has several rows of triangles.
TEST(Wall, OfASmoothBossIsAnOutline) {
    constexpr int kSides = 48;
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons;
    const std::pair<double, double> rings[] = {{10, 30}, {24, 29}, {28, 27}, {30, 24}, {30.0, 15},
                                               {30, 6},  {32, 3},  {36, 1},  {45, 0}};  // radius, z
    for (const auto& [radius, z] : rings) {
        for (int i = 0; i < kSides; ++i) {
            const double angle = 2 * M_PI * (i + 0.3) / kSides;
            positions.emplace_back(50 + radius * std::cos(angle), 50 + radius * std::sin(angle), z);
        }
    }
    for (std::uint32_t ring = 0; ring + 1 < std::size(rings); ++ring) {
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t next = (i + 1) % kSides, inner = ring * kSides, outer = inner + kSides;
            polygons.push_back({inner + i, outer + i, outer + next, inner + next});
        }
    }
    Scene scene = scene_of({soup_of(positions, polygons)});
    scene.lines.classes = LineClass::silhouette;
    for (const RenderFunction render : {render_patel, render_abuffer}) {
        const Drawing d(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100}, 1, render);
        for (int i = 0; i < kSides; ++i) {
            const glm::dvec3 &p = positions[static_cast<std::size_t>(3 * kSides + i)],
                             &q = positions[static_cast<std::size_t>(3 * kSides + (i + 1) % kSides)];
            EXPECT_GT(d.drawn_share({p.x, 100 - p.y}, {q.x, 100 - q.y}, 0), 0.99) << i;
        }
        EXPECT_EQ(d.drawn_share({50, 20}, {50, 45}, 3), 0) << "nothing on the fillet or the plate";
    }
}

}  // namespace
}  // namespace burin::walls_test
