#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "mesh/polygon_soup.h"

// A surface shader gives a flat surface its colour.

namespace burin {

/// How surfaces are filled.
enum class SurfaceShading : std::uint8_t {
    paper,    ///< one colour
    lambert,  ///< the material's colour under a light at the eye
    none,     ///< invisible; surfaces still hide what is behind them
    // What varies over a surface; only methods `abuffer` and `reference`.
    flat,        ///< the material's colour
    toon,        ///< steps of tones by the light
    gooch,       ///< from a warm tone to a cool one (Gooch et al. 1998)
    hatch,       ///< parallel lines, as many as the tone needs
    expression,  ///< a colour that an expression computes
};
constexpr bool varies(SurfaceShading shading) { return shading >= SurfaceShading::flat; }

struct SurfaceRecipe;

struct SurfaceStyle {
    SurfaceShading shading = SurfaceShading::paper;
    glm::vec3 paper_color{1.0f};  ///< linear RGB
    /// Of a shading that varies, else nothing.
    std::shared_ptr<const SurfaceRecipe> recipe = {};
};

/// Colour of a flat surface, linear and premultiplied by its opacity. `normal` is its unit normal in
/// view space and `to_eye` the unit direction towards the eye; surfaces are two-sided. Of a shading that varies it is
/// the material's colour; FragmentShader has the right one.
glm::vec4 surface_color(const SurfaceStyle& style, const Material& material, const glm::dvec3& normal,
                        const glm::dvec3& to_eye);

}  // namespace burin
