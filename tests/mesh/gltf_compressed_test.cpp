#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "mesh/gltf.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::ByteWriter;
using test::GltfParts;
using test::Random;

constexpr std::size_t kVertices = 300, kTriangles = 450;

/// Some triangles on vertices at random.
std::vector<std::uint32_t> some_indices() {
    Random random(3);
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < 3 * kTriangles; ++i)
        indices.push_back(static_cast<std::uint32_t>(random.integer(0, kVertices - 1)));
    return indices;
}

std::vector<float> some_positions() {
    Random random(4);
    std::vector<float> positions;
    for (std::size_t i = 0; i < 3 * kVertices; ++i)
        positions.push_back(static_cast<float>(random.integer(-1000, 1000)) / 8);
    return positions;
}

/// The triangles of a soup by places, as glTF's corners stand.
std::vector<glm::dvec3> corner_places(const PolygonSoup& soup) {
    std::vector<glm::dvec3> places;
    for (const std::uint32_t v : soup.corners) places.push_back(soup.positions[v]);
    return places;
}

class CompressedGltf : public testing::Test {
  protected:
    GltfScene read(const GltfParts& parts) { return read_gltf(folder_.write("part.glb", parts.as_glb())); }
    testing::AssertionResult refuses(const GltfParts& parts, std::initializer_list<std::string_view> texts) {
        return test::refuses([](const std::string& p) { read_gltf(p); }, folder_.write("part.glb", parts.as_glb()),
                             texts);
    }
    /// Reads it with one to some bytes of what is compressed changed: it must be read, or be refused.
    void damage(const GltfParts& good, int trials) {
        int refused = 0;
        for (int trial = 0; trial < trials; ++trial) {
            Random random(static_cast<std::uint64_t>(trial));
            GltfParts parts = good;
            for (int i = random.integer(1, 4); i > 0; --i) {
                parts.binary[static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.binary.size()) - 1))] =
                    static_cast<char>(random.integer(0, 255));
            }
            try {
                read(parts);
            } catch (const InputError& error) {
                ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
                ++refused;
            }
        }
        EXPECT_GT(refused, 0) << "the damage must matter";
    }
    test::TemporaryFolder folder_;
};

// ---- EXT_meshopt_compression ----

enum class Indices { triangles, sequence };

/// A mesh of floats and indices, both compressed. What a program that cannot decompress would read
/// is not there.
struct MeshoptFile {
    GltfParts parts;
    std::string extension[2] = {R"("count": 300, "byteStride": 12, "mode": "ATTRIBUTES")",
                                R"("count": 1350, "byteStride": 4, "mode": "TRIANGLES")"};
    std::string view[2] = {R"("byteLength": 3600, "byteStride": 12)", R"("byteOffset": 3600, "byteLength": 5400)"};
    std::string compressed[2];

    explicit MeshoptFile(Indices kind = Indices::triangles) {
        const std::vector<float> positions = some_positions();
        std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(kVertices, 12));
        bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), positions.data(), kVertices, 12));
        compressed[0].assign(bytes.begin(), bytes.end());
        const std::vector<std::uint32_t> indices = some_indices();
        if (kind == Indices::triangles) {
            bytes.resize(meshopt_encodeIndexBufferBound(indices.size(), kVertices));
            bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
        } else {
            extension[1] = R"("count": 1350, "byteStride": 4, "mode": "INDICES", "filter": "NONE")";
            bytes.resize(meshopt_encodeIndexSequenceBound(indices.size(), kVertices));
            bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
        }
        compressed[1].assign(bytes.begin(), bytes.end());
        finish();
    }
    void finish() {
        parts = GltfParts();
        parts.binary.clear();
        parts.buffer_views = "[";
        for (int i = 0; i < 2; ++i) {
            parts.buffer_views += std::string(i > 0 ? ", " : "") + "{\"buffer\": 1, " + view[i] +
                                  R"(, "extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteOffset": )" +
                                  std::to_string(parts.binary.size()) +
                                  ", \"byteLength\": " + std::to_string(compressed[i].size()) + ", " + extension[i] +
                                  "}}}";
            parts.binary += compressed[i];
        }
        parts.buffer_views += "]";
        parts.accessors =
            R"([{"bufferView": 0, "componentType": 5126, "count": 300, "type": "VEC3"}, {"bufferView": 1, "componentType": 5125, "count": 1350, "type": "SCALAR"}])";
        parts.required = R"(["EXT_meshopt_compression"])";
        set_fallback("{\"byteLength\": 9000}");
    }
    void set_fallback(const std::string& buffer) {
        parts.buffers = "[{\"byteLength\": " + std::to_string(parts.binary.size()) + "}, " + buffer + "]";
    }
};

TEST_F(CompressedGltf, ViewsThatMeshoptimizerCompressedAreRead) {
    const std::vector<float> positions = some_positions();
    const std::vector<std::uint32_t> indices = some_indices();
    for (const Indices kind : {Indices::triangles, Indices::sequence}) {
        const PolygonSoup soup = read(MeshoptFile(kind).parts).meshes.at(0);
        ASSERT_EQ(soup.corners.size(), indices.size());
        for (std::size_t t = 0; t < kTriangles; ++t) {
            // The codec of triangles may turn them.
            bool is_there = false;
            for (std::size_t turn = 0; turn < 3; ++turn) {
                bool same = true;
                for (std::size_t k = 0; k < 3; ++k)
                    same = same && soup.corners[3 * t + k] == indices[3 * t + (k + turn) % 3];
                is_there = is_there || same;
            }
            ASSERT_TRUE(is_there) << t;
        }
        for (std::size_t v = 0; v < kVertices; ++v) {
            ASSERT_EQ(soup.positions[v], glm::dvec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]));
        }
    }
}

TEST_F(CompressedGltf, FallbackBuffersNeedNotBeThere) {
    MeshoptFile file;
    file.set_fallback(
        R"({"byteLength": 9000, "uri": "none.bin", "extensions": {"EXT_meshopt_compression": {"fallback": true}}})");
    EXPECT_EQ(read(file.parts).meshes.at(0).corners.size(), 1350u);
    // If they are, what is compressed is read all the same.
    folder_.write("zeros.bin", std::string(9000, '\0'));
    file.set_fallback(R"({"byteLength": 9000, "uri": "zeros.bin"})");
    EXPECT_NE(read(file.parts).meshes.at(0).positions[0], glm::dvec3(0.0));
    // A view that is not compressed has nothing there.
    file.parts.buffer_views = R"([{"buffer": 1, "byteLength": 3600}, {"buffer": 1, "byteLength": 5400}])";
    file.set_fallback(R"({"byteLength": 9000})");
    EXPECT_TRUE(refuses(file.parts, {"buffers[1]: the buffer has neither a URI nor a binary chunk"}));
    file.set_fallback(
        R"({"byteLength": 9000, "uri": "zeros.bin", "extensions": {"EXT_meshopt_compression": {"fallback": true}}})");
    EXPECT_TRUE(refuses(file.parts, {"buffers[1]: the buffer is a fallback"}));
}

/// Positions of three vertices as one view with a filter.
GltfParts filtered(const std::string& raw, std::size_t stride, const char* filter, const std::string& accessor) {
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(3, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), raw.data(), 3, stride));
    GltfParts parts;
    parts.binary.assign(bytes.begin(), bytes.end());
    parts.buffer_views = "[{\"buffer\": 1, \"byteLength\": " + std::to_string(3 * stride) +
                         ", \"byteStride\": " + std::to_string(stride) +
                         R"(, "extensions": {"EXT_meshopt_compression": {"buffer": 0, "byteLength": )" +
                         std::to_string(bytes.size()) + R"(, "count": 3, "mode": "ATTRIBUTES", "byteStride": )" +
                         std::to_string(stride) + ", \"filter\": \"" + filter + "\"}}}]";
    parts.buffers = "[{\"byteLength\": " + std::to_string(bytes.size()) +
                    "}, {\"byteLength\": " + std::to_string(3 * stride) + "}]";
    parts.accessors = "[{\"bufferView\": 0, \"count\": 3, " + accessor + "}]";
    parts.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0}}]}])";
    return parts;
}

TEST_F(CompressedGltf, TheExponentialFilterGivesFloats) {
    const auto code = [](int exponent, int mantissa) {
        return static_cast<std::uint32_t>(exponent) << 24 | (static_cast<std::uint32_t>(mantissa) & 0xFFFFFF);
    };
    const std::string raw =
        ByteWriter()
            .add<std::uint32_t>({code(-1, 3), code(0, -7), code(10, 1), code(-20, 1 << 20), code(2, 8388607),
                                 code(0, -8388608), code(0, 0), code(-100, 0), code(50, 3)})
            .bytes();
    EXPECT_EQ(read(filtered(raw, 12, "EXPONENTIAL", R"("type": "VEC3", "componentType": 5126)")).meshes.at(0).positions,
              (std::vector<glm::dvec3>{{1.5, -7, 1024}, {1, 4 * 8388607.0, -8388608}, {0, 0, std::ldexp(3.0, 50)}}));
}

TEST_F(CompressedGltf, TheOctahedralFilterGivesUnitVectors) {
    const auto expect_unit = [](const glm::dvec3& p, const glm::dvec3& direction, double step) {
        EXPECT_LE(glm::distance(p, glm::normalize(direction)), step) << p.x << ' ' << p.y << ' ' << p.z;
    };
    // |x| + |y| is more than 1 where z is below 0.
    const std::string bytes = ByteWriter().add<std::int8_t>({0, 0, 127, 0, 63, -63, 126, 0, 127, 127, 127, 0}).bytes();
    std::vector<glm::dvec3> p =
        read(filtered(bytes, 4, "OCTAHEDRAL", R"("type": "VEC3", "componentType": 5120, "normalized": true)"))
            .meshes.at(0)
            .positions;
    expect_unit(p[0], {0, 0, 1}, 0);
    expect_unit(p[1], {1, -1, 0}, 0.01);
    expect_unit(p[2], {0, 0, -1}, 0);
    const std::string shorts =
        ByteWriter().add<std::int16_t>({511, 0, 511, 0, 0, -16000, 32767, 0, -24576, 16384, 32767, 0}).bytes();
    p = read(filtered(shorts, 8, "OCTAHEDRAL", R"("type": "VEC3", "componentType": 5122, "normalized": true)"))
            .meshes.at(0)
            .positions;
    expect_unit(p[0], {1, 0, 0}, 0);
    expect_unit(p[1], {0, -16000, 16767}, 1e-4);
    expect_unit(p[2], {-0.5, 0.25, -0.25}, 1e-4);
}

TEST_F(CompressedGltf, TheQuaternionFilterGivesUnitQuaternions) {
    // Rotations of instances are stored like that: three small numbers, and which the largest one is.
    const auto rotation = [](std::array<double, 4> q, int largest, int bits) {
        const double one = (1 << (bits - 1)) - 1;
        const auto code = [&](int k) {
            return static_cast<std::int16_t>(
                std::lround(q[static_cast<std::size_t>((largest + k) % 4)] * std::sqrt(2.0) * one));
        };
        return ByteWriter()
            .add<std::int16_t>(
                {code(1), code(2), code(3), static_cast<std::int16_t>((static_cast<int>(one) & ~3) | largest)})
            .bytes();
    };
    const double s = std::sqrt(0.5);
    GltfParts parts =
        filtered(rotation({0, 0, s, s}, 3, 16) + rotation({0.8, 0, 0.6, 0}, 0, 12) + rotation({0, 0, 0, 1}, 3, 8), 8,
                 "QUATERNION", R"("type": "VEC4", "componentType": 5122, "normalized": true)");
    parts.accessors = R"([{"type": "VEC3", "componentType": 5126, "count": 3}, )" + parts.accessors.substr(1);
    parts.nodes = R"([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": 1}}}}])";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.objects.size(), 3u);
    const auto turned = [&](std::size_t i, const glm::dvec3& p) {
        return glm::dvec3(scene.objects[i].to_world * glm::dvec4(p, 1.0));
    };
    EXPECT_LT(glm::distance(turned(0, {1, 0, 0}), {0, 1, 0}), 1e-3);
    EXPECT_LT(glm::distance(turned(1, {1, 0, 0}), {0.28, 0, 0.96}), 1e-2);
    EXPECT_LT(glm::distance(turned(1, {0, 1, 0}), {0, -1, 0}), 1e-2);
    EXPECT_LT(glm::distance(turned(2, {1, 2, 3}), {1, 2, 3}), 1e-12);
}

TEST_F(CompressedGltf, BrokenMeshoptViewsAreRefused) {
    const auto with = [](int view, const char* extension, const char* parent = nullptr) {
        MeshoptFile file;
        file.extension[view] = extension;
        if (parent != nullptr) file.view[view] = parent;
        file.finish();
        return file.parts;
    };
    const char* const place = "bufferViews[0].extensions.EXT_meshopt_compression";
    EXPECT_TRUE(
        refuses(with(0, R"("count": 300, "byteStride": 12, "mode": "POINTS")"), {place, "unknown mode 'POINTS'"}));
    EXPECT_TRUE(refuses(with(0, R"("count": 300, "byteStride": 12, "mode": "ATTRIBUTES", "filter": "BLUR")"),
                        {place, "unknown filter 'BLUR'"}));
    EXPECT_TRUE(refuses(with(0, R"("count": 300, "byteStride": 12, "mode": "ATTRIBUTES", "filter": "QUATERNION")"),
                        {place, "byteStride: does not fit the mode and the filter"}));
    EXPECT_TRUE(refuses(with(0, R"("count": 300, "byteStride": 12, "mode": "ATTRIBUTES", "filter": "OCTAHEDRAL")"),
                        {"byteStride: does not fit"}));
    for (const char* stride : {"0", "10", "260", "4294967296"}) {
        EXPECT_TRUE(
            refuses(with(0, (R"("count": 300, "mode": "ATTRIBUTES", "byteStride": )" + std::string(stride)).c_str()),
                    {"byteStride: does not fit"}))
            << stride;
    }
    EXPECT_TRUE(refuses(with(0, R"("count": 299, "byteStride": 12, "mode": "ATTRIBUTES")"),
                        {"count and byteStride do not fit those of the view"}));
    EXPECT_TRUE(refuses(with(0, R"("count": 225, "byteStride": 16, "mode": "ATTRIBUTES")"),
                        {"count and byteStride do not fit those of the view"}));
    EXPECT_TRUE(refuses(with(0, R"("byteStride": 12, "mode": "ATTRIBUTES")"), {"'count' is missing"}));
    EXPECT_TRUE(refuses(with(1, R"("count": 1349, "byteStride": 4, "mode": "TRIANGLES")"),
                        {"count: triangles have three numbers each"}));
    EXPECT_TRUE(refuses(with(1, R"("count": 5400, "byteStride": 1, "mode": "INDICES")"), {"byteStride: does not fit"}));
    EXPECT_TRUE(refuses(with(1, R"("count": 1350, "byteStride": 4, "mode": "INDICES", "filter": "EXPONENTIAL")"),
                        {"byteStride: does not fit"}));
    EXPECT_TRUE(refuses(with(1, R"("count": 1350, "byteStride": 4, "mode": "INDICES")"),
                        {"bufferViews[1].extensions.EXT_meshopt_compression: the compressed data are broken"}));
    EXPECT_TRUE(refuses(with(0, R"("count": 300000000000, "byteStride": 12, "mode": "ATTRIBUTES")",
                             R"("byteLength": 3600000000000, "byteStride": 12)"),
                        {"what it has compressed needs about 3.3 TB", "that models may take"}));
    MeshoptFile cut;
    for (std::string& bytes : cut.compressed) bytes.resize(bytes.size() / 2);
    cut.finish();
    EXPECT_TRUE(refuses(cut.parts, {"the compressed data are broken"}));
    damage(MeshoptFile().parts, 300);
    damage(MeshoptFile(Indices::sequence).parts, 300);
}

// ---- KHR_draco_mesh_compression ----

/// A strip of 2 x 60 triangles with three attributes.
std::unique_ptr<draco::Mesh> strip_for_draco(std::vector<glm::dvec3>& places) {
    draco::TriangleSoupMeshBuilder builder;
    constexpr int kFaces = 120;
    builder.Start(kFaces);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int joints = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
    const int weights = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
    const auto point = [](int i) {
        return std::array<float, 3>{static_cast<float>(i / 2), static_cast<float>(i % 2),
                                    static_cast<float>(i * i % 7)};
    };
    const std::array<std::uint8_t, 4> joint{1, 0, 0, 0};
    const std::array<float, 4> weight{1, 0, 0, 0};
    for (int f = 0; f < kFaces; ++f) {
        const std::array<float, 3> a = point(f + f % 2), b = point(f + 1 - f % 2), c = point(f + 2);
        const draco::FaceIndex face(static_cast<std::uint32_t>(f));
        builder.SetAttributeValuesForFace(position, face, a.data(), b.data(), c.data());
        builder.SetAttributeValuesForFace(joints, face, joint.data(), joint.data(), joint.data());
        builder.SetAttributeValuesForFace(weights, face, weight.data(), weight.data(), weight.data());
        for (const auto& p : {a, b, c}) places.emplace_back(p[0], p[1], p[2]);
    }
    return builder.Finalize();
}

struct DracoFile {
    GltfParts parts;
    std::vector<glm::dvec3> places;  // of corners, in the order before compression
    std::string primitive = R"({"attributes": {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}, "indices": 1,
        "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}}})";

    explicit DracoFile(draco::MeshEncoderMethod method) {
        const std::unique_ptr<draco::Mesh> mesh = strip_for_draco(places);
        draco::Encoder encoder;
        encoder.SetEncodingMethod(method);
        draco::EncoderBuffer buffer;
        EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
        parts.binary.assign(buffer.data(), buffer.size());
        parts.required = R"(["KHR_draco_mesh_compression"])";
        set_counts(mesh->num_points(), 3 * std::size_t{mesh->num_faces()});
        finish();
    }
    void set_counts(std::size_t points, std::size_t corners) {
        const std::string count = ", \"count\": " + std::to_string(points) + "}";
        parts.accessors = R"([{"type": "VEC3", "componentType": 5126)" + count +
                          R"(, {"type": "SCALAR", "componentType": 5123, "count": )" + std::to_string(corners) +
                          R"(}, {"type": "VEC4", "componentType": 5121)" + count +
                          R"(, {"type": "VEC4", "componentType": 5126)" + count + "]";
    }
    void finish() {
        parts.buffer_views = "[{\"buffer\": 0, \"byteLength\": " + std::to_string(parts.binary.size()) + "}]";
        parts.meshes = "[{\"primitives\": [" + primitive + "]}]";
    }
};

/// Triangles in any order, each from its least corner on.
std::vector<std::array<std::array<double, 3>, 3>> sorted_triangles(const std::vector<glm::dvec3>& corners) {
    std::vector<std::array<std::array<double, 3>, 3>> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        std::array<std::array<double, 3>, 3> t;
        for (std::size_t k = 0; k < 3; ++k) t[k] = {corners[i + k].x, corners[i + k].y, corners[i + k].z};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        triangles.push_back(t);
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

TEST_F(CompressedGltf, PrimitivesThatDracoCompressedAreRead) {
    for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        DracoFile file(method);
        EXPECT_EQ(sorted_triangles(corner_places(read(file.parts).meshes.at(0))), sorted_triangles(file.places))
            << method;
        // Joints and weights, too.
        file.parts.scenes = R"([{"nodes": [0, 1, 2]}])";
        file.parts.nodes = R"([{"mesh": 0, "skin": 0}, {}, {"translation": [0, 0, 100]}])";
        file.parts.skins = R"([{"joints": [1, 2]}])";
        std::vector<glm::dvec3> moved = file.places;
        for (glm::dvec3& p : moved) p.z += 100;
        EXPECT_EQ(sorted_triangles(corner_places(read(file.parts).meshes.at(0))), sorted_triangles(moved)) << method;
    }
}

TEST_F(CompressedGltf, DracoGivesColoursToWhoAsks) {
    DracoFile file(draco::MESH_EDGEBREAKER_ENCODING);
    file.primitive = R"({"attributes": {"POSITION": 0, "COLOR_0": 3, "_PART": 2}, "indices": 1,
        "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0, "COLOR_0": 2, "_PART": 1}}}})";
    file.finish();
    ModelBudget budget;
    const std::string path = folder_.write("part.glb", file.parts.as_glb());
    EXPECT_TRUE(read_gltf(path).meshes.at(0).attributes.empty());
    const PolygonSoup soup = read_gltf(path, budget, false, AttributeWish::all()).meshes.at(0);
    ASSERT_EQ(soup.attributes.size(), 1u) << "four numbers are no attribute";
    ASSERT_EQ(soup.attributes[0].rows.size(), 360u);
    for (const std::uint32_t row : soup.attributes[0].rows) {
        EXPECT_EQ(soup.attributes[0].row(row)[0], 1);
        EXPECT_EQ(soup.attributes[0].row(row)[1], 0);
    }
}

TEST_F(CompressedGltf, BrokenDracoDataAreRefused) {
    const char* const place = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: ";
    for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        DracoFile file(method);
        file.set_counts(122, 363);
        EXPECT_TRUE(refuses(file.parts, {place, "it has not as many triangles"}));
        file.set_counts(123, 360);
        EXPECT_TRUE(refuses(file.parts, {place, "it has not as many points"}));
        file.set_counts(122, 361);
        EXPECT_TRUE(refuses(file.parts, {"indices: triangles have three numbers each"}));
        // Counts that data of this size may have are believed as far as the budget goes.
        file.set_counts(4000000000, 3000000000);
        EXPECT_TRUE(refuses(file.parts, {"that models may take"}));
        const std::string whole = file.parts.binary;
        for (std::size_t size = 0; size < whole.size(); size += size < 40 ? 1 : 13) {
            DracoFile cut(method);
            cut.parts.binary.resize(size);
            cut.finish();
            EXPECT_TRUE(refuses(cut.parts, {})) << size;
        }
        damage(DracoFile(method).parts, 500);
    }
    DracoFile file(draco::MESH_SEQUENTIAL_ENCODING);
    const auto with = [&](std::string_view from, std::string_view to) {
        DracoFile changed = file;
        changed.primitive.replace(changed.primitive.find(from), from.size(), to);
        changed.finish();
        return changed.parts;
    };
    EXPECT_TRUE(refuses(with(R"("POSITION": 0, "JOINTS_0": 1)", R"("POSITION": 9, "JOINTS_0": 1)"),
                        {place, "it has not all attributes"}));
    EXPECT_TRUE(refuses(with(R"("POSITION": 0, "JOINTS_0": 1)", R"("POSITION": 1, "JOINTS_0": 1)"),
                        {place, "an attribute is of another type"}));
    EXPECT_TRUE(
        refuses(with(R"("bufferView": 0)", R"("bufferView": 1)"), {"bufferView: buffer view 1 does not exist"}));
    EXPECT_TRUE(refuses(with(R"("indices": 1,)", ""), {"meshes[0].primitives[0]: 'indices' is missing"}));
    EXPECT_TRUE(refuses(with(R"("indices": 1,)", R"("indices": 1, "mode": 5,)"), {place, "only triangles (mode 4)"}));
}

}  // namespace
}  // namespace burin
