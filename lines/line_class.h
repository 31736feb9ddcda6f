#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Each line has classes, of which the first one asked for names it.

namespace burin {

/// The classes of lines, in order of priority: where several fall together, the first one among
/// those asked for is what the line is called. docs/conventions.md defines each.
enum class LineClass : std::uint8_t {
    mark,
    border,
    silhouette,
    intersection,
    object,
    material,
    crease,
    polygon,
};
constexpr int kLineClassCount = 8;

constexpr std::array<std::string_view, kLineClassCount> kLineClassNames = {
    "mark", "border", "silhouette", "intersection", "object", "material", "crease", "polygon"};

constexpr std::string_view name_of(LineClass c) { return kLineClassNames[static_cast<std::size_t>(c)]; }

/// A set of line classes, one bit each.
struct LineClassSet {
    static_assert(kLineClassCount <= 16, "a bit for each class");
    std::uint16_t bits = 0;

    constexpr LineClassSet() = default;
    constexpr LineClassSet(LineClass c) : bits(static_cast<std::uint16_t>(1u << static_cast<int>(c))) {}
    static constexpr LineClassSet all() { return from_bits((1u << kLineClassCount) - 1); }
    static constexpr LineClassSet from_bits(unsigned bits) {
        LineClassSet set;
        set.bits = static_cast<std::uint16_t>(bits);
        return set;
    }
    constexpr bool has(LineClass c) const { return (bits >> static_cast<int>(c) & 1) != 0; }
    constexpr bool has_any_of(LineClassSet b) const { return (bits & b.bits) != 0; }
    constexpr LineClassSet without(LineClassSet b) const { return from_bits(bits & ~unsigned{b.bits}); }
    constexpr bool empty() const { return bits == 0; }
    friend constexpr LineClassSet operator|(LineClassSet a, LineClassSet b) { return from_bits(a.bits | b.bits); }
    friend constexpr LineClassSet operator&(LineClassSet a, LineClassSet b) { return from_bits(a.bits & b.bits); }
    constexpr LineClassSet& operator|=(LineClassSet b) { return *this = *this | b; }
    constexpr bool operator==(const LineClassSet&) const = default;

    /// The member with the highest priority.
    constexpr std::optional<LineClass> first() const {
        for (int i = 0; i < kLineClassCount; ++i) {
            if (has(static_cast<LineClass>(i))) return static_cast<LineClass>(i);
        }
        return std::nullopt;
    }
};
constexpr LineClassSet operator|(LineClass a, LineClass b) { return LineClassSet(a) | LineClassSet(b); }

constexpr LineClassSet kDefaultLineClasses = LineClassSet(LineClass::silhouette) | LineClass::border |
                                             LineClass::crease | LineClass::intersection | LineClass::object;

/// The classes of lines where a surface ends on the screen, before what is behind it.
constexpr LineClassSet kSurfaceEnds = LineClassSet(LineClass::silhouette) | LineClass::border;
/// The classes that a line has in some views only: one that has no other is no feature.
constexpr LineClassSet kClassesOfAView = LineClass::silhouette;

/// The class with this name, if there is one.
std::optional<LineClass> line_class_named(std::string_view name);

/// The names of the classes, joined by commas.
std::string to_string(LineClassSet classes);

}  // namespace burin
