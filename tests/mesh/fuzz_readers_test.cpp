#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "mesh/model.h"
#include "mesh/model_player.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::GltfParts;
using test::Random;

constexpr int kTrials = 3000;

/// Replaces one number in the text by a difficult one.
void replace_number(Random& random, std::string& bytes) {
    static constexpr const char* kNumbers[] = {"4294967295",
                                               "4294967296",
                                               "2147483648",
                                               "-1",
                                               "0",
                                               "-0",
                                               "1e31",
                                               "nan",
                                               "inf",
                                               "-inf",
                                               "1e400",
                                               "1e-400",
                                               "99999999999999999999",
                                               "9223372036854775807",
                                               "-9223372036854775808",
                                               "0.5",
                                               "400000000",
                                               "1e",
                                               "+-1",
                                               ""};
    const auto is_part = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == 'e'; };
    const std::size_t start = bytes.find_first_of(
        "0123456789", static_cast<std::size_t>(random.integer(0, static_cast<int>(bytes.size()) - 1)));
    if (start == std::string::npos) return;
    std::size_t end = start;
    while (end < bytes.size() && is_part(bytes[end])) ++end;
    bytes.replace(start, end - start, kNumbers[random.integer(0, static_cast<int>(std::size(kNumbers)) - 1)]);
}

/// Replaces four bytes by a difficult number.
void replace_word(Random& random, std::string& bytes) {
    static constexpr std::uint32_t kWords[] = {0xFFFFFFFF, 0x80000000, 0x7FFFFFFF, 0,          1,          0xFFFF,
                                               0x7FC00000, 0x7F800000, 0xFF800000, 0x7F7FFFFF, 0x00000001, 400000000};
    if (bytes.size() < 4) return;
    const std::uint32_t word = kWords[random.integer(0, static_cast<int>(std::size(kWords)) - 1)];
    bytes.replace(static_cast<std::size_t>(random.integer(0, static_cast<int>(bytes.size()) - 4)), 4,
                  ByteWriter(random.integer(0, 1) == 1).add({word}).bytes());
}

void mutate(Random& random, std::string& bytes) {
    if (bytes.empty()) return;
    const auto at = static_cast<std::size_t>(random.integer(0, static_cast<int>(bytes.size()) - 1));
    const auto length = static_cast<std::size_t>(random.integer(1, random.integer(0, 3) == 0 ? 64 : 4));
    switch (random.integer(0, 7)) {
        case 0:
            bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.integer(0, 7));
            break;
        case 1:
            bytes[at] = static_cast<char>(random.integer(0, 255));
            break;
        case 2:
            bytes.erase(at, length);
            break;
        case 3:
            bytes.insert(at, bytes.substr(static_cast<std::size_t>(random.integer(0, static_cast<int>(at))), length));
            break;
        case 4:
            bytes.insert(at, length, static_cast<char>(random.integer(0, 255)));
            break;
        case 5:
            bytes.resize(at);
            break;
        case 6:
            replace_number(random, bytes);
            break;
        default:
            replace_word(random, bytes);
            break;
    }
}

/// Reads many damaged versions of some good files. Each must be read, or refused by an InputError of
/// one line that starts with the path.
/// Plays an animation. Whatever it says must be a mesh, or an error.
void play(const std::string& path, const ModelPlayer& player, const std::string& what) {
    for (const double time_s : {-1.0, 0.0, 0.3, 1.0, 1e9}) {
        try {
            for (const auto& [number, mesh] : player.at(time_s).meshes) test::expect_consistent(mesh, what);
        } catch (const InputError& error) {
            throw InputError(path + ": " + error.what());
        }
    }
}

void fuzz(const std::string& extension, const std::vector<std::string>& good_files) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("model" + extension);
    int refused = 0;
    for (std::size_t file = 0; file < good_files.size(); ++file) {
        folder.write("model" + extension, good_files[file]);
        ASSERT_NO_THROW(read_model(path, {})) << "file " << file << " must be good before it is damaged";
        for (int trial = 0; trial < kTrials; ++trial) {
            Random random(static_cast<std::uint64_t>(trial));
            std::string bytes = good_files[file];
            for (int i = random.integer(1, random.integer(1, 6)); i > 0; --i) mutate(random, bytes);
            std::filesystem::remove(path);  // some file systems are slow to overwrite
            folder.write("model" + extension, bytes);
            const std::string what = "file " + std::to_string(file) + ", trial " + std::to_string(trial);
            try {
                MeshOptions options;
                if (trial % 2 == 1) options.attributes = AttributeWish::all();
                AnimationWish animations;
                animations.plays = trial % 3 > 0;
                const Model model = read_model(path, options, animations);
                for (const Mesh& mesh : model.meshes) test::expect_consistent(mesh, what);
                if (model.player) play(path, *model.player, what);
                ASSERT_FALSE(testing::Test::HasFatalFailure()) << what;
            } catch (const InputError& error) {
                const std::string message = error.what();
                ASSERT_EQ(message.find(path + ":"), 0u) << what << ": " << message;
                ASSERT_EQ(message.find_first_of("\n\r"), std::string::npos) << what << ": " << message;
                ++refused;
            } catch (const std::exception& error) {
                FAIL() << what << ": " << error.what();
            }
        }
    }
    const int trials = kTrials * static_cast<int>(good_files.size());
    EXPECT_GT(refused, trials / 20) << "the damage must matter";
    EXPECT_LT(refused, trials) << "some of it is harmless";
}

const std::string kCubeVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";

TEST(FuzzReaders, Obj) {
    fuzz(".obj",
         {
             "# a cube\n" + kCubeVertices + "f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
             "mtllib a.mtl\no left\nvt 0 0\nvn 0 0 1\n" + kCubeVertices +
                 "usemtl red\nf -8/1/1 -7/1/1 -6/1/1\no right\nf 1//1 2//1 \\\n3//1 7//1\nl 1 2 3\n",
             "g a b\r\n" + kCubeVertices + "f 1 2 3\r\ng c\r\nf 4 3 2 1 5\r\nf 1 1 2\r\nf 9 7 8\r\nv -1.5e-3 +2 .5",
             "v 0 0 0 1 0 0.5\nv 1 0 0 1\nv 1 1 0 0 1 1 1\nv 0 1 0\nvt 0 0\nvt 1 .5 0\nvt 1\nf 1/1 2/2 3/3/1\n"
             "f 1/-3 3/-2 4//2\nf 1/1 2/2 4/3 3/1\n",
         });
}

TEST(FuzzReaders, Ply) {
    const std::string vertices =
        "element vertex 4\nproperty float x\nproperty double y\nproperty short z\nproperty uchar red\n";
    const std::string rest =
        "element face 2\nproperty list uchar int vertex_indices\nproperty list ushort float other\n"
        "element tristrips 1\nproperty list int int vertex_indices\nelement edge 1\nproperty int vertex1\nproperty int "
        "vertex2\nend_header\n";
    std::vector<std::string> files{
        "ply\nformat ascii 1.0\ncomment x\n" + vertices + rest +
        "0 0 0 1\n1 0 0 2\n1 1 0 3\n0 1 1 4\n3 0 1 2 1 0.5\n4 0 1 2 3 0\n7 0 1 2 -1 1 2 3\n0 1\n"};
    for (const bool big_endian : {false, true}) {
        ByteWriter b(big_endian);
        for (const auto& [x, y, z] : {std::tuple{0.0f, 0.0, 0}, {1.0f, 0.0, 0}, {1.0f, 1.0, 0}, {0.0f, 1.0, 1}}) {
            b.add({x}).add({y}).add({static_cast<std::int16_t>(z)}).add<std::uint8_t>({7});
        }
        b.add<std::uint8_t>({3}).add<std::int32_t>({0, 1, 2}).add<std::uint16_t>({1}).add<float>({0.5f});
        b.add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3}).add<std::uint16_t>({0});
        b.add<std::int32_t>({7, 0, 1, 2, -1, 1, 2, 3}).add<std::int32_t>({0, 1});
        files.push_back(std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" +
                        vertices + rest + b.bytes());
    }
    files.push_back(
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar float vertex_index\nelement vertex 3\nproperty int "
        "x\n"
        "property int y\nproperty int z\nend_header\n3 0 1 2 0 0 0 1 0 0 0 1 0");
    files.push_back(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float s\nproperty float x\nproperty uchar red\n"
        "property float y\nproperty uchar green\nproperty float z\nproperty uchar blue\nproperty float t\n"
        "property int part\nelement face 2\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nend_header\n0 0 1 0 2 0 3 1 4\n1 1 9 0 9 0 9 1 5\n"
        "1 1 0 1 0 0 255 1 4\n0 0 7 1 7 0 7 1 3\n3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 0\n");
    fuzz(".ply", files);
}

TEST(FuzzReaders, Stl) {
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1.5e0 0\nendloop\nendfacet\n";
    ByteWriter binary;
    binary.add<std::uint32_t>({2});
    binary.add<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1.5f, 0}).add<std::uint16_t>({0});
    binary.add<float>({0, 0, 1, 0, 0, 0, 1, 1.5f, 0, 0, 1, 0}).add<std::uint16_t>({0});
    fuzz(".stl", {"solid a\n" + facet + facet + "endsolid a\n",
                  "solid a\n" + facet + "endsolid\nsolid b\n" + facet + "endsolid b",
                  std::string(80, ' ') + binary.bytes(), "solid" + std::string(75, ' ') + binary.bytes()});
}

TEST(FuzzReaders, Off) {
    const std::string positions = "0 0 0\n1 0 0\n1 1 0\n0 1.5 0\n";
    fuzz(".off", {"OFF\n4 2 0\n" + positions + "3 0 1 2\n4 0 1 2 3\n",
                  "COFF 4 2 5 # counts\n" + positions + "3 0 1 2 255 0 0\n3 0 2 3 0.5 0.5 0.5 1\n",
                  "# head\nNOFF\n\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 2 1 0"});
}

TEST(FuzzReaders, Gltf) {
    GltfParts tree;
    tree.scenes = R"([{"nodes": [0, 2]}])";
    tree.nodes =
        R"([{"children": [1], "rotation": [0, 0, 0, 1]}, {"mesh": 0, "scale": [1, 2, 3]}, {"camera": 0, "translation": [0, 0, 9]}])";
    tree.cameras = R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])";
    tree.materials = R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 0.5]}, "alphaMode": "BLEND"}])";
    tree.meshes =
        R"([{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}, {"attributes": {"POSITION": 0}, "mode": 5}]}])";
    GltfParts sparse;
    sparse.binary += ByteWriter().add<std::uint8_t>({1, 3, 0, 0}).add<float>({2, 0, 7, 0, 3, 7}).bytes();
    sparse.buffer_views =
        R"([{"buffer": 0, "byteLength": 48, "byteStride": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                             {"buffer": 0, "byteOffset": 60, "byteLength": 2}, {"buffer": 0, "byteOffset": 64, "byteLength": 24}])";
    sparse.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 2,
        "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 3}}}, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
    test::GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    a.add_indices({0, 1, 2, 0, 2, 3});
    a.add_vectors({0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0});
    a.add(ByteWriter().add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0}).bytes(), "VEC4", 5121, 4);
    a.add(ByteWriter().add<std::uint8_t>({255, 0, 0, 0, 9, 0, 0, 0, 7, 7, 0, 0, 99, 99, 0, 0}).bytes(), "VEC4", 5121, 4,
          R"("normalized": true)");
    a.add(ByteWriter().add<std::uint8_t>({0x22, 3}).bytes(), "SCALAR", 5121, 2);
    a.add(ByteWriter().add<std::int8_t>({0, 0, 127, 0, 90, 0, 0, 90}).bytes(), "VEC4", 5120, 2,
          R"("normalized": true)");
    a.add_vectors({0, 0, 1, 2, 2, 2});
    GltfParts posed;
    a.put_into(posed);
    posed.scenes = R"([{"nodes": [0, 1, 3]}])";
    posed.nodes =
        R"([{"mesh": 0, "skin": 0, "weights": [0.5]}, {"translation": [1, 2, 3], "children": [2]}, {"scale": [2, 2, 2]},
        {"mesh": 1, "extensions": {"KHR_node_visibility": {"visible": true}, "EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": 6, "SCALE": 7}}}}])";
    posed.skins = R"([{"joints": [1, 2]}])";
    posed.materials =
        R"([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 0.5]}, "alphaMode": "MASK", "alphaCutoff": 0.4}])";
    posed.meshes =
        R"([{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 3, "WEIGHTS_0": 4}, "indices": 1, "targets": [{"POSITION": 2}]}]},
        {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0, "extensions": {"EXT_mesh_primitive_edge_visibility": {"visibility": 5},
        "CESIUM_primitive_outline": {"indices": 1}}}, {"attributes": {"POSITION": 0}, "mode": 2}]}])";
    a.add(ByteWriter().add<float>({1, 2, 3, 4}).bytes(), "SCALAR", 5126, 4);
    a.add(ByteWriter().add<std::uint8_t>({0, 0, 255, 0, 255, 255, 0, 255}).bytes(), "VEC2", 5121, 4,
          R"("normalized": true)");
    GltfParts colored;
    a.put_into(colored);
    colored.scenes = R"([{"nodes": [0, 1]}])";
    colored.nodes = R"([{"mesh": 0}, {"mesh": 1}])";
    colored.meshes =
        R"([{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 4, "_UP": 8, "_WAY": 2}, "indices": 1}]},
        {"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 9}, "indices": 1}, {"attributes": {"POSITION": 0, "COLOR_0": 2}, "mode": 5}]}])";
    a.add(ByteWriter().add<float>({0, 1}).bytes(), "SCALAR", 5126, 2);
    a.add(ByteWriter().add<std::int8_t>({0, 0, 0, 127, 0, 90, 0, 90}).bytes(), "VEC4", 5120, 2,
          R"("normalized": true)");
    a.add(ByteWriter().add<float>({0, 0, 1, 1, 0, 0}).bytes(), "SCALAR", 5126, 6);
    GltfParts animated = posed;
    a.put_into(animated);
    animated.animations =
        R"([{"name": "a", "samplers": [{"input": 10, "output": 11}, {"input": 10, "output": 12, "interpolation": "CUBICSPLINE"},
        {"input": 10, "output": 7, "interpolation": "STEP"}], "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}},
        {"sampler": 1, "target": {"node": 0, "path": "weights"}}, {"sampler": 2, "target": {"node": 3, "path": "translation"}}]}])";
    fuzz(".gltf", {GltfParts{}.json(), tree.json(), sparse.json(), posed.json(), colored.json(), animated.json()});
    fuzz(".glb", {GltfParts{}.as_glb(), tree.as_glb(), sparse.as_glb(), posed.as_glb(), animated.as_glb()});
}

}  // namespace
}  // namespace burin
