#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace burin {

/// One object's polygons after welding and dropping, before triangulation: what subdivision works
/// on. Corners are numbers into `positions`. While all polygons are triangles, they are in
/// `triangles`, else all are in `corners` and `ends`.
struct PolygonMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> ends;              ///< polygon i ends before corners[ends[i]]
    std::vector<std::uint32_t> polygon_material;  ///< empty: all have material 0
    std::vector<std::array<std::uint32_t, 2>> marked_edges;

    std::size_t polygon_count() const { return ends.empty() ? triangles.size() : ends.size(); }
    std::size_t corner_count() const {
        return ends.empty() ? 3 * triangles.size() : corners.size();
    }
    std::span<const std::uint32_t> polygon(std::size_t i) const {
        if (ends.empty()) return triangles[i];
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return {corners.data() + begin, ends[i] - begin};
    }
    void add_polygon(std::span<const std::uint32_t> vertices) {
        if (ends.empty() && vertices.size() == 3) {
            triangles.push_back({vertices[0], vertices[1], vertices[2]});
            return;
        }
        if (ends.empty()) {  // the first one that is no triangle
            for (const auto& triangle : triangles) {
                corners.insert(corners.end(), triangle.begin(), triangle.end());
                ends.push_back(static_cast<std::uint32_t>(corners.size()));
            }
            triangles = {};
        }
        corners.insert(corners.end(), vertices.begin(), vertices.end());
        ends.push_back(static_cast<std::uint32_t>(corners.size()));
    }
};

}  // namespace burin
