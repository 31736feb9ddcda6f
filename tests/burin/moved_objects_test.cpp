// What a scene keeps from one picture to the next when objects move. Of the library this looks at burin_scene, too.

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "burin/scene_state.h"

namespace burin::test::moved_objects_test {
namespace {

struct Free {
    void operator()(burin_scene* scene) const { burin_scene_free(scene); }
    void operator()(burin_picture* picture) const { burin_picture_free(picture); }
    void operator()(burin_drawing* drawing) const { burin_drawing_free(drawing); }
};
using ScenePointer = std::unique_ptr<burin_scene, Free>;

struct Place {
    double x, y, z;
};
void put(double (&to)[16], const Place& at) {
    const double matrix[16] = {1, 0, 0, at.x, 0, 1, 0, at.y, 0, 0, 1, at.z, 0, 0, 0, 1};
    std::copy_n(matrix, 16, to);
}

/// A tetrahedron.
int add_mesh(burin_scene& scene) {
    static const float points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const std::int32_t corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    burin_mesh mesh = {};
    mesh.size = sizeof mesh;
    mesh.points = points, mesh.point_count = 4;
    mesh.corners = corners, mesh.corner_count = 12;
    return burin_add_mesh(&scene, &mesh);
}
int add_object(burin_scene& scene, int mesh, const Place& at) {
    burin_object object = {};
    object.size = sizeof object;
    object.mesh = mesh;
    put(object.to_world, at);
    return burin_add_object(&scene, &object);
}
void move(burin_scene& scene, int object, const Place& to) {
    double matrix[16];
    put(matrix, to);
    ASSERT_EQ(burin_move_object(&scene, object, matrix), BURIN_DONE) << burin_error();
}

std::string encoded(const void* given, const char* format) {
    std::uint8_t* bytes = nullptr;
    std::uint64_t count = 0;
    EXPECT_EQ(burin_encode(given, format, nullptr, &bytes, &count), BURIN_DONE) << burin_error();
    const std::string file(reinterpret_cast<const char*>(bytes), count);
    burin_bytes_free(bytes);
    return file;
}
burin_view view_from_the_side() {
    burin_view view = {};
    view.size = sizeof view;
    view.width = 80, view.height = 60;
    const double matrix[16] = {0.8, 0, 0.6, 3.6, 0, 1, 0, 0.4, -0.6, 0, 0.8, 4.8, 0, 0, 0, 1};
    std::copy_n(matrix, 16, view.camera_to_world);
    return view;
}
std::string picture_of(burin_scene& scene) {
    const burin_view view = view_from_the_side();
    const std::unique_ptr<burin_picture, Free> picture(burin_render(&scene, &view, nullptr));
    EXPECT_NE(picture, nullptr) << burin_error();
    return picture ? encoded(picture.get(), "exr") : "";
}
/// All lines that any style sheet may ask for.
std::string all_lines_of(burin_scene& scene) {
    const burin_view view = view_from_the_side();
    burin_options options = {};
    options.size = sizeof options;
    options.find_all = 1;
    const std::unique_ptr<burin_drawing, Free> drawing(burin_find_lines(&scene, &view, &options));
    EXPECT_NE(drawing, nullptr) << burin_error();
    return drawing ? encoded(drawing.get(), "svg") : "";
}

TEST(MovedObjects, MeshesAreMadeReadyOnce) {
    const auto make = [](int step) {
        ScenePointer scene(burin_scene_new());
        add_object(*scene, add_mesh(*scene), {0, 0.1 * step, 0});
        add_object(*scene, add_mesh(*scene), {0.5 + 0.1 * step, 0, 0});
        burin_set(scene.get(), "lines.hidden.style=solid");
        return scene;
    };
    const ScenePointer scene = make(0);
    const Preparation& kept = scene->preparation;
    picture_of(*scene);
    EXPECT_EQ(kept.meshes_made, 2u);
    const auto* const edges = kept.made.sharp_edges.data();
    for (int step = 1; step <= 4; ++step) {
        move(*scene, 1, {0, 0.1 * step, 0});
        move(*scene, 2, {0.5 + 0.1 * step, 0, 0});
        EXPECT_TRUE(picture_of(*scene) == picture_of(*make(step))) << step;
    }
    EXPECT_EQ(kept.meshes_made, 2u);
    EXPECT_EQ(kept.made.sharp_edges.data(), edges);
    burin_set(scene.get(), "lines.crease_angle=20");  // other edges are sharp
    picture_of(*scene);
    EXPECT_EQ(kept.meshes_made, 4u);
}

TEST(MovedObjects, CopiesThatPartAreMadeReady) {
    // Of two copies in one place the second one is empty for a picture.
    const ScenePointer scene(burin_scene_new());
    const int mesh = add_mesh(*scene), equal = add_mesh(*scene);
    add_object(*scene, mesh, {0, 0, 0});
    const int copy = add_object(*scene, mesh, {0, 0, 0}), other = add_object(*scene, equal, {0, 0, 0});
    for (int i = 0; i < 8; ++i) {
        const Place copy_at{i % 2 == 0 ? 0 : 0.75, 0, 0}, other_at{0, i / 2 % 2 == 0 ? 0 : 0.5, 0};
        move(*scene, copy, copy_at);
        move(*scene, other, other_at);
        const ScenePointer fresh(burin_scene_new());
        add_mesh(*fresh), add_mesh(*fresh);
        add_object(*fresh, mesh, {0, 0, 0});
        add_object(*fresh, mesh, copy_at);
        add_object(*fresh, equal, other_at);
        EXPECT_TRUE(picture_of(*scene) == picture_of(*fresh)) << i;
    }
}

TEST(MovedObjects, PairsThatPassThroughEachOtherAreThoseOfNow) {
    // Only looking for all lines makes these pairs; pictures in between must not leave old ones behind.
    const ScenePointer scene(burin_scene_new()), fresh(burin_scene_new());
    const Place before{0.9, 0.9, 0.9}, now{0.2, 0.1, 0.15};
    for (burin_scene* const s : {scene.get(), fresh.get()}) {
        burin_set(s, "lines.draw=silhouette,crease");
        const int mesh = add_mesh(*s);
        add_object(*s, mesh, {0, 0, 0});
        add_object(*s, mesh, s == fresh.get() ? now : before);
    }
    all_lines_of(*scene);
    move(*scene, 2, now);
    picture_of(*scene);
    EXPECT_TRUE(all_lines_of(*scene) == all_lines_of(*fresh));
}

}  // namespace
}  // namespace burin::test::moved_objects_test
