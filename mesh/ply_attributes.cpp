#include "mesh/ply_attributes.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

namespace burin {
namespace {

double largest_code_value(PlyType type) {
    if (type == PlyType::uint8 || type == PlyType::int8) return 255;
    return type >= PlyType::float32 ? 0 : 65535;
}

}  // namespace

PlyAttributes::PlyAttributes(const PlyElement& vertex, const AttributeWish& wish) {
    if (wish.empty()) return;
    targets_.resize(vertex.properties.size());
    std::vector<bool> is_known(vertex.properties.size(), false);  // as one of those that have no name of their own
    const auto know = [&](const std::vector<std::string>& names) {
        for (const std::string& name : names) {
            const int p = vertex.find(name);
            if (p >= 0) is_known[static_cast<std::size_t>(p)] = true;
        }
    };
    know({"x", "y", "z"});
    const std::vector<std::string> kUv[] = {
        {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    const std::vector<std::string> kColors[] = {{"red", "green", "blue"},
                                                {"diffuse_red", "diffuse_green", "diffuse_blue"}};
    for (const auto& names : kUv) {
        if (add(vertex, AttributeKind::uv, names, wish.uv)) {
            know(names);
            break;
        }
    }
    for (const auto& names : kColors) {
        if (add(vertex, AttributeKind::color, names, wish.color)) {
            know(names);
            break;
        }
    }
    std::size_t named = 0;
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
        const PlyProperty& property = vertex.properties[i];
        if (property.is_list || is_known[i]) continue;
        names_.push_back(property.name);
        if (!wish.wants(property.name) || find_layer(layers_, AttributeKind::named, property.name) != nullptr) continue;
        if (++named > kMostNamedAttributes) continue;
        targets_[i] = {layers_.size(), 0, 0};
        layers_.push_back({AttributeKind::named, property.name, {}, {}});
    }
    rows_.resize(layers_.size());
}

/// Adds a layer of several properties if all are there; returns whether they are.
bool PlyAttributes::add(const PlyElement& vertex, AttributeKind kind, const std::vector<std::string>& names,
                        bool is_wanted) {
    std::vector<std::size_t> found;
    for (const std::string& name : names) {
        const int p = vertex.find(name);
        if (p < 0 || vertex.properties[static_cast<std::size_t>(p)].is_list) return false;
        found.push_back(static_cast<std::size_t>(p));
    }
    if (!is_wanted) return true;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const double code_values =
            kind == AttributeKind::color ? largest_code_value(vertex.properties[found[k]].type) : 0;
        targets_[found[k]] = {layers_.size(), k, code_values};
    }
    layers_.push_back({kind, {}, {}, {}});
    return true;
}

void PlyAttributes::set(std::size_t property, double value) {
    const Target& target = targets_[property];
    rows_[target.layer][target.component] = target.code_values > 0
                                                ? linear_from_code_value(static_cast<float>(value / target.code_values))
                                                : static_cast<float>(value);
}

void PlyAttributes::end_vertex() {
    for (std::size_t i = 0; i < layers_.size(); ++i)
        layers_[i].add_row(std::span(rows_[i]).first(layers_[i].components()));
}

void PlyAttributes::move_to(PolygonSoup& soup) {
    std::move(layers_.begin(), layers_.end(), std::back_inserter(soup.attributes));
    std::move(names_.begin(), names_.end(), std::back_inserter(soup.attribute_names));
}

void PlyCornerUv::end_face(std::size_t corners) {
    const std::size_t own = corners - layer_.rows.size();
    for (std::size_t k = 0; k < own && face_.size() == 2 * own; ++k) {
        layer_.rows.push_back(static_cast<std::uint32_t>(layer_.row_count()));
        layer_.add_row(std::span(face_).subspan(2 * k, 2));
    }
    layer_.rows.resize(corners, AttributeLayer::kNoRow);
    face_.clear();
}

void PlyCornerUv::move_to(PolygonSoup& soup) {
    if (layer_.values.empty()) return;
    std::erase_if(soup.attributes, [](const AttributeLayer& layer) { return layer.kind == AttributeKind::uv; });
    layer_.rows.resize(soup.corners.size(), AttributeLayer::kNoRow);
    soup.attributes.push_back(std::move(layer_));
}

void PlyFaceMaterials::move_to(PolygonSoup& soup) {
    if (of_polygon_.empty()) return;
    of_polygon_.resize(soup.polygon_count(), kNone);
    std::vector<std::uint32_t> used = of_polygon_;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::uint32_t index : used) {
        Material material;
        if (index != kNone) material.name = "material_" + std::to_string(index);
        soup.materials.push_back(std::move(material));
    }
    if (used.size() == 1) return;
    for (std::uint32_t& index : of_polygon_)
        index = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) - used.begin());
    soup.polygon_material = std::move(of_polygon_);
}

}  // namespace burin
