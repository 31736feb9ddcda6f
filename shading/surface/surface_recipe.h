#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "base/error.h"
#include "mesh/vertex_attributes.h"
#include "shading/sheet/style_sheet.h"
#include "shading/surface_shader.h"

namespace burin {

/// Where the lines of a hatching lie.
enum class HatchSpace : std::uint8_t {
    screen,  ///< on the picture
    object,  ///< on the surface, which they cut as parallel planes do
    uv,      ///< on the surface, straight in its texture coordinates
};

/// What the shadings are made of that vary over a surface, as it stands in a file; checked as far as that goes without
/// a scene. Each shading reads what is its own.
struct SurfaceRecipe {
    SourcePosition where;
    bool has_smooth_normals = false;
    bool has_shadows = false;

    StyleValue color;  ///< of `expression`

    // Of `toon`.
    Ramp tones;  ///< over the light of a place: what the material's colour is multiplied by, or colours
    StyleValue softness = StyleValue::of(1);  ///< a constant: of steps, in pixels
    struct Detail {
        StyleValue over;  ///< 0 to 1: how much of these tones there is
        Ramp tones;
    };
    std::optional<Detail> detail;

    // Of `gooch`: linear RGB.
    glm::vec3 cool{0.0f, 0.0f, 0.55f}, warm{0.3f, 0.3f, 0.0f};

    // Of `hatch`.
    StyleValue tone, ink = StyleValue::of_color({0, 0, 0}), ground;
    StyleValue spacing = StyleValue::of(6);  ///< a constant: from line to line, in pixels
    HatchSpace space = HatchSpace::screen;
    double angle_deg = 45;           ///< of the first level on the picture, counter-clockwise; or from u to v
    glm::dvec3 axis{0.0, 1.0, 0.0};  ///< in the object, across the planes of its first level
    int levels = 3;
};

/// Adds what the texts of a recipe name of the values that files give at vertices.
void add_attributes_named_in(const SurfaceRecipe& recipe, AttributeWish& wish);

/// The steps of a drawing with two tones and a highlight.
Ramp default_tones();

}  // namespace burin
