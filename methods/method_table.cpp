#include "methods/method_table.h"

#include <algorithm>
#include <array>

#include "methods/abuffer.h"
#include "methods/feature_edges.h"
#include "methods/gbuffer/gbuffer.h"
#include "methods/patel/patel.h"
#include "methods/reference/reference.h"
#include "methods/wire/id_buffer.h"
#include "methods/wire/single_pass.h"
#include "methods/zbuffer/methods.h"

namespace burin {
namespace {

constexpr std::string_view kHerrell = "Herrell, Baldwin, Wilcox, High-Quality Polygon Edging, 1995";

constexpr std::array kMethods = {
    Method{"abuffer", "Burin; after Mayur Patel, 2000, and Loren Carpenter, 1984", LineClassSet::all(), render_abuffer,
           nullptr, abuffer_finishes_in_bands, true},
    Method{"patel", "Mayur Patel, Hidden Line Rendering with a Modified A-Buffer, 2000", LineClassSet::all(),
           render_patel},
    Method{"gbuffer", "Saito and Takahashi, Comprehensible Rendering of 3-D Shapes, SIGGRAPH 1990",
           LineClass::silhouette | LineClass::crease | LineClass::object | LineClass::material | LineClass::polygon,
           render_gbuffer, gbuffer_also_finds},
    Method{"simple", kHerrell, kEdgeClasses, render_with<simple_method>},
    Method{"offset", kHerrell, kEdgeClasses, render_with<offset_method>},
    Method{"slope-offset", "OpenGL 1.1, glPolygonOffset, 1997", kEdgeClasses, render_with<slope_offset_method>},
    Method{"decal", kHerrell, kEdgeClasses, render_with<decal_method>},
    Method{"edging-plane", kHerrell, kEdgeClasses, render_with<edging_plane_method>},
    Method{"virgin-plane", kHerrell, kEdgeClasses, render_with<virgin_plane_method>},
    Method{"stencil", kHerrell, kEdgeClasses, render_with<stencil_method>},
    Method{"single-pass", "Baerentzen, Nielsen, Gjoel, Larsen and Christensen, Single-pass Wireframe Rendering, 2006",
           kEdgeClasses, render_single_pass},
    Method{"solid-wireframe", "Samuel Gateau, Solid Wireframe, NVIDIA white paper WP-03014-001, 2007", kEdgeClasses,
           render_solid_wireframe},
    Method{"id-buffer",
           "Baerentzen et al., Two Methods for Antialiased Wireframe Drawing with Hidden Line "
           "Removal, 2008",
           kEdgeClasses, render_id_buffer},
    Method{"reference", "ground truth: rays, and exact distances to the lines between them", LineClassSet::all(),
           render_reference, nullptr, nullptr, true},
};

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method* find_method(std::string_view name) {
    const auto it = std::find_if(kMethods.begin(), kMethods.end(), [&](const Method& m) { return m.name == name; });
    return it == kMethods.end() ? nullptr : &*it;
}

}  // namespace burin
