#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "tests/burin/shapes.h"
#include "tests/cli/program.h"

namespace burin::test::scene_test {
namespace {

const std::string kScenes = std::string(BURIN_SOURCE_FOLDER) + "/scenes/";
constexpr View kSmall{.width = 160, .height = 120};

std::string program_exr(const TemporaryFolder& folder, const std::string& input, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"render", input, "--size", "160x120", "-q", "-o", "program.exr"});
    const ProgramResult result = run_burin(folder.path(), more);
    EXPECT_EQ(result.status, 0) << result.err;
    return read_file(folder.file("program.exr"));
}

Matrix moved(double x, double y, double z) { return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}; }

TEST(LibraryScene, FilesGiveThePicturesOfTheProgram) {
    const TemporaryFolder folder;
    for (const char* const name : {"cube", "cage", "still_life", "strokes", "star", "crossing"}) {
        Scene scene = Scene::load(kScenes + name + ".toml");
        EXPECT_TRUE(exr_of(scene, kSmall) == program_exr(folder, kScenes + name + ".toml")) << name;
    }
    folder.write("waves.obj", obj_text(waves(20)));
    Scene model = Scene::load(folder.file("waves.obj"));
    EXPECT_TRUE(exr_of(model, kSmall) == program_exr(folder, "waves.obj"));
}

TEST(LibraryScene, APictureDoesNotChangeTheScene) {
    // Cracks are closed for one camera, copies emptied for one set of objects.
    Arrays arrays = waves(12);
    Arrays shifted = waves(12);
    for (std::size_t i = 0; i < shifted.points.size(); i += 3) shifted.points[i] += 1.0001f;  // a crack between the two
    const auto first = static_cast<std::int32_t>(arrays.points.size() / 3);
    arrays.points.insert(arrays.points.end(), shifted.points.begin(), shifted.points.end());
    for (const std::int32_t corner : shifted.corners) arrays.corners.push_back(first + corner);
    const auto make = [&] {
        Scene scene;
        const int mesh = scene.add_mesh(arrays.mesh());
        scene.add_object(mesh, "one");
        scene.add_object(mesh, "copy");
        scene.add_object(scene.add_mesh(arrays.mesh()), "another copy");
        return scene;
    };
    const View far{.width = 80, .height = 60, .camera_to_world = looking({40, 40, 60}, {1, 0, 0.5})};
    const View near{.width = 80, .height = 60, .camera_to_world = looking({1, 0.004, 0.504}, {1.00005, 0, 0.5})};
    Scene fresh_far = make(), fresh_near = make(), both = make();
    const std::string far_picture = exr_of(fresh_far, far), near_picture = exr_of(fresh_near, near);
    for (int i = 0; i < 2; ++i) {
        EXPECT_TRUE(exr_of(both, far) == far_picture);
        EXPECT_TRUE(exr_of(both, near) == near_picture);
    }
    // What fails on the way gives the meshes back, too.
    EXPECT_EQ(failure_of([&] { both.render({.width = 80, .height = 60, .camera = "none"}); }), BURIN_BAD_ARGUMENT);
    EXPECT_TRUE(exr_of(both, far) == far_picture);
}

TEST(LibraryScene, WhatIsKeptBetweenPicturesFollowsEveryChange) {
    // The first scene is drawn after each change, each of the others only once.
    const View from_front{.width = 80, .height = 60, .camera_to_world = looking({2, 3, 6}, {0.5, 0.5, 0.5})};
    const View from_right{.width = 80, .height = 60, .camera_to_world = looking({6, 2, 1}, {0.5, 0.5, 0.5})};
    int mesh = 0, first = 0, second = 0;
    const std::vector<std::function<void(Scene&)>> changes = {
        [&](Scene& s) { mesh = s.add_mesh(cube().mesh()), first = s.add_object(mesh); },
        [&](Scene& s) { s.set("lines.hidden.style=dashed"); },
        [&](Scene& s) { second = s.add_object(mesh, "second", moved(0.5, 0.25, 0.125)); },  // runs into the first
        [&](Scene& s) { s.add(waves(8).mesh()); },
        [&](Scene& s) { s.set("lines.draw=all"); },
        [&](Scene& s) { s.set_toml("[lines]\ncrease_angle = 100\ndraw = \"silhouette,crease,intersection\"\n"); },
        [&](Scene& s) { s.move(second, moved(0.2, 0.25, 0.3)); },
        [&](Scene& s) { s.add_text("[[object]]\nshape = \"sphere\"\nscale = 1.5\n"); },
        [&](Scene& s) { s.remove(first); },
        [&](Scene& s) { s.clear(), s.add_object(mesh, "third", moved(0, 0, 1)); },
    };
    Scene kept;
    for (std::size_t count = 1; count <= changes.size(); ++count) {
        changes[count - 1](kept);
        Scene once;
        for (std::size_t i = 0; i < count; ++i) changes[i](once);
        const std::string front = exr_of(once, from_front);
        Scene again;
        for (std::size_t i = 0; i < count; ++i) changes[i](again);
        if (count == 3) {
            EXPECT_TRUE(exr_of(kept, from_front, {.memory_bytes = std::uint64_t{1} << 30}) == front) << count;
        }
        EXPECT_TRUE(exr_of(kept, from_front) == front) << count;
        EXPECT_TRUE(exr_of(kept, from_right) == exr_of(again, from_right)) << count;
    }
}

TEST(LibraryScene, TextIsReadAsAFileInItsFolder) {
    const TemporaryFolder folder;
    folder.write("cube.obj", obj_text(cube()));
    const std::string text = "[lines]\nwidth = 3\n[[object]]\nfile = \"cube.obj\"\nrotate = [10, 20, 30]\n";
    folder.write("scene.toml", text);
    Scene scene;
    scene.add_text(text, folder.path());
    EXPECT_TRUE(exr_of(scene, kSmall) == program_exr(folder, "scene.toml"));
    std::string message;
    EXPECT_EQ(failure_of([&] { scene.add_text("[lines]\nwidth = -1\n[[object]]\nshape = \"box\"\n"); }, &message),
              BURIN_BAD_INPUT);
    EXPECT_EQ(message.find("scene:2:9: "), 0u) << message;
    EXPECT_EQ(failure_of([&] { scene.add_text("[lines\n"); }, &message), BURIN_BAD_INPUT);
    EXPECT_EQ(message.find("scene:1:"), 0u) << message;
    EXPECT_EQ(failure_of([&] { scene.add_file(folder.file("none.obj")); }), BURIN_BAD_INPUT);
    EXPECT_EQ(failure_of([&] { scene.add_file(folder.file("model.fbx")); }), BURIN_BAD_INPUT);
    EXPECT_EQ(exr_of(scene, kSmall), program_exr(folder, "scene.toml"));  // nothing has changed
}

TEST(LibraryScene, SettingsAreThoseOfTheProgram) {
    const TemporaryFolder folder;
    const std::string file = kScenes + "still_life.toml";
    const std::vector<std::string> settings = {"lines.width=2.5", "lines.draw=silhouette,crease",
                                               "lines.hidden.style=dashed", "camera.eye=[4, 3, 5]",
                                               "surfaces.shading=lambert"};
    std::vector<std::string> arguments;
    Scene after = Scene::load(file);
    for (const std::string& setting : settings) {
        arguments.insert(arguments.end(), {"--set", setting});
        after.set(setting);
        EXPECT_TRUE(exr_of(after, kSmall) == program_exr(folder, file, arguments)) << setting;
    }
    Scene text = Scene::load(file);
    text.set_toml("[lines]\nwidth = 2.5\ndraw = [\"silhouette\", \"crease\"]\n[lines.hidden]\nstyle = \"dashed\"\n");
    text.set_toml("[surfaces]\nshading = \"lambert\"\n");
    text.set("camera.eye=[4, 3, 5]");
    EXPECT_TRUE(exr_of(text, kSmall) == exr_of(after, kSmall));
}

/// What fails speaks of the library: of its functions and fields, not of the program's options.
TEST(LibraryScene, ErrorsNameNoOptionsOfTheProgram) {
    Scene scene;
    std::string text;
    const auto expect = [&](int kind, const std::string& words, const auto& call) {
        EXPECT_EQ(failure_of(call, &text), kind);
        EXPECT_EQ(text.find(words), 0u) << text;
        EXPECT_EQ(text.find("--"), std::string::npos) << text;
    };
    expect(BURIN_BAD_ARGUMENT, "burin_set() lines.width=-1: [lines] width: ", [&] { scene.set("lines.width=-1"); });
    expect(BURIN_BAD_ARGUMENT, "burin_set() camera.0.fov=60: there is no list 'camera'",
           [&] { scene.set("camera.0.fov=60"); });
    expect(BURIN_BAD_INPUT, "scene:1:1: object 'sphere' of",
           [&] { scene.add_text("[[object]]\nshape = \"sphere\"\nsegments = 4096\nrings = 4096\n"); });
    scene.add(cube().mesh());
    expect(BURIN_BAD_INPUT, "options.memory_bytes: this picture takes at least ",
           [&] { scene.render({.width = 40, .height = 30}, {.threads = 2, .memory_bytes = 1}); });
    expect(BURIN_BAD_INPUT, "an image of 65535x65535 pixels needs ",
           [&] { scene.render({.width = 65535, .height = 65535}); });
}

TEST(LibraryScene, WhatAFileDoesNotSayStaysAsItWasSet) {
    const std::string box = "[[object]]\nshape = \"box\"\n";
    Scene before, after, file;
    before.set("lines.width=4");
    before.add_text(box);
    after.add_text(box);
    after.set("lines.width=4");
    file.add_text("[lines]\nwidth = 4\n" + box);
    EXPECT_TRUE(exr_of(before) == exr_of(file));
    EXPECT_TRUE(exr_of(after) == exr_of(file));
    // What it says goes before what was set.
    Scene both;
    both.set("lines.width=9");
    both.add_text("[lines]\nwidth = 4\n" + box);
    EXPECT_TRUE(exr_of(both) == exr_of(file));
}

TEST(LibraryScene, WrongSettingsChangeNothing) {
    Scene scene;
    scene.add_text("[[object]]\nshape = \"box\"\n");
    const std::string picture = exr_of(scene);
    std::string text;
    for (const char* const wrong :
         {"lines.width", "lines.width=wide", "lines.wdth=2", "", "=", "lines.width=0", "lines=3", "lines.width=nan"}) {
        EXPECT_EQ(failure_of([&] { scene.set(wrong); }), BURIN_BAD_ARGUMENT) << wrong;
    }
    EXPECT_EQ(failure_of([&] { scene.set("object.0.subdivide=2"); }, &text), BURIN_BAD_ARGUMENT);
    EXPECT_EQ(text, "object.0.subdivide: an object is no setting of the scene; write it in the scene that is loaded");
    for (const char* const wrong : {"[lines]\nwidth = -1\n", "[lines", "x = 1\n", "[[object]]\nshape = \"box\"\n",
                                    "[[material]]\nname = \"a\"\n"}) {
        EXPECT_EQ(failure_of([&] { scene.set_toml(wrong); }), BURIN_BAD_INPUT) << wrong;
    }
    EXPECT_TRUE(exr_of(scene) == picture);
}

TEST(LibraryScene, ObjectsMoveAndGo) {
    Scene scene, expected;
    const int mesh = scene.add_mesh(cube().mesh("cube"));
    const int a = scene.add_object(mesh, "a"), b = scene.add_object(mesh, "b", moved(2, 0, 0)),
              c = scene.add_object(mesh);
    EXPECT_EQ((std::set{a, b, c}.size()), 3u);
    EXPECT_EQ(scene.object_name(c), "cube");
    scene.move(c, moved(0, 2, 0));
    scene.move(a, moved(0, 0, 1));
    scene.remove(b);
    EXPECT_EQ(scene.object_of_id(2), c);
    const int same = expected.add_mesh(cube().mesh());
    expected.add_object(same, "a", moved(0, 0, 1));
    expected.add_object(same, "c", moved(0, 2, 0));
    EXPECT_TRUE(exr_of(scene) == exr_of(expected));
    EXPECT_EQ(failure_of([&] { scene.move(b, moved(0, 0, 0)); }), BURIN_BAD_ARGUMENT);
    scene.remove_mesh(mesh);  // objects go on showing it
    EXPECT_TRUE(exr_of(scene) == exr_of(expected));
    EXPECT_EQ(failure_of([&] { scene.add_object(mesh); }), BURIN_BAD_ARGUMENT);
    scene.clear();
    EXPECT_EQ(failure_of([&] { scene.object_of_id(1); }), BURIN_BAD_ARGUMENT);
    const int again = scene.add_object(scene.add_mesh(cube().mesh()));
    EXPECT_GT(again, c);  // numbers are not used twice
}

TEST(LibraryScene, LoadedObjectsMoveLikeOthers) {
    Scene loaded, whole;
    const int first =
        loaded.add_text("[[object]]\nshape = \"box\"\nname = \"a\"\n[[object]]\nshape = \"sphere\"\nname = \"b\"\n");
    EXPECT_EQ(loaded.object_name(first), "a");
    EXPECT_EQ(loaded.object_name(first + 1), "b");
    loaded.move(first + 1, moved(0.5, 0.25, 0));
    whole.add_text("[[object]]\nshape = \"box\"\n[[object]]\nshape = \"sphere\"\ntranslate = [0.5, 0.25, 0]\n");
    EXPECT_TRUE(exr_of(loaded) == exr_of(whole));
}

TEST(LibraryScene, FilesStandBesideEachOther) {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    folder.write("a.obj",
                 "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 2 4 3\n");
    folder.write("b.obj",
                 "mtllib m.mtl\nv 0 0 1\nv 1 0 1\nv 0 2 1\nv 1 1 1\nusemtl blue\nf 1 2 3\nusemtl red\nf 2 4 3\n");
    folder.write("scene.toml",
                 "[surfaces]\nshading = \"lambert\"\n[[object]]\nfile = \"a.obj\"\n[[object]]\nfile = \"b.obj\"\n");
    Scene scene;
    scene.add_file(folder.file("a.obj"));
    scene.add_file(folder.file("b.obj"));
    scene.set("surfaces.shading=lambert");
    EXPECT_TRUE(exr_of(scene, kSmall) == program_exr(folder, "scene.toml"));
}

TEST(LibraryScene, WhatReadersLeaveOutIsNoted) {
    const TemporaryFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib none.mtl\nf 1 2 3\n");
    Scene scene;
    EXPECT_TRUE(scene.notes().empty());
    scene.add_file(folder.file("a.obj"));
    ASSERT_EQ(scene.notes().size(), 1u);
    EXPECT_NE(scene.notes()[0].find("none.mtl"), std::string::npos);
    EXPECT_EQ(burin_note(scene.get(), -1), nullptr);
}

TEST(LibraryScene, WhatMovesIsShownAtRestAndSaysSo) {
    const std::string box = "[[object]]\nshape = \"box\"\n", keys =
                                                                 "[[object.key]]\nframe = 1\ntranslate = [0, 0, 0]\n"
                                                                 "[[object.key]]\nframe = 5\ntranslate = [3, 0, 0]\n";
    Scene still, moving;
    still.add_text(box);
    moving.add_text(box + keys);
    EXPECT_TRUE(still.notes().empty());
    ASSERT_EQ(moving.notes().size(), 1u);
    EXPECT_NE(moving.notes()[0].find("at rest"), std::string::npos);
    const View view{.width = 40, .height = 30, .camera_to_world = looking({3, 4, 6}, {0, 0, 0})};
    View later = view;
    later.frame = 5;
    EXPECT_TRUE(exr_of(still, view) == exr_of(moving, view));
    EXPECT_NO_THROW(still.render(later));  // is for style sheets
    std::string text;
    EXPECT_EQ(failure_of([&] { moving.render(later); }, &text), BURIN_BAD_ARGUMENT);
    EXPECT_NE(text.find("burin render -f 5"), std::string::npos) << text;
    EXPECT_EQ(failure_of([&] { moving.find_lines(later); }), BURIN_BAD_ARGUMENT);
    moving.clear();
    EXPECT_NO_THROW(moving.render(later));
}

TEST(LibraryScene, WithoutObjectsThereIsPaper) {
    Scene scene;
    EXPECT_EQ(failure_of([&] { scene.render(kSmall); }), BURIN_BAD_ARGUMENT);  // no camera can be fitted to nothing
    const Picture picture = scene.render({.width = 16, .height = 8, .camera_to_world = looking({1, 2, 3}, {0, 0, 0})});
    for (const std::uint16_t alpha : picture.channel<std::uint16_t>("A")) EXPECT_EQ(alpha, 0);
}

}  // namespace
}  // namespace burin::test::scene_test
