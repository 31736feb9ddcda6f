// Objects that are exact copies of others in the same place.

#include "render/copied_objects.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"

namespace burin {
namespace {

using namespace test;

constexpr int kSize = 96;

Drawing draw(const Scene& scene, bool hidden = false) {
    Scene styled = scene;
    if (hidden) styled.lines.style.hidden.style = HiddenStyle::solid;
    return Drawing(styled, perspective_camera({3, 2, 5}, {0, 0, 0}), kSize, kSize, {0, 0, kSize, kSize}, 2,
                   render_abuffer);
}

/// A box and a plate that cuts it, and `count` copies of both.
Scene with_copies(int count) {
    const PolygonSoup box = make_box({1, 1, 1}),
                      plate = soup_of({{-1, 0.1, -1}, {1, 0.2, -1}, {1, 0.3, 1}, {-1, 0.2, 1}}, {{0, 1, 2, 3}});
    std::vector<PolygonSoup> objects;
    for (int i = 0; i <= count; ++i) {
        objects.push_back(box);
        objects.push_back(plate);
    }
    Scene scene = scene_of(std::move(objects));
    for (SceneObject& object : scene.objects) object.materials = scene.objects[0].materials;
    return scene;
}

TEST(CopiedObjects, AreNotDrawnAgain) {
    const Scene one = with_copies(0);
    Scene many = with_copies(50);
    EXPECT_EQ(empty_copied_objects(many), 100u);
    EXPECT_EQ(many.objects.size(), 102u);
    std::size_t triangles = 0;
    for (const SceneObject& object : many.objects) triangles += many.meshes[object.mesh].triangles.size();
    EXPECT_EQ(triangles, one.meshes[0].triangles.size() + one.meshes[1].triangles.size());
    for (const bool hidden : {false, true})
        EXPECT_TRUE(same_bits(draw(many, hidden).image(), draw(one, hidden).image())) << hidden;
}

TEST(CopiedObjects, KeepTheNumbersOfPolygonsAfterThem) {
    Scene scene = with_copies(1);
    scene.meshes.push_back(with_copies(0).meshes[0]);
    SceneObject moved = scene.objects[0];
    moved.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    moved.to_world[3].x = 1.5;
    scene.objects.push_back(moved);
    const Drawing all = draw(scene);
    EXPECT_EQ(empty_copied_objects(scene), 2u);
    EXPECT_TRUE(same_bits(draw(scene).image(), all.image()));
}

TEST(CopiedObjects, InstancesOfOneMeshAreFoundByPlace) {
    Scene scene = with_copies(0);
    SceneObject moved = scene.objects[0], again = scene.objects[0];
    moved.to_world[3].x = 0.5;
    scene.objects.push_back(moved);
    scene.objects.push_back(again);
    scene.objects.push_back(moved);
    EXPECT_EQ(empty_copied_objects(scene), 2u);
    EXPECT_FALSE(scene.meshes[scene.objects[0].mesh].triangles.empty());
    EXPECT_FALSE(scene.meshes[scene.objects[2].mesh].triangles.empty());
    EXPECT_TRUE(scene.meshes[scene.objects[3].mesh].triangles.empty());
    EXPECT_TRUE(scene.meshes[scene.objects[4].mesh].triangles.empty());
}

TEST(CopiedObjects, OthersAreKept) {
    const auto left = [](auto change) {
        Scene scene = with_copies(1);
        change(scene);
        return empty_copied_objects(scene);
    };
    EXPECT_EQ(left([](Scene&) {}), 2u);
    EXPECT_EQ(left([](Scene& s) { s.meshes[2].positions[0].x += 1e-3f; }), 1u) << "another shape";
    EXPECT_EQ(left([](Scene& s) { s.meshes[2].marked.assign(3 * s.meshes[2].triangles.size(), true); }), 1u)
        << "other marks";
    EXPECT_EQ(left([](Scene& s) { s.objects[2].to_world[3].y = 1e-9; }), 1u) << "another place";
    EXPECT_EQ(left([](Scene& s) {
                  s.materials.push_back(s.materials[0]);
                  s.objects[2].materials = MaterialList{static_cast<std::uint32_t>(s.materials.size() - 1)};
              }),
              1u)
        << "another material";
    EXPECT_EQ(left([](Scene& s) {
                  for (Material& m : s.materials) m.opacity = 0.5;
              }),
              0u)
        << "each is seen through the others";
    EXPECT_EQ(left([](Scene& s) { s.zbuffer.highlight_objects = {"a"}; }), 0u);
}

}  // namespace
}  // namespace burin
