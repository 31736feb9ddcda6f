#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mesh/gltf.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::gltf_of;
using test::GltfAccessors;
using test::GltfParts;

class GltfNodeExtensions : public testing::Test {
  protected:
    GltfScene read(const GltfParts& parts) { return read_gltf(folder_.write("part.gltf", parts.json())); }
    testing::AssertionResult refuses(const GltfParts& parts, std::initializer_list<std::string_view> texts) {
        return test::refuses([](const std::string& p) { read_gltf(p); }, folder_.write("part.gltf", parts.json()),
                             texts);
    }
    /// A node moved by (10, 0, 0) with EXT_mesh_gpu_instancing. Accessors from 1 on are the caller's.
    static GltfParts instanced(const GltfAccessors& a, const std::string& attributes) {
        GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0}})");
        parts.nodes =
            R"([{"mesh": 0, "name": "tree", "translation": [10, 0, 0], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {)" +
            attributes + "}}}}]";
        return parts;
    }
    static GltfAccessors triangle() {
        GltfAccessors a;
        a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
        return a;
    }
    test::TemporaryFolder folder_;
};

void expect_near(const glm::dvec4& a, const glm::dvec4& b) {
    EXPECT_LT(glm::distance(a, b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST_F(GltfNodeExtensions, InstancesAreObjectsAtTheNodesTransformTimesTheirs) {
    GltfAccessors a = triangle();
    a.add_vectors({0, 0, 0, 2, 0, 0, 4, 5, 6});
    const GltfScene scene = read(instanced(a, R"("TRANSLATION": 1, "_ID": 99)"));
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "tree#1");
    EXPECT_EQ(scene.objects[2].name, "tree#3");
    EXPECT_EQ(scene.objects[0].to_world[3], glm::dvec4(10, 0, 0, 1));
    EXPECT_EQ(scene.objects[2].to_world[3], glm::dvec4(14, 5, 6, 1));
}

TEST_F(GltfNodeExtensions, InstancesAreScaledThenTurnedThenMoved) {
    GltfAccessors a = triangle();
    a.add_vectors({0, 0, 7});
    a.add(ByteWriter().add<float>({0, 0, 0.70710678f, 0.70710678f}).bytes(), "VEC4", 5126, 1);
    a.add_vectors({2, 3, 4});
    const GltfScene scene = read(instanced(a, R"("SCALE": 3, "TRANSLATION": 1, "ROTATION": 2)"));
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "tree") << "as of instances of a scene, one alone has no number";
    expect_near(scene.objects[0].to_world * glm::dvec4(1, 0, 0, 1), {10, 2, 7, 1});
    expect_near(scene.objects[0].to_world * glm::dvec4(0, 1, 0, 1), {7, 0, 7, 1});
}

TEST_F(GltfNodeExtensions, SmallRotationsTurnAndDoNotScale) {
    // A quarter turn: the numbers' squares sum to more or less than 1.
    GltfAccessors bytes = triangle(), shorts = triangle();
    bytes.add(ByteWriter().add<std::int8_t>({0, 0, 90, 90}).bytes(), "VEC4", 5120, 1, R"("normalized": true)");
    shorts.add(ByteWriter().add<std::int16_t>({0, 0, 23170, 23170}).bytes(), "VEC4", 5122, 1, R"("normalized": true)");
    for (const GltfAccessors* a : {&bytes, &shorts}) {
        const GltfScene scene = read(instanced(*a, R"("ROTATION": 1)"));
        expect_near(scene.objects.at(0).to_world * glm::dvec4(1, 0, 0, 0), {0, 1, 0, 0});
        expect_near(scene.objects.at(0).to_world * glm::dvec4(0, 0, 1, 0), {0, 0, 1, 0});
    }
}

TEST_F(GltfNodeExtensions, ListsOfOtherNamesPlaceNothing) {
    EXPECT_EQ(read(instanced(triangle(), R"("_ID": 0)")).objects.size(), 1u);
    EXPECT_EQ(read(instanced(triangle(), "")).objects.size(), 1u);
}

TEST_F(GltfNodeExtensions, BrokenInstancesAreRefused) {
    GltfAccessors a = triangle();
    a.add_vectors({0, 0, 0, 2, 0, 0});                                                        // 1
    a.add(ByteWriter().add<float>({0, 0, 0, 1}).bytes(), "VEC4", 5126, 1);                    // 2
    a.add(ByteWriter().add<float>({0, 0, 0, 1, 0, 0, 0, 0}).bytes(), "VEC4", 5126, 2);        // 3
    a.add(ByteWriter().add<std::int8_t>({0, 0, 0, 1, 0, 0, 0, 1}).bytes(), "VEC4", 5120, 2);  // 4
    a.add(ByteWriter().add<float>({0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0}).bytes(), "VEC3", 5126,
          2);                                                                            // 5
    a.add(ByteWriter().add<std::int16_t>({0, 0, 0, 0, 0, 0}).bytes(), "VEC3", 5122, 2);  // 6
    a.add(ByteWriter().add<std::uint8_t>({0, 0, 0, 1, 0, 0, 0, 1}).bytes(), "VEC4", 5121, 2,
          R"("normalized": true)");  // 7
    const std::string place = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.";
    EXPECT_TRUE(
        refuses(instanced(a, R"("TRANSLATION": 1, "ROTATION": 2)"), {place + "ROTATION: has 1 entries, and not 2"}));
    EXPECT_TRUE(refuses(instanced(a, R"("TRANSLATION": 1, "SCALE": 0)"), {place + "SCALE: has 3 entries, and not 2"}));
    EXPECT_TRUE(refuses(instanced(a, R"("ROTATION": 3)"), {place + "ROTATION: entry 1 is no rotation"}));
    EXPECT_TRUE(
        refuses(instanced(a, R"("ROTATION": 4)"), {place + "ROTATION: must be floats, or normalized bytes or shorts"}));
    EXPECT_TRUE(
        refuses(instanced(a, R"("ROTATION": 7)"), {place + "ROTATION: must be floats, or normalized bytes or shorts"}));
    EXPECT_TRUE(refuses(instanced(a, R"("TRANSLATION": 5)"), {place + "TRANSLATION: entry 1 is not finite"}));
    EXPECT_TRUE(refuses(instanced(a, R"("SCALE": 6)"), {place + "SCALE: must be floats"}));
    EXPECT_TRUE(refuses(instanced(a, R"("SCALE": 2)"), {"accessors[2]: the type must be VEC3"}));
    EXPECT_TRUE(refuses(instanced(a, R"("TRANSLATION": 99)"), {place + "TRANSLATION: accessor 99 does not exist"}));
    GltfParts parts = instanced(a, R"("TRANSLATION": 1)");
    parts.nodes = R"([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}}])";
    EXPECT_TRUE(refuses(parts, {"EXT_mesh_gpu_instancing: 'attributes' is missing"}));
}

TEST_F(GltfNodeExtensions, InvisibleNodesHideAllBelowThemButCameras) {
    GltfParts parts;
    parts.scenes = R"([{"nodes": [0, 1, 4]}])";
    parts.nodes = R"([{"mesh": 0, "name": "seen", "extensions": {"KHR_node_visibility": {"visible": true}}},
                     {"mesh": 0, "children": [2, 3], "extensions": {"KHR_node_visibility": {"visible": false}}},
                     {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": true}}}, {"camera": 0, "name": "eye"},
                     {"mesh": 0, "name": "by default", "extensions": {"KHR_node_visibility": {}}}])";
    parts.cameras = R"([{"type": "perspective", "perspective": {"yfov": 1}}])";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "seen");
    EXPECT_EQ(scene.objects[1].name, "by default");
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.notes, std::vector<std::string>{"left out 2 nodes with a mesh that are not visible"});
    parts.nodes = R"([{"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": 0}}}])";
    parts.scenes = R"([{"nodes": [0]}])";
    EXPECT_TRUE(refuses(parts, {"nodes[0].extensions.KHR_node_visibility.visible: must be true or false"}));
    parts.nodes = R"([{"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}}}])";
    EXPECT_TRUE(refuses(parts, {"no node shows a mesh"}));
}

TEST_F(GltfNodeExtensions, MaterialsBelowTheirCutoffAreInvisible) {
    GltfParts parts;
    const auto polygons_with = [&](const std::string& material) {
        parts.materials = "[{" + material + "}]";
        parts.meshes =
            R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}, {"attributes": {"POSITION": 0}}]}])";
        const GltfScene scene = read(parts);
        EXPECT_EQ(scene.materials.at(0).opacity, 1.0f) << material;
        const std::size_t polygons = scene.meshes.at(0).polygon_count();
        std::vector<std::string> notes;
        if (polygons == 1) notes.push_back("left out 2 polygons that their alphaCutoff makes invisible");
        EXPECT_EQ(scene.notes, notes);
        return polygons;
    };
    const auto color = [](const char* alpha) {
        return R"("pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, )" + std::string(alpha) + "]}";
    };
    EXPECT_EQ(polygons_with(R"("alphaMode": "MASK", )" + color("0.4")), 1u);
    EXPECT_EQ(polygons_with(R"("alphaMode": "MASK", )" + color("0.5")), 3u) << "not below";
    EXPECT_EQ(polygons_with(R"("alphaMode": "MASK", "alphaCutoff": 0.3, )" + color("0.4")), 3u);
    EXPECT_EQ(polygons_with(R"("alphaMode": "MASK", "alphaCutoff": 2, )" + color("1")), 1u);
    EXPECT_EQ(polygons_with(R"("alphaMode": "MASK")"), 3u);
    EXPECT_EQ(polygons_with(R"("alphaMode": "OPAQUE", )" + color("0")), 3u);
    EXPECT_EQ(polygons_with(color("0")), 3u);
    parts.materials = R"([{"alphaMode": "MASK", "alphaCutoff": "x"}])";
    EXPECT_TRUE(refuses(parts, {"materials[0].alphaCutoff: must be a number"}));
    parts.materials = R"([{"alphaMode": "MASK", "alphaCutoff": -1}])";
    EXPECT_TRUE(refuses(parts, {"materials[0].alphaCutoff: must be 0 or more"}));
}

}  // namespace
}  // namespace burin
