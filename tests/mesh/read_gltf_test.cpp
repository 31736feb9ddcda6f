#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "mesh/gltf.h"
#include "mesh/model.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin::read_gltf_test {
namespace {

GltfScene read_file(const std::string& path) { return read_gltf(path); }

using test::ByteWriter;
using test::GltfParts;
using test::Polygons;
using test::polygons_of;

const Polygons kSquareTriangles{{0, 1, 2}, {0, 2, 3}};

class ReadGltf : public testing::Test {
  protected:
    GltfScene read(const GltfParts& parts) { return read_gltf(folder_.write("part.gltf", parts.json())); }
    Model read_as_model(const GltfParts& parts) { return read_model(folder_.write("part.gltf", parts.json()), {}); }
    test::TemporaryFolder folder_;
};

void expect_near(const glm::dvec4& a, const glm::dvec4& b) {
    EXPECT_LT(glm::distance(a, b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST_F(ReadGltf, ReadsTextWithADataUri) {
    const GltfScene scene = read({});
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(polygons_of(scene.meshes[0]), kSquareTriangles);
    EXPECT_EQ(scene.meshes[0].positions[2], glm::dvec3(1, 1, 0));
    EXPECT_EQ(scene.mesh_names, std::vector<std::string>{"quad"});
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "square");
    EXPECT_EQ(scene.objects[0].to_world, glm::dmat4(1.0));
    EXPECT_TRUE(scene.cameras.empty());
}

TEST_F(ReadGltf, ReadsGlb) {
    for (const char* name : {"part.glb", "part.GLB", "glb_by_content.gltf"}) {
        const Model model = read_model(folder_.write(name, GltfParts{}.as_glb()), {});
        ASSERT_EQ(model.meshes.size(), 1u);
        EXPECT_EQ(model.meshes[0].triangles.size(), 2u);
        EXPECT_EQ(model.objects[0].name, "square");
    }
    // Chunks of other kinds, and bytes behind the length in the header, are passed over.
    const std::string more = GltfParts{}.as_glb();
    EXPECT_EQ(read_gltf(folder_.write("a.glb", more + std::string(20, '\x7F'))).meshes.size(), 1u);
    std::string other = more + ByteWriter().add<std::uint32_t>({4, 0x12345678, 0}).bytes();
    other.replace(8, 4, ByteWriter().add<std::uint32_t>({static_cast<std::uint32_t>(other.size())}).bytes());
    EXPECT_EQ(read_gltf(folder_.write("b.glb", other)).meshes.size(), 1u);
    // A GLB may also keep its buffers elsewhere.
    EXPECT_EQ(read_gltf(folder_.write("c.glb", test::glb(GltfParts{}.json(), ""))).meshes.size(), 1u);
}

TEST_F(ReadGltf, TransformsOfParentsComeFirst) {
    GltfParts parts;
    parts.nodes = R"([{"children": [1], "translation": [10, 0, 0], "scale": [2, 3, 4],
                       "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
                      {"children": [2], "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 1,2,3,1]}, {"mesh": 0}])";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.objects.size(), 1u);
    EXPECT_EQ(scene.objects[0].name, "node2");
    // (0,0,0) -> moved (1,2,3) -> scaled (2,6,12) -> turned a quarter (-6,2,12) -> moved (4,2,12)
    expect_near(scene.objects[0].to_world * glm::dvec4(0, 0, 0, 1), {4, 2, 12, 1});
    expect_near(scene.objects[0].to_world * glm::dvec4(1, 0, 0, 0), {0, 2, 0, 0});
    expect_near(scene.objects[0].to_world * glm::dvec4(0, 1, 0, 0), {-3, 0, 0, 0});
    expect_near(scene.objects[0].to_world * glm::dvec4(0, 0, 1, 0), {0, 0, 4, 0});
}

TEST_F(ReadGltf, NodesThatShowOneMeshShareIt) {
    GltfParts parts;
    parts.scenes = R"([{"nodes": [0, 1]}])";
    parts.nodes = R"([{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b", "translation": [5, 0, 0]}])";
    const Model model = read_as_model(parts);
    EXPECT_EQ(model.meshes.size(), 1u);
    ASSERT_EQ(model.objects.size(), 2u);
    EXPECT_EQ(model.objects[0].name, "a");
    EXPECT_EQ(model.objects[1].name, "b");
    EXPECT_EQ(model.objects[0].mesh, model.objects[1].mesh);
    EXPECT_EQ(model.objects[1].to_world[3], glm::dvec4(5, 0, 0, 1));
}

TEST_F(ReadGltf, ObjectsStandInTheOrderOfTheTree) {
    GltfParts parts;
    parts.scenes = R"([{"nodes": [3, 0]}])";
    parts.nodes = R"([{"mesh": 0, "name": "d"}, {"mesh": 0, "name": "b"}, {"mesh": 0, "name": "c"},
                     {"mesh": 0, "name": "a", "children": [1, 2]}])";
    std::string names;
    for (const GltfObject& o : read(parts).objects) names += o.name;
    EXPECT_EQ(names, "abcd");
}

TEST_F(ReadGltf, OnlyTheDefaultSceneCounts) {
    GltfParts parts;
    parts.scenes = R"([{"nodes": [0]}, {"nodes": [1]}])";
    parts.nodes = R"([{"mesh": 0, "name": "first"}, {"mesh": 0, "name": "second"}])";
    EXPECT_EQ(read(parts).objects.at(0).name, "first");
    parts.scene = "1";
    EXPECT_EQ(read(parts).objects.at(0).name, "second");
    parts.scene = "";
    EXPECT_EQ(read(parts).objects.at(0).name, "first");
}

TEST_F(ReadGltf, WithoutScenesAllNodesWithoutAParentAreShown) {
    GltfParts parts;
    parts.scene = parts.scenes = "";
    parts.nodes =
        R"([{"mesh": 0, "name": "child", "translation": [0, 0, 1]}, {"children": [0], "translation": [1, 0, 0]},
                     {"mesh": 0, "name": "root"}])";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "child");
    EXPECT_EQ(scene.objects[0].to_world[3], glm::dvec4(1, 0, 1, 1));
    EXPECT_EQ(scene.objects[1].name, "root");
}

TEST_F(ReadGltf, CamerasStandWhereTheirNodesPutThem) {
    GltfParts parts;
    parts.scenes = R"([{"nodes": [0, 1, 3]}])";
    parts.nodes = R"([{"mesh": 0}, {"translation": [0, 0, 5], "children": [2]},
                     {"camera": 0, "name": "eye", "translation": [1, 0, 0]}, {"camera": 1}])";
    parts.cameras = R"([{"type": "perspective", "perspective": {"yfov": 1.5707963267948966, "znear": 0.1}},
                       {"type": "orthographic", "name": "plan", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 9}}])";
    const Model model = read_as_model(parts);
    ASSERT_EQ(model.cameras.size(), 2u);
    EXPECT_EQ(model.cameras[0].name, "eye");
    EXPECT_FALSE(model.cameras[0].orthographic);
    EXPECT_NEAR(model.cameras[0].fov_deg, 90, 1e-12);
    EXPECT_EQ(model.cameras[0].to_world[3], glm::dvec4(1, 0, 5, 1));
    EXPECT_EQ(model.cameras[1].name, "plan");
    EXPECT_TRUE(model.cameras[1].orthographic);
    EXPECT_EQ(model.cameras[1].height, 4);
}

TEST_F(ReadGltf, MaterialsGiveColourAndOpacity) {
    GltfParts parts;
    parts.materials =
        R"([{"name": "glass", "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 2, 0.5]}},
                         {"pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 0.5]}}, {"name": "plain"}])";
    parts.meshes = R"([{"primitives": [
        {"attributes": {"POSITION": 0}, "indices": 1, "material": 1}, {"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
        {"attributes": {"POSITION": 0}, "indices": 1}]}])";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.materials.size(), 4u);
    EXPECT_EQ(scene.materials[0].name, "glass");
    EXPECT_EQ(scene.materials[0].color, glm::vec3(0.5, 0.25, 1));
    EXPECT_EQ(scene.materials[0].opacity, 0.5f);
    EXPECT_EQ(scene.materials[1].color, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.materials[1].opacity, 1.0f) << "alphaMode is OPAQUE";
    EXPECT_EQ(scene.materials[2].color, glm::vec3(1)) << "the factor that glTF names as the default";
    EXPECT_EQ(scene.materials[3].name, "default");
    EXPECT_EQ(scene.meshes[0].polygon_material, (std::vector<std::uint32_t>{1, 1, 0, 0, 3, 3}));
    EXPECT_EQ(scene.mesh_names[0], "mesh0");
}

TEST_F(ReadGltf, PrimitivesThatShareVerticesShareThemInTheMesh) {
    GltfParts parts;
    parts.meshes =
        R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}, {"attributes": {"POSITION": 0}}]}])";
    const GltfScene scene = read(parts);
    EXPECT_EQ(scene.meshes[0].positions.size(), 4u);
    EXPECT_EQ(polygons_of(scene.meshes[0]), (Polygons{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
}

TEST_F(ReadGltf, PrimitivesWithOwnVerticesFollowEachOther) {
    GltfParts parts;
    parts.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                         {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                         {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}])";
    parts.meshes =
        R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}, {"attributes": {"POSITION": 2}}]}])";
    EXPECT_EQ(polygons_of(read(parts).meshes[0]), (Polygons{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}));
}

TEST_F(ReadGltf, BuffersMayBeFilesInTheFolderOrBelow) {
    GltfParts parts;
    folder_.write("sub/my data.bin", parts.binary);
    folder_.write("real.bin", parts.binary + "tail");
    std::filesystem::create_symlink("real.bin", folder_.file("link.bin"));
    for (const char* uri :
         {"sub/my%20data.bin", "sub/my data.bin", "./real.bin", "real%2Ebin", "sub/../real.bin", "link.bin"}) {
        parts.buffers = R"([{"byteLength": 60, "uri": ")" + std::string(uri) + "\"}]";
        EXPECT_EQ(polygons_of(read(parts).meshes[0]), kSquareTriangles) << uri;
    }
}

TEST_F(ReadGltf, UrisThatLeaveTheFolderAreRefused) {
    GltfParts parts;
    const std::string outside = folder_.write("x.bin", parts.binary);
    folder_.write("inside/readme", "-");
    std::filesystem::create_symlink("../x.bin", folder_.file("inside/link.bin"));
    std::filesystem::create_directory_symlink("..", folder_.file("inside/up"));
    for (const std::string& uri : {std::string("../x.bin"), outside, std::string("link.bin"), std::string("up/x.bin"),
                                   std::string("%2E%2E/x.bin"), std::string("..%2Fx.bin"), std::string(""),
                                   std::string("."), std::string("x.bin%00")}) {
        parts.buffers = "[{\"byteLength\": 60, \"uri\": \"" + uri + "\"}]";
        EXPECT_TRUE(test::refuses(read_file, folder_.write("inside/part.gltf", parts.json()),
                                  {"buffers[0].uri: ", "leads out of the model's folder"}))
            << uri;
    }
}

TEST_F(ReadGltf, StripsAndFansBecomeTrianglesOfOneWinding) {
    GltfParts parts;
    parts.binary = ByteWriter().add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}).bytes();
    parts.buffer_views = R"([{"buffer": 0, "byteLength": 60}])";
    parts.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"}])";
    parts.meshes = R"([{"primitives": [{"mode": 5, "attributes": {"POSITION": 0}}]}])";
    EXPECT_EQ(polygons_of(read(parts).meshes[0]), (Polygons{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
    parts.meshes = R"([{"primitives": [{"mode": 6, "attributes": {"POSITION": 0}}]}])";
    EXPECT_EQ(polygons_of(read(parts).meshes[0]), (Polygons{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
    parts.meshes = R"([{"primitives": [{"mode": 4, "attributes": {"POSITION": 0}}]}])";
    EXPECT_EQ(polygons_of(read(parts).meshes[0]), (Polygons{{0, 1, 2}})) << "two vertices are left over";
}

TEST_F(ReadGltf, PointsAndWhatHasNoPositionsAreSkippedAndCounted) {
    GltfParts parts;
    parts.meshes =
        R"([{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}, {"mode": 0, "attributes": {"POSITION": 0}},
                      {"attributes": {"NORMAL": 0}}, {"attributes": {"POSITION": 0}, "indices": 1}]}])";
    const Model model = read_as_model(parts);
    const std::string path = folder_.path() + "/part.gltf";
    EXPECT_EQ(model.skipped_primitives, 3u);
    EXPECT_EQ(model.notes, (std::vector<std::string>{path + ": left out 2 primitives of points",
                                                     path + ": left out 1 primitive without positions"}));
    EXPECT_EQ(model.meshes[0].triangles.size(), 2u);
}

TEST_F(ReadGltf, IndicesMayHaveOneTwoOrFourBytes) {
    GltfParts parts;
    const auto with_indices = [&](const std::string& bytes, const char* type) {
        parts.binary = test::square_positions() + bytes;
        parts.buffer_views = R"([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": )" +
                             std::to_string(bytes.size()) + "}]";
        parts.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                             {"bufferView": 1, "normalized": true, "componentType": )" +
                          std::string(type) + R"(, "count": 6, "type": "SCALAR"}])";
        return polygons_of(read(parts).meshes[0]);
    };
    // "normalized" means nothing for indices.
    EXPECT_EQ(with_indices(ByteWriter().add<std::uint8_t>({0, 1, 2, 0, 2, 3}).bytes(), "5121"), kSquareTriangles);
    EXPECT_EQ(with_indices(ByteWriter().add<std::uint16_t>({0, 1, 2, 0, 2, 3}).bytes(), "5123"), kSquareTriangles);
    EXPECT_EQ(with_indices(ByteWriter().add<std::uint32_t>({0, 1, 2, 0, 2, 3}).bytes(), "5125"), kSquareTriangles);
}

TEST_F(ReadGltf, VerticesMayBeInterleavedWithOtherData) {
    GltfParts parts;
    parts.binary = ByteWriter().add<float>({9, 9, 0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 1, 1, 0}).bytes();
    parts.buffer_views = R"([{"buffer": 0, "byteLength": 60, "byteStride": 20}])";
    parts.accessors = R"([{"bufferView": 0, "byteOffset": 8, "componentType": 5126, "count": 3, "type": "VEC3"}])";
    parts.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0}}]}])";
    EXPECT_EQ(read(parts).meshes[0].positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
}

TEST_F(ReadGltf, QuantizedPositionsAreScaledIfNormalized) {
    GltfParts parts;
    parts.required = R"(["KHR_mesh_quantization"])";
    parts.binary = ByteWriter().add<std::int16_t>({0, 0, 0, 0, 32767, -32767, -32768, 0, 0, 16384, 100, 0}).bytes();
    parts.buffer_views = R"([{"buffer": 0, "byteLength": 24, "byteStride": 8}])";
    parts.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0}}]}])";
    const auto positions = [&](const char* normalized) {
        parts.accessors = R"([{"bufferView": 0, "componentType": 5122, "count": 3, "type": "VEC3", "normalized": )" +
                          std::string(normalized) + "}]";
        return read(parts).meshes[0].positions;
    };
    EXPECT_EQ(positions("true"),
              (std::vector<glm::dvec3>{{0, 0, 0}, {1, -1, -1}, {0, 16384 / 32767.0, 100 / 32767.0}}));
    EXPECT_EQ(positions("false"), (std::vector<glm::dvec3>{{0, 0, 0}, {32767, -32767, -32768}, {0, 16384, 100}}));
    parts.binary = ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 255, 51, 0, 0, 0, 0, 255, 0}).bytes();
    parts.buffer_views = R"([{"buffer": 0, "byteLength": 12, "byteStride": 4}])";
    parts.accessors = R"([{"bufferView": 0, "componentType": 5121, "count": 3, "type": "VEC3", "normalized": true}])";
    EXPECT_EQ(read(parts).meshes[0].positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0.2, 0}, {0, 0, 1}}));
}

TEST_F(ReadGltf, SparseAccessorsReplaceSomeValues) {
    GltfParts parts;
    parts.binary += ByteWriter().add<std::uint8_t>({1, 3, 0, 0}).add<float>({2, 0, 7, 0, 3, 7}).bytes();
    parts.buffer_views = R"([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                            {"buffer": 0, "byteOffset": 60, "byteLength": 2}, {"buffer": 0, "byteOffset": 64, "byteLength": 24}])";
    const std::string sparse = R"("componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 2,
        "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 3}}})";
    const std::string indices = R"(, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
    parts.accessors = R"([{"bufferView": 0, )" + sparse + indices;
    EXPECT_EQ(read(parts).meshes[0].positions, (std::vector<glm::dvec3>{{0, 0, 0}, {2, 0, 7}, {1, 1, 0}, {0, 3, 7}}));
    parts.accessors = "[{" + sparse + indices;  // without a view the rest is zero
    EXPECT_EQ(read(parts).meshes[0].positions, (std::vector<glm::dvec3>{{0, 0, 0}, {2, 0, 7}, {0, 0, 0}, {0, 3, 7}}));
}

TEST_F(ReadGltf, SurfacesThatHaveNothingToDrawAreRefusedByReadModel) {
    GltfParts parts;
    parts.meshes = R"([{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}])";
    EXPECT_TRUE(test::refuses([](const std::string& p) { read_model(p, {}); }, folder_.write("part.gltf", parts.json()),
                              {"no polygon with an area"}));
    EXPECT_TRUE(test::refuses([](const std::string& p) { read_model(p, {}); }, folder_.write("part.xyz", "x"),
                              {"unknown kind of model '.xyz'", ".gltf"}));
}

}  // namespace
}  // namespace burin::read_gltf_test
