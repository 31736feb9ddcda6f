#include "mesh/collect_triangles.h"

#include <array>
#include <cstddef>

#include "base/huge_pages.h"
#include "base/interrupt.h"

namespace burin {
namespace {

/// How many of the vertices that triangles use fall together with others of these.
std::uint64_t count_welded(const std::vector<std::uint8_t>& is_corner, const std::vector<std::uint32_t>& welded) {
    bool all_apart = true;
    for (std::uint32_t v = 0; v < welded.size(); ++v) all_apart &= welded[v] == v;
    if (all_apart) return 0;
    std::vector<std::uint8_t> is_welded_corner(welded.size(), 0);
    std::uint64_t count = 0;
    for (std::size_t v = 0; v < welded.size(); ++v) {
        std::uint8_t& is_seen = is_welded_corner[welded[v]];
        count += is_corner[v] & is_seen;
        is_seen |= is_corner[v];
    }
    return count;
}

/// Whether the cross product of two sides is not 0. Its parts are looked at one by one: the first one
/// nearly always tells.
bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 p(a), u = glm::dvec3(b) - p, v = glm::dvec3(c) - p;
    return u.x * v.y != v.x * u.y || u.y * v.z != v.y * u.z || u.z * v.x != v.z * u.x;
}

}  // namespace

bool has_only_triangles(const PolygonSoup& soup) {
    return soup.polygon_count() > 0 && soup.polygon_ends.empty() && soup.object_names.size() <= 1 &&
           soup.polygon_object.empty() && soup.polygon_material.empty() &&
           soup.marked_edges.empty();
}

void collect_triangles(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                       const std::vector<std::uint32_t>& welded, Mesh& mesh) {
    constexpr std::uint32_t kUnused = 0xFFFFFFFFu;
    const std::size_t count = soup.polygon_count();
    // Numbers in the object: of vertices, and of the first ones of those that fall together.
    std::vector<std::uint32_t> local = large_vector(positions.size(), kUnused), local_of_first = local;
    std::vector<std::uint8_t> is_corner(positions.size(), 0);
    reserve_large(mesh.positions, positions.size());
    reserve_large(mesh.triangles, count);
    // Each vertex is asked what it falls together with once, not whenever it is used.
    const auto use = [&](std::uint32_t v) {
        is_corner[v] = 1;
        std::uint32_t& number = local_of_first[welded[v]];
        if (number == kUnused) {
            number = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(positions[v]);
        }
        local[v] = number;
    };
    for (std::size_t i = 0; i < count; ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const std::uint32_t* const corners = &soup.corners[3 * i];
        // Vertices that are one make no area, and those that are not have different places.
        if (!has_area(positions[corners[0]], positions[corners[1]], positions[corners[2]])) {
            for (int k = 0; k < 3; ++k) is_corner[corners[k]] = 1;
            continue;
        }
        std::array<std::uint32_t, 3> t;
        for (std::size_t k = 0; k < 3; ++k) {
            if (local[corners[k]] == kUnused) use(corners[k]);
            t[k] = local[corners[k]];
        }
        mesh.triangles.push_back(t);
    }
    mesh.polygon_count = static_cast<std::uint32_t>(mesh.triangles.size());
    mesh.repairs.input_polygons = mesh.repairs.input_triangles = count;
    mesh.repairs.degenerate_polygons = count - mesh.triangles.size();
    mesh.repairs.welded_vertices = count_welded(is_corner, welded);
}

}  // namespace burin
