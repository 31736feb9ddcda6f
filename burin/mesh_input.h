#pragma once

#include <cstdint>
#include <string>

#include "burin/burin.h"
#include "mesh/material_list.h"
#include "mesh/polygon_soup.h"

namespace burin {

/// A mesh as its caller gives it, checked as readers check files.
struct MeshInput {
    PolygonSoup soup;
    /// The scene's material for each number in the soup, both from 0. What is one past the scene's last one is a new
    /// material of the usual colour.
    MaterialList materials;
    bool needs_default_material = false;
};

/// `material_count`: of the scene. `default_material`: the number, from 0, of the one for polygons without.
/// Throws InputError for what an array holds, UsageError for arrays that do not fit each other.
MeshInput checked_mesh(const burin_mesh& mesh, std::uint32_t material_count, std::uint32_t default_material);

/// A text that may be NULL.
inline std::string text_or_empty(const char* text) { return text == nullptr ? std::string() : std::string(text); }

}  // namespace burin
