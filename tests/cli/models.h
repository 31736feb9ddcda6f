#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace burin::test {

/// A cube from -1 to 1, each side a quadrilateral.
constexpr const char* kCubeObj = R"(o cube
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 2 3 7 6
f 1 5 8 4
)";

/// The bytes of little-endian numbers.
template <typename... Values>
std::string bytes_of(Values... values) {
    std::string bytes;
    const auto append = [&bytes](auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        bytes.append(raw, sizeof value);
    };
    (append(values), ...);
    return bytes;
}

/// One tetrahedron in each of the formats: file name and content.
inline std::vector<std::pair<std::string, std::string>> tetrahedra() {
    const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    std::string obj = "# a tetrahedron\n", off = "OFF\n4 4 6\n", stl_text = "solid tetra\n", stl(80, ' ');
    std::string vertices_text, faces_text, vertices, triangles, indices;
    for (const auto& p : points) {
        const std::string text = std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
        obj += "v " + text;
        vertices_text += text;
        vertices += bytes_of(p[0], p[1], p[2]);
    }
    stl += bytes_of(std::uint32_t{4});
    for (const auto& f : faces) {
        obj += "f";
        faces_text += "3";
        stl_text += "facet normal 0 0 0\nouter loop\n";
        stl += bytes_of(0.0f, 0.0f, 0.0f);
        triangles += bytes_of(std::uint8_t{3});
        for (const int i : f) {
            obj += " " + std::to_string(i + 1);
            faces_text += " " + std::to_string(i);
            stl_text += "vertex " + std::to_string(points[i][0]) + " " + std::to_string(points[i][1]) + " " +
                        std::to_string(points[i][2]) + "\n";
            stl += bytes_of(points[i][0], points[i][1], points[i][2]);
            triangles += bytes_of(std::int32_t{i});
            indices += bytes_of(static_cast<std::uint16_t>(i));
        }
        obj += "\n";
        faces_text += "\n";
        stl_text += "endloop\nendfacet\n";
        stl += bytes_of(std::uint16_t{0});
    }
    const auto ply = [](const std::string& encoding) {
        return "ply\nformat " + encoding + " 1.0\nelement vertex 4\nproperty float x\nproperty float y\n" +
               "property float z\nelement face 4\nproperty list uchar int "
               "vertex_indices\nend_header\n";
    };
    const auto gltf = [](const std::string& buffer) {
        return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"tetra"}],)"
               R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
               R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},)"
               R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],)"
               R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],)"
               R"("buffers":[{)" +
               buffer + R"("byteLength":72}]})";
    };
    std::string json = gltf("");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string chunks = bytes_of(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
                               bytes_of(std::uint32_t{72}) + std::string("BIN\0", 4) + vertices + indices;
    const std::string glb =
        "glTF" + bytes_of(std::uint32_t{2}, static_cast<std::uint32_t>(chunks.size() + 12)) + chunks;
    return {{"tetra.obj", obj},
            {"tetra.off", off + vertices_text + faces_text},
            {"text.ply", ply("ascii") + vertices_text + faces_text},
            {"binary.ply", ply("binary_little_endian") + vertices + triangles},
            {"text.stl", stl_text + "endsolid tetra\n"},
            {"binary.stl", stl},
            {"tetra.gltf", gltf(R"("uri":"tetra.bin",)")},
            {"tetra.bin", vertices + indices},
            {"tetra.glb", glb},
            {"scene.toml", "[[object]]\nshape = \"cone\"\n[lines]\nwidth = 2\n"}};
}

}  // namespace burin::test
