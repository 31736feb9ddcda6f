#include "view/order_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/shapes.h"
#include "tests/support/layers.h"
#include "tests/support/random.h"
#include "view/rounded_copies.h"

namespace burin {
namespace {

using namespace test;

/// A bumpy sheet of triangles that faces the eye, and a copy of it, moved by up to `apart` along each axis.
std::vector<PolygonSoup> sheet_and_copy(Random& random, double apart) {
    PolygonSoup sheet = make_plane(80, 80, 12, 12);
    for (glm::dvec3& p : sheet.positions) {
        const glm::dvec3 flat = p;
        p = glm::dvec3(50 + flat.x, 50 + flat.z, random.real(-0.5, 0.5));
    }
    PolygonSoup copy = sheet;
    for (glm::dvec3& p : copy.positions)
        p += glm::dvec3(random.real(-apart, apart), random.real(-apart, apart), random.real(-apart, apart));
    return {sheet, copy};
}

TEST(OrderMemory, ChangesNoAnswer) {
    int copies = 0, others = 0, near = 0, far = 0;
    for (std::uint64_t trial = 0; trial < 12; ++trial) {
        SCOPED_TRACE(trial);
        Random random(trial);
        const Scene scene = scene_of(sheet_and_copy(random, trial % 2 == 0 ? 0.02 : 0.12));
        const Frame frame = make_frame(scene, pixel_camera(100, 100), 100, 100, {0, 0, 100, 100});
        const SurfaceSet& surfaces = frame.surfaces;
        OrderMemory memory(trial % 3 == 0 ? OrderMemory::kMost : 16);  // or one that mostly knows other pairs
        const auto count = static_cast<int>(scene.meshes[0].triangles.size());
        for (int i = 0; i < 3000; ++i) {
            const auto s = static_cast<std::uint32_t>(random.integer(0, count - 1));
            // Mostly the same triangle of the copy, or one beside it.
            const auto t =
                static_cast<std::uint32_t>(std::clamp(static_cast<int>(s) + random.integer(-2, 2), 0, count - 1));
            SurfaceId a{0, s}, b{1, t};
            if (random.integer(0, 1) == 1) std::swap(a, b);
            const bool are_copies = are_rounded_copies(surfaces, a, b);
            ASSERT_EQ(are_rounded_copies(surfaces, a, b, &memory), are_copies) << s << " " << t;
            const glm::dvec2 place(random.real(10, 90), random.real(10, 90));
            const bool are_along = run_along(surfaces, a, b, place);
            ASSERT_EQ(run_along(surfaces, a, b, place, &memory), are_along) << s << " " << t;
            const SurfaceOrder order = surfaces.order(a, b), known = surfaces.order(a, b, &memory);
            ASSERT_EQ(known.are_coincident(), order.are_coincident());
            ASSERT_EQ(known.is_of_copies, order.is_of_copies);
            ++(are_copies ? copies : others);
            ++(are_along ? near : far);
        }
    }
    EXPECT_GT(copies, 200);
    EXPECT_GT(others, 200);
    EXPECT_GT(near, 200);
    EXPECT_GT(far, 200);
}

}  // namespace
}  // namespace burin
