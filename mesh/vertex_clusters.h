#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

// Closing cracks moves vertices together, without turning or collapsing the triangles around them.

namespace burin {

/// Some coordinate decides; an order that does not depend on how vertices are numbered.
bool is_less(const glm::dvec3& p, const glm::dvec3& q);

/// Vertices of a mesh that are to be one, in the middle of all of them.
class VertexClusters {
  public:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    /// `pairs` has all vertices that may become one with others.
    VertexClusters(const Mesh& mesh, std::span<const Pair> pairs);

    /// Whether the clusters of two vertices may be one: none of its vertices are farther apart than `largest`, and no
    /// triangle has both, unless it `may_collapse`.
    bool may_join(Pair pair, double largest, bool may_collapse = false) const;
    void join(Pair pair);

    /// The mesh with one vertex for each cluster. Triangles that have collapsed are left out. Clusters that would turn
    /// another one by more than 60 degrees fall apart, unless that is a needle whose end is about as short as what they
    /// move.
    Mesh merge();

  private:
    std::uint32_t cluster_of(std::uint32_t vertex) const { return cluster_[number_[vertex]]; }
    using Positions = std::vector<glm::dvec3>;  // of all vertices, as the mesh would have them
    glm::dvec3 place(std::uint32_t number) const { return mesh_.local_position(vertices_[number]); }
    glm::dvec3 area_of(const Positions& positions, std::uint32_t triangle) const;
    Positions positions() const;
    bool is_needle(const Positions& moved, std::uint32_t triangle) const;
    bool undo_turned(const Positions& moved);
    std::uint32_t stand_in(std::uint32_t vertex) const;

    const Mesh& mesh_;
    Positions given_;                      // before anything moves
    std::vector<std::uint32_t> number_;    // per vertex of the mesh, of those in pairs
    std::vector<std::uint32_t> vertices_;  // the other way round
    std::vector<std::uint32_t> cluster_;
    std::vector<std::vector<std::uint32_t>> members_;    // per cluster
    std::vector<std::vector<std::uint32_t>> triangles_;  // per vertex
};

/// Copies what does not depend on triangles and their corners. Polygons get their normals, also where they had none
/// since all were triangles, for they may no longer be what they were made of.
Mesh with_polygons_of(const Mesh& mesh);

}  // namespace burin
