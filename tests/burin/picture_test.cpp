#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/burin/shapes.h"
#include "tests/cli/program.h"

namespace burin::test::picture_test {
namespace {

std::string text_of(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A glass cube before a red one.
Scene two_cubes() {
    Scene scene;
    const int red = scene.add(Material{.name = "red", .color = {1, 0, 0}});
    const int glass = scene.add(Material{.name = "glass", .color = {0, 0.5f, 0}, .opacity = 0.25f});
    const int mesh = scene.add_mesh(cube().mesh());
    scene.add_object(mesh, "back", {}, red);
    scene.add_object(mesh, "front", {1, 0, 0, 0.3, 0, 1, 0, 0.2, 0, 0, 1, 1.5, 0, 0, 0, 1}, glass);
    scene.set("surfaces.shading=lambert");
    return scene;
}

constexpr const char* kSameScene = R"(
[surfaces]
shading = "lambert"
[[material]]
name = "red"
color = [1, 0, 0]
[[material]]
name = "glass"
color = [0, 0.5, 0]
opacity = 0.25
[[object]]
name = "back"
file = "cube.obj"
material = "red"
[[object]]
name = "front"
file = "cube.obj"
material = "glass"
translate = [0.3, 0.2, 1.5]
)";

TEST(LibraryPicture, FilesAreThoseOfTheProgram) {
    const TemporaryFolder folder;
    folder.write("cube.obj", obj_text(cube()));
    folder.write("scene.toml", kSameScene);
    Scene scene = two_cubes();
    const Picture picture = scene.render({.width = 120, .height = 90});
    struct Case {
        const char* format;
        const char* file;
        const char* bits;
    };
    for (const Case& c :
         {Case{"png", "a.png", "8"}, {"png16", "b.png", "16"}, {"tif", "a.tif", "8"}, {"tif16", "b.tiff", "16"}}) {
        const ProgramResult result = run_burin(
            folder.path(), {"render", "scene.toml", "--size", "120x90", "-q", "-o", c.file, "--bits", c.bits});
        ASSERT_EQ(result.status, 0) << result.err;
        const std::string expected = read_file(folder.file(c.file));
        EXPECT_TRUE(text_of(picture.encode(c.format)) == expected) << c.format;
        // The format goes before the suffix.
        ASSERT_EQ(burin_write(picture.get(), c.format, nullptr, folder.file("x.any").c_str()), 0) << burin_error();
        EXPECT_TRUE(read_file(folder.file("x.any")) == expected) << c.format;
    }
    picture.write(folder.file("c.png"));
    EXPECT_TRUE(text_of(picture.encode("png")) == read_file(folder.file("c.png")));
    picture.write(folder.file("c.exr"));
    EXPECT_TRUE(text_of(picture.encode("exr")) == read_file(folder.file("c.exr")));
}

TEST(LibraryPicture, WhatCannotBeWrittenIsSaid) {
    const TemporaryFolder folder;
    Scene scene = two_cubes();
    const Picture picture = scene.render({.width = 32, .height = 24});
    std::string text;
    EXPECT_TRUE(failure_of([&] { picture.encode("jpg"); }, &text) == BURIN_BAD_ARGUMENT);
    EXPECT_EQ(text, "unknown format 'jpg'; known are exr png png16 tif tif16 svg pdf dxf");
    EXPECT_EQ(failure_of([&] { picture.write(folder.file("a.jpg")); }), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(failure_of([&] { picture.write(folder.file("none/a.png")); }), BURIN_BAD_INPUT);
    const std::string locked = folder.write("locked.png", "mine");
    std::filesystem::permissions(locked, std::filesystem::perms::owner_read);
    EXPECT_EQ(failure_of([&] { picture.write(locked); }, &text), BURIN_BAD_INPUT);
    EXPECT_EQ(text, locked + ": cannot write: the file is read-only; give another name or change its permissions");
    EXPECT_EQ(read_file(locked), "mine");
    std::filesystem::remove(locked);
    EXPECT_EQ(burin_write(picture.get(), nullptr, "comic", folder.file("a.png").c_str()), BURIN_BAD_ARGUMENT);
    const Picture depth = scene.render({.width = 32, .height = 24}, {.layers = "Z"});
    EXPECT_EQ(failure_of([&] { depth.write(folder.file("a.png")); }), BURIN_BAD_ARGUMENT);
    std::vector<std::uint8_t> pixels(std::size_t{32} * 24 * 4);
    EXPECT_EQ(failure_of([&] { depth.pixels(pixels.data(), 3); }), BURIN_BAD_ARGUMENT);
    for (const int channels : {-1, 0, 2, 5})
        EXPECT_EQ(failure_of([&] { picture.pixels(pixels.data(), channels); }), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(folder.names(), std::vector<std::string>());
    // No picture at all:
    std::uint32_t other[64] = {1, 2, 3};
    EXPECT_EQ(burin_write(other, "png", nullptr, folder.file("a.png").c_str()), BURIN_BAD_ARGUMENT);
}

TEST(LibraryPicture, ChannelsHaveTheirTypesAndSizes) {
    Scene scene = two_cubes();
    const Picture picture =
        scene.render({.width = 60, .height = 40, .crop = {10, 5, 50, 35}}, {.layers = "beauty,Z,ids"});
    EXPECT_EQ(picture.channel_names(),
              (std::vector<std::string>{"R", "G", "B", "A", "Z", "id.object", "id.material", "id.polygon"}));
    EXPECT_EQ(picture.size().width, 40);
    EXPECT_EQ(picture.size().height, 30);
    EXPECT_EQ(picture.channel<std::uint16_t>("R").size(), 1200u);
    EXPECT_EQ(picture.channel<float>("Z").size(), 1200u);
    const auto ids = picture.channel<std::uint32_t>("id.object");
    EXPECT_EQ(*std::max_element(ids.begin(), ids.end()), 2u);
    EXPECT_EQ(failure_of([&] { picture.channel<float>("R"); }), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(failure_of([&] { picture.channel<float>("N.X"); }), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(burin_channel_name(picture.get(), -1), nullptr);
    EXPECT_EQ(burin_channel_name(picture.get(), 8), nullptr);
}

TEST(LibraryPicture, CryptomatteHasTheRanksOfItsSetting) {
    Scene scene = two_cubes();
    for (const std::size_t ranks : {2, 8}) {
        scene.set("crypto.ranks=" + std::to_string(ranks));
        const Picture picture = scene.render({.width = 20, .height = 15}, {.layers = "CryptoObject"});
        EXPECT_EQ(picture.channel_names().size(), 2 * ranks);
    }
}

TEST(LibraryPicture, PixelsAreThoseOfADisplay) {
    Scene scene = two_cubes();
    scene.set("picture.background=#336699");
    const View view{.width = 60, .height = 40, .crop = {10, 5, 50, 35}};
    const Picture picture = scene.render(view, {.layers = "beauty"});
    constexpr std::size_t kPixels = 60 * 40, kGuard = 8;
    std::vector<std::uint8_t> grey(kPixels + kGuard, 0xEE), rgb(3 * kPixels + kGuard, 0xEE),
        rgba(4 * kPixels + kGuard, 0xEE);
    picture.pixels(grey.data(), 1);
    picture.pixels(rgb.data(), 3);
    picture.pixels(rgba.data(), 4);
    for (const auto* pixels : {&grey, &rgb, &rgba})
        EXPECT_TRUE(std::all_of(pixels->end() - kGuard, pixels->end(), [](int b) { return b == 0xEE; }));
    // Outside of the crop is background.
    EXPECT_EQ((std::vector<std::uint8_t>(rgb.begin(), rgb.begin() + 3)), (std::vector<std::uint8_t>{0x33, 0x66, 0x99}));
    EXPECT_EQ((std::vector<std::uint8_t>(rgba.begin(), rgba.begin() + 4)), (std::vector<std::uint8_t>{0, 0, 0, 0}));
    const auto alpha = picture.channel<std::uint16_t>("A");
    constexpr std::uint16_t kQuarter = 0x3400, kThreeQuarters = 0x3A00, kOne = 0x3C00;  // in half precision
    for (std::size_t i = 0; i < kPixels; ++i) {
        const double luma = 0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2];
        ASSERT_NEAR(grey[i], luma, 1.01) << i;
        const std::size_t x = i % 60, y = i / 60;
        const bool is_inside = x >= 10 && x < 50 && y >= 5 && y < 35;
        const std::uint16_t half = is_inside ? alpha[(y - 5) * 40 + x - 10] : std::uint16_t{0};
        if (half == 0) {
            ASSERT_EQ(rgba[4 * i + 3], 0) << i;
        }
        if (half == kOne) {
            ASSERT_EQ(rgba[4 * i + 3], 255) << i;
        }
        if (kQuarter <= half && half < kThreeQuarters) {
            ASSERT_NEAR(rgba[4 * i + 3], 127, 64) << i;
        }
    }
    // On white paper what is grey is the same in all channels.
    Scene lines;
    lines.add(cube().mesh());
    const Picture drawing = lines.render({.width = 60, .height = 40});
    drawing.pixels(grey.data(), 1);
    drawing.pixels(rgb.data(), 3);
    for (std::size_t i = 0; i < kPixels; ++i) {
        for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(rgb[3 * i + c], grey[i]);
    }
    EXPECT_EQ(grey[0], 255);
}

TEST(LibraryPicture, LivesOnWithoutItsScene) {
    burin_picture* kept = nullptr;
    std::string before;
    {
        Scene scene = two_cubes();
        before = exr_of(scene, {.width = 60, .height = 40});
        burin_view view = {};
        view.size = sizeof view;
        view.width = 60;
        view.height = 40;
        kept = burin_render(scene.get(), &view, nullptr);
        scene.clear();
    }
    const Picture picture(kept);
    EXPECT_TRUE(text_of(picture.encode("exr")) == before);
}

}  // namespace
}  // namespace burin::test::picture_test
