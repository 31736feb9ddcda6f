// The program plays what moves within models: animations of glTF files, and a file per frame.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::animated_models_test {
namespace {

const std::vector<std::string> kView{"-r", "64x48", "--eye", "1,2,6", "--target", "0.5,0.5,0"};

/// A fan of two triangles that a morph target bends in a second, and a joint turns by 90 degrees.
GltfParts bending() {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    a.add_indices({0, 1, 2, 0, 2, 3});
    a.add_vectors({0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 2});
    a.add(ByteWriter().add<float>({0, 1}).bytes(), "SCALAR", 5126, 2);
    a.add(ByteWriter().add<float>({0, 1}).bytes(), "SCALAR", 5126, 2);
    a.add(std::string(16, '\0'), "VEC4", 5121, 4);
    a.add(ByteWriter().add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}).bytes(), "VEC4", 5126, 4);
    a.add(ByteWriter().add<float>({0, 0, 0, 1, 0, 0, 1, 0}).bytes(), "VEC4", 5126, 2);
    GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0, "JOINTS_0": 5, "WEIGHTS_0": 6}, "indices": 1,)"
                                 R"( "targets": [{"POSITION": 2}]})");
    parts.scenes = R"([{"nodes": [0, 1]}])";
    parts.nodes = R"([{"mesh": 0, "skin": 0}, {}])";
    parts.skins = R"([{"joints": [1]}])";
    parts.animations =
        R"([{"name": "Bend", "samplers": [{"input": 3, "output": 4}, {"input": 3, "output": 7}], "channels": [)"
        R"({"sampler": 0, "target": {"node": 0, "path": "weights"}},)"
        R"( {"sampler": 1, "target": {"node": 1, "path": "rotation"}}]}])";
    return parts;
}

std::vector<std::string> rendering(const char* input, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", input};
    arguments.insert(arguments.end(), kView.begin(), kView.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(AnimatedModels, AFrameIsTheStillOfTheModelInThatPose) {
    const TemporaryFolder folder;
    folder.write("bend.gltf", bending().json());
    GltfParts posed = bending();
    posed.animations = "";
    posed.nodes =
        R"([{"mesh": 0, "skin": 0, "weights": [0.5]}, {"rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]}])";
    folder.write("posed.gltf", posed.json());
    posed.nodes = R"([{"mesh": 0, "skin": 0}, {}])";
    folder.write("rest.gltf", posed.json());
    const auto picture = [&](const char* input, std::vector<std::string> more) {
        more.insert(more.end(), {"-o", "out.png"});
        const ProgramResult result = run_burin(folder.path(), rendering(input, more));
        EXPECT_EQ(result.status, 0) << result.err;
        return read_file(folder.file("out.png"));
    };
    const std::string still = picture("bend.gltf", {});
    EXPECT_EQ(still, picture("rest.gltf", {})) << "a still is at rest";
    const std::string half = picture("posed.gltf", {});
    EXPECT_NE(half, still);
    EXPECT_EQ(picture("bend.gltf", {"--frame", "12"}), half);
    EXPECT_EQ(picture("bend.gltf", {"--frame", "6", "--fps", "12"}), half);
    EXPECT_EQ(picture("bend.gltf", {"--frame", "12", "--set", "object.0.animation=none"}), still);
    EXPECT_EQ(picture("bend.gltf", {"--frame", "0", "-j", "2"}), still);
}

TEST(AnimatedModels, AllFramesOfARunAreThere) {
    const TemporaryFolder folder;
    folder.write("bend.gltf", bending().json());
    const ProgramResult result = run_burin(folder.path(), rendering("bend.gltf", {"-f", "0-4x2", "-o", "out.##.png"}));
    EXPECT_EQ(result.status, 0) << result.err;
    const std::string first = read_file(folder.file("out.00.png"));
    EXPECT_NE(read_file(folder.file("out.02.png")), first);
    EXPECT_NE(read_file(folder.file("out.04.png")), read_file(folder.file("out.02.png")));
}

TEST(AnimatedModels, InfoListsAnimations) {
    const TemporaryFolder folder;
    folder.write("bend.gltf", bending().json());
    const ProgramResult text = run_burin(folder.path(), {"info", "bend.gltf"});
    EXPECT_NE(text.out.find("animation 0  \"Bend\": 1 s, 2 channels, of bend.gltf"), std::string::npos) << text.out;
    const ProgramResult json = run_burin(folder.path(), {"info", "bend.gltf", "--json"});
    const nlohmann::json animation = nlohmann::json::parse(json.out).at("animations").at(0);
    EXPECT_EQ(animation.at("name"), "Bend");
    EXPECT_EQ(animation.at("seconds"), 1);
    EXPECT_EQ(animation.at("channels"), 2);
    GltfParts broken = bending();
    broken.animations.replace(broken.animations.find("\"input\": 3"), 10, "\"input\": 9");
    folder.write("broken.gltf", broken.json());
    const ProgramResult listed = run_burin(folder.path(), {"info", "broken.gltf"});
    EXPECT_EQ(listed.status, 0);
    EXPECT_NE(listed.out.find("note       broken.gltf: animations[0].samplers[0].input: accessor 9 does not exist"),
              std::string::npos)
        << listed.out;
}

TEST(AnimatedModels, WhatIsWrongIsOneLineAndWritesNothing) {
    const TemporaryFolder folder;
    GltfParts parts = bending();
    parts.animations.replace(parts.animations.find("\"output\": 7"), 11, "\"output\": 2");
    folder.write("broken.gltf", parts.json());
    folder.write("bend.gltf", bending().json());
    folder.write("walk.0006.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("walk.toml", "[[object]]\nfile = 'walk.####.obj'\nname = 'walk'\n");
    const auto fails = [&](std::vector<std::string> arguments, int status, const std::string& part) {
        const std::vector<std::string> before = folder.names();
        const ProgramResult result = run_burin(folder.path(), arguments);
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(folder.names(), before);
    };
    fails(rendering("broken.gltf", {"-f", "1-2", "-o", "out.#.png"}), 1,
          "broken.gltf: accessors[2]: the type must be VEC4");
    fails(rendering("bend.gltf", {"--frame", "1", "--set", "object.0.animation=Run", "-o", "out.png"}), 1,
          "bend.gltf: no animation \"Run\"; it has \"Bend\"");
    fails(rendering("walk.toml", {"-o", "out.png"}), 2, "walk.####.obj: is a model per frame; say which with --frames");
    fails(rendering("walk.toml", {"-f", "7", "-o", "out.png"}), 1,
          "walk.0007.obj: no such file (frame 7 of object \"walk\")");
    const ProgramResult stopped =
        run_burin(folder.path(), rendering("walk.toml", {"-f", "6-7", "-q", "-o", "out.##.png"}));
    EXPECT_EQ(stopped.status, 1);
    EXPECT_NE(stopped.err.find("frame 7: "), std::string::npos) << stopped.err;
    EXPECT_NE(stopped.err.find("walk.0007.obj: no such file (frame 7 of object \"walk\")"), std::string::npos)
        << stopped.err;
}

}  // namespace
}  // namespace burin::test::animated_models_test
