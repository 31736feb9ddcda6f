#include "methods/method_table.h"

#include <algorithm>
#include <array>

#include "methods/patel.h"
#include "methods/reference.h"

namespace burin {
namespace {

constexpr std::array kMethods = {
    Method{"patel", "Mayur Patel, Hidden Line Rendering with a Modified A-Buffer, 2000",
           LineClassSet::all(), render_patel},
    Method{"reference", "ground truth: rays, and exact distances to the lines between them",
           LineClassSet::all(), render_reference},
};

constexpr std::string_view kPlanned[] = {
    "abuffer", "gbuffer", "single-pass", "solid-wireframe", "id-buffer",    "simple",  "offset",
    "slope-offset", "decal", "edging-plane", "virgin-plane", "stencil"};

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method* find_method(std::string_view name) {
    const auto it = std::find_if(kMethods.begin(), kMethods.end(),
                                 [&](const Method& m) { return m.name == name; });
    return it == kMethods.end() ? nullptr : &*it;
}

bool is_planned_method(std::string_view name) {
    return std::find(std::begin(kPlanned), std::end(kPlanned), name) != std::end(kPlanned);
}

}  // namespace burin
