#include "shading/surface_shader.h"

#include <cmath>

namespace burin {

glm::vec4 surface_color(const SurfaceStyle& style, const Material& material, const glm::dvec3& normal,
                        const glm::dvec3& to_eye) {
    switch (style.shading) {
        case SurfaceShading::none:
            return glm::vec4(0.0f);
        case SurfaceShading::paper:
            return glm::vec4(style.paper_color, 1.0f);
        case SurfaceShading::lambert: {
            // A little light from everywhere, so that grazing surfaces do not turn black.
            const double facing = std::abs(glm::dot(normal, to_eye));
            const float light = static_cast<float>(0.15 + 0.85 * facing);
            return glm::vec4(material.color * light, 1.0f);
        }
        case SurfaceShading::flat:
        case SurfaceShading::toon:
        case SurfaceShading::gooch:
        case SurfaceShading::hatch:
        case SurfaceShading::expression:
            return glm::vec4(material.color, 1.0f);
    }
    return glm::vec4(0.0f);
}

}  // namespace burin
