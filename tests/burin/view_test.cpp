#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "image/half.h"
#include "tests/burin/shapes.h"

namespace burin::test::view_test {
namespace {

Scene two_cubes() {
    Scene scene;
    const int mesh = scene.add_mesh(cube().mesh());
    scene.add_object(mesh, "a");
    scene.add_object(mesh, "b", {1, 0, 0, 0.4, 0, 1, 0, 0.6, 0, 0, 1, 0.8, 0, 0, 0, 1});
    return scene;
}

Matrix in_single_precision(Matrix matrix) {
    for (double& number : matrix) number = static_cast<double>(static_cast<float>(number));
    return matrix;
}

/// Colours and ids; the last bits of depths depend on those of the matrix.
std::vector<std::uint32_t> what_is_seen(const Picture& picture) {
    std::vector<std::uint32_t> values;
    for (const char* const name : {"R", "G", "B", "A"}) {
        const auto channel = picture.channel<std::uint16_t>(name);
        values.insert(values.end(), channel.begin(), channel.end());
    }
    for (const char* const name : {"id.object", "id.polygon"}) {
        const auto channel = picture.channel<std::uint32_t>(name);
        values.insert(values.end(), channel.begin(), channel.end());
    }
    return values;
}

TEST(LibraryView, AMatrixIsTheCameraOfASceneFile) {
    Scene scene = two_cubes();
    scene.set_toml(
        "[[camera]]\nname = \"eye\"\neye = [3, 4, 5]\ntarget = [0, 0, 0]\nfov = 20\n"
        "[[camera]]\nname = \"flat\"\nprojection = \"orthographic\"\neye = [3, 4, 5]\ntarget = [0, 0, 0]\nheight = "
        "4\n");
    const Matrix camera = looking({3, 4, 5}, {0, 0, 0});
    const auto by_name = [&](const char* name) { return scene.render({.width = 90, .height = 60, .camera = name}); };
    const Picture perspective = scene.render({.width = 90, .height = 60, .camera_to_world = camera, .fov_deg = 20});
    const Picture flat = scene.render({.width = 90, .height = 60, .camera_to_world = camera, .ortho_height = 4});
    EXPECT_TRUE(what_is_seen(perspective) == what_is_seen(by_name("eye")));
    EXPECT_TRUE(what_is_seen(flat) == what_is_seen(by_name("flat")));
    EXPECT_TRUE(exr_of(scene, {.width = 90, .height = 60}) ==
                exr_of(scene, {.width = 90, .height = 60, .camera = "eye"}));
}

TEST(LibraryView, AMatrixOfSinglePrecisionIsMadeRigid) {
    // Its columns are off by 1e-8. Taken as they stand, they would make a picture that is skewed by as much, and
    // many lines that cannot be told from others.
    Scene scene = two_cubes();
    const Matrix exact = looking({3, 4, 5}, {0.3, 0.4, 0.5});
    Matrix rounded = in_single_precision(exact);
    ASSERT_NE(exact, rounded);
    const Picture picture = scene.render({.width = 90, .height = 60, .camera_to_world = rounded, .fov_deg = 30});
    // What is orthonormal to the last bit, and nearest to it: the same camera.
    const auto dot = [](const Matrix& m, std::size_t a, std::size_t b) {
        return m[a] * m[b] + m[a + 4] * m[b + 4] + m[a + 8] * m[b + 8];
    };
    Matrix rigid = rounded;
    const auto normalize = [&](std::size_t column) {
        const double length = std::sqrt(dot(rigid, column, column));
        for (std::size_t row = 0; row < 3; ++row) rigid[4 * row + column] /= length;
    };
    normalize(2);
    normalize(1);
    const auto cross = [&](std::size_t to, std::size_t a, std::size_t b) {
        for (std::size_t row = 0; row < 3; ++row) {
            const std::size_t i = 4 * ((row + 1) % 3), k = 4 * ((row + 2) % 3);
            rigid[4 * row + to] = rigid[i + a] * rigid[k + b] - rigid[k + a] * rigid[i + b];
        }
    };
    cross(0, 1, 2);
    normalize(0);
    cross(1, 2, 0);
    EXPECT_TRUE(what_is_seen(picture) ==
                what_is_seen(scene.render({.width = 90, .height = 60, .camera_to_world = rigid, .fov_deg = 30})));
}

TEST(LibraryView, ACropIsAPartOfThePicture) {
    Scene scene = two_cubes();
    const Picture whole = scene.render({.width = 90, .height = 60});
    const Picture part = scene.render({.width = 90, .height = 60, .crop = {20, 10, 70, 44}});
    for (const std::string& name : {std::string("Z"), std::string("N.X")}) {
        const auto all = whole.channel<float>(name), some = part.channel<float>(name);
        for (std::size_t y = 10; y < 44; ++y) {
            for (std::size_t x = 20; x < 70; ++x)
                ASSERT_EQ(std::bit_cast<std::uint32_t>(some[(y - 10) * 50 + x - 20]),
                          std::bit_cast<std::uint32_t>(all[y * 90 + x]));
        }
    }
}

TEST(LibraryView, AShiftedLensShowsAnotherPartOfTheSameView) {
    Scene scene = two_cubes();
    View view{.width = 90, .height = 60};
    view.camera_to_world = Matrix{1, 0, 0, 0.3, 0, 1, 0, 0.4, 0, 0, 1, 6, 0, 0, 0, 1};
    const Picture plain = scene.render(view);
    view.shift = {0.25, -0.5};  // 15 pixels to the right, 30 down
    const Picture shifted = scene.render(view);
    const auto all = plain.channel<std::uint16_t>("lines.A"), some = shifted.channel<std::uint16_t>("lines.A");
    std::size_t drawn = 0;
    for (std::size_t y = 0; y < 30; ++y) {
        for (std::size_t x = 0; x < 75; ++x) {
            // Where samples of strokes lie within a pixel depends on its row.
            ASSERT_NEAR(float_from_half(some[y * 90 + x]), float_from_half(all[(y + 30) * 90 + x + 15]), 0.01)
                << x << " " << y;
            drawn += some[y * 90 + x] != 0;
        }
    }
    EXPECT_GT(drawn, 50u);
    scene.set_toml("[[camera]]\neye = [0.3, 0.4, 6]\ntarget = [0.3, 0.4, 0]\nshift = [0.25, -0.5]\n");
    const Picture of_scene = scene.render({.width = 90, .height = 60});
    EXPECT_EQ(what_is_seen(of_scene), what_is_seen(shifted));
}

TEST(LibraryView, SizeAndSamplesComeFromTheSceneUnlessTheyAreGiven) {
    Scene scene = two_cubes();
    scene.set_toml("[picture]\nsize = [70, 30]\n[abuffer]\nsamples = 4\n");
    EXPECT_EQ(scene.render().size().width, 70);
    EXPECT_EQ(scene.render().size().height, 30);
    EXPECT_TRUE(exr_of(scene, {}) == exr_of(scene, {.width = 70, .height = 30, .samples = 4}));
    EXPECT_TRUE(exr_of(scene, {}) != exr_of(scene, {.samples = 8}));
}

TEST(LibraryView, HiddenLinesHaveALayerOfTheirOwn) {
    Scene scene = two_cubes();
    const auto has_hidden = [&] {
        const std::vector<std::string> names = scene.render({.width = 20, .height = 20}).channel_names();
        return std::find(names.begin(), names.end(), "lines_hidden.A") != names.end();
    };
    EXPECT_FALSE(has_hidden());
    scene.set("lines.hidden.style=solid");
    EXPECT_TRUE(has_hidden());
}

}  // namespace
}  // namespace burin::test::view_test
