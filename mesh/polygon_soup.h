#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "mesh/vertex_attributes.h"

// A reader delivers a soup: polygons, marks, names and materials as they stand in the file.

namespace burin {

/// What a polygon looks like when it is shaded and how much it hides.
struct Material {
    std::string name;
    glm::vec3 color{0.8f};  ///< linear RGB, 0..1
    float opacity = 1.0f;   ///< 1 = opaque
};

/// Polygons as they stand in a file: not welded, not checked, any number of corners.
struct PolygonSoup {
    std::vector<glm::dvec3> positions;
    /// Vertex numbers (from 0) of all polygons, one polygon after the other.
    std::vector<std::uint32_t> corners;
    /// Polygon i has corners [polygon_ends[i-1], polygon_ends[i]). Empty: all are triangles.
    std::vector<std::uint32_t> polygon_ends;
    std::vector<std::uint32_t> polygon_object;               ///< per polygon; empty: all are object 0
    std::vector<std::uint32_t> polygon_material;             ///< per polygon; empty: all have material 0
    std::vector<std::array<std::uint32_t, 2>> marked_edges;  ///< vertex numbers
    std::vector<std::uint32_t> marked_edge_object;           ///< per marked edge; empty: all are of object 0
    std::vector<std::string> object_names;                   ///< at least one
    std::vector<Material> materials;                         ///< at least one
    std::uint64_t non_finite_polygons = 0;                   ///< left out: a coordinate is not finite or beyond 1e30
    std::vector<AttributeLayer> attributes;                  ///< as they were asked for; those of objects are together
    std::vector<std::string> attribute_names;  ///< if any were asked for: all named ones that the file has
    std::vector<std::string> notes;            ///< what the reader left out or did not take as it stands, a line each

    /// Corner counts are stored in 32 bits.
    static constexpr std::size_t kMaxCorners = std::numeric_limits<std::uint32_t>::max();

    std::size_t polygon_count() const { return polygon_ends.empty() ? corners.size() / 3 : polygon_ends.size(); }
    std::span<const std::uint32_t> polygon(std::size_t i) const {
        if (polygon_ends.empty()) return {corners.data() + 3 * i, 3};
        const std::size_t begin = i == 0 ? 0 : polygon_ends[i - 1];
        return {corners.data() + begin, polygon_ends[i] - begin};
    }
    std::uint32_t object_of(std::size_t i) const { return polygon_object.empty() ? 0 : polygon_object[i]; }
    /// Counts where no polygon has the marked edge: a polygon's own marks are its object's.
    std::uint32_t object_of_mark(std::size_t i) const { return marked_edge_object.empty() ? 0 : marked_edge_object[i]; }
    std::uint32_t material_of(std::size_t i) const { return polygon_material.empty() ? 0 : polygon_material[i]; }

    /// Adds a polygon of any size to a soup whose polygon_ends are in use from the first one on.
    void add_polygon(std::span<const std::uint32_t> vertices) {
        corners.insert(corners.end(), vertices.begin(), vertices.end());
        polygon_ends.push_back(static_cast<std::uint32_t>(corners.size()));
    }
};

}  // namespace burin
