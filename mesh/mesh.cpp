#include "mesh/mesh.h"

#include "base/interrupt.h"

namespace burin {

glm::dvec3 Mesh::polygon_area_vector(std::uint32_t triangle) const {
    if (!polygon_normals.empty()) return glm::dvec3(polygon_normals[polygon_of(triangle)]);
    const auto& [a, b, c] = triangles[triangle];
    const glm::dvec3 p = local_position(a);
    return glm::cross(local_position(b) - p, local_position(c) - p);
}

EdgeCounts count_edges(const Mesh& mesh) {
    EdgeCounts counts;
    const auto half_edges = static_cast<HalfEdge>(mesh.next_on_edge.size());
    for (HalfEdge h = 0; h < half_edges; ++h) {
        if ((h & 0xFFFFF) == 0) throw_if_interrupted();
        if (mesh.next_on_edge[h] > h) continue;  // rings are in order: only the last one turns back
        std::uint64_t ring = 1;
        for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) ++ring;
        const bool is_diagonal = ring == 2 && mesh.polygon_of(h / 3) == mesh.polygon_of(mesh.next_on_edge[h] / 3);
        counts.marked += mesh.is_marked(h);
        if (is_diagonal) continue;
        ++counts.edges;
        counts.border += ring == 1;
        counts.non_manifold += ring > 2;
    }
    counts.loose = mesh.loose_edges.size();
    counts.marked += counts.loose;
    for (const BorderIndex::Segment& s : mesh.borders.segments()) {
        throw_if_interrupted();
        const glm::dvec3 middle = 0.5 * (s.a + s.b);
        counts.seam += mesh.borders.seam_partner(s.half_edge, middle).has_value();
    }
    return counts;
}

}  // namespace burin
