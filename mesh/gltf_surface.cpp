#include "mesh/gltf_surface.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>

#include "base/error.h"
#include "base/interrupt.h"
#include "mesh/gltf_marks.h"

namespace burin {
namespace {

class SurfaceBuilder {
  public:
    SurfaceBuilder(const GltfMeshPlan& plan, GltfBuffers& buffers, const AttributeWish& attributes)
        : plan_(plan), buffers_(buffers), attributes_(attributes), group_vertices_(plan.group_corners.size()) {
        surface_.soup.object_names = {plan.name};
        if (!attributes.empty()) add_layers();
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
    /// A layer for each attribute of any primitive that is asked for.
    void add_layers() {
        PolygonSoup& soup = surface_.soup;
        std::size_t named = 0;
        for (const GltfPrimitive& primitive : plan_.primitives) {
            const JsonPlace attributes = primitive.place.at("attributes");
            for (const auto& [name, accessor] : attributes.json().items()) {
                const bool is_named = name.starts_with('_');
                std::string type;
                const bool is_there =
                    !is_named || is_read([&, &name = name] { type = buffers_.type_of(attributes.at(name.c_str())); });
                if (is_named && (!is_there || type != "SCALAR")) continue;
                const auto is_known = [&name = name](const std::vector<std::string>& names) {
                    return std::find(names.begin(), names.end(), name) != names.end();
                };
                if (is_named && !is_known(soup.attribute_names)) soup.attribute_names.push_back(name);
                if (!is_wanted_attribute(name, attributes_) || is_known(layer_names_)) continue;
                if (is_named && ++named > kMostNamedAttributes) continue;
                const AttributeKind kind = is_named            ? AttributeKind::named
                                           : name == "COLOR_0" ? AttributeKind::color
                                                               : AttributeKind::uv;
                soup.attributes.push_back({kind, is_named ? name : std::string(), {}, {}});
                layer_names_.push_back(name);
            }
        }
    }

    /// Where all attributes are kept, because somebody may read them later, what is wrong with one is only noted.
    template <typename Read>
    bool is_read(const Read& read) {
        try {
            read();
            return true;
        } catch (const InputError& error) {
            if (!attributes_.all_named) throw;
            surface_.soup.notes.push_back(std::string("values of vertices left out: ") + error.what());
            return false;
        }
    }
    DracoGeometry decode(const GltfPrimitive& primitive) {
        DracoGeometry geometry;
        if (!is_read([&] { geometry = decode_draco(primitive, buffers_, attributes_); }))
            geometry = decode_draco(primitive, buffers_, {});
        return geometry;
    }

    /// The values of the attributes that the vertices of a primitive have.
    void add_values(const GltfPrimitive& primitive, GltfVertices& vertices) {
        vertices.first_rows.assign(layer_names_.size(), AttributeLayer::kNoRow);
        if (vertices.elements == 0) return;
        for (std::size_t i = 0; i < layer_names_.size(); ++i) {
            if (primitive.place.at("attributes").has(layer_names_[i].c_str()))
                is_read([&] { add_values_of(i, primitive, vertices); });
        }
    }
    void add_values_of(std::size_t i, const GltfPrimitive& primitive, GltfVertices& vertices) {
        const char* const name = layer_names_[i].c_str();
        const JsonPlace attributes = primitive.place.at("attributes");
        AttributeLayer& layer = surface_.soup.attributes[i];
        const bool has_alpha = layer.kind == AttributeKind::color && buffers_.type_of(attributes.at(name)) == "VEC4";
        static constexpr const char* kTypes[] = {"VEC2", "VEC3", "SCALAR"};
        const GltfAccessor accessor =
            vertices.attribute(name, has_alpha ? "VEC4" : kTypes[static_cast<std::size_t>(layer.kind)], buffers_);
        vertices.first_rows[i] = static_cast<std::uint32_t>(layer.row_count());
        std::array<float, 3> row{};
        for (std::uint64_t v = 0; v < vertices.size(); ++v) {
            for (std::size_t k = 0; k < layer.components(); ++k)
                row[k] = static_cast<float>(accessor.number(vertices.element_of(v), static_cast<int>(k)));
            layer.add_row(std::span(row).first(layer.components()));
        }
    }

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
            vertices.draco = std::make_shared<const DracoGeometry>(decode(primitive));
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
        add_values(primitive, vertices);
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
                const std::uint32_t vertex = vertices.vertex_of(corners[c]);
                soup.corners.push_back(vertex);
                for (std::size_t i = 0; i < soup.attributes.size(); ++i) {
                    const std::uint32_t first = vertices.first_rows[i];
                    soup.attributes[i].rows.push_back(first == AttributeLayer::kNoRow
                                                          ? first
                                                          : first +
                                                                (vertex - static_cast<std::uint32_t>(vertices.first)));
                }
            }
        }
        soup.polygon_material.resize(soup.polygon_count(), primitive.material);
    }

    const GltfMeshPlan& plan_;
    GltfBuffers& buffers_;
    const AttributeWish& attributes_;
    std::vector<std::string> layer_names_;  // in the file, of the soup's attributes
    std::vector<std::optional<std::size_t>> group_vertices_;
    GltfSurface surface_;
};

}  // namespace

GltfSurface expand_gltf_mesh(const GltfMeshPlan& plan, GltfBuffers& buffers, const AttributeWish& attributes) {
    return SurfaceBuilder(plan, buffers, attributes).build();
}

}  // namespace burin
