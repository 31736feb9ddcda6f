// Lines as data through the interface: what is found draws the rendered picture, and columns say what was found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "tests/burin/shapes.h"
#include "tests/support/random.h"

namespace burin::test::drawing_test {
namespace {

const View kView{.width = 160, .height = 120};
const Options kAllLayers{.layers = "beauty,lines,Z,N,ids,coverage,surface,lines_hidden"};

bool same_channels(const Picture& a, const Picture& b) {
    for (int i = 0;; ++i) {
        const char *const name = burin_channel_name(a.get(), i), *const other = burin_channel_name(b.get(), i);
        if (name == nullptr || other == nullptr) return name == other;
        std::int32_t type = 0, size[2] = {};
        const void* const values = burin_channel(a.get(), name, &type, size);
        const void* const others = burin_channel(b.get(), name, nullptr, nullptr);
        const std::size_t bytes = type == BURIN_HALF ? 2 : 4;
        const std::size_t count = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
        if (others == nullptr || std::memcmp(values, others, bytes * count) != 0) return false;
    }
}

/// Waves behind a glass cube, and a cube in them.
Scene three_objects() {
    Scene scene;
    const int glass = scene.add(Material{.name = "glass", .color = {0, 0.5f, 0}, .opacity = 0.25f});
    const int mesh = scene.add_mesh(cube().mesh());
    scene.add(waves(12).mesh("waves"));
    scene.add_object(mesh, "inside", {0.3, 0, 0, 0.3, 0, 0.3, 0, -0.1, 0, 0, 0.3, 0.3, 0, 0, 0, 1});
    scene.add_object(mesh, "glass", {0.4, 0, 0, 0.2, 0, 0.4, 0, 0, 0, 0, 0.4, 1.2, 0, 0, 0, 1}, glass);
    return scene;
}

TEST(LibraryDrawing, DrawsTheRenderedPictureWithoutItsScene) {
    for (const char* const settings :
         {"lines.width=1", "lines.hidden.style=solid", "lines.hidden.style=dashed", "lines.dash=[5, 3]",
          "lines.contours=smooth", "lines.side=outside", "lines.filter=mitchell", "lines.crease_angle=[10, 50]"}) {
        Scene scene = three_objects();
        scene.set(settings);
        const Picture rendered = scene.render(kView, kAllLayers);
        const Drawing drawing = scene.find_lines(kView, kAllLayers);
        scene.clear();
        scene = Scene();
        EXPECT_TRUE(same_channels(drawing.draw(), rendered)) << settings;
        EXPECT_TRUE(same_channels(drawing.draw(1), rendered)) << settings << ", again";
        EXPECT_TRUE(drawing.encode("png") == rendered.encode("png")) << settings;
    }
}

TEST(LibraryDrawing, ColumnsTellTheLinesOfACube) {
    Scene scene;
    const int mesh = scene.add_mesh(cube().mesh());
    scene.add_object(mesh, "beside", {0.1, 0, 0, -3, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 1});
    scene.add_object(mesh, "cube");
    scene.set("lines.hidden.style=solid");
    scene.set("lines.draw=all");
    const Drawing drawing = scene.find_lines(
        {.width = 300, .height = 200, .camera_to_world = {1, 0, 0, 0.4, 0, 1, 0, 0.6, 0, 0, 1, 4, 0, 0, 0, 1}});
    const std::size_t count = drawing.piece_count();
    const auto x0 = drawing.column<double>("x0"), y0 = drawing.column<double>("y0");
    const auto x1 = drawing.column<double>("x1"), y1 = drawing.column<double>("y1");
    const auto near0 = drawing.column<float>("nearness0"), near1 = drawing.column<float>("nearness1");
    const auto line = drawing.column<std::uint64_t>("line");
    const auto object = drawing.column<std::uint32_t>("object");
    const auto classes = drawing.column<std::uint16_t>("classes");
    const auto invisibility = drawing.column<std::uint8_t>("invisibility");
    ASSERT_EQ(drawing.column<std::uint32_t>("material").size(), count);
    std::map<int, std::set<std::uint64_t>> lines;  // of the large cube, by invisibility
    std::map<std::uint64_t, double> depth_at_end;
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_NE(classes[i], 0);
        EXPECT_FALSE(x0[i] == x1[i] && y0[i] == y1[i]);
        EXPECT_GE(object[i], 1u);
        EXPECT_LE(object[i], 2u);
        if (object[i] != 2) continue;
        EXPECT_GT(std::hypot(x1[i] - x0[i], y1[i] - y0[i]), 0);
        lines[invisibility[i]].insert(line[i]);
        // The cube lies from 3 to 4 in front of the eye.
        for (const float nearness : {near0[i], near1[i]}) {
            EXPECT_GE(1 / nearness, 2.999);
            EXPECT_LE(1 / nearness, 4.001);
        }
    }
    // From in front, a face is seen; of the sides none, as all lie behind it.
    EXPECT_EQ(lines[0].size(), 4u);
    EXPECT_EQ(lines[1].size(), 8u);
    EXPECT_EQ(lines.size(), 2u);
}

/// From anywhere, a cube has its twelve edges as lines, and each piece has a direction.
TEST(LibraryDrawing, PiecesHaveADirection) {
    Scene scene;
    scene.add(cube().mesh());
    scene.set("lines.hidden.style=solid");
    Random random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        const glm::dvec3 back = random.direction();
        const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.3, 1, 0.2), back)),
                         up = glm::cross(back, right);
        const glm::dvec3 eye = glm::dvec3(0.5) + 4.0 * back;
        const View view{.width = 160,
                        .height = 120,
                        .camera_to_world = {right.x, up.x, back.x, eye.x, right.y, up.y, back.y, eye.y, right.z, up.z,
                                            back.z, eye.z, 0, 0, 0, 1}};
        const Drawing drawing = scene.find_lines(view);
        const auto x0 = drawing.column<double>("x0"), y0 = drawing.column<double>("y0");
        const auto x1 = drawing.column<double>("x1"), y1 = drawing.column<double>("y1");
        const auto line = drawing.column<std::uint64_t>("line");
        for (std::size_t i = 0; i < x0.size(); ++i) {
            ASSERT_GE(std::hypot(x1[i] - x0[i], y1[i] - y0[i]), 1.0 / 1024) << trial << ' ' << x0[i] << ' ' << y0[i];
        }
        EXPECT_LE(std::set<std::uint64_t>(line.begin(), line.end()).size(), 12u) << trial;
    }
}

TEST(LibraryDrawing, RefusesWhatItHasNot) {
    Scene scene;
    scene.add(cube().mesh());
    const Drawing drawing = scene.find_lines(kView);
    EXPECT_THROW(drawing.column<float>("width"), Error);
    EXPECT_THROW(drawing.column<float>("x0"), Error);
    EXPECT_EQ(burin_draw(drawing.get(), "comic", nullptr), nullptr);
    EXPECT_EQ(burin_column(nullptr, "x0", nullptr, nullptr), nullptr);
    EXPECT_EQ(burin_error_kind(), BURIN_BAD_ARGUMENT);
    burin_options options = {};
    options.size = sizeof options;
    options.layers = "beauty";
    EXPECT_EQ(burin_draw(drawing.get(), nullptr, &options), nullptr);
    burin_drawing_free(nullptr);
    const Picture picture = drawing.draw();
    EXPECT_EQ(burin_column(reinterpret_cast<burin_drawing*>(picture.get()), "x0", nullptr, nullptr), nullptr);
}

TEST(LibraryMesh, PartsNeedNoNames) {
    Arrays arrays = cube();
    arrays.objects = {0, 0, 2, 2, 1, 1};
    Scene scene;
    scene.add(arrays.mesh());
    const Picture picture = scene.render(kView);
    std::uint32_t most = 0;
    for (const std::uint32_t id : picture.channel<std::uint32_t>("id.object")) most = std::max(most, id);
    EXPECT_GE(most, 2u);
}

TEST(LibraryDrawing, OfAnEmptySceneHasNoPieces) {
    Scene scene;
    const View view{.width = 160, .height = 120, .camera_to_world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 4, 0, 0, 0, 1}};
    const Drawing drawing = scene.find_lines(view);
    EXPECT_EQ(drawing.piece_count(), 0u);
    EXPECT_TRUE(drawing.column<double>("x0").empty());
    EXPECT_TRUE(same_channels(drawing.draw(), scene.render(view)));
}

}  // namespace
}  // namespace burin::test::drawing_test
