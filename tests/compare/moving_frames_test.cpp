#include "compare/moving_frames.h"

#include <gtest/gtest.h>

#include "compare/difference_picture.h"
#include "mesh/shapes.h"
#include "tests/support/drawing.h"

namespace burin {
namespace {

/// Where a world position is seen.
glm::dvec2 seen_at(const ComparedView& view, const glm::dvec3& p) {
    const glm::dvec3 in_view(view.camera.to_view() * glm::dvec4(p, 1.0));
    return view.camera.projection(view.width, view.height, 0).to_pixel(in_view);
}

TEST(MovedView, MovesTheSceneByPartsOfAPixel) {
    const Scene scene = test::scene_of({make_box({2, 2, 2})});
    const ComparedView orthographic{test::pixel_camera(64, 48), 64, 48, {0, 0, 64, 48}};
    const ComparedView perspective{test::perspective_camera({0, 0, 9}, {0, 0, 0}), 64, 48, {0, 0, 64, 48}};
    for (const ComparedView& view : {orthographic, perspective}) {
        EXPECT_EQ(seen_at(moved_view(scene, view, 0), {0, 0, 0}), seen_at(view, {0, 0, 0}));
        const glm::dvec2 moved = seen_at(moved_view(scene, view, 8), {0, 0, 0}) - seen_at(view, {0, 0, 0});
        EXPECT_NEAR(moved.x, -0.25, 1e-9);  // the camera moves to the right and up
        EXPECT_NEAR(moved.y, 0.25 * .618, 1e-9);
    }
}

TEST(BusiestPart, IsWhereTheLinesAre) {
    Plane coverage(400, 300);
    for (int x = 250; x < 290; ++x) coverage.at(x, 200) = 1;
    const PixelRect part = busiest_part(coverage, {10, 20, 410, 320}, 64, 48);
    EXPECT_EQ(part.width(), 64);
    EXPECT_EQ(part.height(), 48);
    EXPECT_TRUE(part.x0 <= 10 + 250 && part.x1 >= 10 + 290 && part.y0 <= 20 + 200 && part.y1 > 20 + 200);
    const PixelRect small{5, 6, 15, 16};
    EXPECT_EQ(busiest_part(Plane(10, 10), small, 64, 48), small);
}

TEST(DifferencePicture, SaysWhichWayAPixelDiffers) {
    Plane result(3, 1), truth(3, 1);
    result.values = {1, 0, 1};
    truth.values = {0, 1, 1};
    const DisplayImage picture = difference_picture(result, truth);
    const auto color = [&](std::size_t x) {
        return glm::vec3(picture.pixels[3 * x], picture.pixels[3 * x + 1], picture.pixels[3 * x + 2]) / 65535.0f;
    };
    EXPECT_LT(glm::distance(color(0), kTooMuchColor), 1e-4f);
    EXPECT_LT(glm::distance(color(1), kMissingColor), 1e-4f);
    EXPECT_EQ(color(2).r, color(2).b);  // grey
}

}  // namespace
}  // namespace burin
