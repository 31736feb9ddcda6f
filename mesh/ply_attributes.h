#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/ply_header.h"
#include "mesh/polygon_soup.h"

namespace burin {

/// PlyAttributes collects what the vertices of a PLY have beside their coordinates, as far as it is asked for: texture
/// coordinates, colours, which are code values of sRGB where they are integers, and other numbers by their names.
class PlyAttributes {
  public:
    PlyAttributes(const PlyElement& vertex, const AttributeWish& wish);

    bool empty() const { return layers_.empty(); }
    /// Whether a property is to be set for each vertex.
    bool has(std::size_t property) const { return targets_[property].layer != kNone; }
    void set(std::size_t property, double value);
    void end_vertex();
    void move_to(PolygonSoup& soup);

  private:
    static constexpr std::size_t kNone = ~std::size_t{0};
    /// Where the value of a property goes.
    struct Target {
        std::size_t layer = kNone, component = 0;
        double code_values = 0;  ///< the largest code value of a colour; 0: it is linear
    };
    bool add(const PlyElement& vertex, AttributeKind kind, const std::vector<std::string>& names, bool is_wanted);

    std::vector<Target> targets_;  // per property
    std::vector<AttributeLayer> layers_;
    std::vector<std::array<float, 3>> rows_;  // per layer, of this vertex
    std::vector<std::string> names_;
};

/// PlyCornerUv collects texture coordinates that faces list for their corners.
class PlyCornerUv {
  public:
    static bool is_list_of(const PlyProperty& property) { return property.is_list && property.name == "texcoord"; }
    /// Adds a number of the list of the next face that ends.
    void add(double number) { face_.push_back(static_cast<float>(number)); }
    /// Ends a face. Its list counts if it has two numbers a corner. `corners`: of all faces so far.
    void end_face(std::size_t corners);
    /// Gives the soup what there is, in the place of what its vertices have.
    void move_to(PolygonSoup& soup);

  private:
    AttributeLayer layer_{AttributeKind::uv, {}, {}, {}};
    std::vector<float> face_;
};

/// PlyFaceMaterials collects which material each face has, by the property material_index.
class PlyFaceMaterials {
  public:
    static constexpr double kLargest = 0x7FFFFFFF;

    static bool is_index(const PlyProperty& property) { return !property.is_list && property.name == "material_index"; }
    /// Of the next polygon. `polygons`: how many are before it; those without a material get one of their own.
    void add(std::uint64_t polygons, std::uint32_t index) {
        of_polygon_.resize(polygons, kNone);
        of_polygon_.push_back(index);
    }
    /// Gives the soup a material for each number that there is, in ascending order, named material_NUMBER.
    void move_to(PolygonSoup& soup);

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::vector<std::uint32_t> of_polygon_;
};

}  // namespace burin
