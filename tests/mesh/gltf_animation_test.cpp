#include "mesh/gltf_animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "mesh/gltf.h"
#include "mesh/model.h"
#include "mesh/model_player.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin::gltf_animation_test {
namespace {

using test::ByteWriter;
using test::gltf_of;
using test::GltfAccessors;
using test::GltfParts;

constexpr float kRoot = 0.70710678f;  // of 1/2

AnimationWish playing(AnimationChoice choice = {}) { return {true, false, std::move(choice)}; }
AnimationChoice named(const char* name) { return {AnimationChoice::By::name, 0, name}; }
AnimationChoice numbered(std::uint32_t number) { return {AnimationChoice::By::number, number, {}}; }

std::string floats(std::initializer_list<float> numbers) { return ByteWriter().add<float>(numbers).bytes(); }
int add_times(GltfAccessors& a, std::initializer_list<float> times) {
    return a.add(floats(times), "SCALAR", 5126, times.size());
}

/// An animation of one channel.
std::string animation_of(int node, const char* path, int input, int output, const char* more = "",
                         const char* name = "") {
    return R"({"name": ")" + std::string(name) + R"(", "channels": [{"sampler": 0, "target": {"node": )" +
           std::to_string(node) + R"(, "path": ")" + path + R"("}}], "samplers": [{"input": )" + std::to_string(input) +
           R"(, "output": )" + std::to_string(output) + more + "}]}";
}

/// A triangle, whose accessor is number 0.
GltfAccessors triangle() {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    return a;
}
constexpr const char* kTriangle = R"({"attributes": {"POSITION": 0}})";

class GltfAnimations : public testing::Test {
  protected:
    Model model(const GltfParts& parts, const AnimationWish& wish = playing()) {
        return read_model(folder_.write("part.gltf", parts.json()), {}, wish);
    }
    testing::AssertionResult refuses(const GltfParts& parts, std::initializer_list<std::string_view> texts,
                                     const AnimationWish& wish = playing()) {
        return test::refuses([&](const std::string& p) { read_model(p, {}, wish); },
                             folder_.write("part.gltf", parts.json()), texts);
    }
    test::TemporaryFolder folder_;
};

/// Where a vertex of a model of one object is at a time. Vertices are in the order of the file.
glm::dvec3 place(const Model& model, double time_s, std::uint32_t vertex) {
    const ModelMoment moment = model.player->at(time_s);
    const Mesh& mesh = moment.meshes.empty() ? model.meshes[model.objects[0].mesh] : moment.meshes[0].second;
    return glm::dvec3(moment.objects.at(0) * glm::dvec4(mesh.position(vertex), 1.0));
}

testing::AssertionResult is_near(const glm::dvec3& p, const glm::dvec3& q) {
    if (glm::distance(p, q) < 1e-6) return testing::AssertionSuccess();
    return testing::AssertionFailure() << p.x << ' ' << p.y << ' ' << p.z;
}

// ---- nodes ----

TEST_F(GltfAnimations, NodesMoveTheirChildren) {
    GltfAccessors a = triangle();
    const int times = add_times(a, {0, 2});
    const int turns = a.add(floats({0, 0, 0, 1, 0, 0, kRoot, kRoot}), "VEC4", 5126, 2);
    GltfParts parts = gltf_of(a, kTriangle);
    parts.nodes = R"([{"children": [1], "translation": [10, 0, 0]}, {"mesh": 0, "translation": [1, 0, 0],)"
                  R"( "scale": [2, 2, 2]}])";
    parts.animations = "[" + animation_of(0, "rotation", times, turns) + "]";
    const Model m = model(parts);
    EXPECT_EQ(m.objects[0].to_world[3], glm::dvec4(11, 0, 0, 1)) << "at rest";
    EXPECT_TRUE(m.player->at(1).meshes.empty()) << "no vertex moves within its mesh";
    EXPECT_TRUE(is_near(place(m, 0, 1), {13, 0, 0}));
    EXPECT_TRUE(is_near(place(m, 1, 1), {10 + 3 * std::sqrt(0.5), 3 * std::sqrt(0.5), 0}));
    EXPECT_TRUE(is_near(place(m, 2, 1), {10, 3, 0}));
    EXPECT_TRUE(is_near(place(m, 7, 1), {10, 3, 0}));
}

TEST_F(GltfAnimations, WhatIsNotMovedStaysAsTheFileHasIt) {
    GltfAccessors a = triangle();
    const int times = add_times(a, {0, 1});
    const int scales = a.add(floats({1, 1, 1, 3, 1, 1}), "VEC3", 5126, 2);
    const int ways = a.add(floats({0, 0, 0, 0, 8, 0}), "VEC3", 5126, 2);
    GltfParts parts = gltf_of(a, kTriangle);
    parts.nodes = R"([{"mesh": 0, "translation": [0, 0, 5], "rotation": [0, 0, 1, 0]}])";
    parts.animations = "[" + animation_of(0, "scale", times, scales) + ", " +
                       animation_of(0, "translation", times, ways, R"(, "interpolation": "STEP")", "Jump") + "]";
    EXPECT_TRUE(is_near(place(model(parts), 0.5, 1), {-2, 0, 5}));
    const Model jump = model(parts, playing(named("Jump")));
    EXPECT_TRUE(is_near(place(jump, 0.5, 1), {-1, 0, 0})) << "the channel has the value, not the node";
    EXPECT_TRUE(is_near(place(jump, 1, 1), {-1, 8, 0}));
    EXPECT_TRUE(is_near(place(model(parts, playing(numbered(1))), 1, 1), {-1, 8, 0}));
}

TEST_F(GltfAnimations, CamerasAndInstancesMoveWithTheirNodes) {
    GltfAccessors a = triangle();
    a.add_vectors({0, 0, 0, 0, 0, 1});
    const int times = add_times(a, {0, 1});
    const int ways = a.add(floats({0, 0, 0, 2, 0, 0}), "VEC3", 5126, 2);
    GltfParts parts = gltf_of(a, kTriangle);
    parts.nodes =
        R"([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}, "children": [1]},
            {"camera": 0, "translation": [0, 0, 9]}])";
    parts.cameras = R"([{"type": "perspective", "perspective": {"yfov": 1}}])";
    parts.animations = "[" + animation_of(0, "translation", times, ways) + "]";
    const Model m = model(parts);
    ASSERT_EQ(m.objects.size(), 2u);
    const ModelMoment moment = m.player->at(0.5);
    ASSERT_EQ(moment.objects.size(), 2u);
    EXPECT_EQ(moment.objects[0][3], glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(moment.objects[1][3], glm::dvec4(1, 0, 1, 1));
    ASSERT_EQ(moment.cameras.size(), 1u);
    EXPECT_EQ(moment.cameras[0][3], glm::dvec4(1, 0, 9, 1));
    EXPECT_EQ(m.cameras[0].to_world[3], glm::dvec4(0, 0, 9, 1));
}

TEST_F(GltfAnimations, KeysMayBeSparseAndNormalized) {
    GltfAccessors a = triangle();
    const int indices = a.add_view(ByteWriter().add<std::uint8_t>({1}).bytes());
    const int values = a.add_view(floats({4}));
    const int times = a.add_object(
        R"({"type": "SCALAR", "componentType": 5126, "count": 2, "sparse": {"count": 1, "indices": {"bufferView": )" +
        std::to_string(indices) + R"(, "componentType": 5121}, "values": {"bufferView": )" + std::to_string(values) +
        "}}}");
    const int bytes = a.add(ByteWriter().add<std::int8_t>({0, 0, 0, 127, 0, 0, -128, 0}).bytes(), "VEC4", 5120, 2,
                            R"("normalized": true)");
    const int shorts = a.add(ByteWriter().add<std::int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170}).bytes(), "VEC4", 5122,
                             2, R"("normalized": true)");
    GltfParts parts = gltf_of(a, kTriangle);
    parts.animations =
        "[" + animation_of(0, "rotation", times, bytes) + ", " + animation_of(0, "rotation", times, shorts) + "]";
    EXPECT_TRUE(is_near(place(model(parts), 4, 1), {-1, 0, 0})) << "by 180 degrees, -128 is -1";
    EXPECT_TRUE(is_near(place(model(parts), 2, 1), {0, -1, 0})) << "the turn is about -Z";
    EXPECT_TRUE(is_near(place(model(parts, playing(numbered(1))), 2, 1), {kRoot, kRoot, 0}));
    EXPECT_TRUE(is_near(place(model(parts, playing(numbered(1))), 4, 1), {0, 1, 0}));
}

// ---- meshes that deform ----

/// The triangle with two targets; accessors 0 to 2.
GltfParts morphing(const std::string& outputs, int component_type, std::size_t count, const char* more = "") {
    GltfAccessors a = triangle();
    a.add_vectors({0, 0, 1, 0, 0, 1, 0, 0, 2});
    a.add_vectors({4, 0, 0, 0, 0, 0, 0, 8, 0});
    const int times = add_times(a, {0, 1});
    const int weights =
        a.add(outputs, "SCALAR", component_type, count, component_type == 5126 ? "" : R"("normalized": true)");
    GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}, {"POSITION": 2}]})");
    parts.animations = "[" + animation_of(0, "weights", times, weights, more) + "]";
    return parts;
}

TEST_F(GltfAnimations, WeightsOfMorphTargetsMove) {
    // All targets of a key stand together.
    const Model m = model(morphing(floats({0, 0, 1, 0.5f}), 5126, 4));
    EXPECT_TRUE(is_near(place(m, 0, 2), {0, 1, 0}));
    EXPECT_TRUE(is_near(place(m, 0.5, 2), {0, 3, 1}));
    EXPECT_TRUE(is_near(place(m, 1, 2), {0, 5, 2}));
    EXPECT_TRUE(is_near(place(m, 1, 0), {2, 0, 1}));
    EXPECT_EQ(m.meshes[0].position(2), glm::dvec3(0, 1, 0)) << "at rest";

    const Model bytes = model(morphing(std::string("\0\0\xff\0", 4), 5121, 4));
    EXPECT_TRUE(is_near(place(bytes, 0.5, 2), {0, 1, 1}));

    const Model spline = model(
        morphing(floats({9, 9, 0, 0, 0, 0, 0, 0, 1, 0.5f, 9, 9}), 5126, 12, R"(, "interpolation": "CUBICSPLINE")"));
    EXPECT_TRUE(is_near(place(spline, 0.5, 2), {0, 3, 1}));
    EXPECT_TRUE(is_near(place(spline, 0.25, 2), {0, 1 + 4 * 10.0 / 64, 2 * 10.0 / 64}));
}

/// A triangle whose vertices depend on joint 0 (node 1), on joint 1 (node 2, in node 1), and half on each.
struct SkinnedTriangle {
    GltfAccessors a = triangle();
    int times = 0, turns = 0;

    SkinnedTriangle() {
        a.add(ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}).bytes(), "VEC4", 5121, 3);
        a.add(floats({1, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.25f, 0, 0}), "VEC4", 5126, 3);
        times = add_times(a, {0, 1});
        turns = a.add(floats({0, 0, 0, 1, 0, 0, kRoot, kRoot}), "VEC4", 5126, 2);
    }
    GltfParts parts(int animated_node) const {
        GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}})");
        parts.scenes = R"([{"nodes": [0, 1]}])";
        parts.nodes = R"([{"mesh": 0, "skin": 0, "translation": [50, 0, 0]}, {"children": [2]}, {}])";
        parts.skins = R"([{"joints": [1, 2]}])";
        parts.animations = "[" + animation_of(animated_node, "rotation", times, turns) + "]";
        return parts;
    }
};

TEST_F(GltfAnimations, JointsTurnWhatDependsOnThem) {
    const Model child = model(SkinnedTriangle().parts(2));
    EXPECT_TRUE(is_near(place(child, 1, 0), {0, 0, 0}));
    EXPECT_TRUE(is_near(place(child, 1, 1), {0, 1, 0})) << "by 90 degrees";
    EXPECT_TRUE(is_near(place(child, 1, 2), {-0.5, 0.5, 0})) << "half of it; weights are divided by their sum";
    const Model parent = model(SkinnedTriangle().parts(1));
    EXPECT_TRUE(is_near(place(parent, 1, 2), {-1, 0, 0})) << "all joints turn";
}

TEST_F(GltfAnimations, ASkinnedNodesOwnMotionMeansNothing) {
    const Model m = model(SkinnedTriangle().parts(0));
    EXPECT_TRUE(m.player->at(1).meshes.empty());
    EXPECT_TRUE(is_near(place(m, 1, 1), {1, 0, 0}));
    GltfParts parts = SkinnedTriangle().parts(1);  // recursive: the node lies in its own joint
    parts.scenes = R"([{"nodes": [1]}])";
    parts.nodes = R"([{"mesh": 0, "skin": 0}, {"children": [2]}, {"children": [0]}])";
    EXPECT_TRUE(is_near(place(model(parts), 1, 1), {0, 1, 0}));
}

TEST_F(GltfAnimations, JointsMayMoveOutsideTheScene) {
    GltfParts parts = SkinnedTriangle().parts(2);
    parts.scenes = R"([{"nodes": [0]}])";
    EXPECT_TRUE(is_near(place(model(parts), 1, 1), {0, 1, 0}));
}

TEST_F(GltfAnimations, TargetsComeBeforeJoints) {
    SkinnedTriangle t;
    const int deltas = t.a.add_vectors({0, 0, 0, 1, 0, 0, 0, 0, 0});
    GltfParts parts = t.parts(2);
    t.a.put_into(parts);
    parts.meshes = R"([{"weights": [1], "primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2},)"
                   R"( "targets": [{"POSITION": )" +
                   std::to_string(deltas) + "}]}]}]";
    EXPECT_TRUE(is_near(place(model(parts), 1, 1), {0, 2, 0}));
}

TEST_F(GltfAnimations, AtTheTimeOfTheRestPoseAllIsAsAtRest) {
    GltfParts parts = SkinnedTriangle().parts(2);
    parts.nodes = R"([{"mesh": 0, "skin": 0}, {"children": [2], "rotation": [0.36, 0.48, 0, 0.8]}, {}])";
    const Model m = model(parts), still = model(parts, {});
    const Mesh moved = m.player->at(0).meshes.at(0).second;
    EXPECT_EQ(moved.positions, m.meshes[0].positions);
    EXPECT_EQ(moved.positions, still.meshes[0].positions) << "to the bit";
    EXPECT_EQ(still.player, nullptr);
}

TEST_F(GltfAnimations, NodesOfOneMeshMoveApart) {
    GltfParts parts = morphing(floats({0, 0, 1, 1}), 5126, 4);
    parts.scenes = R"([{"nodes": [0, 1]}])";
    parts.nodes = R"([{"mesh": 0}, {"mesh": 0}])";
    const Model m = model(parts);
    ASSERT_EQ(m.objects.size(), 2u);
    EXPECT_NE(m.objects[0].mesh, m.objects[1].mesh);
    const ModelMoment moment = m.player->at(1);
    ASSERT_EQ(moment.meshes.size(), 1u);
    EXPECT_EQ(moment.meshes[0].first, m.objects[0].mesh);
}

// ---- choice ----

GltfParts with_names() {
    GltfAccessors a = triangle();
    const int times = add_times(a, {0, 2.5f}), ways = a.add(floats({0, 0, 0, 1, 0, 0}), "VEC3", 5126, 2);
    GltfParts parts = gltf_of(a, kTriangle);
    parts.animations = "[" + animation_of(0, "translation", times, ways, "", "Walk") + ", " +
                       animation_of(0, "scale", times, ways, "", "Idle") + "]";
    return parts;
}

TEST_F(GltfAnimations, OneIsChosenByNameOrNumber) {
    EXPECT_NE(model(with_names()).player->at(2.5).objects[0], glm::dmat4(1.0));
    EXPECT_EQ(model(with_names(), playing({AnimationChoice::By::none, 0, {}})).player, nullptr);
    const AnimationWish run = playing(named("Run"));
    EXPECT_TRUE(refuses(with_names(), {R"(: no animation "Run"; it has "Walk", "Idle")"}, run));
    EXPECT_TRUE(refuses(with_names(), {"no animation 2; it has"}, playing(numbered(2))));
    EXPECT_TRUE(refuses(with_names(), {"no animation"}, {false, false, named("Run")})) << "also of a still";
    EXPECT_TRUE(refuses(gltf_of(triangle(), kTriangle), {R"(no animation "Run"; it has none)"}, run));
    EXPECT_EQ(model(gltf_of(triangle(), kTriangle)).player, nullptr);
    GltfParts parts = with_names();
    parts.animations = R"([{"channels": [], "samplers": []}, {"channels": [], "samplers": []}])";
    EXPECT_TRUE(refuses(parts, {"no animation \"Run\"; it has 2 without names"}, run));
}

TEST_F(GltfAnimations, TheyAreListedOnRequest) {
    const Model m = model(with_names(), {false, true, {}});
    EXPECT_EQ(m.player, nullptr);
    ASSERT_EQ(m.animations.size(), 2u);
    EXPECT_EQ(m.animations[0].name, "Walk");
    EXPECT_EQ(m.animations[0].channels, 1u);
    EXPECT_EQ(m.animations[0].seconds, 2.5);
    GltfParts parts = with_names();
    parts.animations.insert(1, R"({"channels": [{}], "samplers": [{"input": 77}]}, )");
    const Model broken = model(parts, {false, true, {}});
    ASSERT_EQ(broken.animations.size(), 3u);
    EXPECT_EQ(broken.animations[2].name, "Idle");
    ASSERT_EQ(broken.notes.size(), 1u);
    EXPECT_NE(broken.notes[0].find("part.gltf: animations[0].samplers[0].input: accessor 77 does not exist"),
              std::string::npos)
        << broken.notes[0];
}

TEST_F(GltfAnimations, ChannelsWithoutANodeAreLeftOutWithOneNote) {
    GltfParts parts = with_names();
    const std::string channel = R"({"sampler": 0, "target": {"path": "translation"}}, )";
    const std::string pointer =
        R"({"sampler": 0, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/a"}}}}, )";
    const std::string again = R"({"sampler": 0, "target": {"node": 0, "path": "translation"}}, )";
    parts.animations.insert(parts.animations.find("[{\"sampler\"") + 1, channel + pointer + again);
    const Model m = model(parts);
    ASSERT_EQ(m.notes.size(), 2u);
    EXPECT_NE(m.notes[0].find("animation \"Walk\": left out 2 channels without a node"), std::string::npos)
        << m.notes[0];
    EXPECT_NE(m.notes[1].find("left out 1 channel for what an earlier channel moves"), std::string::npos) << m.notes[1];
    EXPECT_NE(m.player->at(2.5).objects[0], glm::dmat4(1.0));
}

// ---- what is broken ----

TEST_F(GltfAnimations, BrokenKeysAreRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const auto with = [](std::initializer_list<float> times, std::initializer_list<float> values, const char* path,
                         const char* type, const char* more = "") {
        GltfAccessors a = triangle();
        const int input = add_times(a, times);
        const std::size_t size = std::string_view(type) == "SCALAR" ? 1 : (std::string_view(type) == "VEC4" ? 4 : 3);
        const int output = a.add(floats(values), type, 5126, values.size() / size);
        GltfParts parts = gltf_of(a, kTriangle);
        parts.animations = "[" + animation_of(0, path, input, output, more) + "]";
        return parts;
    };
    constexpr const char* kMoves = "translation";
    EXPECT_TRUE(refuses(with({}, {}, kMoves, "VEC3"), {"animations[0].samplers[0].input: an animation needs a key"}));
    EXPECT_TRUE(refuses(with({1, 0}, {0, 0, 0, 0, 0, 0}, kMoves, "VEC3"),
                        {"animations[0].samplers[0].input: the time of key 1 is not after that of the one before"}));
    EXPECT_TRUE(refuses(with({1, 1}, {0, 0, 0, 0, 0, 0}, kMoves, "VEC3"), {"times must ascend"}));
    EXPECT_TRUE(
        refuses(with({nan}, {0, 0, 0}, kMoves, "VEC3"), {"samplers[0].input: the time of key 0 is not finite"}));
    EXPECT_TRUE(refuses(with({0, 1}, {0, 0, 0, 0, inf, 0}, kMoves, "VEC3"),
                        {"animations[0].samplers[0].output: element 1 is not finite"}));
    EXPECT_TRUE(refuses(with({0, 1}, {0, 0, 0}, kMoves, "VEC3"),
                        {"animations[0].samplers[0].output: has 1 elements; 2 keys need 2"}));
    EXPECT_TRUE(refuses(with({0}, {0, 0, 0}, kMoves, "VEC3", R"(, "interpolation": "CUBICSPLINE")"),
                        {"has 1 elements; 1 key needs 3"}));
    EXPECT_TRUE(refuses(with({0}, {0, 0, 0}, kMoves, "VEC3", R"(, "interpolation": "SMOOTH")"),
                        {"samplers[0].interpolation: must be STEP, LINEAR or CUBICSPLINE"}));
    EXPECT_TRUE(refuses(with({0}, {0, 0, 0, 0}, "rotation", "VEC4"), {"output: the rotation of key 0 is 0"}));
    EXPECT_TRUE(refuses(with({0}, {0, 0, 0}, "rotation", "VEC3"), {"the type must be VEC4"}));
    EXPECT_TRUE(refuses(with({0}, {0}, "weights", "SCALAR"), {"target: the mesh of node 0 has no morph targets"}));
    EXPECT_TRUE(refuses(with({0}, {0, 0, 0}, "colour", "VEC3"),
                        {"target.path: must be translation, rotation, scale or weights"}));
    EXPECT_TRUE(refuses(morphing(floats({0, 0, 1}), 5126, 3), {"output: has 3 elements; 2 keys need 4"}));
}

TEST_F(GltfAnimations, BrokenReferencesAreRefused) {
    const auto with = [](const std::string& animation) {
        GltfParts parts = with_names();
        parts.nodes = R"([{"mesh": 0}, {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}])";
        parts.animations = "[" + animation + "]";
        return parts;
    };
    EXPECT_TRUE(refuses(with(animation_of(7, "scale", 1, 2)), {"channels[0].target.node: node 7 does not exist"}));
    EXPECT_TRUE(refuses(with(animation_of(1, "scale", 1, 2)), {"target: node 1 has a matrix"}));
    EXPECT_TRUE(refuses(with(animation_of(1, "weights", 1, 2)), {"target: node 1 has no mesh"}));
    EXPECT_TRUE(refuses(with(animation_of(0, "scale", 1, 9)), {"samplers[0].output: accessor 9 does not exist"}));
    EXPECT_TRUE(refuses(with(R"({"channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]})"),
                        {"channels[0].sampler: sampler 0 does not exist"}));
    EXPECT_TRUE(refuses(with(R"({"samplers": []})"), {"animations[0]: 'channels' is missing"}));
}

TEST_F(GltfAnimations, BrokenOnesThatAreNotPlayedOnlyWarn) {
    GltfParts parts = with_names();
    parts.animations = "[" + animation_of(7, "scale", 1, 2) + ", " + animation_of(0, "scale", 1, 2) + "]";
    EXPECT_TRUE(model(parts, {}).notes.empty()) << "of a still they are not read";
    EXPECT_TRUE(model(parts, playing(numbered(1))).notes.empty());
    const Model none = model(parts, playing({AnimationChoice::By::none, 0, {}}));
    ASSERT_EQ(none.notes.size(), 1u);
    EXPECT_NE(none.notes[0].find("part.gltf: animations[0].channels[0].target.node: node 7"), std::string::npos)
        << none.notes[0];
}

TEST_F(GltfAnimations, WhatMovesTooFarIsAnErrorOfTheFrame) {
    GltfAccessors a = triangle();
    const int times = add_times(a, {0, 1}), scales = a.add(floats({1, 1, 1, 1e20f, 1, 1}), "VEC3", 5126, 2);
    GltfParts parts = gltf_of(a, kTriangle);
    parts.nodes = R"([{"children": [1], "scale": [1e20, 1, 1]}, {"mesh": 0}])";
    parts.animations = "[" + animation_of(1, "scale", times, scales) + "]";
    const Model m = model(parts);
    EXPECT_NO_THROW(m.player->at(0));
    EXPECT_THROW(m.player->at(1), InputError);
    SkinnedTriangle t;
    const int far = t.a.add(floats({0, 0, 0, 1e30f, 1e30f, 1e30f}), "VEC3", 5126, 2);
    GltfParts skinned = t.parts(2);
    t.a.put_into(skinned);
    skinned.nodes = R"([{"mesh": 0, "skin": 0}, {"children": [2]}, {"scale": [1e3, 1e3, 1e3]}])";
    skinned.animations = "[" + animation_of(1, "scale", t.times, far) + "]";
    EXPECT_THROW(model(skinned).player->at(1), InputError);
}

TEST_F(GltfAnimations, MemoryIsCountedBeforeItIsTaken) {
    // A thousand targets that are one accessor, of a mesh of 3000 vertices.
    GltfAccessors a;
    a.add(std::string(36000, '\0'), "VEC3", 5126, 3000);
    a.add(std::string(12 * 3000, '\1'), "VEC3", 5126, 3000);
    std::string targets = R"({"POSITION": 1})", weights = "0";
    for (int i = 1; i < 1000; ++i) {
        targets += R"(, {"POSITION": 1})";
        weights += ", 0";
    }
    const int times = add_times(a, {0});
    const int keys = a.add(std::string(4000, '\0'), "SCALAR", 5126, 1000);
    GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0}, "targets": [)" + targets + "]}");
    parts.animations = "[" + animation_of(0, "weights", times, keys) + "]";
    const std::string path = folder_.write("part.gltf", parts.json());
    const auto read = [&](std::uint64_t limit, bool plays) {
        ModelBudget budget(limit);
        AnimationWish wish;
        wish.plays = plays;
        read_gltf(path, budget, false, {}, wish);
    };
    EXPECT_THROW(read(10u << 20, true), InputError);
    EXPECT_NO_THROW(read(10u << 20, false));
    EXPECT_NO_THROW(read(1u << 30, true));
}

}  // namespace
}  // namespace burin::gltf_animation_test
