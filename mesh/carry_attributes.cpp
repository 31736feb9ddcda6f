#include "mesh/carry_attributes.h"

#include <algorithm>

namespace burin {

AttributeCarrier::AttributeCarrier(const PolygonSoup& soup, const std::vector<std::uint32_t>& welded)
    : soup_(soup), welded_(welded) {
    for (const AttributeLayer& layer : soup.attributes)
        own_rows_.emplace_back(layer.row_count(), AttributeLayer::kNoRow);
}

/// The corners of a polygon of the soup by their vertices; of those that pass a vertex again, the first one is found.
void AttributeCarrier::list_corners(std::uint32_t polygon) {
    corners_.clear();
    const auto first = static_cast<std::uint32_t>(soup_.polygon(polygon).data() - soup_.corners.data());
    for (const std::uint32_t v : soup_.polygon(polygon))
        corners_.emplace_back(welded_[v], first + static_cast<std::uint32_t>(corners_.size()));
    std::sort(corners_.begin(), corners_.end());
}

std::uint32_t AttributeCarrier::corner_at(std::uint32_t vertex) const {
    return std::lower_bound(corners_.begin(), corners_.end(), std::pair(vertex, 0u))->second;
}

std::vector<AttributeLayer> AttributeCarrier::carry(const PolygonMesh& polygons, const Mesh& mesh) {
    std::vector<AttributeLayer> layers;
    std::vector<std::vector<std::uint32_t>> used(soup_.attributes.size());  // rows of the soup
    for (const AttributeLayer& layer : soup_.attributes) {
        layers.push_back({layer.kind, layer.name, {}, {}});
        layers.back().rows.reserve(3 * mesh.triangles.size());
    }
    std::uint32_t listed = AttributeLayer::kNoRow;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::uint32_t polygon = polygons.sources[mesh.polygon_of(t)];
        if (polygon != listed) list_corners(listed = polygon);
        for (const std::uint32_t v : mesh.triangles[t]) {
            const std::uint32_t corner = corner_at(polygons.source_vertices[v]);
            for (std::size_t i = 0; i < layers.size(); ++i) {
                const std::uint32_t row = soup_.attributes[i].rows[corner];
                if (row == AttributeLayer::kNoRow) {
                    layers[i].rows.push_back(row);
                    continue;
                }
                std::uint32_t& own = own_rows_[i][row];
                if (own == AttributeLayer::kNoRow) {
                    own = static_cast<std::uint32_t>(used[i].size());
                    used[i].push_back(row);
                    layers[i].add_row(soup_.attributes[i].row(row));
                }
                layers[i].rows.push_back(own);
            }
        }
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
        for (const std::uint32_t row : used[i]) own_rows_[i][row] = AttributeLayer::kNoRow;
    }
    std::erase_if(layers, [](const AttributeLayer& layer) { return layer.values.empty(); });
    return layers;
}

}  // namespace burin
