#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/gltf_buffers.h"
#include "mesh/gltf_json.h"
#include "mesh/gltf_materials.h"
#include "mesh/vertex_attributes.h"

// What a glTF will take is known before its accessors are expanded, so that too much can be refused.

namespace burin {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";
inline constexpr const char* kEdgeVisibilityExtension = "EXT_mesh_primitive_edge_visibility";
inline constexpr const char* kOutlineExtension = "CESIUM_primitive_outline";

/// A primitive of a glTF mesh before its accessors are expanded.
struct GltfPrimitive {
    explicit GltfPrimitive(const JsonPlace& primitive) : place(primitive) {}

    JsonPlace place;
    std::uint64_t mode = 4;
    std::uint32_t material = 0;
    std::uint64_t vertices = 0;     ///< elements of its accessors
    std::uint64_t corners = 0;      ///< vertex numbers: of its indices, or as many as vertices
    std::uint64_t vertex_size = 0;  ///< bytes of a position in the file
    std::uint64_t index_size = 0;   ///< bytes of one; 0: it has no indices
    std::size_t vertex_group = 0;   ///< equal in primitives of a mesh that have the same vertices

    bool has_lines() const { return mode < 4; }
    std::uint64_t triangles() const;
    std::uint64_t line_segments() const;
    /// Whether one of the extensions that name edges of its triangles is there.
    bool has_marked_edges() const;
    bool is_draco() const;
};

/// A glTF mesh before its accessors are expanded.
struct GltfMeshPlan {
    std::string name;
    std::vector<GltfPrimitive> primitives;     ///< what is drawn; equal ones are there once
    std::vector<std::uint64_t> group_corners;  ///< per vertex group, of all its primitives
    std::string key;                           ///< the same for meshes that hold the same
    std::uint64_t skipped_points = 0;
    std::uint64_t skipped_without_positions = 0;
    std::uint64_t cut_out_polygons = 0;
    std::uint64_t cut_out_lines = 0;

    /// Of all groups together.
    std::uint64_t vertex_count() const;
};

/// Whether an attribute of a primitive, by its name in the file, is one that was asked for.
bool is_wanted_attribute(std::string_view name, const AttributeWish& attributes);

/// `attributes`: primitives that differ in these do not share their vertices.
GltfMeshPlan plan_gltf_mesh(const JsonPlace& mesh, std::size_t number, GltfBuffers& buffers,
                            const GltfMaterials& materials, const AttributeWish& attributes = {});

/// Whether only the vertices that a group's primitives use are read: they use few of them.
bool uses_few_vertices(const GltfMeshPlan& mesh, const GltfPrimitive& primitive);

/// What accessors become when they are expanded. A file may name the same accessor again and again.
class GltfExpansion {
  public:
    /// A mesh is made this often.
    void add_mesh(const GltfMeshPlan& mesh, std::uint64_t times);
    void add_instances(std::uint64_t count);
    /// Bytes that are needed beyond those for the file's own data, used once.
    std::uint64_t beyond(std::uint64_t own_bytes) const;

  private:
    double read_ = 0;    // bytes of accessors, as often as they are read
    double needed_ = 0;  // bytes
};

}  // namespace burin
