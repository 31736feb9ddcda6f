#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

// Subdivision works on polygons that are welded and cleaned, but not yet cut into triangles.

namespace burin {

/// One object's polygons after welding and dropping, before triangulation: what subdivision works
/// on. Corners are numbers into `positions`.
struct PolygonMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> residuals;  ///< as Mesh has them
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> ends;              ///< empty: all polygons are triangles
    std::vector<std::uint32_t> polygon_material;  ///< empty: all have material 0
    std::vector<std::array<std::uint32_t, 2>> marked_edges;
    /// The polygon of the soup that each one was, and the vertex of the soup; empty: nobody asks.
    std::vector<std::uint32_t> sources, source_vertices;

    glm::dvec3 local_position(std::uint32_t vertex) const {
        const glm::dvec3 p(positions[vertex]);
        return residuals.empty() ? p : p + glm::dvec3(residuals[vertex]);
    }
    std::size_t polygon_count() const { return ends.empty() ? corners.size() / 3 : ends.size(); }
    std::span<const std::uint32_t> polygon(std::size_t i) const {
        if (ends.empty()) return {corners.data() + 3 * i, 3};
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return {corners.data() + begin, ends[i] - begin};
    }
    void add_polygon(std::span<const std::uint32_t> vertices) {
        if (ends.empty() && vertices.size() != 3) {
            // The first one that is no triangle: list the ends of those before it.
            for (std::size_t end = 3; end <= corners.size(); end += 3) {
                ends.push_back(static_cast<std::uint32_t>(end));
            }
        }
        const bool has_ends = !ends.empty() || vertices.size() != 3;
        corners.insert(corners.end(), vertices.begin(), vertices.end());
        if (has_ends) ends.push_back(static_cast<std::uint32_t>(corners.size()));
    }
};

}  // namespace burin
