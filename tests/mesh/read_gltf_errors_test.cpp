#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "mesh/gltf.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

GltfScene read_file(const std::string& path) { return read_gltf(path); }

using test::ByteWriter;
using test::GltfParts;

class ReadGltfErrors : public testing::Test {
  protected:
    testing::AssertionResult refuses_text(std::string_view text, std::initializer_list<std::string_view> parts) {
        return test::refuses(read_file, folder_.write("part.gltf", text), parts);
    }
    /// The good file with some parts changed.
    testing::AssertionResult refuses(const std::function<void(GltfParts&)>& change,
                                     std::initializer_list<std::string_view> parts) {
        GltfParts changed;
        change(changed);
        return refuses_text(changed.json(), parts);
    }
    static std::string accessors(const std::string& positions, const std::string& indices) {
        return "[{\"type\": \"VEC3\", " + positions + "}, {\"type\": \"SCALAR\", " + indices + "}]";
    }
    const std::string positions_ = R"("bufferView": 0, "componentType": 5126, "count": 4)";
    const std::string indices_ = R"("bufferView": 1, "componentType": 5123, "count": 6)";
    test::TemporaryFolder folder_;
};

TEST_F(ReadGltfErrors, TheFileThatTheyStartFromIsGood) {
    EXPECT_NO_THROW(read_gltf(folder_.write("part.gltf", GltfParts{}.json())));
    GltfParts same;
    same.accessors = accessors(positions_, indices_);
    EXPECT_NO_THROW(read_gltf(folder_.write("part.gltf", same.json())));
}

TEST_F(ReadGltfErrors, NodesMustFormATree) {
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "children": [0]}])"; },
                        {"nodes[0]: the node is reached twice"}));
    EXPECT_TRUE(
        refuses([](auto& p) { p.nodes = R"([{"children": [1]}, {"mesh": 0, "children": [2]}, {"children": [1]}])"; },
                {"nodes[1]: the node is reached twice"}));
    EXPECT_TRUE(refuses(
        [](auto& p) {
            p.scenes = R"([{"nodes": [0, 1]}])";
            p.nodes = R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])";
        },
        {"nodes[2]: the node is reached twice", "two parents"}));
    EXPECT_TRUE(refuses([](auto& p) { p.scenes = R"([{"nodes": [0, 0]}])"; }, {"nodes[0]: the node is reached twice"}));
    // Without scenes, a ring has no root at all.
    EXPECT_TRUE(refuses(
        [](auto& p) {
            p.scene = p.scenes = "";
            p.nodes = R"([{"mesh": 0, "children": [1]}, {"children": [0]}])";
        },
        {"no node shows a mesh"}));
}

TEST_F(ReadGltfErrors, NumbersOfThingsMustExist) {
    EXPECT_TRUE(refuses([](auto& p) { p.scene = "1"; }, {"scene: scene 1 does not exist (there are 1)"}));
    EXPECT_TRUE(
        refuses([](auto& p) { p.scenes = R"([{"nodes": [1]}])"; }, {"scenes[0].nodes[0]: node 1 does not exist"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "children": [7]}])"; },
                        {"nodes[0].children[0]: node 7 does not exist"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 1}])"; }, {"nodes[0].mesh: mesh 1 does not exist"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "camera": 0}])"; },
                        {"nodes[0].camera: camera 0 does not exist"}));
    EXPECT_TRUE(refuses([](auto& p) { p.meshes = R"([{"primitives": [{"attributes": {"POSITION": 2}}]}])"; },
                        {"meshes[0].primitives[0].attributes.POSITION: accessor 2 does not exist"}));
    EXPECT_TRUE(refuses(
        [](auto& p) { p.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 4294967296}]}])"; },
        {"meshes[0].primitives[0].indices: accessor 4294967296 does not exist"}));
    EXPECT_TRUE(
        refuses([](auto& p) { p.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}])"; },
                {"meshes[0].primitives[0].material: material 0 does not exist"}));
    EXPECT_TRUE(refuses([](auto& p) { p.buffer_views = R"([{"buffer": 1, "byteLength": 48}])"; },
                        {"bufferViews[0].buffer: buffer 1 does not exist"}));
    EXPECT_TRUE(refuses([](auto& p) { p.buffer_views = R"([{"buffer": 0, "byteLength": 48}])"; },
                        {"accessors[1].bufferView: buffer view 1 does not exist"}));
}

TEST_F(ReadGltfErrors, ValuesMustHaveTheirType) {
    for (const char* bad : {"-1", "0.5", "\"0\"", "null", "[]", "1e300", "-0.5"}) {
        EXPECT_TRUE(refuses([&](auto& p) { p.nodes = "[{\"mesh\": " + std::string(bad) + "}]"; },
                            {"nodes[0].mesh: must be an integer of 0 or more"}))
            << bad;
    }
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"({"mesh": 0})"; }, {"nodes: must be an array"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "name": 7}])"; }, {"nodes[0].name: must be a text"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "matrix": [1, 2]}])"; },
                        {"nodes[0].matrix: a matrix has 16 numbers"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "rotation": [0, 0, 1]}])"; },
                        {"nodes[0].rotation: needs 4 numbers"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "scale": [1, "x", 1]}])"; },
                        {"nodes[0].scale[1]: must be a number"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "scale": [1, 1e31, 1]}])"; },
                        {"nodes[0].scale[1]: the number is not finite or beyond 1e30"}));
    EXPECT_TRUE(refuses([](auto& p) { p.meshes = R"([{}])"; }, {"meshes[0]: 'primitives' is missing"}));
    EXPECT_TRUE(
        refuses([](auto& p) { p.meshes = R"([{"primitives": {}}])"; }, {"meshes[0].primitives: must be an array"}));
    EXPECT_TRUE(refuses([](auto& p) { p.meshes = R"([{"primitives": [{}]}])"; },
                        {"meshes[0].primitives[0]: 'attributes' is missing"}));
    EXPECT_TRUE(refuses([](auto& p) { p.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0}, "mode": 7}]}])"; },
                        {"meshes[0].primitives[0]: unknown mode 7"}));
    EXPECT_TRUE(refuses([](auto& p) { p.materials = R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 1]}}])"; },
                        {"materials[0].pbrMetallicRoughness.baseColorFactor: element 2 does not exist"}));
    EXPECT_TRUE(refuses(
        [](auto& p) {
            p.nodes = R"([{"mesh": 0, "camera": 0}])";
            p.cameras = R"([{"type": "perspective"}])";
        },
        {"cameras[0]: 'perspective' is missing"}));
}

TEST_F(ReadGltfErrors, PlacesOfNodesMustStayFinite) {
    // Each scale is within reason; forty of them are not.
    std::string nodes = "[";
    for (int i = 0; i < 40; ++i) nodes += R"({"scale": [1e30, 1, 1], "children": [)" + std::to_string(i + 1) + "]}, ";
    EXPECT_TRUE(refuses([&](auto& p) { p.nodes = nodes + R"({"mesh": 0}])"; }, {"nodes[1]: ", "1e30"}));
}

TEST_F(ReadGltfErrors, AccessorsMustLieInTheirViews) {
    const auto with = [&](const std::string& positions, const std::string& indices) {
        return [=](GltfParts& p) { p.accessors = accessors(positions, indices); };
    };
    EXPECT_TRUE(refuses(with(R"("bufferView": 0, "componentType": 5126, "count": 5)", indices_),
                        {"accessors[0]: reaches beyond its buffer view of 48 bytes"}));
    EXPECT_TRUE(refuses(with(R"("bufferView": 0, "byteOffset": 1, "componentType": 5126, "count": 4)", indices_),
                        {"accessors[0]: reaches beyond its buffer view"}));
    EXPECT_TRUE(refuses(
        with(R"("bufferView": 0, "byteOffset": 18446744073709551615, "componentType": 5126, "count": 4)", indices_),
        {"accessors[0]: reaches beyond its buffer view"}));
    EXPECT_TRUE(refuses(with(positions_, R"("bufferView": 1, "componentType": 5123, "count": 7)"),
                        {"accessors[1]: reaches beyond its buffer view of 12 bytes"}));
    EXPECT_TRUE(refuses(with(positions_, R"("bufferView": 1, "componentType": 5125, "count": 6)"),
                        {"accessors[1]: reaches beyond its buffer view"}));
    EXPECT_TRUE(refuses(with(R"("bufferView": 0, "componentType": 5126, "count": 4000000000)", indices_),
                        {"accessors[0]: reaches beyond its buffer view"}));
    EXPECT_TRUE(refuses(with(R"("bufferView": 0, "componentType": 5126, "count": 40000000000)", indices_),
                        {"accessors[0]: more than 4 billion"}));
    EXPECT_TRUE(refuses(with(R"("componentType": 5126, "count": 4000000000)", indices_),
                        {"accessors[0]: has no data for its 4000000000 elements"}));
    EXPECT_TRUE(refuses(with(positions_, R"("componentType": 5125, "count": 4000000000)"),
                        {"accessors[1]: has no data for its 4000000000 elements"}));
    EXPECT_TRUE(refuses(with(R"("bufferView": 0, "componentType": 5124, "count": 4)", indices_),
                        {"accessors[0]: unknown componentType"}));
    EXPECT_TRUE(refuses(with(positions_, R"("bufferView": 1, "componentType": 5126, "count": 3)"),
                        {"meshes[0].primitives[0].indices: indices must be integers"}));
    EXPECT_TRUE(refuses([](auto& p) { p.meshes = R"([{"primitives": [{"attributes": {"POSITION": 1}}]}])"; },
                        {"accessors[1]: the type must be VEC3"}));
    EXPECT_TRUE(
        refuses([](auto& p) { p.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 0}]}])"; },
                {"accessors[0]: the type must be SCALAR"}));
    EXPECT_TRUE(
        refuses(with("\"bufferView\": 0, \"componentType\": 5126", indices_), {"accessors[0]: 'count' is missing"}));
}

TEST_F(ReadGltfErrors, ViewsMustLieInTheirBuffers) {
    const auto first_view = [](const std::string& view) {
        return [=](GltfParts& p) {
            p.buffer_views = "[{\"buffer\": 0, " + view + R"(}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
        };
    };
    EXPECT_TRUE(
        refuses(first_view(R"("byteLength": 61)"), {"bufferViews[0]: the view reaches beyond its buffer of 60 bytes"}));
    EXPECT_TRUE(refuses(first_view(R"("byteOffset": 13, "byteLength": 48)"),
                        {"bufferViews[0]: the view reaches beyond its buffer"}));
    EXPECT_TRUE(refuses(first_view(R"("byteOffset": 18446744073709551615, "byteLength": 48)"),
                        {"bufferViews[0]: the view reaches beyond"}));
    EXPECT_TRUE(refuses(first_view(R"("byteOffset": 1, "byteLength": 18446744073709551615)"),
                        {"bufferViews[0]: the view reaches beyond"}));
    EXPECT_TRUE(refuses(first_view(R"("byteLength": 48, "byteStride": 4)"),
                        {"accessors[0]: the byteStride is too small or large"}));
    EXPECT_TRUE(
        refuses(first_view(R"("byteLength": 48, "byteStride": 13)"), {"accessors[0]: reaches beyond its buffer view"}));
    EXPECT_TRUE(refuses(first_view(R"("byteLength": 48, "byteStride": 18446744073709551615)"),
                        {"accessors[0]: the byteStride"}));
    EXPECT_TRUE(refuses(first_view(R"("byteOffset": 0)"), {"bufferViews[0]: 'byteLength' is missing"}));
}

TEST_F(ReadGltfErrors, BuffersMustBeThereInFull) {
    EXPECT_TRUE(
        refuses([](auto& p) { p.buffers = "[{\"byteLength\": 61, \"uri\": \"" + test::data_uri(p.binary) + "\"}]"; },
                {"buffers[0]: byteLength is 61, but there are only 60 bytes"}));
    EXPECT_TRUE(refuses([](auto& p) { p.buffers = R"([{"byteLength": 60}])"; },
                        {"buffers[0]: the buffer has neither a URI nor a binary chunk"}));
    EXPECT_TRUE(refuses([](auto& p) { p.buffers = R"([{"byteLength": 60, "uri": "none.bin"}])"; },
                        {"buffers[0].uri: ", "none.bin", "No such file"}));
    EXPECT_TRUE(
        refuses([](auto& p) { p.buffers = R"([{"byteLength": 60, "uri": "a%0Ab.bin"}])"; }, {"buffers[0].uri: "}));
    EXPECT_TRUE(refuses([](auto& p) { p.buffers = R"([{"byteLength": 60, "uri": "https://example.org/a.bin"}])"; },
                        {"buffers[0].uri: "}));
    folder_.write("short.bin", "too short");
    EXPECT_TRUE(refuses([](auto& p) { p.buffers = R"([{"byteLength": 60, "uri": "short.bin"}])"; },
                        {"buffers[0]: byteLength is 60, but there are only 9 bytes"}));
    for (const char* uri : {"data:text/plain,abc", "data:;base64", "data:;base64,A*BC", "data:;base64,AA AA"}) {
        EXPECT_TRUE(
            refuses([&](auto& p) { p.buffers = "[{\"byteLength\": 60, \"uri\": \"" + std::string(uri) + "\"}]"; },
                    {"buffers[0].uri: the data URI is not base64"}))
            << uri;
    }
}

TEST_F(ReadGltfErrors, IndicesMustExist) {
    const auto with_index = [](std::uint16_t bad) {
        return [=](GltfParts& p) {
            p.binary = test::square_positions() + ByteWriter().add<std::uint16_t>({0, 1, bad, 0, 2, 3}).bytes();
        };
    };
    EXPECT_TRUE(refuses(with_index(4), {"meshes[0].primitives[0].indices: vertex 4 does not exist (there are 4)"}));
    EXPECT_TRUE(refuses(with_index(65535), {"meshes[0].primitives[0].indices: vertex 65535 does not exist"}));
    EXPECT_TRUE(refuses(
        [&](auto& p) {
            p.binary = test::square_positions() + ByteWriter().add<std::int16_t>({0, 1, -1, 0, 2, 3}).bytes();
            p.accessors = accessors(positions_, R"("bufferView": 1, "componentType": 5122, "count": 6)");
        },
        {"meshes[0].primitives[0].indices: vertex -1 does not exist"}));
}

TEST_F(ReadGltfErrors, CoordinatesMustBeFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.1e30f}) {
        EXPECT_TRUE(refuses(
            [&](auto& p) {
                p.binary =
                    ByteWriter().add<float>({0, 0, 0, 1, 0, 0, 1, bad, 0, 0, 1, 0}).bytes() + test::square_indices();
            },
            {"meshes[0].primitives[0].attributes.POSITION: vertex 2 is not finite or beyond 1e30"}));
    }
}

TEST_F(ReadGltfErrors, SparseValuesMustFit) {
    const auto sparse = [&](const std::string& text, const std::string& start = R"("bufferView": 0, )") {
        return [=, this](GltfParts& p) {
            p.binary += std::string(40, '\0') + ByteWriter().add<std::uint16_t>({9, 1}).bytes();
            p.buffer_views = R"([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                                {"buffer": 0, "byteOffset": 60, "byteLength": 40}, {"buffer": 0, "byteOffset": 100, "byteLength": 4}])";
            p.accessors = accessors(start + R"("componentType": 5126, "count": 4, "sparse": )" + text, indices_);
        };
    };
    const std::string values = R"("values": {"bufferView": 2})";
    const std::string indices = R"("indices": {"bufferView": 2, "componentType": 5123}, )";
    EXPECT_TRUE(refuses(sparse(R"({"count": 5, )" + indices + values + "}"),
                        {"accessors[0].sparse: more sparse values than elements"}));
    EXPECT_TRUE(refuses(sparse(R"({"count": 4, )" + indices + values + "}"),
                        {"accessors[0].sparse.values: reaches beyond its buffer view"}));
    EXPECT_TRUE(refuses(sparse(R"({"count": 1, "indices": {"bufferView": 3, "componentType": 5123}, )" + values + "}"),
                        {"accessors[0].sparse.indices: a sparse index lies beyond the accessor"}));
    EXPECT_TRUE(refuses(sparse(R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5126}, )" + values + "}"),
                        {"accessors[0].sparse.indices: unknown componentType"}));
    EXPECT_TRUE(refuses(sparse(R"({"count": 1, )" + values + "}"), {"accessors[0].sparse: 'indices' is missing"}));
    EXPECT_TRUE(refuses(
        [&](auto& p) {
            p.accessors = accessors(R"("componentType": 5126, "count": 4000000000, "sparse": {"count": 1})", indices_);
        },
        {"accessors[0]: has no data"}));
}

TEST_F(ReadGltfErrors, UnknownVersionsAndExtensionsAreRefused) {
    EXPECT_TRUE(refuses([](auto& p) { p.asset = R"({"version": "1.0"})"; }, {"glTF version 1.0 is not read"}));
    EXPECT_TRUE(refuses([](auto& p) { p.asset = R"({"version": 1})"; }, {"glTF version 1 is not read"}));
    EXPECT_TRUE(refuses([](auto& p) { p.asset = ""; }, {"no 'asset'"}));
    EXPECT_TRUE(refuses([](auto& p) { p.required = R"(["KHR_materials_unlit", "CESIUM_RTC"])"; },
                        {"needs the glTF extension CESIUM_RTC"}));
    EXPECT_TRUE(refuses([](auto& p) { p.required = R"(["KHR_meshopt_compression"])"; },
                        {"needs the glTF extension KHR_meshopt_compression"}));
    EXPECT_TRUE(refuses_text("[1, 2]", {"no 'asset'"}));
    EXPECT_TRUE(refuses_text("7", {"no 'asset'"}));
    GltfParts parts;
    for (const char* harmless :
         {"KHR_materials_unlit", "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp",
          "KHR_lights_punctual", "EXT_lights_image_based", "KHR_xmp_json_ld", "EXT_structural_metadata",
          "EXT_mesh_features", "KHR_mesh_quantization", "KHR_node_visibility", "EXT_mesh_gpu_instancing",
          "EXT_meshopt_compression", "KHR_draco_mesh_compression"}) {
        parts.required = "[\"" + std::string(harmless) + "\"]";
        EXPECT_NO_THROW(read_gltf(folder_.write("part.gltf", parts.json()))) << harmless;
    }
}

TEST_F(ReadGltfErrors, MalformedJsonIsRefusedWithItsLine) {
    const std::string whole = GltfParts{}.json();
    for (std::size_t size = 1; size < whole.size() - 3; size += 7) {
        EXPECT_TRUE(refuses_text(whole.substr(0, size), {"the JSON breaks off at byte"})) << size;
    }
    EXPECT_TRUE(refuses_text("{\n\"asset\": {\"version\" \"2.0\"}}",
                             {":2: the JSON is malformed at byte ", "at '\"2.0\"'", "export the file again"}));
    EXPECT_TRUE(
        refuses([](auto& p) { p.nodes = "[{\"mesh\": 0, \"name\": \"\xFF\xFE\"}]"; }, {":5: the JSON is malformed"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "scale": [1e999, 1, 1]}])"; }, {"number"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "scale": [nan, 1, 1]}])"; },
                        {":5: ", "at 'nan'", "no such number"}));
    EXPECT_TRUE(refuses([](auto& p) { p.nodes = R"([{"mesh": 0, "scale": [1, -Infinity, 1]}])"; },
                        {":5: ", "at '-Infinity'", "no such number"}));
    EXPECT_TRUE(refuses_text(std::string(100000, '['), {"nested too deeply"}));
    EXPECT_TRUE(refuses_text(std::string(100000, '[') + std::string(100000, ']'), {"nested too deeply"}));
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    EXPECT_TRUE(refuses_text(objects, {"nested too deeply"}));
    EXPECT_TRUE(refuses_text("", {"empty"}));
}

TEST_F(ReadGltfErrors, TruncatedGlbIsRefused) {
    const std::string whole = GltfParts{}.as_glb();
    for (std::size_t size = 1; size < whole.size(); ++size) {
        EXPECT_TRUE(test::refuses(read_file, folder_.write("part.glb", whole.substr(0, size)), {})) << "after " << size;
    }
    const auto refuses_glb = [&](std::size_t at, std::uint32_t value, std::string_view part) {
        std::string bytes = whole;
        bytes.replace(at, 4, ByteWriter().add<std::uint32_t>({value}).bytes());
        return test::refuses(read_file, folder_.write("part.glb", bytes), {part});
    };
    const auto size = static_cast<std::uint32_t>(whole.size());
    EXPECT_TRUE(refuses_glb(4, 1, "only GLB version 2"));
    EXPECT_TRUE(refuses_glb(8, size + 1, "shorter than its header says"));
    EXPECT_TRUE(refuses_glb(8, 0xFFFFFFFF, "shorter than its header says"));
    EXPECT_TRUE(refuses_glb(8, 11, "no JSON chunk"));
    EXPECT_TRUE(refuses_glb(8, 0, "no JSON chunk"));
    EXPECT_TRUE(refuses_glb(8, size - 1, "a chunk is longer than the file"));
    EXPECT_TRUE(refuses_glb(12, 0xFFFFFFFF, "a chunk is longer than the file"));
    EXPECT_TRUE(refuses_glb(16, 0x12345678, "no JSON chunk"));
}

}  // namespace
}  // namespace burin
