#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Values that files give at the corners of polygons beside their places: texture coordinates, colours, named numbers.

namespace burin {

enum class AttributeKind : std::uint8_t {
    uv,     ///< texture coordinates, two numbers, as the file has them
    color,  ///< linear RGB
    named,  ///< one number, by its name in the file
};

/// Whether a name that somebody asks for is that of an attribute of a file: glTF puts "_" before names.
bool is_attribute_name(std::string_view asked, std::string_view of_file);

/// Readers keep up to so many values with names.
constexpr std::size_t kMostNamedAttributes = 64;

/// Which values of a file are kept: what nobody reads is not.
struct AttributeWish {
    bool uv = false, color = false;
    bool all_named = false;
    std::vector<std::string> named;

    bool empty() const { return !uv && !color && !all_named && named.empty(); }
    bool wants(std::string_view name) const;
    static AttributeWish all() { return {true, true, true, {}}; }
};

/// AttributeLayer has the values of one kind: a table with a row for each place that the file distinguishes, and for
/// each corner its row. Two polygons may have different rows at one vertex: so seams of textures stay.
struct AttributeLayer {
    static constexpr std::uint32_t kNoRow = 0xFFFFFFFFu;

    AttributeKind kind = AttributeKind::named;
    std::string name;           ///< of a named one
    std::vector<float> values;  ///< components() numbers a row, all of them finite
    /// Of a soup, per corner of its polygons; empty: the row of each corner is the number of its vertex. Of a mesh, per
    /// triangle and corner: 3t + k. kNoRow: the file gives none.
    std::vector<std::uint32_t> rows;

    std::size_t components() const { return kind == AttributeKind::uv ? 2 : kind == AttributeKind::color ? 3 : 1; }
    std::size_t row_count() const { return values.size() / components(); }
    std::span<const float> row(std::uint32_t number) const {
        return std::span(values).subspan(number * components(), components());
    }
    /// Adds a row; what is not finite becomes 0.
    void add_row(std::span<const float> numbers);
    /// Adds a row that lies at a share of the way between two others, and returns its number.
    std::uint32_t add_between(std::uint32_t from, std::uint32_t to, double share);
};

/// The layer of a kind, by its name if it is a named one; nullptr: none is there.
const AttributeLayer* find_layer(std::span<const AttributeLayer> layers, AttributeKind kind,
                                 std::string_view name = {});

/// Writes the value of a mesh's layer at a place on a triangle; 0 if a corner has none. `weights`: of the corners,
/// with the sum 1. `to`: components() numbers.
void attribute_at(const AttributeLayer& layer, std::uint32_t triangle, const std::array<double, 3>& weights, float* to);

/// Where a corner of polygons that were made anew comes from: a corner of those before, or a place between two.
struct CornerOrigin {
    std::uint32_t from = 0, to = 0;
    double share = 0;
};

/// Lists the row of each corner where only vertices have rows.
void list_rows(std::span<const std::uint32_t> corners, std::vector<AttributeLayer>& layers);
/// Gives corners that were made anew their rows. The layers have lists of rows.
void move_rows(std::span<const CornerOrigin> origins, std::vector<AttributeLayer>& layers);

/// Linear light, 0 to 1, of a code value of sRGB, 0 to 1.
float linear_from_code_value(float code);

}  // namespace burin
