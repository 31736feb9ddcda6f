#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/build_meshes.h"
#include "mesh/mesh.h"
#include "mesh/polygon_mesh.h"
#include "mesh/polygon_soup.h"

// Meshes whose vertices move keep their polygons, their links and their order.

namespace burin {

/// A mesh that is made once, with its vertices at rest, and then given other places for them.
///
/// What is made of the file's polygons is decided at rest, so that nothing of it flickers: which vertices are one,
/// which polygons are left out, how they are cut into triangles, which edges are linked, and in which order they stand.
/// Left out is what has no area however its vertices move. What depends on places is made for each frame: origin and
/// rounding, normals of polygons, and where borders are.
class DeformingMesh {
  public:
    /// `soup`: of one object, at rest. `kinds`: per vertex of the soup, equal where vertices in one place stay together
    /// and polygons without area get none. Throws InputError as build_meshes() does.
    DeformingMesh(PolygonSoup soup, std::vector<std::uint32_t> kinds, const MeshOptions& options);

    /// Gives the mesh at rest away; none: the soup has no polygons and no lines.
    std::optional<Mesh> take_rest() { return std::exchange(rest_, std::nullopt); }
    /// The mesh with the soup's vertices at other places. There must be one. May be called by several threads.
    Mesh at(const std::vector<glm::dvec3>& positions) const;

  private:
    MeshOptions options_;
    PolygonSoup frame_;  // without vertices: what rounding wants to know
    std::optional<Mesh> rest_;
    Mesh topology_;                       // without what depends on places
    std::vector<std::uint32_t> sources_;  // per vertex of the mesh, or of what is subdivided: vertex of the soup
    PolygonMesh control_;                 // what is subdivided, if it is; without positions
};

}  // namespace burin
