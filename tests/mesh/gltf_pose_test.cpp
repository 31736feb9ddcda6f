#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesh/gltf.h"
#include "mesh/model.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::gltf_of;
using test::GltfAccessors;
using test::GltfParts;

using Points = std::vector<glm::dvec3>;

constexpr const char* kMorphing =
    R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}, {"NORMAL": 1}, {"POSITION": 2}]})";

/// A triangle with two targets that move it, and one that does not.
GltfAccessors morphing_triangle() {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    a.add_vectors({0, 0, 1, 0, 0, 1, 0, 0, 2});
    a.add_vectors({4, 0, 0, 0, 0, 0, 0, 8, 0});
    return a;
}

class GltfPose : public testing::Test {
  protected:
    GltfScene read(const GltfParts& parts) { return read_gltf(folder_.write("part.gltf", parts.json())); }
    testing::AssertionResult refuses(const GltfParts& parts, std::initializer_list<std::string_view> texts) {
        return test::refuses([](const std::string& p) { read_gltf(p); }, folder_.write("part.gltf", parts.json()),
                             texts);
    }
    test::TemporaryFolder folder_;
};

// ---- morph targets ----

TEST_F(GltfPose, WeightsOfTheMeshAddItsTargets) {
    GltfParts parts = gltf_of(morphing_triangle(), kMorphing);
    EXPECT_EQ(read(parts).meshes.at(0).positions, (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << "without weights";
    parts.meshes.insert(parts.meshes.size() - 2, R"(, "weights": [0.5, 1, -0.25])");
    EXPECT_EQ(read(parts).meshes.at(0).positions, (Points{{-1, 0, 0.5}, {1, 0, 0.5}, {0, -1, 1}}));
}

TEST_F(GltfPose, WeightsOfANodeComeBeforeThoseOfTheMesh) {
    GltfParts parts = gltf_of(morphing_triangle(), kMorphing);
    parts.meshes.insert(parts.meshes.size() - 2, R"(, "weights": [1, 0, 0])");
    parts.scenes = R"([{"nodes": [0, 1, 2, 3]}])";
    parts.nodes =
        R"([{"mesh": 0}, {"mesh": 0, "weights": [2, 0, 0], "translation": [9, 0, 0]}, {"mesh": 0, "weights": [0, 0, 0]},
                     {"mesh": 0, "weights": [2, 0, 0]}])";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.meshes.size(), 3u) << "one per pose";
    ASSERT_EQ(scene.objects.size(), 4u);
    EXPECT_EQ(scene.objects[1].mesh, scene.objects[3].mesh);
    EXPECT_EQ(scene.meshes[scene.objects[0].mesh].positions[2], glm::dvec3(0, 1, 2));
    EXPECT_EQ(scene.meshes[scene.objects[1].mesh].positions[2], glm::dvec3(0, 1, 4));
    EXPECT_EQ(scene.meshes[scene.objects[2].mesh].positions[2], glm::dvec3(0, 1, 0));
    EXPECT_EQ(scene.objects[1].to_world[3], glm::dvec4(9, 0, 0, 1));
}

TEST_F(GltfPose, TargetsMayBeSparseWithoutAView) {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int indices = a.add_view(ByteWriter().add<std::uint8_t>({2}).bytes());
    const int values = a.add_view(ByteWriter().add<float>({0, 0, 3}).bytes());
    a.add_object(
        R"({"type": "VEC3", "componentType": 5126, "count": 3, "sparse": {"count": 1, "indices": {"bufferView": )" +
        std::to_string(indices) + R"(, "componentType": 5121}, "values": {"bufferView": )" + std::to_string(values) +
        "}}}");
    GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]})");
    parts.nodes = R"([{"mesh": 0, "weights": [2]}])";
    EXPECT_EQ(read(parts).meshes.at(0).positions, (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 6}}));
}

TEST_F(GltfPose, TargetsMayBeQuantized) {
    GltfAccessors a;
    a.add(ByteWriter().add<std::int16_t>({0, 0, 0, 100, 0, 0, 0, 100, 0}).bytes(), "VEC3", 5122, 3);
    a.add(ByteWriter().add<std::int8_t>({0, 0, 127, 0, 0, -127, 0, 0, -128}).bytes(), "VEC3", 5120, 3,
          R"("normalized": true)");
    GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]})");
    parts.nodes = R"([{"mesh": 0, "weights": [10]}])";
    EXPECT_EQ(read(parts).meshes.at(0).positions, (Points{{0, 0, 10}, {100, 0, -10}, {0, 100, -10}}));
}

/// Two triangles over one square. They share two places, with own vertices for each triangle.
GltfAccessors square_of_six(float last_delta) {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
    a.add_vectors({0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, last_delta, 0, 0, 0});
    return a;
}

TEST_F(GltfPose, VerticesAreWeldedWhereTheTargetsPutThem) {
    for (const bool is_torn : {false, true}) {
        GltfParts parts =
            gltf_of(square_of_six(is_torn ? 3 : 1), R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]})");
        EXPECT_EQ(read_model(folder_.write("part.gltf", parts.json()), {}).meshes.at(0).positions.size(), 4u)
            << "not moved";
        parts.nodes = R"([{"mesh": 0, "weights": [1]}])";
        const Model model = read_model(folder_.write("part.gltf", parts.json()), {});
        EXPECT_EQ(model.meshes.at(0).positions.size(), is_torn ? 5u : 4u);
        EXPECT_EQ(count_edges(model.meshes[0]).border, is_torn ? 6u : 4u);
    }
}

TEST_F(GltfPose, PrimitivesThatShareVerticesButNotTargetsMoveApart) {
    GltfParts parts = gltf_of(morphing_triangle(), R"({"attributes": {"POSITION": 0}, "targets": [{"POSITION": 1}]},
                                                     {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 2}]})");
    parts.nodes = R"([{"mesh": 0, "weights": [1]}])";
    EXPECT_EQ(read(parts).meshes.at(0).positions,
              (Points{{0, 0, 1}, {1, 0, 1}, {0, 1, 2}, {4, 0, 0}, {1, 0, 0}, {0, 9, 0}}));
}

TEST_F(GltfPose, APrimitiveWithoutCornersHasNothingToMove) {
    GltfAccessors a = morphing_triangle();
    a.add_object(R"({"type": "SCALAR", "componentType": 5123, "count": 0})");
    GltfParts parts =
        gltf_of(a, std::string(kMorphing) +
                       R"(, {"attributes": {"POSITION": 2}, "indices": 3, "targets": [{"POSITION": 1}, {}, {}]})");
    parts.nodes = R"([{"mesh": 0, "weights": [1, 0, 0]}])";
    EXPECT_EQ(read(parts).meshes.at(0).positions, (Points{{0, 0, 1}, {1, 0, 1}, {0, 1, 2}}));
}

TEST_F(GltfPose, BrokenTargetsAreRefused) {
    const auto with = [](const std::string& primitive, const char* weights) {
        GltfAccessors a = morphing_triangle();
        a.add_vectors({0, 0, 0, 0, 0, 0});
        a.add_vectors({0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0});
        a.add_indices({0, 1, 2});
        GltfParts parts = gltf_of(a, primitive);
        parts.nodes = "[{\"mesh\": 0, \"weights\": " + std::string(weights) + "}]";
        return parts;
    };
    const auto target = [](const char* targets) {
        return R"({"attributes": {"POSITION": 0}, "targets": )" + std::string(targets) + "}";
    };
    EXPECT_TRUE(
        refuses(with(kMorphing, "[1]"), {"meshes[0].primitives[0]: has 3 morph targets, but there are 1 weights"}));
    EXPECT_TRUE(refuses(with(target("[]"), "[1]"), {"meshes[0].primitives[0]: has 0 morph targets"}));
    EXPECT_TRUE(refuses(with(kMorphing, "[1, \"x\", 0]"), {"nodes[0].weights[1]: must be a number"}));
    EXPECT_TRUE(refuses(with(kMorphing, "[1, 1e31, 0]"), {"nodes[0].weights[1]: the number is not finite"}));
    EXPECT_TRUE(refuses(with(kMorphing, "{}"), {"nodes[0].weights: must be an array"}));
    EXPECT_TRUE(refuses(with(target("{}"), "[1]"), {"meshes[0].primitives[0].targets: must be an array"}));
    EXPECT_TRUE(
        refuses(with(target(R"([{"POSITION": 9}])"), "[1]"), {"targets[0].POSITION: accessor 9 does not exist"}));
    EXPECT_TRUE(refuses(with(target(R"([{"POSITION": 3}])"), "[1]"),
                        {"targets[0].POSITION: has 2 elements, but there are 3 positions"}));
    EXPECT_TRUE(refuses(with(target(R"([{"POSITION": 4}])"), "[1]"), {"targets[0].POSITION: vertex 1 is not finite"}));
    EXPECT_TRUE(refuses(with(target(R"([{"POSITION": 5}])"), "[1]"), {"accessors[5]: the type must be VEC3"}));
    EXPECT_TRUE(refuses(with(target(R"([{"POSITION": 1}])"), "[1e30]"),
                        {"meshes[0].primitives[0]: morph targets or joints move vertex 2 beyond 1e30"}));
}

// ---- skins ----

constexpr const char* kSkinned = R"({"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}})";

/// A triangle whose vertices depend on joint 0, on joint 1, and half on each.
struct SkinnedTriangle {
    GltfAccessors accessors;
    GltfParts parts;

    SkinnedTriangle(const std::string& joints, int joint_type, const std::string& weights, int weight_type) {
        accessors.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
        accessors.add(joints, "VEC4", joint_type, 3);
        accessors.add(weights, "VEC4", weight_type, 3, weight_type == 5126 ? "" : R"("normalized": true)");
        finish();
    }
    SkinnedTriangle()
        : SkinnedTriangle(ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}).bytes(), 5121,
                          ByteWriter().add<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}).bytes(), 5126) {}
    void finish(const std::string& primitives = kSkinned) {
        parts = gltf_of(accessors, primitives);
        parts.scenes = R"([{"nodes": [0, 1]}])";
        parts.nodes =
            R"([{"mesh": 0, "skin": 0, "translation": [50, 0, 0]}, {"translation": [0, 2, 0], "children": [2]},
                         {"translation": [0, 0, 4], "scale": [1, 1, 3]}])";
        parts.skins = R"([{"joints": [1, 2]}])";
    }
};

const Points kPosed{{0, 2, 0}, {1, 2, 4}, {0, 3, 2}};

TEST_F(GltfPose, SkinsStandWhereTheirJointsAre) {
    const SkinnedTriangle t;
    const GltfScene scene = read(t.parts);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions, kPosed);
    EXPECT_EQ(scene.objects.at(0).to_world, glm::dmat4(1.0)) << "the node's own transform means nothing";
}

TEST_F(GltfPose, JointsAndWeightsMayHaveAllTypes) {
    const auto joints8 = ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}).bytes();
    const auto joints16 = ByteWriter().add<std::uint16_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}).bytes();
    const auto floats = ByteWriter().add<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}).bytes();
    // The last vertex's do not sum to 1.
    const auto bytes = ByteWriter().add<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 99, 99, 0, 0}).bytes();
    const auto shorts = ByteWriter().add<std::uint16_t>({65535, 0, 0, 0, 65535, 0, 0, 0, 30000, 30000, 0, 0}).bytes();
    for (const auto& [joints, joint_type] : {std::pair(joints8, 5121), std::pair(joints16, 5123)}) {
        for (const auto& [weights, weight_type] :
             {std::pair(floats, 5126), std::pair(bytes, 5121), std::pair(shorts, 5123)}) {
            EXPECT_EQ(read(SkinnedTriangle(joints, joint_type, weights, weight_type).parts).meshes.at(0).positions,
                      kPosed)
                << joint_type << ' ' << weight_type;
        }
    }
}

TEST_F(GltfPose, WeightsAreDividedByTheirSum) {
    SkinnedTriangle t(ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}).bytes(), 5121,
                      ByteWriter().add<float>({0.25f, 0, 0, 0, 7, 0, 0, 0, 3, 1, 0, 0}).bytes(), 5126);
    EXPECT_EQ(read(t.parts).meshes.at(0).positions, (Points{{0, 2, 0}, {1, 2, 4}, {0, 3, 1}}));
}

TEST_F(GltfPose, InverseBindMatricesComeFirst) {
    SkinnedTriangle t;
    t.accessors.add(ByteWriter()
                        .add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5, 0, 1, 1,
                                     1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 1, 1})
                        .bytes(),
                    "MAT4", 5126, 2);
    t.finish();
    t.parts.skins = R"([{"joints": [1, 2], "inverseBindMatrices": 3}])";
    EXPECT_EQ(read(t.parts).meshes.at(0).positions, (Points{{-5, 2, 1}, {1, 2, 7}, {-2.5, 3, 4}}));
}

TEST_F(GltfPose, AllSetsOfJointsCount) {
    SkinnedTriangle t;
    t.accessors.add(ByteWriter().add<std::uint8_t>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}).bytes(), "VEC4", 5121, 3);
    t.accessors.add(ByteWriter().add<float>({1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}).bytes(), "VEC4", 5126, 3);
    t.finish(R"({"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2, "JOINTS_1": 3, "WEIGHTS_1": 4}})");
    EXPECT_EQ(read(t.parts).meshes.at(0).positions, (Points{{0, 2, 2}, {1, 2, 2}, {0, 3, 2}}));
}

TEST_F(GltfPose, JointsMayLieOutsideTheScene) {
    SkinnedTriangle t;
    t.parts.scenes = R"([{"nodes": [0]}])";
    EXPECT_EQ(read(t.parts).meshes.at(0).positions, kPosed);
}

TEST_F(GltfPose, TargetsComeBeforeJoints) {
    SkinnedTriangle t;
    t.accessors.add_vectors({0, 0, 1, 0, 0, 1, 0, 0, 1});
    t.finish(R"({"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "targets": [{"POSITION": 3}]})");
    t.parts.nodes.replace(t.parts.nodes.find("\"skin\""), 0, "\"weights\": [1], ");
    EXPECT_EQ(read(t.parts).meshes.at(0).positions, (Points{{0, 2, 1}, {1, 2, 7}, {0, 3, 4}}));
}

TEST_F(GltfPose, OneMeshInTwoSkinsIsTwoMeshes) {
    SkinnedTriangle t;
    t.parts.scenes = R"([{"nodes": [0, 1, 3, 4, 5]}])";
    t.parts.nodes.insert(t.parts.nodes.size() - 1,
                         R"(, {"mesh": 0, "skin": 1}, {"mesh": 0, "translation": [1, 0, 0]}, {"mesh": 0, "skin": 0})");
    t.parts.skins = R"([{"joints": [1, 2]}, {"joints": [2, 1]}])";
    const GltfScene scene = read(t.parts);
    ASSERT_EQ(scene.meshes.size(), 3u);
    EXPECT_EQ(scene.meshes[scene.objects.at(1).mesh].positions, (Points{{0, 2, 4}, {1, 2, 0}, {0, 3, 2}}));
    EXPECT_EQ(scene.meshes[scene.objects.at(2).mesh].positions, (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.objects.at(2).to_world[3], glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(scene.objects.at(3).mesh, scene.objects.at(0).mesh);
}

TEST_F(GltfPose, EqualVerticesStayTogetherWhateverTheOrderOfTheirJoints) {
    // Two vertices in one place. The joints of the second one stand in another order, and one twice.
    GltfAccessors a;
    a.add_positions({0.3f, 0.7f, 0.9f, 1, 0, 0, 0, 1, 0, 0.3f, 0.7f, 0.9f, 0, 1, 0, 1, 0, 0});
    a.add(ByteWriter()
              .add<std::uint8_t>({0, 1, 2, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0})
              .bytes(),
          "VEC4", 5121, 6);
    a.add(ByteWriter()
              .add<std::uint8_t>(
                  {51, 102, 68, 0, 255, 0, 0, 0, 255, 0, 0, 0, 68, 51, 102, 0, 255, 0, 0, 0, 200, 55, 0, 0})
              .bytes(),
          "VEC4", 5121, 6, R"("normalized": true)");
    GltfParts parts = gltf_of(a, kSkinned);
    parts.scenes = R"([{"nodes": [0, 1, 2, 3]}])";
    parts.nodes = R"([{"mesh": 0, "skin": 0}, {"rotation": [0.36, 0.48, 0, 0.8], "translation": [0.1, 0.2, 0.3]},
                     {"rotation": [0, 0.6, 0, 0.8], "scale": [1.1, 1.2, 1.3]}, {"translation": [7.7, 0, 0.13]}])";
    parts.skins = R"([{"joints": [1, 2, 3]}])";
    const std::vector<glm::dvec3> p = read(parts).meshes.at(0).positions;
    EXPECT_EQ(p[0], p[3]);
    EXPECT_EQ(p[1], p[5]);
    EXPECT_EQ(p[2], p[4]);
}

TEST_F(GltfPose, VerticesThatNothingUsesNeedNoWeights) {
    SkinnedTriangle t(ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}).bytes(), 5121,
                      ByteWriter().add<float>({1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}).bytes(), 5126);
    EXPECT_TRUE(refuses(t.parts, {"meshes[0].primitives[0].attributes.WEIGHTS_0: the weights of vertex 1 sum to 0"}));
    t.accessors.add_indices({0, 2, 0});
    t.finish(R"({"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3})");
    EXPECT_NO_THROW(read(t.parts));
}

TEST_F(GltfPose, BrokenSkinsAreRefused) {
    const auto with_skin = [](const char* skin) {
        SkinnedTriangle t;
        t.accessors.add(std::string(64, '\0'), "MAT4", 5126, 1);
        t.accessors.add(
            ByteWriter()
                    .add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0, 0, 1})
                    .bytes() +
                std::string(64, '\0'),
            "MAT4", 5126, 2);
        t.finish();
        t.parts.skins = "[" + std::string(skin) + "]";
        return t.parts;
    };
    EXPECT_TRUE(refuses(with_skin(R"({"joints": []})"), {"skins[0].joints: a skin needs a joint"}));
    EXPECT_TRUE(refuses(with_skin("{}"), {"skins[0]: 'joints' is missing"}));
    EXPECT_TRUE(
        refuses(with_skin(R"({"joints": [1, 3]})"), {"skins[0].joints[1]: node 3 does not exist (there are 3)"}));
    EXPECT_TRUE(
        refuses(with_skin(R"({"joints": [1]})"), {"attributes.JOINTS_0: vertex 1 has joint 1, but its skin has 1"}));
    EXPECT_TRUE(
        refuses(with_skin(R"({"joints": [1, 2], "inverseBindMatrices": 0})"), {"accessors[0]: the type must be MAT4"}));
    EXPECT_TRUE(refuses(with_skin(R"({"joints": [1, 2], "inverseBindMatrices": 3})"),
                        {"skins[0].inverseBindMatrices: has 1 matrices for 2 joints"}));
    EXPECT_TRUE(refuses(with_skin(R"({"joints": [1, 2], "inverseBindMatrices": 4})"),
                        {"skins[0].joints[0]: its matrix", "not finite"}));
    GltfParts parts = SkinnedTriangle().parts;
    parts.skins = "";
    EXPECT_TRUE(refuses(parts, {"nodes[0].skin: skin 0 does not exist (there are 0)"}));
    parts = SkinnedTriangle().parts;
    parts.nodes.replace(parts.nodes.find("\"skin\""), 0,
                        R"("extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}, )");
    EXPECT_TRUE(refuses(parts, {"nodes[0]: a node with a skin cannot have instances"}));
    parts = SkinnedTriangle().parts;
    parts.scenes = R"([{"nodes": [0]}])";
    parts.nodes = R"([{"mesh": 0, "skin": 0}, {"children": [2]}, {"children": [1]}])";
    EXPECT_TRUE(refuses(parts, {"skins[0].joints[0]: the node is its own ancestor"}));
}

TEST_F(GltfPose, BrokenJointsAndWeightsAreRefused) {
    const auto joints = ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}).bytes();
    const auto floats = [](float w) {
        return ByteWriter().add<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, w, 0, 0}).bytes();
    };
    for (const float bad : {-0.5f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        EXPECT_TRUE(refuses(SkinnedTriangle(joints, 5121, floats(bad), 5126).parts,
                            {"attributes.WEIGHTS_0: vertex 2 has a weight that is below 0 or not finite"}))
            << bad;
    }
    EXPECT_TRUE(refuses(SkinnedTriangle(joints, 5120, floats(0.5f), 5126).parts,
                        {"attributes.JOINTS_0: must be unsigned bytes or shorts"}));
    EXPECT_TRUE(refuses(SkinnedTriangle(joints, 5121, joints, 5120).parts,
                        {"attributes.WEIGHTS_0: must be floats, or normalized"}));
    SkinnedTriangle t;
    t.accessors.add(joints.substr(0, 8), "VEC4", 5121, 2);
    t.finish(R"({"attributes": {"POSITION": 0, "JOINTS_0": 3, "WEIGHTS_0": 2}})");
    EXPECT_TRUE(refuses(t.parts, {"attributes.JOINTS_0: has 2 elements, but there are 3 positions"}));
    t.finish(R"({"attributes": {"POSITION": 0, "JOINTS_0": 1}})");
    EXPECT_TRUE(refuses(t.parts, {"meshes[0].primitives[0].attributes: 'WEIGHTS_0' is missing"}));
    t.finish(R"({"attributes": {"POSITION": 0}})");
    EXPECT_TRUE(refuses(t.parts, {"meshes[0].primitives[0].attributes: 'JOINTS_0' is missing"}));
    t.finish(R"({"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2, "WEIGHTS_1": 2}})");
    EXPECT_TRUE(refuses(t.parts, {"'JOINTS_1' is missing"}));
    t.finish(R"({"attributes": {"POSITION": 0, "JOINTS_0": 0, "WEIGHTS_0": 2}})");
    EXPECT_TRUE(refuses(t.parts, {"accessors[0]: the type must be VEC4"}));
}

}  // namespace
}  // namespace burin
