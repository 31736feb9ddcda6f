#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "mesh/border_index.h"
#include "mesh/input_order.h"
#include "mesh/vertex_attributes.h"

// A mesh is what all else works on: welded vertices, triangles with links across edges, and the polygons that they are
// parts of.

namespace burin {

/// Half-edge k of triangle t (HalfEdge number 3t + k) runs from corner k to corner (k + 1) % 3.
constexpr HalfEdge kNoHalfEdge = 0xFFFFFFFFu;

/// What was done to the polygons of the input on the way to a Mesh.
struct MeshRepairs {
    std::uint64_t input_polygons = 0;
    std::uint64_t input_triangles = 0;      ///< a polygon of n corners counts as n - 2
    std::uint64_t degenerate_polygons = 0;  ///< dropped: under 3 distinct corners, or no area
    std::uint64_t duplicate_polygons = 0;   ///< dropped: the same edges as an earlier polygon
    std::uint64_t cut_polygons = 0;         ///< cut into pieces: they passed an edge twice in one direction
    std::uint64_t cut_pieces = 0;           ///< which are polygons of the mesh, or degenerate or duplicate ones
    std::uint64_t welded_vertices = 0;      ///< vertices merged into one with equal coordinates
};

/// One object's surface: welded vertices and triangulated polygons, with its neighbours.
///
/// Vertices with equal coordinates are one vertex; vertices that no polygon and no loose edge uses
/// are left out. A polygon stays one polygon: its triangles share a number, and the diagonals
/// between them are no edges of the model. Surfaces are two-sided, so winding carries no meaning by
/// itself.
struct Mesh {
    std::string name;

    /// Coordinates are origin + position (+ residual). The origin is 0 unless the model lies so far from 0
    /// that single precision would blur it.
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> positions;
    /// What single precision leaves of each position, 0 too. Empty unless the model is so much larger than what it is
    /// made of that single precision would blur that, wherever the origin is.
    std::vector<glm::vec3> residuals;

    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< vertex numbers
    std::vector<std::uint32_t> triangle_polygon;          ///< empty: triangle i is polygon i
    std::uint32_t polygon_count = 0;
    InputOrder input_order;  ///< of polygons; large meshes are put in spatial order
    /// Normals of the polygons, by their area vectors (Newell); empty: all are triangles, with an area of their own.
    std::vector<glm::vec3> polygon_normals;
    std::vector<std::uint32_t> polygon_material;  ///< empty: all have material 0

    /// The other half-edges on the same two vertices, as a ring: itself at a border, the partner
    /// on a two-manifold edge, a longer ring where more than two triangles meet.
    std::vector<HalfEdge> next_on_edge;
    /// Per half-edge, whether the user or the file marked its edge; empty: none is marked.
    std::vector<bool> marked;
    /// Edges that the file marked and no polygon has, as vertex numbers: lines by themselves.
    std::vector<std::array<std::uint32_t, 2>> loose_edges;
    /// The border half-edges, findable by place (in the coordinates of `positions`).
    BorderIndex borders;

    /// Values at the corners of triangles, as far as they were asked for and the file has them.
    std::vector<AttributeLayer> attributes;

    MeshRepairs repairs;

    std::uint32_t polygon_of(std::uint32_t triangle) const {
        return triangle_polygon.empty() ? triangle : triangle_polygon[triangle];
    }
    /// The place of its polygon among those of the input, which users know.
    std::uint32_t input_place_of(std::uint32_t triangle) const { return input_order.place_of(polygon_of(triangle)); }
    std::uint32_t material_of(std::uint32_t triangle) const {
        return polygon_material.empty() ? 0 : polygon_material[polygon_of(triangle)];
    }
    bool is_marked(HalfEdge h) const { return !marked.empty() && marked[h]; }
    /// Loose edges are numbered behind the half-edges.
    HalfEdge loose_number(std::size_t loose_edge) const {
        return static_cast<HalfEdge>(3 * triangles.size() + loose_edge);
    }
    bool is_loose(HalfEdge h) const { return h >= 3 * triangles.size(); }
    const std::array<std::uint32_t, 2>& loose_edge(HalfEdge h) const { return loose_edges[h - 3 * triangles.size()]; }
    bool has_residuals() const { return !residuals.empty(); }
    /// The place of a vertex, as seen from the origin.
    glm::dvec3 local_position(std::uint32_t vertex) const {
        const glm::dvec3 p(positions[vertex]);
        return residuals.empty() ? p : p + glm::dvec3(residuals[vertex]);
    }
    glm::dvec3 position(std::uint32_t vertex) const { return origin + local_position(vertex); }
    /// Area vector of the polygon that the triangle belongs to (any length, never used as 0).
    glm::dvec3 polygon_area_vector(std::uint32_t triangle) const;
};

/// What kinds of edges a mesh has.
struct EdgeCounts {
    std::uint64_t edges = 0;  ///< between two vertices, without triangulation diagonals
    std::uint64_t border = 0;
    std::uint64_t non_manifold = 0;
    std::uint64_t seam = 0;    ///< border edges with an unstitched neighbour at their middle
    std::uint64_t marked = 0;  ///< of them, and of diagonals; and loose ones
    std::uint64_t loose = 0;   ///< lines that no polygon has
};
EdgeCounts count_edges(const Mesh& mesh);

}  // namespace burin
