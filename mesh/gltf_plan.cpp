#include "mesh/gltf_plan.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace burin {
namespace {

// What a triangle, a vertex, a mark and an object take at most at a time, while they are loaded
// (90, 50, 130 and 350 were measured) and drawn.
constexpr double kTriangleBytes = 160, kVertexBytes = 70, kMarkBytes = 150, kObjectBytes = 700;
constexpr double kInstanceBytes = 12;  // a translation in the file

constexpr std::array<const char*, 3> kExtensions = {kDracoExtension, kEdgeVisibilityExtension, kOutlineExtension};

/// What the vertices come from, as text.
std::string vertex_key(const JsonPlace& place, const AttributeWish& attributes) {
    std::string key;
    for (const auto& [name, accessor] : place.at("attributes").json().items()) {
        if (name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") ||
            is_wanted_attribute(name, attributes)) {
            key += name + ' ' + accessor.dump() + ' ';
        }
    }
    for (std::size_t i = 0; i < place.size_of("targets"); ++i) {
        const JsonPlace target = place.at("targets").element(i);
        key += target.has("POSITION") ? "target " + target.at("POSITION").json().dump() + ' ' : "-";
    }
    if (place.has_extension(kDracoExtension)) {
        key += place.extension(kDracoExtension).json().dump();
    }
    return key;
}

/// What its polygons and lines come from, as text.
std::string primitive_key(const JsonPlace& place, const GltfPrimitive& primitive) {
    std::string key = std::to_string(primitive.vertex_group) + ' ' + std::to_string(primitive.mode) + ' ' +
                      std::to_string(primitive.material);
    if (place.has("indices")) key += ' ' + place.at("indices").json().dump();
    for (const char* name : kExtensions) {
        if (place.has_extension(name)) key += ' ' + place.extension(name).json().dump();
    }
    return key;
}

std::uint64_t material_of(const JsonPlace& place, const GltfMaterials& materials) {
    const std::size_t own = materials.materials.size() - 1;
    return place.has("material") ? place.at("material").index_below(own, "material") : own;
}

}  // namespace

std::uint64_t GltfPrimitive::triangles() const {
    if (mode < 4) return 0;
    return mode == 4 ? corners / 3 : (corners < 3 ? 0 : corners - 2);
}

std::uint64_t GltfPrimitive::line_segments() const {
    if (mode == 1) return corners / 2;
    if (mode > 3 || corners < 2) return 0;
    return mode == 2 ? corners : corners - 1;
}

bool GltfPrimitive::has_marked_edges() const {
    return place.has_extension(kEdgeVisibilityExtension) || place.has_extension(kOutlineExtension);
}

bool GltfPrimitive::is_draco() const { return place.has_extension(kDracoExtension); }

bool is_wanted_attribute(std::string_view name, const AttributeWish& attributes) {
    if (name == "TEXCOORD_0") return attributes.uv;
    if (name == "COLOR_0") return attributes.color;
    return name.starts_with('_') && attributes.wants(name);
}

GltfMeshPlan plan_gltf_mesh(const JsonPlace& mesh, std::size_t number, GltfBuffers& buffers,
                            const GltfMaterials& materials, const AttributeWish& attributes) {
    GltfMeshPlan plan;
    plan.name = mesh.text_or("name", "mesh" + std::to_string(number));
    std::map<std::string, std::size_t> groups;
    std::set<std::string> known;
    const JsonPlace primitives = mesh.at("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const JsonPlace place = primitives.element(i);
        GltfPrimitive primitive(place);
        primitive.mode = place.integer_or("mode", 4);
        if (primitive.mode > 6) place.fail("unknown mode " + std::to_string(primitive.mode));
        const bool has_positions = place.at("attributes").has("POSITION");
        if (primitive.mode == 0 || !has_positions) {
            ++(has_positions ? plan.skipped_points : plan.skipped_without_positions);
            continue;
        }
        // What Draco compressed has accessors without data.
        const std::uint64_t known_count = primitive.is_draco() ? UINT64_MAX : 0;
        const GltfAccessor positions =
            buffers.without_sparse(place.at("attributes").at("POSITION"), "VEC3", known_count);
        primitive.vertices = primitive.corners = positions.count;
        primitive.vertex_size = positions.element_size;
        primitive.material = static_cast<std::uint32_t>(material_of(place, materials));
        if (place.has("indices") || primitive.is_draco()) {
            const GltfAccessor indices = buffers.without_sparse(place.at("indices"), "SCALAR", known_count);
            if (indices.component_type == kGltfFloat) {
                place.at("indices").fail("indices must be integers");
            }
            primitive.corners = indices.count;
            primitive.index_size = indices.element_size;
        }
        if (materials.is_cut_out[primitive.material]) {
            plan.cut_out_polygons += primitive.triangles();
            plan.cut_out_lines += primitive.line_segments();
            continue;
        }
        primitive.vertex_group = groups.try_emplace(vertex_key(place, attributes), groups.size()).first->second;
        const auto [key, is_new] = known.insert(primitive_key(place, primitive));
        if (!is_new) continue;
        plan.group_corners.resize(groups.size());
        plan.group_corners[primitive.vertex_group] += primitive.corners;
        plan.primitives.push_back(std::move(primitive));
    }
    // The numbers of the groups are in those of the primitives.
    std::vector<const std::string*> by_number(groups.size());
    for (const auto& [key, group] : groups) by_number[group] = &key;
    for (const std::string* key : by_number) plan.key += *key + '\n';
    for (const GltfPrimitive& primitive : plan.primitives) {
        plan.key += primitive_key(primitive.place, primitive) + '\n';
    }
    return plan;
}

std::uint64_t GltfMeshPlan::vertex_count() const {
    std::vector<std::uint64_t> in_group(group_corners.size(), 0);
    for (const GltfPrimitive& p : primitives)
        in_group[p.vertex_group] = uses_few_vertices(*this, p) ? group_corners[p.vertex_group] : p.vertices;
    std::uint64_t count = 0;
    for (const std::uint64_t vertices : in_group) count += std::min(vertices, UINT64_MAX - count);
    return count;
}

bool uses_few_vertices(const GltfMeshPlan& mesh, const GltfPrimitive& primitive) {
    return primitive.index_size > 0 && !primitive.has_marked_edges() && !primitive.is_draco() &&
           mesh.group_corners[primitive.vertex_group] < primitive.vertices / 2;
}

void GltfExpansion::add_mesh(const GltfMeshPlan& mesh, std::uint64_t times) {
    double read = 0, needed = 0;
    std::vector<bool> has_group(mesh.group_corners.size(), false);
    for (const GltfPrimitive& p : mesh.primitives) {
        const auto corners = static_cast<double>(p.corners);
        const auto triangles = static_cast<double>(p.triangles());
        read += corners * static_cast<double>(p.index_size);
        needed += triangles * kTriangleBytes + static_cast<double>(p.line_segments()) * kMarkBytes;
        if (p.has_marked_edges()) needed += triangles * kMarkBytes;
        if (has_group[p.vertex_group]) continue;
        has_group[p.vertex_group] = true;
        const auto vertices =
            static_cast<double>(uses_few_vertices(mesh, p) ? mesh.group_corners[p.vertex_group] : p.vertices);
        read += vertices * static_cast<double>(p.vertex_size);
        needed += vertices * kVertexBytes;
    }
    read_ += read * static_cast<double>(times);
    needed_ += needed * static_cast<double>(times);
}

void GltfExpansion::add_instances(std::uint64_t count) {
    read_ += static_cast<double>(count) * kInstanceBytes;
    needed_ += static_cast<double>(count) * kObjectBytes;
}

std::uint64_t GltfExpansion::beyond(std::uint64_t own_bytes) const {
    const auto own = static_cast<double>(own_bytes);
    if (read_ <= own) return 0;
    return static_cast<std::uint64_t>(std::min(needed_ * (1 - own / read_), 1e18));
}

}  // namespace burin
