#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shading/sheet/variables.h"

namespace burin {

/// What a sheet reads of smooth surfaces and of the values at their vertices: numbers that are known at the ends of
/// pieces, each in a column.
struct SurfaceNeeds {
    bool kr = false, uv = false, color = false;
    std::vector<std::string> attributes;  ///< names, each once, in ascending order

    bool empty() const { return column_count() == 0; }
    bool has_attributes() const { return uv || color || !attributes.empty(); }
    std::size_t column_count() const { return (kr ? 1u : 0u) + (uv ? 2u : 0u) + (color ? 3u : 0u) + attributes.size(); }
    std::size_t uv_column() const { return kr ? 1 : 0; }
    std::size_t color_column() const { return uv_column() + (uv ? 2 : 0); }
    std::size_t attribute_column() const { return color_column() + (color ? 3 : 0); }
    /// The column of a component of a variable; none if there is no such column.
    std::optional<std::size_t> column_of(Variable v, std::size_t component) const {
        if (v == Variable::kr && kr) return 0;
        if (v == Variable::u && uv) return uv_column();
        if (v == Variable::v && uv) return uv_column() + 1;
        if (v == Variable::Cv && color) return color_column() + component;
        return std::nullopt;
    }
    std::optional<std::size_t> column_of_attribute(std::string_view name) const {
        const auto at = std::find(attributes.begin(), attributes.end(), name);
        if (at == attributes.end()) return std::nullopt;
        return attribute_column() + static_cast<std::size_t>(at - attributes.begin());
    }
    void add_attribute(const std::string& name) {
        const auto at = std::lower_bound(attributes.begin(), attributes.end(), name);
        if (at == attributes.end() || *at != name) attributes.insert(at, name);
    }
    bool operator==(const SurfaceNeeds&) const = default;
};

}  // namespace burin
