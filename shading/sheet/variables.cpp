#include "shading/sheet/variables.h"

#include <algorithm>
#include <array>
#include <utility>

namespace burin {
namespace {

using enum ValueType;
using V = Variable;
using R = ValueRate;
using T = VariableTier;
using K = NameKind;

constexpr auto kBeforeClasses = std::to_array<VariableRow>({
    {V::x, "x", number, "px", "", R::sample, T::piece, K::none,
     "to the right on the full picture; pixel 0 covers 0 to 1"},
    {V::y, "y", number, "px", "", R::sample, T::piece, K::none, "down on the full picture; pixel 0 covers 0 to 1"},
    {V::depth, "depth", number, "world", "> 0", R::sample, T::piece, K::none,
     "distance along the view axis, as in the channel `Z`"},
    {V::distance, "distance", number, "world", "> 0", R::sample, T::piece, K::none,
     "distance to the eye; in an orthographic view `depth`"},
    {V::px_size, "px_size", number, "world per px", "> 0", R::sample, T::piece, K::none, "width of a pixel there"},
    {V::P, "P", vector, "world", "", R::sample, T::piece, K::none, "position"},
    {V::PO, "PO", vector, "object units", "", R::sample, T::sides, K::none,
     "position in the object, before its transform"},
    {V::gap, "gap", number, "world", "0 to inf", R::sample, T::sides, K::none,
     "depth of the nearest surface behind the line, beside it, less `depth`; inf: background; 0 where the line lies on "
     "a surface"},
    {V::gap_px, "gap_px", number, "px", "0 to inf", R::sample, T::sides, K::none, "`gap` over `px_size`"},
    {V::depth_x, "depth_x", number, "world per px", "", R::sample, T::sides, K::none,
     "how the depth of the front surface changes to the right on the screen; over `px_size` it is a slope"},
    {V::depth_y, "depth_y", number, "world per px", "", R::sample, T::sides, K::none, "the same downwards"},
    {V::N, "N", vector, "", "unit length", R::sample, T::sides, K::none,
     "normal of the front side, in the world, towards the eye; 0 if there is none"},
    {V::N2, "N2", vector, "", "unit length", R::sample, T::sides, K::none,
     "normal of the other side, or of what is behind"},
    {V::facing, "facing", number, "", "0 to 1", R::sample, T::sides, K::none,
     "N · V, where V is the unit vector to the eye"},
    {V::facing2, "facing2", number, "", "0 to 1", R::sample, T::sides, K::none, "N2 · V"},
    {V::dihedral, "dihedral", number, "degrees", "0 to 180", R::piece, T::sides, K::none,
     "angle between the normals of the two polygons; 0 = flat, as `crease_angle`"},
    {V::convex, "convex", number, "", "-1, 0, 1", R::piece, T::sides, K::none,
     "1: an edge that sticks out; -1: one that goes inwards; else 0"},
    {V::light, "light", number, "", "0 to 1", R::sample, T::sides, K::none,
     "max(0, N · L), where L is the unit vector to the key light"},
    {V::light2, "light2", number, "", "0 to 1", R::sample, T::sides, K::none, "the same of N2"},
    {V::lit, "lit", number, "", "0, 1", R::sample, T::shadows, K::none,
     "0 where the front side is in shadow or turned away from the key light, else 1"},
    {V::drawn_class, "class", number, "", "names", R::piece, T::piece, K::line_class,
     "class as drawn: `class == \"crease\"`"},
});

constexpr auto kBehindClasses = std::to_array<VariableRow>({
    {V::object, "object", number, "", "names", R::piece, T::piece, K::object,
     "object of the front side: `object == \"wheel*\"`; as a number from 1"},
    {V::material, "material", number, "", "names", R::piece, T::piece, K::material,
     "material of the front side; as a number from 1"},
    {V::object2, "object2", number, "", "names", R::piece, T::sides, K::object,
     "object of the other side, or of what is behind; 0 = background"},
    {V::material2, "material2", number, "", "names", R::piece, T::sides, K::material,
     "material of the other side, or of what is behind; 0 = background"},
    {V::C, "C", color, "linear RGB", "", R::piece, T::sides, K::none, "colour of the material of the front side"},
    {V::C2, "C2", color, "linear RGB", "", R::piece, T::sides, K::none, "colour of the other one"},
    {V::qi, "qi", number, "", "0 to 255", R::piece, T::piece, K::none,
     "quantitative invisibility: how many opaque surfaces are in front"},
    {V::transmission, "transmission", number, "", "0 to 1", R::piece, T::piece, K::none,
     "what transparent surfaces in front let through"},
    {V::s, "s", number, "px", "0 to `length`", R::sample, T::chains, K::none,
     "way along the chain, seen or not, from its beginning, before anything moves it"},
    {V::length, "length", number, "px", ">= 0", R::chain, T::chains, K::none, "length of the chain"},
    {V::t, "t", number, "", "0 to 1", R::sample, T::chains, K::none, "`s / length`"},
    {V::s_world, "s_world", number, "world", ">= 0", R::sample, T::chains, K::none, "as `s`, in space"},
    {V::run_s, "run_s", number, "px", "0 to `run_length`", R::sample, T::chains, K::none,
     "as `s`, within the run: the part of the chain that is all visible or all hidden"},
    {V::run_length, "run_length", number, "px", ">= 0", R::piece, T::chains, K::none, "length of the run"},
    {V::end_distance, "end_distance", number, "px", "0 to inf", R::sample, T::chains, K::none,
     "to the nearest free end of the run; inf: it has none"},
    {V::closed, "closed", number, "", "0, 1", R::chain, T::chains, K::none, "whether the chain is a loop"},
    {V::direction, "direction", number, "degrees", "0 to 180", R::piece, T::piece, K::none,
     "of the line on the screen; 0 = level, counter-clockwise"},
    {V::kr, "kr", number, "1/world", "", R::sample, T::curvature, K::none,
     "curvature of the front surface towards the eye; > 0: it bends away from the eye, as a ball; 0 where it is flat"},
    {V::u, "u", number, "the file's", "", R::sample, T::attributes, K::none,
     "first texture coordinate of the front polygon; 0 if there is none"},
    {V::v, "v", number, "the file's", "", R::sample, T::attributes, K::none,
     "second texture coordinate of the front polygon; 0 if there is none"},
    {V::Cv, "Cv", color, "linear RGB", "", R::sample, T::attributes, K::none,
     "colour of the vertices of the front polygon; black if there is none"},
    {V::rand_object, "rand_object", number, "", "[0, 1)", R::piece, T::piece, K::none,
     "a random number of the object, the same in all frames"},
    {V::rand_chain, "rand_chain", number, "", "[0, 1)", R::chain, T::chains, K::none, "a random number of the chain"},
    {V::rand_set, "rand_set", number, "", "[0, 1)", R::chain, T::piece, K::none, "a random number of the set"},
    {V::copy, "copy", number, "", "0 to 7", R::chain, T::piece, K::none,
     "number of the copy, where a style has several (`copies`)"},
    {V::frame, "frame", number, "", "", R::frame, T::piece, K::none, "number of the frame"},
    {V::time, "time", number, "s", "", R::frame, T::piece, K::none, "`frame` over `[frames] fps`"},
    {V::width_px, "width_px", number, "px", "", R::frame, T::piece, K::none, "width of the picture"},
    {V::height_px, "height_px", number, "px", "", R::frame, T::piece, K::none, "height of the picture"},
});

/// A text made of others.
struct Text {
    std::array<char, 80> characters{};
    std::size_t size = 0;

    constexpr Text(std::string_view begin, std::string_view middle, std::string_view end) {
        for (const std::string_view part : {begin, middle, end}) {
            for (const char c : part) characters[size++] = c;
        }
    }
    constexpr std::string_view view() const { return {characters.data(), size}; }
};

template <std::size_t... numbers>
constexpr std::array<Text, sizeof...(numbers)> texts_of_classes(const auto& text_of, std::index_sequence<numbers...>) {
    return {text_of(static_cast<LineClass>(numbers))...};
}
constexpr auto kClasses = std::make_index_sequence<kLineClassCount>();
constexpr auto kClassNames = texts_of_classes([](LineClass c) { return Text("is_", name_of(c), ""); }, kClasses);
constexpr auto kClassMeanings = texts_of_classes(
    [](LineClass c) {
        return c == LineClass{} ? Text("whether the class `", name_of(c), "` applies, be it the one as drawn or not")
                                : Text("the same of `", name_of(c), "`");
    },
    kClasses);

constexpr std::array<VariableRow, kVariableCount> table() {
    static_assert(kBeforeClasses.size() + kLineClassCount + kBehindClasses.size() == kVariableCount);
    std::array<VariableRow, kVariableCount> rows{};
    auto next = std::copy(kBeforeClasses.begin(), kBeforeClasses.end(), rows.begin());
    for (std::size_t i = 0; i < kLineClassCount; ++i) {
        *next++ = {is_class(static_cast<LineClass>(i)),
                   kClassNames[i].view(),
                   number,
                   "",
                   "0, 1",
                   R::piece,
                   T::piece,
                   K::none,
                   kClassMeanings[i].view()};
    }
    std::copy(kBehindClasses.begin(), kBehindClasses.end(), next);
    return rows;
}
constexpr std::array<VariableRow, kVariableCount> kTable = table();

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < kVariableCount; ++i) {
        if (static_cast<std::size_t>(kTable[i].variable) != i) return false;
    }
    return true;
}
static_assert(is_in_order());

constexpr auto kLaterClasses = std::to_array<std::string_view>({"suggestive", "ridge", "valley", "light", "shadow"});

constexpr auto kLater =
    std::to_array<std::string_view>({"k1", "k2", "valley", "ridge", "suggestive", "light", "shadow", "is_suggestive",
                                     "is_ridge", "is_valley", "is_light", "is_shadow"});

constexpr bool is_later_class(std::string_view name) {
    return std::find(kLaterClasses.begin(), kLaterClasses.end(), name) != kLaterClasses.end();
}
/// Whether what is there already is none of these. A class and a variable may have one name.
constexpr bool is_none_there() {
    for (const std::string_view name : kLineClassNames) {
        if (is_later_class(name) || std::find(kLater.begin(), kLater.end(), name) != kLater.end()) return false;
    }
    return std::none_of(kLater.begin(), kLater.end(), [](std::string_view name) {
        return !is_later_class(name) &&
               std::any_of(kTable.begin(), kTable.end(), [name](const VariableRow& row) { return row.name == name; });
    });
}
static_assert(is_none_there(), "what is there is no name of a later version");

}  // namespace

std::span<const VariableRow, kVariableCount> variable_table() { return kTable; }

std::optional<Variable> variable_named(std::string_view name) {
    const auto row = std::find_if(kTable.begin(), kTable.end(), [&](const VariableRow& r) { return r.name == name; });
    if (row == kTable.end()) return std::nullopt;
    return row->variable;
}

std::span<const std::string_view> names_of_later_versions() { return kLater; }
std::span<const std::string_view> classes_of_later_versions() { return kLaterClasses; }

void VariableSet::add(Variable v) {
    for (std::size_t k = 0; k < component_count(row_of(v).type); ++k) add(v, k);
}

bool VariableSet::has_tier(VariableTier tier) const {
    return std::any_of(kTable.begin(), kTable.end(),
                       [&](const VariableRow& row) { return row.tier == tier && has(row.variable); });
}

}  // namespace burin
