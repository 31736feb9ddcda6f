#include "mesh/vertex_attributes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin {

bool is_attribute_name(std::string_view asked, std::string_view of_file) {
    return asked == of_file || (of_file.starts_with('_') && asked == of_file.substr(1));
}

bool AttributeWish::wants(std::string_view name) const {
    return all_named || std::any_of(named.begin(), named.end(),
                                    [&](const std::string& asked) { return is_attribute_name(asked, name); });
}

void AttributeLayer::add_row(std::span<const float> numbers) {
    for (const float number : numbers) values.push_back(std::isfinite(number) ? number : 0.0f);
}

std::uint32_t AttributeLayer::add_between(std::uint32_t from, std::uint32_t to, double share) {
    if (from == kNoRow || to == kNoRow) return kNoRow;
    if (from == to) return from;
    const auto number = static_cast<std::uint32_t>(row_count());
    std::array<float, 3> mean{};
    for (std::size_t k = 0; k < components(); ++k) {
        const double a = row(from)[k], b = row(to)[k];
        mean[k] = static_cast<float>(a + share * (b - a));
    }
    add_row(std::span(mean).first(components()));
    return number;
}

const AttributeLayer* find_layer(std::span<const AttributeLayer> layers, AttributeKind kind, std::string_view name) {
    for (const AttributeLayer& layer : layers) {
        if (layer.kind == kind && (kind != AttributeKind::named || is_attribute_name(name, layer.name))) return &layer;
    }
    return nullptr;
}

void attribute_at(const AttributeLayer& layer, std::uint32_t triangle, const std::array<double, 3>& weights,
                  float* to) {
    const std::size_t n = layer.components();
    const std::uint32_t* const rows = layer.rows.data() + 3 * std::size_t{triangle};
    const bool has_all = std::find(rows, rows + 3, AttributeLayer::kNoRow) == rows + 3;
    for (std::size_t k = 0; k < n; ++k) {
        double sum = 0;
        for (std::size_t corner = 0; has_all && corner < 3; ++corner)
            sum += weights[corner] * static_cast<double>(layer.row(rows[corner])[k]);
        to[k] = static_cast<float>(sum);
    }
}

void list_rows(std::span<const std::uint32_t> corners, std::vector<AttributeLayer>& layers) {
    for (AttributeLayer& layer : layers) {
        if (!layer.rows.empty()) continue;
        layer.rows.assign(corners.begin(), corners.end());
        for (std::uint32_t& row : layer.rows) row = row < layer.row_count() ? row : AttributeLayer::kNoRow;
    }
}

void move_rows(std::span<const CornerOrigin> origins, std::vector<AttributeLayer>& layers) {
    for (AttributeLayer& layer : layers) {
        std::vector<std::uint32_t> rows;
        rows.reserve(origins.size());
        for (const CornerOrigin& origin : origins) {
            const std::uint32_t from = layer.rows[origin.from];
            rows.push_back(origin.from == origin.to ? from
                                                    : layer.add_between(from, layer.rows[origin.to], origin.share));
        }
        layer.rows = std::move(rows);
    }
}

float linear_from_code_value(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

}  // namespace burin
