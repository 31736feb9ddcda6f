#include <gtest/gtest.h>

#include <string>

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

/// `text` so often, with numbers in place of each '#', between commas.
std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) {
        if (i > 0) all += ", ";
        for (const char c : text) c == '#' ? all += std::to_string(i) : all += c;
    }
    return all;
}

/// Accessor 0: three positions. Accessor 1: 30,000 indices into them.
GltfAccessors many_indices() {
    GltfAccessors a;
    a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    std::string bytes;
    for (int i = 0; i < 10000; ++i) bytes += std::string("\0\1\2", 3);
    a.add(bytes, "SCALAR", 5121, bytes.size());
    return a;
}

class GltfMemory : public testing::Test {
  protected:
    GltfScene read(const GltfParts& parts) { return read_gltf(folder_.write("part.gltf", parts.json())); }
    testing::AssertionResult refuses(const GltfParts& parts, std::initializer_list<std::string_view> texts) {
        return test::refuses([](const std::string& p) { read_gltf(p); }, folder_.write("part.gltf", parts.json()),
                             texts);
    }
    test::TemporaryFolder folder_;
};

TEST_F(GltfMemory, EqualPrimitivesOfAMeshAreOne) {
    const std::string primitive = R"({"attributes": {"POSITION": 0, "NORMAL": #}, "indices": 1})";
    const GltfScene scene = read(gltf_of(many_indices(), repeated(primitive, 20000)));
    EXPECT_EQ(scene.meshes.at(0).polygon_count(), 10000u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 3u);
}

TEST_F(GltfMemory, PrimitivesThatDifferInWhatIsDrawnAreNotEqual) {
    GltfAccessors a = many_indices();
    a.add_indices({0, 1, 2});
    a.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    a.add(std::string(7500, '\0'), "SCALAR", 5121, 7500);
    GltfParts parts =
        gltf_of(a, R"({"attributes": {"POSITION": 0}, "indices": 1}, {"attributes": {"POSITION": 3}, "indices": 1},
        {"attributes": {"POSITION": 0}, "indices": 2}, {"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
        {"attributes": {"POSITION": 0}, "indices": 1, "mode": 1},
        {"attributes": {"POSITION": 0}, "indices": 1, "extensions": {"EXT_mesh_primitive_edge_visibility": {"visibility": 4}}})");
    parts.materials = "[{}]";
    const GltfScene scene = read(parts);
    EXPECT_EQ(scene.meshes.at(0).polygon_count(), 4 * 10000u + 1u);
    EXPECT_EQ(scene.meshes[0].marked_edges.size(), 15000u);
}

TEST_F(GltfMemory, EqualMeshesAreOne) {
    GltfParts parts;
    parts.meshes = "[" +
                   repeated(R"({"name": "m#", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]})", 3) +
                   R"(, {"primitives": [{"attributes": {"POSITION": 0}}]}])";
    parts.scenes = R"([{"nodes": [0, 1, 2]}])";
    parts.nodes = R"([{"mesh": 2, "name": "c"}, {"mesh": 3, "name": "d"}, {"mesh": 0, "name": "a"}])";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.meshes.size(), 2u);
    ASSERT_EQ(scene.objects.size(), 3u);
    EXPECT_EQ(scene.objects[0].mesh, scene.objects[2].mesh);
    EXPECT_NE(scene.objects[0].mesh, scene.objects[1].mesh);
    EXPECT_EQ(scene.objects[2].name, "a");
}

TEST_F(GltfMemory, AnAccessorThatIsUsedAgainAndAgainIsRefusedBeforeItIsExpanded) {
    GltfParts parts =
        gltf_of(many_indices(), repeated(R"({"attributes": {"POSITION": 0}, "indices": 1, "material": #})", 20000));
    parts.materials = "[" + repeated("{}", 20000) + "]";
    EXPECT_TRUE(refuses(parts, {"what it makes of its accessors", " GB", "that models may take"}));
    // Accessors that differ in where they begin ask for as much.
    GltfAccessors a = many_indices();
    for (int i = 0; i < 20000; ++i)
        a.add_object("{\"bufferView\": 1, \"byteOffset\": " + std::to_string(3 * (i % 1000)) +
                     R"(, "type": "SCALAR", "componentType": 5121, "count": 27000})");
    std::string primitives;
    for (int i = 0; i < 20000; ++i)
        primitives += (i > 0 ? ", " : "") + std::string(R"({"attributes": {"POSITION": 0}, "indices": )") +
                      std::to_string(i + 2) + "}";
    EXPECT_TRUE(refuses(gltf_of(a, primitives), {"what it makes of its accessors", " GB", "that models may take"}));
}

TEST_F(GltfMemory, SoIsWhatPosesLinesMeshesAndInstancesMakeOfIt) {
    GltfAccessors a = many_indices();
    a.add_vectors({0, 0, 0, 0, 0, 0, 0, 0, 1});
    GltfParts posed = gltf_of(a, R"({"attributes": {"POSITION": 0}, "indices": 1, "targets": [{"POSITION": 2}]})");
    posed.scene = posed.scenes = "";
    posed.nodes = "[" + repeated(R"({"mesh": 0, "weights": [#.5]})", 20000) + "]";
    EXPECT_TRUE(refuses(posed, {"that models may take"}));

    GltfParts lines = gltf_of(
        many_indices(), repeated(R"({"attributes": {"POSITION": 0}, "indices": 1, "mode": 3, "material": #})", 20000));
    lines.materials = "[" + repeated("{}", 20000) + "]";
    EXPECT_TRUE(refuses(lines, {"that models may take"}));

    std::string positions(120000, '\0');
    GltfAccessors points;
    points.add(positions, "VEC3", 5126, 10000);
    GltfParts meshes;
    points.put_into(meshes);
    meshes.materials = "[" + repeated("{}", 5000) + "]";
    meshes.meshes = "[" + repeated(R"({"primitives": [{"attributes": {"POSITION": 0}, "material": #}]})", 5000) + "]";
    EXPECT_TRUE(refuses(meshes, {"that models may take"}));

    GltfParts instances = gltf_of(points, R"({"attributes": {"POSITION": 0}})");
    instances.scene = instances.scenes = "";
    instances.nodes =
        "[" +
        repeated(R"({"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}})",
                 2000) +
        "]";
    EXPECT_TRUE(refuses(instances, {"that models may take"}));
}

TEST_F(GltfMemory, AccessorsWithoutDataCannotFillTheMemory) {
    // Each is small enough; a thousand of them are not.
    GltfParts parts;
    parts.materials = "[" + repeated("{}", 1000) + "]";
    parts.meshes = "[" + repeated(R"({"primitives": [{"attributes": {"POSITION": 0}, "material": #}]})", 1000) + "]";
    parts.accessors = R"([{"type": "VEC3", "componentType": 5126, "count": 1000000}])";
    EXPECT_TRUE(refuses(parts, {"what it makes of its accessors", "that models may take"}));
}

TEST_F(GltfMemory, TheBudgetIsForWhatIsUsedMoreThanOnce) {
    // 10,000 triangles of own vertices and indices.
    GltfAccessors a;
    std::string bytes, indices;
    for (std::uint32_t i = 0; i < 30000; ++i) {
        bytes += ByteWriter()
                     .add<float>({static_cast<float>(i % 173), static_cast<float>(i % 211), static_cast<float>(i)})
                     .bytes();
        indices += ByteWriter().add<std::uint32_t>({i}).bytes();
    }
    a.add(bytes, "VEC3", 5126, 30000);
    a.add(indices, "SCALAR", 5125, 30000);
    GltfParts parts = gltf_of(a, R"({"attributes": {"POSITION": 0}, "indices": 1})");
    ModelBudget none(0);
    const std::string path = folder_.write("part.gltf", parts.json());
    EXPECT_EQ(read_gltf(path, none).meshes.at(0).polygon_count(), 10000u);
    EXPECT_EQ(none.counted_bytes(), 0u);
    parts.materials = "[{}]";
    parts.meshes.insert(parts.meshes.size() - 3, R"(, {"attributes": {"POSITION": 0}, "indices": 1, "material": 0})");
    ModelBudget enough;
    read_gltf(folder_.write("part.gltf", parts.json()), enough);
    EXPECT_GT(enough.counted_bytes(), 100000u);
    ModelBudget too_little(enough.counted_bytes() - 1);
    EXPECT_THROW(read_gltf(path, too_little), InputError);
}

TEST_F(GltfMemory, MeshesThatUseFewVerticesOfAnAccessorTakeFew) {
    GltfAccessors a;
    std::string bytes;
    for (int i = 0; i < 10000; ++i)
        bytes += ByteWriter().add<float>({static_cast<float>(i), static_cast<float>(i * i), 0}).bytes();
    a.add(bytes, "VEC3", 5126, 10000);
    for (std::uint16_t i = 0; i < 2000; ++i)
        a.add_indices({static_cast<std::uint16_t>(5 * i + 2), static_cast<std::uint16_t>(5 * i),
                       static_cast<std::uint16_t>(9 * i % 7)});
    GltfParts parts = gltf_of(a, "");
    parts.meshes = "[";
    for (int i = 1; i <= 2000; ++i) {
        parts.meshes += (i > 1 ? ", " : "") +
                        std::string(R"({"primitives": [{"attributes": {"POSITION": 0}, "indices": )") +
                        std::to_string(i) + R"(}, {"attributes": {"POSITION": 0}, "indices": )" + std::to_string(i) +
                        ", \"mode\": 2}]}";
    }
    parts.meshes += "]";
    parts.scene = parts.scenes = "";
    parts.nodes = "[" + repeated("{\"mesh\": #}", 2000) + "]";
    const GltfScene scene = read(parts);
    ASSERT_EQ(scene.meshes.size(), 2000u);
    const PolygonSoup& soup = scene.meshes[10];
    EXPECT_EQ(soup.positions, (std::vector<glm::dvec3>{{6, 36, 0}, {50, 2500, 0}, {52, 2704, 0}}));
    EXPECT_EQ(test::polygons_of(soup), (test::Polygons{{2, 1, 0}}));
    EXPECT_EQ(soup.marked_edges, (std::vector<std::array<std::uint32_t, 2>>{{2, 1}, {1, 0}, {0, 2}}));
    // Its numbers are checked all the same.
    a.add_indices({0, 1, 10000});
    EXPECT_TRUE(refuses(gltf_of(a, R"({"attributes": {"POSITION": 0}, "indices": 2001})"),
                        {"meshes[0].primitives[0].indices: vertex 10000 does not exist (there are 10000)"}));
}

}  // namespace
}  // namespace burin
