#include "mesh/collect_triangles.h"

#include <array>
#include <cstddef>

#include "base/huge_pages.h"
#include "base/interrupt.h"

namespace burin {
namespace {

/// How many of the vertices that triangles use fall together with others of these.
std::uint64_t count_welded(const PolygonSoup& soup, const std::vector<std::uint32_t>& welded) {
    std::vector<std::uint8_t> is_corner(welded.size(), 0), is_welded_corner(welded.size(), 0);
    for (const std::uint32_t corner : soup.corners) is_corner[corner] = 1;
    std::uint64_t count = 0;
    for (std::size_t v = 0; v < welded.size(); ++v) {
        std::uint8_t& is_seen = is_welded_corner[welded[v]];
        count += is_corner[v] & is_seen;
        is_seen |= is_corner[v];
    }
    return count;
}

bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 p(a);
    return glm::cross(glm::dvec3(b) - p, glm::dvec3(c) - p) != glm::dvec3(0.0);
}

}  // namespace

bool has_only_triangles(const PolygonSoup& soup) {
    return soup.polygon_count() > 0 && soup.polygon_ends.empty() && soup.object_names.size() <= 1 &&
           soup.polygon_object.empty() && soup.polygon_material.empty() &&
           soup.marked_edges.empty();
}

PolygonMesh collect_triangles(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                              const std::vector<std::uint32_t>& welded, MeshRepairs& repairs) {
    constexpr std::uint32_t kUnused = 0xFFFFFFFFu;
    const std::size_t count = soup.polygon_count();
    std::vector<std::uint32_t> local =
        large_vector(positions.size(), kUnused);  // number in the object
    PolygonMesh mesh;
    reserve_large(mesh.positions, positions.size());
    reserve_large(mesh.corners, 3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const std::uint32_t* const corners = &soup.corners[3 * i];
        std::array<std::uint32_t, 3> t{welded[corners[0]], welded[corners[1]], welded[corners[2]]};
        // Vertices that are one make no area, and those that are not have different places.
        if (!has_area(positions[t[0]], positions[t[1]], positions[t[2]])) continue;
        for (std::uint32_t& v : t) {
            if (local[v] == kUnused) {
                local[v] = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back(positions[v]);
            }
            v = local[v];
        }
        mesh.corners.insert(mesh.corners.end(), t.begin(), t.end());
    }
    repairs.input_polygons = repairs.input_triangles = count;
    repairs.degenerate_polygons = count - mesh.polygon_count();
    repairs.welded_vertices = count_welded(soup, welded);
    return mesh;
}

}  // namespace burin
