#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <thread>

#include "tests/burin/shapes.h"

namespace burin::test::arguments_test {
namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

TEST(Arguments, VersionIsThatOfTheHeader) {
    EXPECT_EQ(burin_abi(), BURIN_ABI);
    EXPECT_STREQ(burin_version(), "0.1.0");
}

TEST(Arguments, NullIsNamedAndNothingElse) {
    burin_scene_free(nullptr);
    burin_picture_free(nullptr);
    burin_bytes_free(nullptr);
    burin_cancel(nullptr);
    EXPECT_EQ(burin_load(nullptr, "x.obj"), BURIN_BAD_ARGUMENT);
    EXPECT_STREQ(burin_error(), "scene is NULL");
    const Scene scene;
    EXPECT_EQ(burin_load(scene.get(), nullptr), BURIN_BAD_ARGUMENT);
    EXPECT_STREQ(burin_error(), "path is NULL");
    EXPECT_EQ(burin_add_mesh(scene.get(), nullptr), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(burin_add_object(scene.get(), nullptr), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(burin_add_material(scene.get(), nullptr), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(burin_set(scene.get(), nullptr), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(burin_render(nullptr, nullptr, nullptr), nullptr);
    EXPECT_EQ(burin_channel(nullptr, "R", nullptr, nullptr), nullptr);
    EXPECT_EQ(burin_pixels(nullptr, nullptr, 3), BURIN_BAD_ARGUMENT);
    EXPECT_TRUE(burin_encode(nullptr, "png", nullptr, nullptr, nullptr) == BURIN_BAD_ARGUMENT);
    EXPECT_EQ(burin_write(nullptr, "png", nullptr, "x.png"), BURIN_BAD_ARGUMENT);
}

TEST(Arguments, EachThreadHasItsOwnError) {
    EXPECT_EQ(burin_load(nullptr, "x.obj"), BURIN_BAD_ARGUMENT);
    std::thread([] {
        EXPECT_STREQ(burin_error(), "");
        EXPECT_EQ(burin_error_kind(), BURIN_DONE);
        EXPECT_EQ(burin_pixels(nullptr, nullptr, 3), BURIN_BAD_ARGUMENT);
        EXPECT_STREQ(burin_error(), "picture is NULL");
    }).join();
    EXPECT_STREQ(burin_error(), "scene is NULL");
}

TEST(Arguments, StructsOfOtherVersionsAreTakenAsFarAsTheyAreKnown) {
    Scene scene;
    scene.add(cube().mesh());
    const std::string usual = exr_of(scene, {});
    struct Longer {
        burin_view view;
        double later[4];
    } longer;
    std::memset(&longer, 0, sizeof longer);
    const auto render = [&](std::uint32_t size) {
        longer.view.size = size;
        burin_picture* const picture = burin_render(scene.get(), &longer.view, nullptr);
        burin_picture_free(picture);
        return picture != nullptr;
    };
    EXPECT_TRUE(render(sizeof longer));
    EXPECT_TRUE(render(12));  // width and height alone
    longer.later[2] = 1;
    EXPECT_FALSE(render(sizeof longer));
    EXPECT_STREQ(burin_error(), "view has fields that burin 0.1.0 does not know; use a newer one");
    for (const std::uint32_t size : {0u, 3u, 5000u, 0xFFFFFFFFu}) {
        EXPECT_FALSE(render(size));
        EXPECT_EQ(burin_error(), "view.size is " + std::to_string(size) + "; set it to sizeof(burin_view)");
    }
    // One that ends within a field is of no version.
    for (const std::uint32_t size : {5u, 7u, 9u, 11u, 13u, 20u, 27u, 41u, std::uint32_t{sizeof(burin_view)} - 1}) {
        EXPECT_FALSE(render(size)) << size;
        EXPECT_EQ(burin_error(), "view.size is " + std::to_string(size) + "; set it to sizeof(burin_view)");
    }
    // What a shorter struct does not have counts as 0, whatever stands behind it in memory.
    longer.view.shift[0] = 7;
    EXPECT_TRUE(render(12));
}

TEST(Arguments, EveryNumberOfAViewIsChecked) {
    Scene scene;
    scene.add(cube().mesh());
    burin_view good = {};
    good.size = sizeof good;
    good.width = 32;
    good.height = 24;
    const Matrix camera = looking({3, 4, 5}, {0.5, 0.5, 0.5});
    std::copy(camera.begin(), camera.end(), good.camera_to_world);
    const auto expect_refused = [&](const auto& change, const char* field) {
        burin_view view = good;
        change(view);
        EXPECT_EQ(burin_render(scene.get(), &view, nullptr), nullptr) << field;
        EXPECT_EQ(burin_error_kind(), BURIN_BAD_ARGUMENT) << field;
        EXPECT_EQ(std::string(burin_error()).find(std::string("view.") + field), 0u) << burin_error();
    };
    burin_picture* const picture = burin_render(scene.get(), &good, nullptr);
    ASSERT_NE(picture, nullptr) << burin_error();
    burin_picture_free(picture);
    for (const double bad : {kNaN, kInfinity, -kInfinity, -1.0, 1e300}) {
        expect_refused([&](burin_view& v) { v.fov_deg = bad; }, "fov_deg");
        expect_refused([&](burin_view& v) { v.ortho_height = bad; }, "ortho_height");
        const double far_off = bad == -1 ? 101 : bad;
        expect_refused([&](burin_view& v) { v.shift[0] = far_off; }, "shift");
        expect_refused([&](burin_view& v) { v.shift[1] = far_off; }, "shift");
        expect_refused([&](burin_view& v) { v.pixel_aspect = bad; }, "pixel_aspect");
        for (int i = 0; i < 16; ++i)
            expect_refused([&](burin_view& v) { v.camera_to_world[i] = std::abs(bad) == 1 ? kNaN : bad; },
                           "camera_to_world");
    }
    expect_refused([](burin_view& v) { v.fov_deg = 180; }, "fov_deg");
    expect_refused([](burin_view& v) { v.fov_deg = 30, v.ortho_height = 3; },
                   "fov_deg and view.ortho_height: give one of them");
    expect_refused(
        [](burin_view& v) {
            std::fill_n(v.camera_to_world, 16, 0.0);
            v.fov_deg = 0;
            v.shift[0] = 0.25;
        },
        "shift");
    for (const double bad : {0.09, 10.1}) expect_refused([&](burin_view& v) { v.pixel_aspect = bad; }, "pixel_aspect");
    for (const int bad : {1000000001, -1000000001, std::numeric_limits<int>::min()})
        expect_refused([&](burin_view& v) { v.frame = bad; }, "frame");
    for (const int bad : {-1, 1, 3, 16, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
        expect_refused([&](burin_view& v) { v.samples = bad; }, "samples");
    for (const int bad : {-1, 0, 65536, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        expect_refused([&](burin_view& v) { v.width = bad; }, "width");
        expect_refused([&](burin_view& v) { v.height = bad; }, "width and view.height");
    }
    expect_refused([](burin_view& v) { v.crop[2] = 33, v.crop[3] = 2; }, "crop");
    expect_refused([](burin_view& v) { v.crop[0] = -1, v.crop[2] = 4, v.crop[3] = 2; }, "crop");
    expect_refused([](burin_view& v) { v.crop[0] = 5, v.crop[2] = 5, v.crop[3] = 2; }, "crop");
    expect_refused([](burin_view& v) { v.camera = "front"; }, "camera");
    expect_refused([](burin_view& v) { v.camera_to_world[0] *= 1.01; }, "camera_to_world");  // scales
    expect_refused(
        [](burin_view& v) {
            for (int i : {0, 4, 8}) v.camera_to_world[i] *= -1;
        },
        "camera_to_world");                                                               // a mirror
    expect_refused([](burin_view& v) { v.camera_to_world[12] = 1; }, "camera_to_world");  // no row by row
    good.pixel_aspect = 10;
    burin_picture_free(burin_render(scene.get(), &good, nullptr));
}

TEST(Arguments, EveryNumberOfOptionsIsChecked) {
    Scene scene;
    scene.add(cube().mesh());
    std::string text;
    for (const int threads : {-1, 1025, std::numeric_limits<int>::max()}) {
        EXPECT_EQ(failure_of([&] { scene.render({}, {.threads = threads}); }, &text), BURIN_BAD_ARGUMENT);
        EXPECT_EQ(text, "options.threads: must be from 0 to 1024, got " + std::to_string(threads));
    }
    EXPECT_EQ(failure_of([&] { scene.render({}, {.layers = "beauty,wool"}); }, &text), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(text.find("options.layers: unknown layer 'wool'"), 0u);
    const View small{.width = 40, .height = 30};
    const std::string usual = exr_of(scene, small);
    for (const std::uint64_t memory : {std::uint64_t{1} << 26, std::numeric_limits<std::uint64_t>::max()}) {
        EXPECT_TRUE(exr_of(scene, small, {.memory_bytes = memory}) == usual) << memory;
    }
    EXPECT_EQ(failure_of([&] { scene.render(small, {.memory_bytes = 1}); }, &text), BURIN_BAD_INPUT);
    EXPECT_EQ(text.find("options.memory_bytes: this picture takes at least "), 0u) << text;
    for (const int threads : {1, 2, 7}) EXPECT_TRUE(exr_of(scene, small, {.threads = threads}) == usual) << threads;
}

TEST(Arguments, MatricesOfObjectsAreChecked) {
    Scene scene;
    const int mesh = scene.add_mesh(cube().mesh());
    const Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const int object = scene.add_object(mesh, "cube", identity);
    for (std::size_t i = 0; i < 16; ++i) {
        for (const double bad : {kNaN, kInfinity, 2e30}) {
            Matrix matrix = identity;
            matrix[i] = bad;
            EXPECT_EQ(failure_of([&] { scene.add_object(mesh, "cube", matrix); }), BURIN_BAD_ARGUMENT);
            EXPECT_EQ(failure_of([&] { scene.move(object, matrix); }), BURIN_BAD_ARGUMENT);
        }
    }
    Matrix flat = identity;
    flat[5] = 0;
    EXPECT_EQ(failure_of([&] { scene.move(object, flat); }), BURIN_BAD_ARGUMENT);
    for (const int none : {-1, 0, 2, std::numeric_limits<int>::max()}) {
        EXPECT_EQ(failure_of([&] { scene.move(none, identity); }), BURIN_BAD_ARGUMENT);
        EXPECT_EQ(failure_of([&] { scene.remove(none); }), BURIN_BAD_ARGUMENT);
        EXPECT_EQ(failure_of([&] { scene.remove_mesh(none); }), BURIN_BAD_ARGUMENT);
        EXPECT_EQ(failure_of([&] { scene.add_object(none); }), BURIN_BAD_ARGUMENT);
        EXPECT_EQ(failure_of([&] { scene.object_name(none); }), BURIN_BAD_ARGUMENT);
    }
    for (const int none : {-1, 2, std::numeric_limits<int>::max()})
        EXPECT_EQ(failure_of([&] { scene.add_object(mesh, "", {}, none); }), BURIN_BAD_ARGUMENT);
}

TEST(Arguments, MaterialsAreChecked) {
    Scene scene;
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.1f, 1.1f}) {
        for (std::size_t i = 0; i < 3; ++i) {
            Material material;
            material.color[i] = bad;
            EXPECT_EQ(failure_of([&] { scene.add(material); }), BURIN_BAD_ARGUMENT);
        }
        EXPECT_EQ(failure_of([&] { scene.add(Material{.name = "glass", .opacity = bad}); }), BURIN_BAD_ARGUMENT);
    }
    EXPECT_EQ(scene.add(Material{.name = "red", .color = {1, 0, 0}}), 1);
    EXPECT_EQ(scene.add(Material{}), 2);
}

}  // namespace
}  // namespace burin::test::arguments_test
