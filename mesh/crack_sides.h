#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

// Closing cracks needs to know which borders are the two sides of one, and how wide it may be.

namespace burin {

/// How far apart the two sides of a crack may be at a place, in units of the mesh; 0 or less: not at all.
using CrackReach = std::function<double(const glm::dvec3& position)>;

/// A thread looks for what is beside this many borders in a row.
constexpr std::size_t kBordersAtOnce = 256;

/// The borders of a mesh, as sides of cracks.
class CrackSides {
  public:
    CrackSides(const Mesh& mesh, const CrackReach& reach);

    const Mesh& mesh() const { return mesh_; }
    std::span<const BorderIndex::Segment> segments() const { return segments_; }
    double length(std::uint32_t segment) const { return lengths_[segment]; }
    /// Whether a border is as short as 1/8 of the reach and 1/3 of its triangle's other edges: no side of a crack, but
    /// a corner that was two equal ones before they were moved apart.
    bool is_end_of_needle(std::uint32_t segment) const { return is_end_of_needle_[segment]; }
    /// How wide a crack between two sides of this length may be. No wider than half of the triangle beside it, unless
    /// that is 1/8 of the reach: slats of a blind are as far apart as they are high.
    double widest(std::uint32_t segment, double length) const;
    /// The vertices that a border runs between.
    std::pair<std::uint32_t, std::uint32_t> ends(std::uint32_t segment) const;
    /// Whether two borders may be the sides of one crack, as far as their polygons say: not those of a strip or groove,
    /// with polygons between them.
    bool are_beside(std::uint32_t s, std::uint32_t t) const;
    /// The direction from the border into its polygon.
    glm::dvec3 inward(std::uint32_t segment) const;
    /// The length that directions have in trees of places and directions: a part of how far borders reach. In a pile,
    /// what lies in one place is told apart by its polygon; elsewhere places tell more.
    double length_of_directions() const;
    /// Whether no border with a direction inward in a box is beside one with direction `inward`: each of their polygons
    /// folds back over the other one. In a pile that is so of nearly all.
    static bool all_fold_back(const glm::dvec3& inward, const glm::dvec3& low, const glm::dvec3& high);

  private:
    bool ends_before(std::uint32_t segment, std::uint32_t other) const;
    bool has_beside(std::uint32_t segment, std::uint32_t vertex) const;
    std::uint32_t apex_vertex(std::uint32_t segment) const;
    glm::dvec3 apex(std::uint32_t segment) const;
    glm::dvec3 across(std::uint32_t segment) const;

    const Mesh& mesh_;
    std::span<const BorderIndex::Segment> segments_;
    std::vector<double> lengths_, reach_, heights_;  // per segment
    std::vector<bool> is_end_of_needle_;
};

}  // namespace burin
