#pragma once

#include <burin/burin.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace burin::test {

/// Arrays of a mesh.
struct Arrays {
    std::vector<float> points;
    std::vector<std::int32_t> corners, sizes, materials, objects, marks;
    std::vector<std::string> object_names;

    Mesh mesh(const std::string& name = {}) const {
        return {name, points, corners, sizes, materials, objects, object_names, marks};
    }
};

/// A cube of six quads with a corner at (x, y, z), added to what is there.
inline void add_cube(Arrays& to, float side = 1, float x = 0, float y = 0, float z = 0) {
    const auto first = static_cast<std::int32_t>(to.points.size() / 3);
    for (const std::array<float, 3>& p :
         {std::array<float, 3>{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}) {
        to.points.insert(to.points.end(), {x + side * p[0], y + side * p[1], z + side * p[2]});
    }
    for (const int corner : {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7})
        to.corners.push_back(first + corner);
    to.sizes.insert(to.sizes.end(), 6, 4);
}
inline Arrays cube() {
    Arrays arrays;
    add_cube(arrays);
    return arrays;
}

/// A wavy sheet of n x n triangulated squares: smooth contours, creases and borders.
inline Arrays waves(int n) {
    Arrays arrays;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(n),
                        v = static_cast<float>(y) / static_cast<float>(n);
            arrays.points.insert(arrays.points.end(), {u, 0.2f * std::sin(9 * u) * std::cos(7 * v), v});
        }
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const int a = y * (n + 1) + x, b = a + n + 1;
            for (const int corner : {a, a + 1, b + 1, a, b + 1, b}) arrays.corners.push_back(corner);
        }
    }
    return arrays;
}

/// The same arrays as an OBJ file writes them, with `usemtl` and `o` where they change.
inline std::string obj_text(const Arrays& arrays) {
    std::string text = arrays.materials.empty() ? "" : "mtllib colours.mtl\n";
    char line[120];
    for (std::size_t i = 0; i < arrays.points.size(); i += 3) {
        std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", static_cast<double>(arrays.points[i]),
                      static_cast<double>(arrays.points[i + 1]), static_cast<double>(arrays.points[i + 2]));
        text += line;
    }
    std::size_t corner = 0;
    int object = -1, material = -1;
    for (std::size_t i = 0; corner < arrays.corners.size(); ++i) {
        if (!arrays.objects.empty() && arrays.objects[i] != object) {
            object = arrays.objects[i];
            text += "o " + arrays.object_names[static_cast<std::size_t>(object)] + "\n";
        }
        if (!arrays.materials.empty() && arrays.materials[i] != material) {
            material = arrays.materials[i];
            text += "usemtl m" + std::to_string(material) + "\n";
        }
        text += "f";
        const int size = arrays.sizes.empty() ? 3 : arrays.sizes[i];
        for (int k = 0; k < size; ++k) text += " " + std::to_string(arrays.corners[corner++] + 1);
        text += "\n";
    }
    for (std::size_t i = 0; i < arrays.marks.size(); i += 2)
        text += "l " + std::to_string(arrays.marks[i] + 1) + " " + std::to_string(arrays.marks[i + 1] + 1) + "\n";
    return text;
}

inline std::string exr_of(Scene& scene, const View& view = {.width = 200, .height = 150}, const Options& options = {}) {
    const std::vector<std::byte> bytes = scene.render(view, options).encode("exr");
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// What the call throws: its kind, or BURIN_DONE, and what it says.
template <typename Call>
int failure_of(const Call& call, std::string* text = nullptr) {
    try {
        call();
        return BURIN_DONE;
    } catch (const Error& error) {
        if (text != nullptr) *text = error.what();
        return error.kind();
    }
}

/// A camera at `eye` that looks at `target`, +Y up.
inline Matrix looking(const std::array<double, 3>& eye, const std::array<double, 3>& target) {
    const auto unit = [](std::array<double, 3> v) {
        const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return std::array{v[0] / length, v[1] / length, v[2] / length};
    };
    const auto z = unit({eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]});
    const auto x = unit({z[2], 0, -z[0]});
    const std::array y = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]};
    return {x[0], y[0], z[0], eye[0], x[1], y[1], z[1], eye[1], x[2], y[2], z[2], eye[2], 0, 0, 0, 1};
}

}  // namespace burin::test
