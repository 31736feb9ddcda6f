// Values that files give at corners of polygons are at the corners of the triangles that are made of them.

#include "mesh/vertex_attributes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "mesh/build_meshes.h"
#include "mesh/model.h"
#include "mesh/stitch_cracks.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/mesh_checks.h"
#include "tests/mesh/model_files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Random;
using Kind = AttributeKind;

class Attributes : public testing::Test {
  protected:
    Model read(const std::string& name, const std::string& text, const AttributeWish& wish = AttributeWish::all(),
               int subdivide = 0) {
        MeshOptions options;
        options.attributes = wish;
        options.subdivision_levels = subdivide;
        return read_model(folder_.write(name, text), options);
    }
    test::TemporaryFolder folder_;
};

/// The values of a layer at a corner of a triangle; nothing: it has none.
std::vector<float> value_at(const Mesh& mesh, Kind kind, std::uint32_t triangle, std::size_t corner,
                            const std::string& name = {}) {
    const AttributeLayer* const layer = find_layer(mesh.attributes, kind, name);
    if (layer == nullptr || layer->rows[3 * triangle + corner] == AttributeLayer::kNoRow) return {};
    const auto row = layer->row(layer->rows[3 * triangle + corner]);
    return {row.begin(), row.end()};
}

/// Expects, at every corner of a mesh, the value that a function of its place gives.
template <typename Value>
void expect_values(const Mesh& mesh, Kind kind, double tolerance, const Value& value, const std::string& name = {}) {
    ASSERT_FALSE(mesh.triangles.empty());
    const std::uint32_t step = mesh.triangles.size() > 10000 ? 31 : 1;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); t += step) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::vector<float> found = value_at(mesh, kind, t, k, name);
            const std::vector<double> expected = value(mesh.position(mesh.triangles[t][k]), t);
            ASSERT_EQ(found.size(), expected.size()) << t << ' ' << k;
            for (std::size_t i = 0; i < found.size(); ++i)
                ASSERT_NEAR(static_cast<double>(found[i]), expected[i], tolerance) << t << ' ' << k << ' ' << i;
        }
    }
}

std::vector<double> plane_values(const glm::dvec3& p) { return {0.5 * p.x - p.y + 2 * p.z + 1, p.x + 0.25 * p.y}; }

TEST_F(Attributes, OfAnObjFileKeepSeams) {
    const std::string text =
        "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1 1\nv 0 1 0\nv 2 0 0 0.5 0.5 0.5\nv 2 1 0 1 1 1\n"
        "vt 0 0\nvt 1 0\nvt 1 1 7\nvt 0 1\nvt 0.25 nothing\n"
        "f 1/1 2/2/1 3/3 4/4\nf 2/-5 5/-4 6/-3\nf 2//1 6/9 3\n";
    const Mesh mesh = read("part.obj", text).meshes.at(0);
    ASSERT_EQ(mesh.triangles.size(), 4u);
    std::vector<std::vector<float>> of_second_polygon, of_third;
    for (std::uint32_t t = 0; t < 4; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::vector<float> uv = value_at(mesh, Kind::uv, t, k);
            const glm::dvec3 p = mesh.position(mesh.triangles[t][k]);
            if (mesh.polygon_of(t) == 0) {
                EXPECT_EQ(uv, (std::vector<float>{static_cast<float>(p.x), static_cast<float>(p.y)}));
            } else if (mesh.polygon_of(t) == 1) {  // counted back from the end: its own values at the same vertices
                EXPECT_EQ(uv, (std::vector<float>{static_cast<float>(p.x - 1), static_cast<float>(p.y)}));
            } else {
                EXPECT_TRUE(uv.empty());
            }
            const std::vector<float> color = value_at(mesh, Kind::color, t, k);
            if (p == glm::dvec3(0, 1, 0)) {
                EXPECT_TRUE(color.empty());
            } else if (p == glm::dvec3(1, 1, 0)) {
                EXPECT_EQ(color, (std::vector<float>{0, 0, 1}));
            } else {
                EXPECT_EQ(color.size(), 3u);
            }
        }
    }
    EXPECT_EQ(read("part.obj", text).notes.size(), 1u) << "9 does not exist";
    EXPECT_TRUE(read("part.obj", text, {}).meshes[0].attributes.empty()) << "nobody asks";
    EXPECT_TRUE(read("part.obj", text, {}).notes.empty());
    AttributeWish colors;
    colors.color = true;
    EXPECT_EQ(read("part.obj", text, colors).meshes[0].attributes.size(), 1u);
}

TEST_F(Attributes, OfAPlyFile) {
    const std::string head =
        "element vertex 4\nproperty float x\nproperty uchar red\nproperty float y\n"
        "property float z\nproperty float s\nproperty float t\nproperty uchar green\n"
        "property uchar blue\nproperty float quality\nproperty int part\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const auto check = [](const Model& model) {
        ASSERT_EQ(model.meshes.size(), 1u);
        const Mesh& mesh = model.meshes[0];
        expect_values(mesh, Kind::uv, 0, [](glm::dvec3 p, auto) { return std::vector{1 - p.x, 2 * p.y}; });
        expect_values(
            mesh, Kind::named, 0, [](glm::dvec3 p, auto) { return std::vector{p.x + 0.5}; }, "quality");
        expect_values(
            mesh, Kind::named, 0, [](glm::dvec3 p, auto) { return std::vector{p.y == 0 ? 7.0 : -7.0}; }, "part");
        // Code values of sRGB: 188 is half of the light.
        expect_values(mesh, Kind::color, 1e-6, [](glm::dvec3 p, auto) {
            return std::vector{p.x, 0.502886458033077, p.x * 0.00030352698354883};
        });
        EXPECT_EQ(model.attribute_names, (std::vector<std::string>{"quality", "part"}));
    };
    check(read("a.ply", "ply\nformat ascii 1.0\n" + head +
                            "0 0 0 0 1 0 188 0 0.5 7\n1 255 0 0 0 0 188 1 1.5 7\n1 255 1 0 0 2 188 1 1.5 -7\n"
                            "0 0 1 0 1 2 188 0 0.5 -7\n4 0 1 2 3\n"));
    for (const bool big : {false, true}) {
        test::ByteWriter body(big);
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            body.add<float>({fx}).add<std::uint8_t>({static_cast<std::uint8_t>(255 * x)});
            body.add<float>({fy, 0, 1 - fx, 2 * fy});
            body.add<std::uint8_t>({188, static_cast<std::uint8_t>(x)}).add<float>({fx + 0.5f});
            body.add<std::int32_t>({y == 0 ? 7 : -7});
        }
        body.add<std::uint8_t>({4}).add<std::int32_t>({0, 1, 2, 3});
        check(read("b.ply", std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + head +
                                body.bytes()));
    }
}

TEST_F(Attributes, OfAPlyFileMayStandAtCornersOfFaces) {
    const Mesh mesh =
        read("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "property float red\nproperty float green\nproperty float blue\nelement face 3\n"
             "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n"
             "0 0 0 nan 0.5 1e39\n1 0 0 0 0.5 0\n1 1 0 0 0.5 0\n0 1 0 0 0.5 0\n"
             "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 5 5 6 6 5 6\n3 0 1 3 2 1 1\n")
            .meshes.at(0);
    ASSERT_EQ(mesh.triangles.size(), 3u);
    EXPECT_EQ(value_at(mesh, Kind::uv, 0, 0), (std::vector<float>{0, 0}));
    EXPECT_EQ(value_at(mesh, Kind::uv, 1, 0), (std::vector<float>{5, 5})) << "the same vertex";
    EXPECT_TRUE(value_at(mesh, Kind::uv, 2, 0).empty()) << "a list that does not fit";
    EXPECT_EQ(value_at(mesh, Kind::color, 0, 0), (std::vector<float>{0, 0.5f, 0})) << "what is not finite is 0";
}

TEST_F(Attributes, OfAGltfFile) {
    test::GltfAccessors accessors;
    const int positions = accessors.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const std::string bytes = {0, 0, '\xFF', 0, '\xFF', '\xFF', 0, '\xFF'};
    const int uv = accessors.add(bytes, "VEC2", 5121, 4, R"("normalized": true)");
    const int other_uv = accessors.add(bytes, "VEC2", 5121, 4);
    const std::string shorts(4 * 4 * 2, '\xFF');
    const int colors = accessors.add(shorts, "VEC4", 5123, 4, R"("normalized": true)");
    const float numbers[4] = {1, 2, 3, 4};
    const int heat =
        accessors.add(std::string(reinterpret_cast<const char*>(numbers), sizeof numbers), "SCALAR", 5126, 4);
    const int indices = accessors.add_indices({0, 1, 2, 0, 2, 3});
    const auto primitive = [&](int own_uv, const std::string& more) {
        return R"({"attributes": {"POSITION": )" + std::to_string(positions) + R"(, "TEXCOORD_0": )" +
               std::to_string(own_uv) + more + R"(}, "indices": )" + std::to_string(indices) + "}";
    };
    const std::string text =
        test::gltf_of(accessors, primitive(uv, R"(, "COLOR_0": )" + std::to_string(colors) + R"(, "_HEAT": )" +
                                                   std::to_string(heat) + R"(, "_WAY": )" + std::to_string(positions)))
            .json();
    const Model model = read("a.gltf", text);
    const Mesh& mesh = model.meshes.at(0);
    expect_values(mesh, Kind::uv, 0, [](glm::dvec3 p, auto) { return std::vector{p.x, p.y}; });
    expect_values(mesh, Kind::color, 0, [](glm::dvec3, auto) { return std::vector{1.0, 1.0, 1.0}; });
    for (const std::string name : {"_HEAT", "HEAT"}) {
        expect_values(
            mesh, Kind::named, 0, [](glm::dvec3 p, auto) { return std::vector{1 + (p.y == 0 ? p.x : 3 - p.x)}; }, name);
    }
    EXPECT_EQ(model.attribute_names, std::vector<std::string>{"_HEAT"}) << "a vector is no number";
    EXPECT_TRUE(read("a.gltf", text, {}).meshes.at(0).attributes.empty());
    // Primitives that share their places may have other values there: only one of two equal polygons is left.
    const Mesh two = read("b.gltf", test::gltf_of(accessors, primitive(other_uv, "") + ", " + primitive(uv, "")).json())
                         .meshes.at(0);
    EXPECT_EQ(two.triangles.size(), 2u);
    expect_values(two, Kind::uv, 0, [](glm::dvec3 p, auto) { return std::vector{255 * p.x, 255 * p.y}; });
}

/// Who keeps all, as somebody may read it later, gets no error for what was read without before.
TEST_F(Attributes, ThatAreWrongAreErrorsForWhoNamesThemAlone) {
    test::GltfAccessors accessors;
    const int positions = accessors.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const int indices = accessors.add_indices({0, 1, 2, 0, 2, 3});
    for (const std::string& uv : {std::to_string(positions), std::string("99"), std::to_string(indices)}) {
        const std::string text =
            test::gltf_of(accessors, R"({"attributes": {"POSITION": 0, "TEXCOORD_0": )" + uv + R"(, "_A": )" + uv +
                                         R"(}, "indices": )" + std::to_string(indices) + "}")
                .json();
        EXPECT_TRUE(read("a.gltf", text, {}).notes.empty());
        const Model kept = read("a.gltf", text);
        EXPECT_TRUE(kept.meshes.at(0).attributes.empty());
        EXPECT_FALSE(kept.notes.empty());
        AttributeWish named;
        named.uv = true;
        EXPECT_THROW(read("a.gltf", text, named), InputError);
    }
    const Mesh mesh = read("a.ply",
                           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nproperty float heat\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0 0 hot\n1 0 0 2\n0 1 0 3\n3 0 1 2\n")
                          .meshes.at(0);
    EXPECT_EQ(value_at(mesh, Kind::named, 0, 0, "heat"), std::vector<float>{0});
    EXPECT_EQ(value_at(mesh, Kind::named, 0, 1, "heat"), std::vector<float>{2});
}

/// Polygons of many kinds, each with values of its own at vertices that they share, among them polygons that are
/// dropped.
TEST_F(Attributes, ThatAreNoNumbersAreErrorsWithTheirLine) {
    const auto error = [&](const std::string& name, const std::string& text, const AttributeWish& wish) {
        try {
            read(name, text, wish);
        } catch (const InputError& fault) {
            return std::string(fault.what());
        }
        return std::string();
    };
    const std::string obj = "v 0 0 0 1 0 x\nv 1 0 0\nv 0 1 0\nvt 0.5 1e-\nf 1/1 2/1 3/1\n";
    AttributeWish uv, color, heat;
    uv.uv = color.color = true;
    heat.named = {"heat"};
    EXPECT_NE(error("a.obj", obj, uv).find("a.obj:4: a texture coordinate needs numbers, found '1e-'"),
              std::string::npos)
        << error("a.obj", obj, uv);
    EXPECT_NE(error("a.obj", obj, color).find("a.obj:1: the colour of a vertex needs numbers, found 'x'"),
              std::string::npos)
        << error("a.obj", obj, color);
    EXPECT_EQ(error("a.obj", obj, {}), "");
    EXPECT_EQ(
        error("b.obj", "v 0 0 0 1 # weight\nv 1 0 0\nv 0 1 0\nvt 0.5 # u alone\nf 1/1 2/1 3/1\n", AttributeWish::all()),
        "");
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float heat\nproperty float other\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0 1 -\n1 0 0 1.2.3 0\n0 1 0 3 0\n3 0 1 2\n";
    EXPECT_NE(error("a.ply", ply, heat).find("a.ply:13: property 'heat' is no number"), std::string::npos)
        << error("a.ply", ply, heat);
    EXPECT_EQ(error("a.ply", ply, {}), "");
}

TEST_F(Attributes, GoWithTheirPolygons) {
    for (std::uint64_t trial = 0; trial < 40; ++trial) {
        Random random(trial);
        PolygonSoup soup = test::soup_of({}, {});
        for (int i = 0; i < 30; ++i) soup.positions.push_back(glm::round(random.in_box(4)));  // some are equal
        AttributeLayer layer{Kind::uv, {}, {}, {}};
        for (std::uint32_t i = 0; i < 40; ++i) {
            const int corners = random.integer(3, 8);
            std::vector<std::uint32_t> polygon;
            for (int k = 0; k < corners; ++k) polygon.push_back(static_cast<std::uint32_t>(random.integer(0, 29)));
            soup.add_polygon(polygon);
            soup.polygon_material.push_back(i);
            soup.polygon_object.push_back(i % 2);
            for (const std::uint32_t v : polygon) {
                layer.rows.push_back(static_cast<std::uint32_t>(layer.row_count()));
                std::vector<double> at = plane_values(soup.positions[v]);
                layer.add_row(std::array{static_cast<float>(at[0] + 100 * i), static_cast<float>(at[1])});
            }
        }
        soup.object_names = {"a", "b"};
        soup.materials.resize(40);
        soup.attributes.push_back(layer);
        for (const Mesh& mesh : build_meshes(soup, {})) {
            if (mesh.triangles.empty()) continue;
            expect_values(mesh, Kind::uv, 1e-3, [&](glm::dvec3 p, std::uint32_t t) {
                std::vector<double> at = plane_values(p);
                at[0] += 100 * mesh.material_of(t);
                return at;
            });
        }
    }
}

/// A grid of squares with texture coordinates that are a function of the place, as an OBJ file.
std::string grid(int size, int (*shift)(int row)) {
    std::string text;
    int corners = 0;
    for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j) {
            for (const auto& [x, y] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
                const double place = x + 0.5 * shift(j);
                const std::vector<double> uv = plane_values({place, y, 0});
                text += "v " + std::to_string(place) + ' ' + std::to_string(y) + " 0\nvt " + std::to_string(uv[0]) +
                        ' ' + std::to_string(uv[1]) + '\n';
            }
            text += "f";
            for (int k = 0; k < 4; ++k, ++corners)
                text += ' ' + std::to_string(corners + 1) + '/' + std::to_string(corners + 1);
            text += '\n';
        }
    }
    return text;
}

TEST_F(Attributes, OfLargeModelsAreInTheirOrder) {
    const Mesh mesh = read("a.obj", grid(260, [](int) { return 0; })).meshes.at(0);
    ASSERT_NE(mesh.input_place_of(1000), 1000u) << "large enough to be put in order";
    expect_values(mesh, Kind::uv, 1e-4, [](glm::dvec3 p, auto) { return plane_values(p); });
}

TEST_F(Attributes, AreBetweenThoseOfTheEndsWhereCracksAreClosed) {
    const Mesh mesh = read("a.obj", grid(8, [](int row) { return row % 2; })).meshes.at(0);
    const auto stitched = stitch_cracks(
        mesh, [](const glm::dvec3&) { return 0.01; }, 2);
    ASSERT_TRUE(stitched);
    EXPECT_GT(stitched->triangles.size(), mesh.triangles.size());
    expect_values(*stitched, Kind::uv, 1e-4, [](glm::dvec3 p, auto) { return plane_values(p); });
}

TEST_F(Attributes, OfPolygonsThatCrossThemselves) {
    const Mesh mesh =
        read("a.obj",
             "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nvt 1 0\nvt 0 2.5\nvt 2 2\nvt -1 0.5\nf 1/1 2/2 3/3 4/4\n"
             "f 1/1 3/3 2/2\n")
            .meshes.at(0);
    expect_values(mesh, Kind::uv, 1e-6, [](glm::dvec3 p, auto) { return plane_values(p); });
    bool has_crossing = false;
    for (const auto& t : mesh.triangles) {
        for (const std::uint32_t v : t) has_crossing = has_crossing || mesh.position(v) == glm::dvec3(1, 1, 0);
    }
    EXPECT_TRUE(has_crossing);
}

TEST_F(Attributes, AreLostBySubdivisionWithANote) {
    const Model model = read("a.obj", grid(2, [](int) { return 0; }), AttributeWish::all(), 1);
    EXPECT_TRUE(model.meshes.at(0).attributes.empty());
    ASSERT_EQ(model.notes.size(), 1u);
    EXPECT_NE(model.notes[0].find("subdivided"), std::string::npos);
}

TEST(AttributeAt, IsTheMeanOfTheCorners) {
    AttributeLayer layer{Kind::uv, {}, {1, 2, 3, 4, 5, 0}, {0, 1, 2, 0, 1, AttributeLayer::kNoRow}};
    float uv[2] = {7, 7};
    attribute_at(layer, 0, {0.5, 0.25, 0.25}, uv);
    EXPECT_EQ(uv[0], 2.5f);
    EXPECT_EQ(uv[1], 2.0f);
    attribute_at(layer, 1, {0.5, 0.25, 0.25}, uv);
    EXPECT_EQ(uv[0], 0);
    EXPECT_EQ(uv[1], 0);
    EXPECT_EQ(layer.add_between(0, AttributeLayer::kNoRow, 0.5), AttributeLayer::kNoRow);
    EXPECT_EQ(layer.row(layer.add_between(0, 2, 0.5))[0], 3);
}

}  // namespace
}  // namespace burin
