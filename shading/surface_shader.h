#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "mesh/polygon_soup.h"

// A surface shader gives a flat surface its colour.

namespace burin {

/// How surfaces are filled.
enum class SurfaceShading : std::uint8_t {
    paper,    ///< one colour
    lambert,  ///< the material's colour under a light at the eye
    none,     ///< invisible; surfaces still hide what is behind them
};

struct SurfaceStyle {
    SurfaceShading shading = SurfaceShading::paper;
    glm::vec3 paper_color{1.0f};  ///< linear RGB
};

/// Colour of a flat surface, linear and premultiplied by its opacity. `normal` is its unit normal in
/// view space and `to_eye` the unit direction towards the eye; surfaces are two-sided.
glm::vec4 surface_color(const SurfaceStyle& style, const Material& material, const glm::dvec3& normal,
                        const glm::dvec3& to_eye);

}  // namespace burin
