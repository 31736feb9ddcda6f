#include "mesh/deforming_mesh.h"

#include <array>
#include <span>
#include <utility>

#include "base/interrupt.h"
#include "mesh/edge_links.h"
#include "mesh/flat_triangles.h"
#include "mesh/moving_vertices.h"
#include "mesh/round_positions.h"
#include "mesh/subdivide.h"

namespace burin {
namespace {

/// The normals of polygons that are not all triangles, as build_meshes() makes them. `polygons`: those of the mesh.
std::vector<glm::vec3> normals_of(const PolygonMesh& polygons) {
    std::vector<glm::vec3> normals;
    if (polygons.ends.empty()) return normals;
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < polygons.polygon_count(); ++i) {
        corners.clear();
        for (const std::uint32_t v : polygons.polygon(i)) corners.push_back(polygons.local_position(v));
        normals.push_back(polygon_normal(corners));
    }
    return normals;
}

}  // namespace

DeformingMesh::DeformingMesh(PolygonSoup soup, std::vector<std::uint32_t> kinds, const MeshOptions& options)
    : options_(options) {
    options_.budget = nullptr;  // what is made in frames is counted once, at rest
    frame_.corners = soup.corners;
    frame_.polygon_ends = soup.polygon_ends;
    frame_.marked_edges = soup.marked_edges;
    MovingVertices moving;
    moving.kinds = std::move(kinds);
    std::vector<Mesh> built = build_meshes(std::move(soup), options, &moving);
    if (built.empty()) return;
    rest_ = std::move(built.front());
    topology_ = *rest_;
    lend_normals_to_flat_triangles(*rest_);
    topology_.positions.clear();
    topology_.residuals.clear();
    topology_.borders = BorderIndex();
    sources_ = std::move(moving.sources);
    control_ = std::move(moving.control);
}

Mesh DeformingMesh::at(const std::vector<glm::dvec3>& positions) const {
    PolygonSoup frame = frame_;
    frame.positions = positions;
    const RoundedPositions rounded = round_positions(frame);
    throw_if_interrupted();
    Mesh mesh = topology_;
    mesh.origin = rounded.origin;
    const bool has_residuals = !rounded.residuals.empty();
    const auto add_sources = [&](std::span<const std::uint32_t> sources, auto& vertices) {
        for (const std::uint32_t v : sources) {
            vertices.positions.push_back(rounded.positions[v]);
            if (has_residuals) vertices.residuals.push_back(rounded.residuals[v]);
        }
    };
    const std::span<const std::uint32_t> sources(sources_);
    if (control_.polygon_count() == 0) {
        add_sources(sources, mesh);
    } else {
        const std::size_t control_vertices = control_.positions.size();
        PolygonMesh control = control_;
        control.positions.clear();
        control.residuals.clear();
        add_sources(sources.first(control_vertices), control);
        PolygonMesh fine = subdivide(control, options_.scheme, options_.subdivision_levels, mesh.name);
        mesh.polygon_normals = normals_of(fine);
        mesh.positions = std::move(fine.positions);
        mesh.residuals = std::move(fine.residuals);
        add_sources(sources.subspan(control_vertices), mesh);
    }
    mesh.borders = index_borders(mesh);
    lend_normals_to_flat_triangles(mesh);
    return mesh;
}

}  // namespace burin
