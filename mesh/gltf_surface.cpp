#include "mesh/gltf_surface.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/interrupt.h"
#include "mesh/gltf_marks.h"

namespace burin {
namespace {

class SurfaceBuilder {
  public:
    SurfaceBuilder(const GltfMeshPlan& plan, GltfBuffers& buffers)
        : plan_(plan), buffers_(buffers), group_vertices_(plan.group_corners.size()) {
        surface_.soup.object_names = {plan.name};
    }

    GltfSurface build() {
        reserve();
        for (const GltfPrimitive& primitive : plan_.primitives) {
            throw_if_interrupted();
            const GltfVertices& vertices = vertices_of(primitive);
            const GltfCorners corners(primitive, vertices.draco.get(), buffers_);
            if (!primitive.has_lines()) add_triangles(primitive, corners, vertices);
            append_gltf_marks(primitive, corners, vertices, buffers_, surface_.soup.marked_edges);
        }
        surface_.soup.marked_edge_object.assign(surface_.soup.marked_edges.size(), 0);
        return std::move(surface_);
    }

  private:
    void reserve() {
        std::uint64_t vertices = 0, triangles = 0;
        std::vector<bool> has_group(plan_.group_corners.size(), false);
        for (const GltfPrimitive& primitive : plan_.primitives) {
            triangles += primitive.triangles();
            if (has_group[primitive.vertex_group]) continue;
            has_group[primitive.vertex_group] = true;
            if (!uses_few_vertices(plan_, primitive)) vertices += primitive.vertices;
        }
        PolygonSoup& soup = surface_.soup;
        if (vertices > 0xFFFFFFFFu || 3 * triangles > PolygonSoup::kMaxCorners) return;  // refused
        soup.positions.reserve(vertices);
        soup.corners.reserve(3 * triangles);
    }

    /// Primitives of one mesh often share their vertices: then these are there already.
    const GltfVertices& vertices_of(const GltfPrimitive& primitive) {
        std::optional<std::size_t>& known = group_vertices_[primitive.vertex_group];
        if (known) return surface_.vertices[*known];
        std::vector<glm::dvec3>& positions = surface_.soup.positions;
        GltfVertices vertices(primitive.place);
        vertices.first = positions.size();
        vertices.elements = primitive.vertices;
        if (primitive.is_draco()) {
            vertices.draco = std::make_shared<const DracoGeometry>(decode_draco(primitive, buffers_));
        }
        if (uses_few_vertices(plan_, primitive)) {
            vertices.used = used_elements(primitive.vertex_group);
            if (vertices.used.empty()) vertices.elements = 0;
        }
        const JsonPlace attribute = primitive.place.at("attributes").at("POSITION");
        if (vertices.first + vertices.size() > 0xFFFFFFFFu) {
            attribute.fail("more than 4 billion vertices");
        }
        const GltfAccessor accessor =
            vertices.elements == 0 ? GltfAccessor() : vertices.attribute("POSITION", "VEC3", buffers_);
        for (std::uint64_t i = 0; i < vertices.size(); ++i) {
            positions.push_back(gltf_position(accessor, vertices.element_of(i), attribute));
        }
        known = surface_.vertices.size();
        surface_.vertices.push_back(std::move(vertices));
        return surface_.vertices.back();
    }

    /// What the primitives of a group use of their accessors' elements, in order.
    std::vector<std::uint32_t> used_elements(std::size_t group) {
        std::vector<std::uint32_t> used;
        for (const GltfPrimitive& primitive : plan_.primitives) {
            if (primitive.vertex_group != group) continue;
            const GltfCorners corners(primitive, nullptr, buffers_);
            for (std::uint64_t i = 0; i < corners.count(); ++i) {
                used.push_back(static_cast<std::uint32_t>(corners[i]));
            }
        }
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        return used;
    }

    void add_triangles(const GltfPrimitive& primitive, const GltfCorners& corners, const GltfVertices& vertices) {
        PolygonSoup& soup = surface_.soup;
        const std::uint64_t triangles = primitive.triangles();
        if (soup.corners.size() + 3 * triangles > PolygonSoup::kMaxCorners) {
            primitive.place.fail("more than 4 billion polygon corners");
        }
        for (std::uint64_t t = 0; t < triangles; ++t) {
            std::array<std::uint64_t, 3> corner = gltf_triangle(primitive.mode, t);
            // Turned, so that fans and strips begin with the vertex that has been there longest.
            const bool is_turned = primitive.mode == 6 || (primitive.mode == 5 && t % 2 == 1);
            if (is_turned) corner = {corner[2], corner[0], corner[1]};
            for (const std::uint64_t c : corner) {
                soup.corners.push_back(vertices.vertex_of(corners[c]));
            }
        }
        soup.polygon_material.resize(soup.polygon_count(), primitive.material);
    }

    const GltfMeshPlan& plan_;
    GltfBuffers& buffers_;
    std::vector<std::optional<std::size_t>> group_vertices_;
    GltfSurface surface_;
};

}  // namespace

GltfSurface expand_gltf_mesh(const GltfMeshPlan& plan, GltfBuffers& buffers) {
    return SurfaceBuilder(plan, buffers).build();
}

}  // namespace burin
