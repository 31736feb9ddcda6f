#include "lines/line_decision.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "render/frame.h"
#include "tests/support/drawing.h"
#include "tests/support/oracle.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

constexpr int kWidth = 200, kHeight = 150;

/// A frame, and what rays see in it.
struct View {
    explicit View(Scene s, const Camera& camera)
        : scene(std::move(s)),
          oracle(scene, camera, kWidth, kHeight),
          frame(make_frame(scene, camera, kWidth, kHeight, {0, 0, kWidth, kHeight})) {
        std::uint32_t first = 0;
        for (const SceneObject& object : scene.objects) {
            first_triangle.push_back(first);
            first += static_cast<std::uint32_t>(scene.meshes[object.mesh].triangles.size());
        }
    }
    VisiblePoint at(glm::dvec2 pixel) const {
        const std::uint32_t t = oracle.cast(pixel).triangle;
        if (t == Oracle::Hit::kNone) return {pixel, kBackground};
        const std::uint32_t object = oracle.object_of(t);
        return {pixel, {object, t - first_triangle[object]}};
    }
    LineDecision decide(glm::dvec2 a, glm::dvec2 b) const {
        LineCriteria criteria = frame.criteria;
        criteria.classes = LineClassSet::all();
        return decide_line(frame.surfaces, at(a), at(b), criteria);
    }

    Scene scene;
    Oracle oracle;
    Frame frame;
    std::vector<std::uint32_t> first_triangle;
};

View some_view() {
    std::vector<PolygonSoup> objects = {make_torus(0.8, 0.3, 40, 20), make_box({0.7, 1.3, 0.5}), make_teapot(6)};
    objects[2] = transformed(objects[2], [](glm::dvec3 p) { return p * 0.3 + glm::dvec3(0.4, -0.2, 0.3); });
    return View(scene_of(objects), perspective_camera({2, 1.6, 3}, {0.1, 0, 0}));
}

TEST(DecideLine, DoesNotDependOnTheOrderOfThePoints) {
    const View view = some_view();
    int lines = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const glm::dvec2 a(random.real(20, kWidth - 20), random.real(20, kHeight - 20));
        const glm::dvec2 b = a + glm::dvec2(random.real(-0.5, 0.5), random.real(-0.5, 0.5));
        const LineDecision forth = view.decide(a, b), back = view.decide(b, a);
        ASSERT_EQ(forth.classes, back.classes) << trial;
        ASSERT_EQ(forth.reason, back.reason) << trial;
        if (forth.classes.empty()) continue;
        ++lines;
        ASSERT_EQ(forth.front, 1 - back.front) << trial;
        ASSERT_NEAR(forth.fraction, 1 - back.fraction, 1e-9) << trial;
    }
    EXPECT_GT(lines, 1000);
}

TEST(DecideLine, PutsTheLineWhereTheVisibleSurfaceChanges) {
    // Between two points with one line in between, rays must see both surfaces at `fraction`.
    const View view = some_view();
    int checked = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Random random(static_cast<std::uint64_t>(trial));
        const glm::dvec2 a(random.real(20, kWidth - 20), random.real(20, kHeight - 20));
        const double angle = random.real(0, 6.283);
        const glm::dvec2 b = a + 0.25 * glm::dvec2(std::cos(angle), std::sin(angle));
        const LineDecision d = view.decide(a, b);
        const SurfaceId sa = view.at(a).surface, sb = view.at(b).surface;
        if (d.classes.empty() || (d.reason != LineReason::turns_away && d.reason != LineReason::passes_through &&
                                  d.reason != LineReason::feature_edge))
            continue;
        // Only pairs where nothing else shows up on the way.
        bool simple = true;
        for (int k = 1; k < 16; ++k) {
            const SurfaceId s = view.at(glm::mix(a, b, k / 16.0)).surface;
            simple = simple && (s == sa || s == sb);
        }
        if (!simple) continue;
        // Snapping moves edges by less than 1/256 pixel: around the place, both must be seen.
        bool sees[2] = {false, false};
        for (int k = 0; k < 64; ++k) {
            const double turn = 6.2831853 * k / 64;
            const glm::dvec2 around = glm::mix(a, b, d.fraction) + glm::dvec2(std::cos(turn), std::sin(turn)) / 128.0;
            const SurfaceId s = view.at(around).surface;
            // Other triangles of the same object may lie between the point and the line.
            const bool two_objects = sa.instance != sb.instance;
            sees[0] = sees[0] || s == sa || (two_objects && s.instance == sa.instance);
            sees[1] = sees[1] || s == sb || (two_objects && s.instance == sb.instance);
        }
        ASSERT_TRUE(sees[0] && sees[1]) << trial << ": " << describe(d.reason);
        ++checked;
    }
    EXPECT_GT(checked, 500);
}

TEST(DecideLine, NamesTheEdgeThatTheLineIs) {
    const View view(scene_of({make_box({1, 1, 1})}), perspective_camera({2, 1.5, 3}, {0, 0, 0}));
    int edges = 0;
    for (int y = 10; y < kHeight - 10; ++y) {
        for (int x = 10; x < kWidth - 10; ++x) {
            const LineDecision d = view.decide({x + 0.37, y + 0.41}, {x + 0.87, y + 0.41});
            if (d.classes.empty()) continue;
            ASSERT_NE(d.edge.half_edge, kNoHalfEdge);
            const Mesh& mesh = view.frame.surfaces.mesh_of(d.edge.surface);
            const auto& t = mesh.triangles[d.edge.half_edge / 3];
            const glm::vec3 p = mesh.positions[t[d.edge.half_edge % 3]],
                            q = mesh.positions[t[(d.edge.half_edge + 1) % 3]];
            // An edge of a box runs along one axis; a diagonal does not.
            const glm::vec3 along = glm::abs(p - q);
            ASSERT_FLOAT_EQ(along.x + along.y + along.z, 1.0f);
            ++edges;
        }
    }
    EXPECT_GT(edges, 100);
}

TEST(DecideLine, NeverDependsOnTheSizeOfTheModel) {
    for (const double scale : {0x1p-30, 0x1p30}) {
        const auto build = [&](double s) {
            return View(scene_of({transformed(make_torus(0.8, 0.3, 40, 20), [=](glm::dvec3 p) { return p * s; }),
                                  transformed(make_box({0.7, 1.3, 0.5}), [=](glm::dvec3 p) { return p * s; })}),
                        perspective_camera(glm::dvec3(2, 1.6, 3) * s, {0, 0, 0}));
        };
        const View unit = build(1), scaled = build(scale);
        for (int trial = 0; trial < 4000; ++trial) {
            Random random(static_cast<std::uint64_t>(trial));
            const glm::dvec2 a(random.real(20, kWidth - 20), random.real(20, kHeight - 20));
            const glm::dvec2 b = a + glm::dvec2(random.real(-0.5, 0.5), random.real(-0.5, 0.5));
            ASSERT_EQ(unit.decide(a, b).classes, scaled.decide(a, b).classes) << trial;
        }
    }
}

}  // namespace
}  // namespace burin
