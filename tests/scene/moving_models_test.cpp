#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "base/error.h"
#include "scene/animation/frame_pattern.h"
#include "scene/scene_description.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin::moving_models_test {
namespace {

using test::ByteWriter;
using test::GltfAccessors;
using test::GltfParts;

/// A triangle that the animation "Slide" moves along X, by 8 in one second, with a morph target; "Rise" moves it along
/// Y.
std::string sliding_gltf() {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    a.add_vectors({0, 0, 3, 0, 0, 3, 0, 0, 3});
    const auto floats = [](std::initializer_list<float> n) { return ByteWriter().add<float>(n).bytes(); };
    a.add(floats({0, 1}), "SCALAR", 5126, 2);
    a.add(floats({0, 0, 0, 8, 0, 0}), "VEC3", 5126, 2);
    a.add(floats({0, 0, 0, 0, 8, 0}), "VEC3", 5126, 2);
    a.add(floats({0, 1}), "SCALAR", 5126, 2);
    GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]})");
    parts.nodes = R"([{"mesh": 0, "children": [1]}, {"camera": 0, "translation": [0, 0, 9]}])";
    parts.cameras = R"([{"type": "perspective", "perspective": {"yfov": 1}}])";
    const std::string slide = R"({"name": "Slide", "samplers": [{"input": 2, "output": 3}, {"input": 2, "output": 5}],)"
                              R"( "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}},)"
                              R"( {"sampler": 1, "target": {"node": 0, "path": "weights"}}]})";
    const std::string rise = R"({"name": "Rise", "samplers": [{"input": 2, "output": 4}],)"
                             R"( "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]})";
    parts.animations = "[" + slide + ", " + rise + "]";
    return parts.json();
}

/// A square at a height, and a second object.
std::string square(double height, const std::string& second = "", const std::string& name = "square") {
    const std::string z = " " + std::to_string(height) + "\n";
    return "o " + name + "\nv 0 0" + z + "v 1 0" + z + "v 1 1" + z + "v 0 1" + z + "f 1 2 3 4\n" +
           (second.empty() ? "" : "o " + second + "\nf 2 3 4\n");
}

class MovingModels : public testing::Test {
  protected:
    MovingModels() { folder_.write("slide.gltf", sliding_gltf()); }

    AnimatedScene load(const std::string& text, std::optional<double> frame = 0, bool lists = false) {
        LoadOptions options;
        options.first_frame = frame;
        options.lists_animations = lists;
        return load_animated_scene(read_scene_file(folder_.write("scene.toml", text), {}), options);
    }
    /// What a scene says that is wrong.
    std::string error_of(const std::string& text, double frame = 0) {
        try {
            AnimatedScene loaded = load(text, frame);
            loaded.animation.at(frame);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    }
    test::TemporaryFolder folder_;
};

testing::AssertionResult has(const std::string& text, const std::string& part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

Scene scene_at(AnimatedScene& loaded, double frame) {
    Scene scene = loaded.scene;
    apply(loaded.animation.at(frame), scene);
    return scene;
}

glm::dvec3 vertex(const Scene& scene, std::size_t object, std::uint32_t number) {
    const SceneObject& o = scene.objects.at(object);
    return glm::dvec3(o.to_world * glm::dvec4(scene.meshes[o.mesh].position(number), 1));
}

// ---- animations of glTF files ----

TEST_F(MovingModels, TheFirstAnimationIsPlayedAtFramesPerSecond) {
    AnimatedScene loaded = load("[frames]\nfps = 12\n[[object]]\nfile = 'slide.gltf'\n");
    EXPECT_TRUE(loaded.animation.moves());
    EXPECT_EQ(vertex(loaded.scene, 0, 1), glm::dvec3(1, 0, 0));
    EXPECT_EQ(vertex(scene_at(loaded, 3), 0, 1), glm::dvec3(3, 0, 0.75));
    EXPECT_EQ(vertex(scene_at(loaded, 4.5), 0, 1), glm::dvec3(4, 0, 1.125));
    EXPECT_EQ(vertex(scene_at(loaded, 300), 0, 1), glm::dvec3(9, 0, 3));
    EXPECT_EQ(scene_at(loaded, 6).cameras.at(0).to_world.value()[3], glm::dvec4(4, 0, 9, 1));
}

TEST_F(MovingModels, AStillIsAtRestAndReadsNoKeys) {
    AnimatedScene loaded = load("[[object]]\nfile = 'slide.gltf'\n", std::nullopt);
    EXPECT_FALSE(loaded.animation.moves());
    EXPECT_EQ(vertex(loaded.scene, 0, 1), glm::dvec3(1, 0, 0));
}

TEST_F(MovingModels, AnimationsAreChosenByNameAndNumber) {
    for (const char* choice : {"'Rise'", "1"}) {
        AnimatedScene loaded =
            load("[frames]\nfps = 1\n[[object]]\nfile = 'slide.gltf'\nanimation = " + std::string(choice) + "\n");
        EXPECT_EQ(vertex(scene_at(loaded, 0.5), 0, 1), glm::dvec3(1, 4, 0)) << choice;
    }
    EXPECT_FALSE(load("[[object]]\nfile = 'slide.gltf'\nanimation = 'none'\n").animation.moves());
    EXPECT_TRUE(has(error_of("[[object]]\nfile = 'slide.gltf'\nanimation = 'Run'\n"),
                    R"(slide.gltf: no animation "Run"; it has "Slide", "Rise")"));
    EXPECT_TRUE(has(error_of("[[object]]\nfile = 'slide.gltf'\nanimation = -1\n"), "animation"));
    EXPECT_TRUE(has(error_of("[[object]]\nfile = 'a.obj'\nanimation = 'Run'\n"),
                    "scene.toml:3:13: [[object]] animation: only .gltf and .glb files have animations"));
    EXPECT_TRUE(has(error_of("[[object]]\nshape = 'box'\nmissing = 'hold'\n"), "is for model files"));
}

TEST_F(MovingModels, MotionsOfObjectInstanceAndNodeAreOneAfterTheOther) {
    AnimatedScene loaded = load(
        "[frames]\nfps = 1\n"
        "[[object]]\nfile = 'slide.gltf'\nanimation = 'Rise'\nscale = 2\n"
        "instance = [{}, {translate = [0, 0, 10]}]\n"
        "[[object.key]]\nframe = 0\ntranslate = [100, 0, 0]\n[[object.key]]\nframe = 1\ntranslate = [200, 0, 0]\n"
        "[[object]]\nfile = 'slide.gltf'\nanimation = 'Slide'\n");
    ASSERT_EQ(loaded.scene.objects.size(), 3u);
    const Scene scene = scene_at(loaded, 0.5);
    EXPECT_EQ(vertex(scene, 0, 1), glm::dvec3(152, 8, 0));
    EXPECT_EQ(vertex(scene, 1, 1), glm::dvec3(152, 8, 20));
    EXPECT_EQ(vertex(scene, 2, 1), glm::dvec3(5, 0, 1.5)) << "the file in another animation is another model";
}

TEST_F(MovingModels, FilesTellTheirAnimations) {
    AnimatedScene loaded = load("[[object]]\nfile = 'slide.gltf'\n", std::nullopt, true);
    ASSERT_EQ(loaded.animation.file_animations.size(), 1u);
    ASSERT_EQ(loaded.animation.file_animations[0].animations.size(), 2u);
    EXPECT_EQ(loaded.animation.file_animations[0].animations[0].name, "Slide");
    EXPECT_EQ(loaded.animation.file_animations[0].animations[0].channels, 2u);
    EXPECT_EQ(loaded.animation.file_animations[0].animations[0].seconds, 1);
    EXPECT_FALSE(loaded.animation.moves());
}

// ---- sequences ----

TEST_F(MovingModels, ASequenceHasAFilePerFrame) {
    for (int i = 1; i <= 3; ++i) folder_.write("walk.000" + std::to_string(i) + ".obj", square(i * i));
    for (const char* pattern : {"walk.####.obj", "walk.%04d.obj", "walk.$F4.obj", "walk.#.obj"}) {
        AnimatedScene loaded = load("[[object]]\nfile = '" + std::string(pattern) + "'\n", 1);
        EXPECT_EQ(vertex(loaded.scene, 0, 0).z, 1) << pattern;
        EXPECT_EQ(vertex(scene_at(loaded, 2), 0, 0).z, 4);
        EXPECT_EQ(vertex(scene_at(loaded, 3), 0, 0).z, 9);
        EXPECT_EQ(vertex(scene_at(loaded, 2.5), 0, 0).z, 6.5) << "vertices lie between";
        EXPECT_EQ(loaded.animation.models.at(0).motion->files_at(2.5).size(), 2u);
    }
    AnimatedScene later = load("[[object]]\nfile = 'walk.####.obj'\nframe_offset = -10\n", 11);
    EXPECT_EQ(vertex(scene_at(later, 12.25), 0, 0).z, 5.25);
    AnimatedScene of_range = load("[frames]\nrange = '2-3'\n[[object]]\nfile = 'walk.####.obj'\n", 3);
    EXPECT_EQ(vertex(of_range.scene, 0, 0).z, 4) << "the first file is the range's, whatever is drawn";
}

TEST_F(MovingModels, MissingFilesAreErrorsOrHeld) {
    folder_.write("walk.0006.obj", square(6));
    folder_.write("walk.0009.obj", square(9));
    const std::string scene = "[[object]]\nfile = 'walk.####.obj'\nname = 'walk'\n";
    EXPECT_TRUE(has(error_of(scene, 7), "walk.0007.obj: no such file (frame 7 of object \"walk\")"));
    AnimatedScene strict = load(scene, 6);
    EXPECT_NO_THROW(strict.animation.at(6));
    EXPECT_THROW(strict.animation.at(6.5), InputError);
    EXPECT_THROW(strict.animation.at(6.75), InputError) << "it is a moment of a frame that has no file";
    // A shutter that is open into a gap, as of a sequence on twos, sees the nearer file, which is said.
    EXPECT_EQ(vertex(scene_at(strict, 6.25), 0, 0).z, 6);
    EXPECT_EQ(vertex(scene_at(strict, 8.75), 0, 0).z, 9);
    const std::vector<std::string> notes = strict.animation.at(6.25).notes;
    EXPECT_TRUE(!notes.empty() && has(notes.front(), "walk.0007.obj: no such file; at moments beside it"));
    EXPECT_TRUE(strict.animation.at(5.75).notes.empty());
    EXPECT_EQ(vertex(scene_at(strict, 5.75), 0, 0).z, 6) << "a shutter that is open before the first file";
    EXPECT_EQ(vertex(scene_at(strict, 9.25), 0, 0).z, 9) << "or behind the last one";
    AnimatedScene held = load(scene + "missing = 'hold'\n", 7);
    EXPECT_EQ(vertex(scene_at(held, 6.5), 0, 0).z, 6);
    EXPECT_EQ(vertex(scene_at(held, 8.5), 0, 0).z, 7.5);
    EXPECT_EQ(vertex(scene_at(held, 99), 0, 0).z, 9);
    EXPECT_EQ(vertex(scene_at(held, -4), 0, 0).z, 6) << "before the first file that one is held";
    EXPECT_TRUE(has(error_of("[[object]]\nfile = 'run.####.obj'\nmissing = 'hold'\n", 7), "none of another frame"));
    folder_.write("walk.0007.obj", "v 0 0 0\nf 1 2 3\n");
    EXPECT_TRUE(has(error_of(scene, 7), "walk.0007.obj")) << "a broken file";
}

TEST_F(MovingModels, OtherPolygonsAreHeldUntilTheNextFile) {
    folder_.write("walk.0001.obj", square(1));
    folder_.write("walk.0002.obj", square(2, "extra"));
    AnimatedScene loaded = load("[[object]]\nfile = 'walk.####.obj'\n", 1);
    const SceneChange between = loaded.animation.at(1.5);
    ASSERT_EQ(between.notes.size(), 1u);
    EXPECT_TRUE(has(between.notes[0], "walk.0002.obj: other polygons than in the file before"));
    EXPECT_EQ(between.meshes.at(0).second.position(0).z, 1);
    const SceneChange second = loaded.animation.at(2);
    ASSERT_EQ(second.notes.size(), 1u);
    EXPECT_TRUE(has(second.notes[0], "walk.0002.obj: left out 1 object, which the first file of the frames has not"));
}

TEST_F(MovingModels, ObjectsOfASequenceAreFoundByName) {
    folder_.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    folder_.write(
        "walk.0001.obj",
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\no left\nusemtl red\nf 1 2 3\no right\nusemtl blue\n"
        "f 2 3 4\n");
    folder_.write(
        "walk.0002.obj",
        "mtllib a.mtl\nv 0 0 5\nv 1 0 5\nv 0 1 5\nv 1 1 5\no right\nusemtl blue\nf 2 3 4\no left\nusemtl red\n"
        "f 1 2 3\n");
    folder_.write("walk.0003.obj", "v 0 0 7\nv 1 0 7\nv 0 1 7\no right\nf 1 2 3\n");
    folder_.write("walk.0004.obj", "v 0 0 7\nv 1 0 7\nv 0 1 7\no walk_0004\nf 1 2 3\n");
    AnimatedScene loaded = load("[[object]]\nfile = 'walk.####.obj'\n", 1);
    ASSERT_EQ(loaded.scene.objects.size(), 2u);
    const auto color = [](const Scene& scene, std::size_t object) {
        const SceneObject& o = scene.objects[object];
        glm::vec3 found(0);
        const std::uint32_t wanted = scene.meshes[o.mesh].material_of(0);
        std::uint32_t number = 0;
        o.materials.for_each([&](std::uint32_t m) {
            if (number++ == wanted) found = scene.materials[m].color;
        });
        return found;
    };
    const Scene second = scene_at(loaded, 2);
    EXPECT_EQ(vertex(second, 0, 0), glm::dvec3(0, 0, 5));
    EXPECT_EQ(vertex(second, 1, 0), glm::dvec3(1, 0, 5));
    EXPECT_EQ(color(second, 0), color(loaded.scene, 0));
    EXPECT_EQ(color(second, 1), color(loaded.scene, 1));
    EXPECT_NE(color(second, 0), color(second, 1));
    folder_.write("b.mtl", "newmtl red\nnewmtl green\nnewmtl grey\n");
    folder_.write("walk.0005.obj",
                  "mtllib b.mtl\nv 0 0 7\nv 1 0 7\nv 0 1 7\nv 1 1 7\no left\nusemtl green\nf 1 2 3\nusemtl red\nf 2 3 "
                  "4\nusemtl grey\nf 1 2 4\n");
    const std::vector<std::string> notes = loaded.animation.at(5).notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_TRUE(has(notes[0], "walk.0005.obj: 1 material, which the first file of the frames has not"));
    const Scene third = scene_at(loaded, 3);
    EXPECT_TRUE(third.meshes[third.objects[0].mesh].triangles.empty()) << "there is no left one";
    EXPECT_EQ(vertex(third, 1, 0), glm::dvec3(0, 0, 7));
    const Scene fourth = scene_at(loaded, 4);
    EXPECT_EQ(vertex(fourth, 0, 0), glm::dvec3(0, 0, 7)) << "names differ: by order";
}

TEST_F(MovingModels, ASequenceNeedsFrames) {
    folder_.write("walk.0001.obj", square(1));
    EXPECT_THROW(load("[[object]]\nfile = 'walk.####.obj'\n", std::nullopt), UsageError);
    EXPECT_EQ(load("[[object]]\nfile = 'walk.####.obj'\n", std::nullopt, true).scene.objects.size(), 1u);
    folder_.write("part#.obj", square(3));
    EXPECT_EQ(load("[[object]]\nfile = 'part#.obj'\n", std::nullopt).scene.objects.size(), 1u) << "a letter";
    EXPECT_EQ(load("[[object]]\nfile = 'part#.obj'\n", 1).scene.objects.size(), 1u) << "there is such a file";
    EXPECT_TRUE(has(error_of("[[object]]\nfile = 'a.obj'\nframe_offset = 3\n"),
                    "scene.toml:3:16: [[object]] frame_offset: is for a file per frame"));
    EXPECT_TRUE(has(error_of("[[object]]\nfile = 'a.##.%02d.obj'\nmissing = 'hold'\n"), "one pattern"));
}

TEST_F(MovingModels, PatternsFindNumbersInNames) {
    const FramePattern pattern = *FramePattern::find("/some/walk.####.obj", FramePattern::SingleHash::letter);
    EXPECT_EQ(pattern.number_in("walk.0012.obj"), 12);
    EXPECT_EQ(pattern.number_in("walk.12345.obj"), 12345);
    EXPECT_EQ(pattern.number_in("walk.-0003.obj"), -3);
    for (const char* other : {"walk.12.obj", "walk.00012.obj", "walk..obj", "walk.obj", "walk.0012.ply",
                              "talk.0012.obj", "walk.00x2.obj", "walk.0012.obj~", ""}) {
        EXPECT_EQ(pattern.number_in(other), std::nullopt) << other;
    }
}

}  // namespace
}  // namespace burin::moving_models_test
