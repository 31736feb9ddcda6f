#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/marked_edges.h"
#include "mesh/mesh.h"
#include "mesh/moving_vertices.h"
#include "mesh/polygon_mesh.h"
#include "mesh/polygon_soup.h"

// Polygons of any kind become objects: sorted by object, welded, cleaned and counted.

namespace burin {

/// Polygons of the soup, object by object, in their order.
struct PolygonsByObject {
    std::vector<std::uint32_t> order;  ///< empty: one object, in the soup's order
    std::vector<std::size_t> end;      ///< per object
};
PolygonsByObject group_by_object(const PolygonSoup& soup);

/// A normal to any three corners that do not lie on one line; 0 if all do.
glm::dvec3 normal_of_any_corners(std::span<const glm::dvec3> corners);

/// Collects one object's polygons: own vertex numbers in the order of their use, nothing repeated,
/// nothing without area.
class ObjectCollector {
  public:
    /// `residuals`: of positions, as Mesh has them. `welded`: per vertex of the soup the number of the first one at its
    /// place. `marks`: of the soup. `moving`: nullptr: the vertices stay where they are.
    ObjectCollector(const PolygonSoup& soup, const std::vector<glm::vec3>& positions,
                    const std::vector<glm::vec3>& residuals, const std::vector<std::uint32_t>& welded,
                    const MarkedEdges& marks, const MovingVertices* moving = nullptr);

    /// The polygons groups.order[begin, end), which are all of one object. `dropped`: gets the places, from `begin` on,
    /// of those without area.
    PolygonMesh collect(const PolygonsByObject& groups, std::size_t begin, std::size_t end, MeshRepairs& repairs,
                        std::vector<std::uint32_t>& dropped);
    /// The numbers of the marks that the last object got, in the order of its marked edges.
    const std::vector<std::size_t>& collected_marks() const { return collected_marks_; }

  private:
    static constexpr std::uint32_t kUnused = 0xFFFFFFFFu;

    void collapse(std::span<const std::uint32_t> corners, MeshRepairs& repairs);
    void add_marks(PolygonMesh& mesh);
    void forget(const PolygonsByObject& groups, std::size_t begin, std::size_t end);
    bool has_no_area();
    bool may_get_area() const;
    bool knows_sources() const { return moving_ != nullptr || !soup_.attributes.empty(); }
    std::uint32_t local_number(std::uint32_t v, PolygonMesh& mesh);

    const PolygonSoup& soup_;
    const std::vector<glm::vec3>&positions_, &residuals_;
    const std::vector<std::uint32_t>& welded_;
    std::vector<std::uint32_t> local_;  // per soup vertex: its number in the object
    std::vector<std::uint32_t> used_;
    // Per soup vertex, whether a polygon of the object has it as a corner, before and after
    // welding.
    std::vector<bool> is_corner_, is_welded_corner_;
    std::uint64_t corners_seen_ = 0, welded_corners_seen_ = 0;
    const MarkedEdges& marks_;
    const MovingVertices* moving_;
    std::vector<std::size_t> collected_marks_;
    std::vector<std::uint32_t> corners_;
    std::vector<glm::dvec3> places_;  // of corners_
};

}  // namespace burin
