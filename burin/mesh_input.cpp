#include "burin/mesh_input.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/huge_pages.h"
#include "base/interrupt.h"
#include "burin/failure.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

constexpr std::uint64_t kMostPoints = std::numeric_limits<std::int32_t>::max();
constexpr std::uint64_t kMostPolygons = std::numeric_limits<std::uint32_t>::max() - 1;  // as make_frame() numbers them
constexpr std::uint64_t kMostParts = std::uint64_t{1} << 24;
constexpr std::uint64_t kBetweenStops = std::uint64_t{1} << 20;

/// An array with its name for messages. Throws UsageError if it is missing or too long.
template <typename T>
std::span<const T> array_of(const T* array, std::uint64_t count, std::uint64_t most, std::uint64_t per_element,
                            const char* name) {
    if (count > most) {
        throw UsageError("mesh: " + std::to_string(count) + " " + name + "; there may be " + std::to_string(most) +
                         " at most");
    }
    if (count > 0 && array == nullptr)
        throw UsageError("mesh: " + std::to_string(count) + " " + name + ", but the array is NULL");
    return {array, static_cast<std::size_t>(count * per_element)};
}

/// Copies numbers, each of them below `end`. `what`: they are, `why`: for messages.
std::vector<std::uint32_t> numbers_below(std::span<const std::int32_t> from, std::uint64_t end, const char* what,
                                         const std::string& why) {
    std::vector<std::uint32_t> numbers;
    reserve_large(numbers, from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (i % kBetweenStops == 0) throw_if_interrupted();
        if (from[i] < 0 || static_cast<std::uint64_t>(from[i]) >= end) {
            throw InputError("mesh: " + std::string(what) + " " + std::to_string(i) + " is " + std::to_string(from[i]) +
                             "; " + why);
        }
        numbers.push_back(static_cast<std::uint32_t>(from[i]));
    }
    return numbers;
}

void copy_points(std::span<const float> from, PolygonSoup& soup) {
    reserve_large(soup.positions, from.size() / 3);
    for (std::size_t i = 0; i < from.size(); i += 3) {
        if (i % (3 * kBetweenStops) == 0) throw_if_interrupted();
        const glm::dvec3 p(from[i], from[i + 1], from[i + 2]);
        if (!(std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
              std::abs(p.z) <= kLargestCoordinate)) {
            throw InputError("mesh: a coordinate of point " + std::to_string(i / 3) + " is not finite or beyond 1e30");
        }
        soup.positions.push_back(p);
    }
}

/// Where the polygons end, and how many there are.
std::uint64_t copy_sizes(const burin_mesh& mesh, PolygonSoup& soup) {
    if (mesh.polygon_sizes == nullptr) {
        const std::uint64_t count = mesh.corner_count / 3;
        if (mesh.corner_count % 3 != 0 || (mesh.polygon_count != 0 && mesh.polygon_count != count)) {
            throw UsageError("mesh: " + std::to_string(mesh.corner_count) + " corners are not those of " +
                             std::to_string(mesh.polygon_count == 0 ? count : mesh.polygon_count) +
                             " triangles; give polygon_sizes");
        }
        return count;
    }
    const auto sizes = array_of(mesh.polygon_sizes, mesh.polygon_count, kMostPolygons, 1, "polygons");
    reserve_large(soup.polygon_ends, sizes.size());
    std::uint64_t end = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (i % kBetweenStops == 0) throw_if_interrupted();
        end += sizes[i] < 0 ? mesh.corner_count + 1 : static_cast<std::uint64_t>(sizes[i]);
        if (end > mesh.corner_count) {
            throw InputError("mesh: polygon " + std::to_string(i) + " has " + std::to_string(sizes[i]) +
                             " corners; there are " + std::to_string(mesh.corner_count) + " of all polygons");
        }
        soup.polygon_ends.push_back(static_cast<std::uint32_t>(end));
    }
    if (end != mesh.corner_count) {
        throw InputError("mesh: its polygons have " + std::to_string(end) + " corners, but there are " +
                         std::to_string(mesh.corner_count));
    }
    return sizes.size();
}

void copy_materials(const burin_mesh& mesh, std::uint64_t polygons, std::uint32_t material_count,
                    std::uint32_t default_material, MeshInput& result) {
    std::vector<std::uint32_t> used;  // the scene's, in the order in which polygons have them
    if (mesh.polygon_materials == nullptr) {
        used.push_back(default_material);
        result.needs_default_material = true;
    } else {
        const std::vector<std::uint32_t> given = numbers_below(
            {mesh.polygon_materials, static_cast<std::size_t>(polygons)}, std::uint64_t{material_count} + 1,
            "the material of polygon",
            "the scene has " + std::to_string(material_count) + " materials, counted from 1, and 0 is none");
        constexpr std::uint32_t kUnused = 0xFFFFFFFFu;
        std::vector<std::uint32_t> own_number(std::size_t{material_count} + 2, kUnused);
        for (const std::uint32_t number : given) {
            result.needs_default_material = result.needs_default_material || number == 0;
            const std::uint32_t material = number == 0 ? default_material : number - 1;
            std::uint32_t& own = own_number[material];
            if (own == kUnused) {
                own = static_cast<std::uint32_t>(used.size());
                used.push_back(material);
            }
            result.soup.polygon_material.push_back(own);
        }
        if (used.size() == 1) result.soup.polygon_material.clear();
        if (used.empty()) {
            used.push_back(default_material);
            result.needs_default_material = true;
        }
    }
    result.materials = MaterialList(used);
    result.soup.materials.resize(used.size());
}

void copy_parts(const burin_mesh& mesh, std::uint64_t polygons, PolygonSoup& soup) {
    if (mesh.polygon_objects == nullptr) {
        soup.object_names = {std::string()};
        return;
    }
    if (mesh.object_count == 0 || mesh.object_count > kMostParts) {
        throw UsageError("mesh: object_count is " + std::to_string(mesh.object_count) +
                         "; with polygon_objects it must be from 1 to " + std::to_string(kMostParts));
    }
    soup.polygon_object = numbers_below({mesh.polygon_objects, static_cast<std::size_t>(polygons)}, mesh.object_count,
                                        "the object of polygon",
                                        "the mesh has " + std::to_string(mesh.object_count) + ", counted from 0");
    for (std::uint64_t i = 0; i < mesh.object_count; ++i) {
        soup.object_names.push_back(mesh.object_names == nullptr ? std::string() : text_or_empty(mesh.object_names[i]));
    }
}

/// A layer with a row for each element of an array. What is not finite counts as 0, as in files.
AttributeLayer layer_of(AttributeKind kind, std::string name, const float* values, std::uint64_t rows) {
    AttributeLayer layer{kind, std::move(name), {}, {}};
    layer.add_row({values, static_cast<std::size_t>(rows * layer.components())});
    return layer;
}

void copy_attributes(const burin_mesh& mesh, PolygonSoup& soup) {
    if (mesh.corner_uv != nullptr && mesh.corner_count > 0) {
        soup.attributes.push_back(layer_of(AttributeKind::uv, {}, mesh.corner_uv, mesh.corner_count));
        std::vector<std::uint32_t>& rows = soup.attributes.back().rows;
        rows.resize(soup.corners.size());
        std::iota(rows.begin(), rows.end(), 0u);
    }
    if (mesh.point_colors != nullptr)
        soup.attributes.push_back(layer_of(AttributeKind::color, {}, mesh.point_colors, mesh.point_count));
    const auto names =
        array_of(mesh.attribute_names, mesh.attribute_count, kMostNamedAttributes, 1, "names of attributes");
    const auto arrays =
        array_of(mesh.point_attributes, mesh.attribute_count, kMostNamedAttributes, 1, "arrays of attributes");
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string name = text_or_empty(names[i]);
        if (name.empty()) throw UsageError("mesh: attribute " + std::to_string(i) + " has no name");
        if (arrays[i] == nullptr && mesh.point_count > 0)
            throw UsageError("mesh: the array of attribute '" + printable(name, 200) + "' is NULL");
        soup.attributes.push_back(layer_of(AttributeKind::named, name, arrays[i], mesh.point_count));
    }
}

}  // namespace

MeshInput checked_mesh(const burin_mesh& mesh, std::uint32_t material_count, std::uint32_t default_material) {
    MeshInput result;
    PolygonSoup& soup = result.soup;
    const auto points = array_of(mesh.points, mesh.point_count, kMostPoints, 3, "points");
    const auto corners = array_of(mesh.corners, mesh.corner_count, PolygonSoup::kMaxCorners, 1, "corners");
    const auto marks = array_of(mesh.marked_edges, mesh.marked_edge_count, kMostPoints, 2, "marked edges");
    const std::uint64_t polygons = copy_sizes(mesh, soup);
    copy_points(points, soup);
    const std::string why = "the mesh has " + std::to_string(mesh.point_count) + " points, counted from 0";
    soup.corners = numbers_below(corners, mesh.point_count, "corner", why);
    const std::vector<std::uint32_t> ends = numbers_below(marks, mesh.point_count, "marked_edges: number", why);
    for (std::size_t i = 0; i < ends.size(); i += 2) soup.marked_edges.push_back({ends[i], ends[i + 1]});
    copy_materials(mesh, polygons, material_count, default_material, result);
    copy_parts(mesh, polygons, soup);
    copy_attributes(mesh, soup);
    return result;
}

}  // namespace burin
