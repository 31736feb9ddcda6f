#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shading/expression/ramp.h"

// The names that an expression may use. Who reads a sheet makes the table.

namespace burin {

/// Over what a value stays the same, from the most to the least.
enum class ValueRate : std::uint8_t { frame, chain, piece, sample };

enum class ValueType : std::uint8_t { number, color, vector };

/// Names of classes, objects or materials; the values of variables are numbers of them.
struct NameList {
    std::string kind;  ///< "class", "object", "material": what messages say, and what groups are for
    std::vector<std::string> names;
    std::uint32_t first_number = 0;  ///< of names.front()
    bool is_complete = false;        ///< another name is an error; else it is one that no object has
};

struct ExpressionVariable {
    std::string name;
    ValueType type = ValueType::number;
    ValueRate rate = ValueRate::sample;
    std::shared_ptr<const NameList> names = {};  ///< of what its values are numbers, if of anything
};
/// A name for a value that is known when expressions are compiled.
struct ExpressionParameter {
    std::string name;
    ValueType type = ValueType::number;
    std::array<float, 3> value{};  ///< a number: in the first one
};
/// A name for an expression, which is computed once however often it is used.
struct ExpressionLet {
    std::string name, text;  ///< without the "=" of the file
};
/// A name for patterns of names of one kind. Groups of several kinds may have one name.
struct ExpressionGroup {
    std::string name, kind;
    std::vector<std::string> patterns;
};
struct ExpressionRamp {
    std::string name;
    Ramp ramp;  ///< without fault
};

struct ExpressionSymbols {
    std::vector<ExpressionVariable> variables;
    std::vector<ExpressionParameter> parameters;
    std::vector<ExpressionLet> lets;
    std::vector<ExpressionGroup> groups;
    std::vector<ExpressionRamp> ramps;
    std::string hint_for_unknown;    ///< what the message on an unknown variable ends with
    std::vector<std::string> later;  ///< names of variables and classes that later versions know
    double px_per_mm = 96 / 25.4;
};

/// Why a parameter, a let, a ramp or a group may not have a name: it is none, or a variable or a function has it.
std::optional<std::string> fault_of_name(std::string_view name, const ExpressionSymbols& symbols);

}  // namespace burin
