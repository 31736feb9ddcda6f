#include "mesh/flat_triangles.h"

#include <algorithm>
#include <numeric>

#include "base/interrupt.h"

namespace burin {
namespace {

glm::dvec3 area_of(const Mesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const glm::dvec3 p = mesh.local_position(a);
    return glm::cross(mesh.local_position(b) - p, mesh.local_position(c) - p);
}

/// The unit normals of a mesh of triangles alone; 0 where there is none.
std::vector<glm::vec3> normals_of_triangles(const Mesh& mesh) {
    std::vector<glm::vec3> normals;
    normals.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 area = area_of(mesh, t);
        const double length = glm::length(area);
        normals.emplace_back(length > 0 ? area / length : glm::dvec3(0.0));
    }
    return normals;
}

bool is_flat(const glm::vec3& normal) { return normal == glm::vec3(0.0f); }

bool has_flat(const Mesh& mesh) {
    if (!mesh.polygon_normals.empty())
        return std::any_of(mesh.polygon_normals.begin(), mesh.polygon_normals.end(), is_flat);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if ((t & 0xFFFF) == 0) throw_if_interrupted();
        const glm::dvec3 area = area_of(mesh, t);
        if (area == glm::dvec3(0.0)) return true;
    }
    return false;
}

}  // namespace

void lend_normals_to_flat_triangles(Mesh& mesh) {
    if (!has_flat(mesh)) return;
    if (mesh.polygon_normals.empty()) {
        mesh.polygon_normals = normals_of_triangles(mesh);
        mesh.triangle_polygon.resize(mesh.triangles.size());
        std::iota(mesh.triangle_polygon.begin(), mesh.triangle_polygon.end(), 0u);
    }
    const auto start_of = [&](HalfEdge h) { return mesh.triangles[h / 3][h % 3]; };
    // From polygons with an area to their neighbours, and on from these.
    std::vector<std::uint32_t> lenders(mesh.triangles.size());
    std::iota(lenders.begin(), lenders.end(), 0u);
    std::erase_if(lenders, [&](std::uint32_t t) { return is_flat(mesh.polygon_normals[mesh.triangle_polygon[t]]); });
    for (std::size_t i = 0; i < lenders.size(); ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        for (HalfEdge h = 3 * lenders[i]; h < 3 * lenders[i] + 3; ++h) {
            const glm::vec3 normal = mesh.polygon_normals[mesh.triangle_polygon[lenders[i]]];
            for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) {
                glm::vec3& other = mesh.polygon_normals[mesh.triangle_polygon[g / 3]];
                if (!is_flat(other)) continue;
                other = start_of(g) == start_of(h) ? -normal : normal;  // as it is wound
                lenders.push_back(g / 3);
            }
        }
    }
    // What has no such neighbour is seen from no side.
    std::replace_if(mesh.polygon_normals.begin(), mesh.polygon_normals.end(), is_flat, glm::vec3(0, 0, 1));
}

}  // namespace burin
