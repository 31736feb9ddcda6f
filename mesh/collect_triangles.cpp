#include "mesh/collect_triangles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/huge_pages.h"
#include "base/interrupt.h"
#include "base/unfilled_vector.h"
#include "mesh/spatial_order.h"

namespace burin {
namespace {

/// Whether no vertices fall together.
bool are_apart(const std::vector<std::uint32_t>& welded) {
    std::uint32_t differing = 0;
    for (std::size_t v = 0; v < welded.size(); ++v) differing |= welded[v] ^ static_cast<std::uint32_t>(v);
    return differing == 0;
}

/// How many of the vertices that triangles use fall together with others of these.
std::uint64_t count_welded(const PolygonSoup& soup, const std::vector<std::uint32_t>& welded) {
    std::vector<std::uint8_t> is_corner(welded.size(), 0);
    for (const std::uint32_t v : soup.corners) is_corner[v] = 1;
    std::uint64_t count = 0;
    for (std::uint32_t v = 0; v < welded.size(); ++v) {
        const std::uint32_t first = welded[v];
        if (first == v) continue;
        count += is_corner[v] & is_corner[first];
        is_corner[first] |= is_corner[v];
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
           soup.polygon_object.empty() && soup.polygon_material.empty() && soup.marked_edges.empty();
}

void collect_triangles(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                       const std::vector<std::uint32_t>& welded, bool in_spatial_order, Mesh& mesh) {
    constexpr std::uint32_t kUnused = 0xFFFFFFFFu;
    const std::size_t count = soup.polygon_count();
    // The numbers in the object of the first ones of vertices that fall together, and the other way round.
    std::vector<std::uint32_t> local = large_vector(positions.size(), kUnused);
    UnfilledVector<std::uint32_t> used(positions.size() + 1);
    reserve_large(mesh.triangles, count);
    std::uint32_t used_count = 0;
    // Half of the triangles meet a new vertex, and a branch on that would be unpredictable: each is noted as if it were
    // new.
    const auto number_of = [&used_count, local = local.data(), used = used.data(),
                            welded = welded.data()](std::uint32_t v) {
        const std::uint32_t first = welded[v], known = local[first], is_new = known == kUnused ? 1 : 0;
        const std::uint32_t number =
            known ^ ((known ^ used_count) & (0u - is_new));  // a condition would become a branch
        local[first] = number;
        used[used_count] = first;
        used_count += is_new;
        return number;
    };
    const std::uint32_t* const corners = soup.corners.data();
    const glm::vec3* const places = positions.data();
    const auto take = [&](std::size_t i) {
        const std::uint32_t a = corners[3 * i], b = corners[3 * i + 1], c = corners[3 * i + 2];
        // Vertices that are one make no area, and those that are not have different places.
        if (!has_area(places[a], places[b], places[c])) return false;
        const std::uint32_t na = number_of(a), nb = number_of(b), nc = number_of(c);  // in this order
        mesh.triangles.push_back({na, nb, nc});
        return true;
    };
    if (in_spatial_order) {
        UnfilledVector<std::uint32_t> order = SpatialOrder(positions, soup.corners).of_triangles(soup.corners);
        std::vector<std::uint32_t> dropped;
        for (std::size_t k = 0; k < count; ++k) {
            if ((k & 0xFFFF) == 0) throw_if_interrupted();
            const auto corners_ahead = [&](std::size_t ahead) {
                return corners + 3 * std::size_t{order[std::min(k + ahead, count - 1)]};
            };
            __builtin_prefetch(corners_ahead(24));
            const std::uint32_t* const soon = corners_ahead(8);
            for (int corner = 0; corner < 3; ++corner) {
                __builtin_prefetch(places + soon[corner]);
                __builtin_prefetch(&welded[soon[corner]]);
                __builtin_prefetch(&local[soon[corner]], 1);
            }
            const std::uint32_t i = order[k];
            order[mesh.triangles.size()] = i;
            if (!take(i)) dropped.push_back(i);
        }
        order.resize(mesh.triangles.size());
        std::sort(dropped.begin(), dropped.end());
        mesh.input_order = InputOrder(std::move(order), std::move(dropped));
    } else {
        for (std::size_t i = 0; i < count; ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            take(i);
        }
    }
    if (!are_apart(welded)) mesh.repairs.welded_vertices = count_welded(soup, welded);
    reserve_large(mesh.positions, used_count);
    for (std::uint32_t i = 0; i < used_count; ++i) mesh.positions.push_back(places[used[i]]);
    mesh.polygon_count = static_cast<std::uint32_t>(mesh.triangles.size());
    mesh.repairs.input_polygons = mesh.repairs.input_triangles = count;
    mesh.repairs.degenerate_polygons = count - mesh.triangles.size();
}

}  // namespace burin
