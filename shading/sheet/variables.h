#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "lines/line_class.h"
#include "shading/expression/symbols.h"

// What expressions of a sheet may read of a line: one table, from which the names of expressions, the columns that
// shading fills, and docs/shading/variables.md follow.

namespace burin {

/// A variable of sheets. Its name in sheets is that of its row in variable_table().
enum class Variable : std::uint8_t {
    x,
    y,
    depth,
    distance,
    px_size,
    P,
    PO,
    gap,
    gap_px,
    depth_x,
    depth_y,
    N,
    N2,
    facing,
    facing2,
    dihedral,
    convex,
    light,
    light2,
    lit,
    drawn_class,     ///< "class"
    is_class_first,  ///< "is_mark", and one for each other class in their order
    is_class_last = is_class_first + kLineClassCount - 1,
    object,
    material,
    object2,
    material2,
    C,
    C2,
    qi,
    transmission,
    s,
    length,
    t,
    s_world,
    run_s,
    run_length,
    end_distance,
    closed,
    direction,
    kr,
    u,
    v,
    Cv,
    rand_object,
    rand_chain,
    rand_set,
    copy,
    frame,
    time,
    width_px,
    height_px,
};
constexpr std::size_t kVariableCount = static_cast<std::size_t>(Variable::height_px) + 1;

constexpr Variable is_class(LineClass c) {
    return static_cast<Variable>(static_cast<int>(Variable::is_class_first) + static_cast<int>(c));
}
/// The class that a variable asks for, if it is one that is_class() returns.
constexpr std::optional<LineClass> class_asked_by(Variable v) {
    const int c = static_cast<int>(v) - static_cast<int>(Variable::is_class_first);
    return c >= 0 && c < kLineClassCount ? std::optional(static_cast<LineClass>(c)) : std::nullopt;
}

/// Where a variable's values come from, from what is known anyway to what costs most.
enum class VariableTier : std::uint8_t {
    piece,           ///< 0: known of each piece and of each place on it
    sides,           ///< 1: from the surfaces at its two sides and behind it
    chains,          ///< 2: from the chain that the piece is a part of
    curvature,       ///< 3: from the curvature of smooth surfaces
    shadows = 4,     ///< 4: from all that casts shadows
    attributes = 5,  ///< 5: from what the file of a model gives at its vertices
};

enum class NameKind : std::uint8_t { none, line_class, object, material };

struct VariableRow {
    Variable variable;
    std::string_view name;
    ValueType type;
    std::string_view unit;   ///< as the page shows it; empty: none
    std::string_view range;  ///< as the page shows it; empty: any
    ValueRate rate;
    VariableTier tier;
    NameKind names;  ///< of what its values are numbers, if of anything
    std::string_view meaning;
};

/// One row for each variable, in the order of the enumeration.
std::span<const VariableRow, kVariableCount> variable_table();
inline const VariableRow& row_of(Variable v) { return variable_table()[static_cast<std::size_t>(v)]; }
std::optional<Variable> variable_named(std::string_view name);
constexpr std::size_t component_count(ValueType type) { return type == ValueType::number ? 1 : 3; }
/// Names of variables and classes that later versions know.
std::span<const std::string_view> names_of_later_versions();
/// Those of classes alone.
std::span<const std::string_view> classes_of_later_versions();

/// Some components of some variables.
class VariableSet {
  public:
    bool has(Variable v, std::size_t component) const { return bits_[bit(v, component)]; }
    /// Whether it has any component of a variable.
    bool has(Variable v) const { return has(v, 0) || has(v, 1) || has(v, 2); }
    void add(Variable v, std::size_t component) { bits_.set(bit(v, component)); }
    /// All components of a variable.
    void add(Variable v);
    VariableSet& operator|=(const VariableSet& other) {
        bits_ |= other.bits_;
        return *this;
    }
    bool empty() const { return bits_.none(); }
    bool has_tier(VariableTier tier) const;
    bool operator==(const VariableSet&) const = default;

  private:
    static std::size_t bit(Variable v, std::size_t component) { return 3 * static_cast<std::size_t>(v) + component; }
    std::bitset<3 * kVariableCount> bits_;
};

/// A column of numbers for each component of a variable, or none where nobody reads it.
struct VariableColumns {
    std::array<std::array<const float*, 3>, kVariableCount> columns{};

    const float*& of(Variable v, std::size_t component = 0) { return columns[static_cast<std::size_t>(v)][component]; }
    const float* of(Variable v, std::size_t component = 0) const {
        return columns[static_cast<std::size_t>(v)][component];
    }
};

}  // namespace burin
