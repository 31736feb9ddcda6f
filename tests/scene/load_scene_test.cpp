#include <gtest/gtest.h>

#include <filesystem>

#include "scene/color.h"
#include "tests/scene/scene_text.h"

namespace burin {
namespace {

using test::expect_near;
using test::SceneText;
using test::TemporaryFolder;

constexpr const char* kTwoParts = R"(mtllib parts.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
o first
usemtl red
f 1 2 3
o second
usemtl blue
f 1 2 4
)";

/// Two nodes that show one mesh, and two cameras.
constexpr const char* kGltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2,3]}],
"nodes":[{"name":"left","mesh":0},{"name":"right","mesh":0,"translation":[5,0,0]},
{"name":"eye","camera":0,"translation":[1,2,3],"scale":[4,4,4]},{"camera":1}],
"cameras":[{"name":"main","type":"perspective","perspective":{"yfov":0.5,"znear":0.1}},
{"name":"plan","type":"orthographic","orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":9}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"tri.bin"}]})";

std::string triangle_bytes() {
    const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    return {reinterpret_cast<const char*>(values), sizeof values};
}

TEST(LoadScene, FilesAreRelativeToTheScene) {
    const SceneText text("[[object]]\nfile='models/tri.obj'\n[[object]]\nfile='./models/../models/tri.obj'\n");
    text.folder().write("models/tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(text.load().objects.size(), 2u);
    const SceneText absolute("[[object]]\nfile='" + text.folder().file("models/tri.obj") + "'\n");
    EXPECT_EQ(absolute.load().objects.size(), 1u);
    EXPECT_THROW(SceneText("[[object]]\nfile='models/tri.obj'\n").load(), InputError);
}

TEST(LoadScene, AFileIsLoadedOncePerSubdivision) {
    const SceneText text(R"(
[[material]]
name = 'clay'
[[object]]
file = 'two.obj'
[[object]]
file = 'two.obj'
name = 'other'
material = 'clay'
translate = [3, 0, 0]
[[object]]
file = 'two.obj'
subdivide = 1
[[object]]
file = 'two.obj'
subdivide = 1
scheme = 'catmull-clark'
)");
    text.folder().write("two.obj", kTwoParts);
    const Scene scene = text.load();
    EXPECT_EQ(scene.objects.size(), 8u);
    EXPECT_EQ(scene.meshes.size(), 6u);
    EXPECT_EQ(scene.objects[0].mesh, scene.objects[2].mesh);
    EXPECT_EQ(scene.objects[1].mesh, scene.objects[3].mesh);
    EXPECT_EQ(scene.meshes[scene.objects[4].mesh].polygon_count, 4u);
    EXPECT_EQ(scene.meshes[scene.objects[6].mesh].polygon_count, 3u);
    EXPECT_EQ(glm::dvec3(scene.objects[2].to_world[3]), glm::dvec3(3, 0, 0));
    EXPECT_NE(scene.objects[0].materials, scene.objects[2].materials);
}

TEST(LoadScene, NamesOfObjects) {
    const auto name = [](const std::string& keys) {
        const SceneText text("[[object]]\nfile='two.obj'\n" + keys);
        text.folder().write("two.obj", kTwoParts);
        return text.load().objects.back().name;
    };
    EXPECT_EQ(name(""), "second");
    EXPECT_EQ(name("name='pair'"), "pair/second");
    EXPECT_EQ(name("name='pair'\n[[object.instance]]\n[[object.instance]]\n"), "pair/second#2");
}

TEST(LoadScene, AMaterialReplacesAllOfTheFile) {
    const SceneText text(
        "[[material]]\nname='clay'\n[[object]]\nfile='two.obj'\n[[object]]\nfile='two.obj'"
        "\nmaterial='clay'\n");
    text.folder().write("two.obj", kTwoParts);
    text.folder().write("parts.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nd 0.5\n");
    const Scene scene = text.load();
    const auto material = [&](std::size_t object) {
        const SceneObject& o = scene.objects[object];
        return scene.materials[o.materials[scene.meshes[o.mesh].material_of(0)]];
    };
    EXPECT_EQ(material(0).name, "red");
    EXPECT_EQ(material(1).name, "blue");
    EXPECT_EQ(material(1).opacity, 0.5f);
    EXPECT_EQ(material(2).name, "clay");
    EXPECT_EQ(material(3).name, "clay");
}

TEST(LoadScene, GltfObjectsAndCameras) {
    const SceneText text("[[object]]\nfile='tri.gltf'\ntranslate=[0,0,100]\n");
    text.folder().write("tri.gltf", kGltf);
    text.folder().write("tri.bin", triangle_bytes());
    const Scene scene = text.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "left");
    EXPECT_EQ(glm::dvec3(scene.objects[1].to_world[3]), glm::dvec3(5, 0, 100));
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_FALSE(scene.camera_is_default);
    EXPECT_EQ(scene.cameras[0].name, "main");
    EXPECT_NEAR(scene.cameras[0].fov_deg, 28.6478897565, 1e-9);
    expect_near(glm::dvec3((*scene.cameras[0].to_world)[3]), {1, 2, 103});  // goes with its object
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].height, 4);
}

TEST(LoadScene, CamerasOfTheSceneComeBeforeThoseOfFiles) {
    const SceneText text("[[object]]\nfile='tri.gltf'\n[[camera]]\nname='mine'\n");
    text.folder().write("tri.gltf", kGltf);
    text.folder().write("tri.bin", triangle_bytes());
    EXPECT_EQ(text.load().cameras.front().name, "mine");
}

TEST(LoadScene, WithoutAnyCameraThereIsADefaultOne) {
    const Scene scene = test::loaded(test::kBox);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(scene.camera_is_default);
    EXPECT_FALSE(scene.cameras[0].eye);
}

TEST(LoadScene, BareModels) {
    const TemporaryFolder folder;
    folder.write("a b/two.obj", kTwoParts);
    const SceneDescription scene = bare_model_scene(folder.file("a b/two.obj"), {});
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].file, folder.file("a b/two.obj"));
    EXPECT_EQ(load_scene(scene).objects.size(), 2u);

    // Messages name a file as it was typed.
    const auto old = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    std::string message;
    try {
        load_scene(bare_model_scene("a b/missing.obj", {}));
    } catch (const InputError& error) {
        message = error.what();
    }
    EXPECT_EQ(load_scene(bare_model_scene("a b/two.obj", {})).objects.size(), 2u);
    std::filesystem::current_path("a b");
    EXPECT_EQ(load_scene(bare_model_scene("two.obj", {})).objects.size(), 2u);
    std::filesystem::current_path(old);
    EXPECT_EQ(message.find("a b/missing.obj: "), 0u) << message;
}

// They come some at a time.
TEST(LoadScene, ScenePointsAreAllVertices) {
    const Scene scene = test::loaded("[[object]]\nshape='sphere'\n[[object.instance]]\ntranslate=[3,0,0]\n");
    const Mesh& mesh = scene.meshes[0];
    ASSERT_GT(mesh.positions.size(), 600u);
    std::vector<glm::dvec3> expected, points;
    for (const SceneObject& object : scene.objects) {
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            expected.emplace_back(object.to_world * glm::dvec4(mesh.position(v), 1.0));
        }
    }
    for_each_point(scene_points(scene), [&](const glm::dvec3& p) { points.push_back(p); });
    EXPECT_EQ(points, expected);
}

TEST(LoadScene, ScenePointsAreInWorldSpace) {
    const Scene scene = test::loaded(
        "[[object]]\nshape='box'\nscale=2\ntranslate=[10,0,0]\n[[object.instance]]\ntranslate=[1,0,"
        "0]\n");
    int count = 0;
    for_each_point(scene_points(scene), [&](const glm::dvec3& p) {
        ++count;
        EXPECT_NEAR(std::abs(p.x - 12), 1, 1e-9);
        EXPECT_NEAR(std::abs(p.y), 1, 1e-9);
    });
    EXPECT_EQ(count, 8);
}

TEST(Color, HexTexts) {
    EXPECT_EQ(color_from_hex("#ffffff"), glm::vec3(1.0f));
    EXPECT_EQ(color_from_hex("#000"), glm::vec3(0.0f));
    EXPECT_EQ(color_from_hex("#f00"), color_from_hex("#FF0000"));
    EXPECT_NEAR(static_cast<double>(color_from_hex("#bc0000")->r), 0.502886, 1e-5);
    EXPECT_EQ(color_from_hex("#123"), color_from_hex("#112233"));
    for (const char* text : {"", "#", "fff", "ffffff", "#ff", "#ffff", "#fffff", "#fffffff", "#ggg", "#-1-1-1",
                             "#+1+1+1", "# 1 2 3", "#0x1122", "#12345g"}) {
        EXPECT_FALSE(color_from_hex(text)) << text;
    }
}

}  // namespace
}  // namespace burin
