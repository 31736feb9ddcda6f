#include "methods/wire/wire_pixel.h"

namespace burin {

PixelResult finish_pixel(const Frame& frame, const WirePixel& pixel, const DepthPlane& plane, int x, int y,
                         bool is_open) {
    const SurfaceSet& surfaces = frame.surfaces;
    PixelResult result;
    result.distance = std::numeric_limits<float>::infinity();
    const float line = static_cast<float>(pixel.line);
    result.lines = glm::vec4(frame.scene->lines.style.color_of(pixel.line_class), 1.0f) * line;
    result.coverage[static_cast<std::size_t>(pixel.line_class)] = line;
    if (!pixel.surface.is_background()) {
        const SurfaceId id = pixel.surface;
        const glm::dvec2 center(x + 0.5, y + 0.5);
        glm::dvec3 origin, ray;
        surfaces.projection.view_ray(center, origin, ray);
        const glm::dvec3 to_eye = -glm::normalize(ray), normal = surfaces.view_normal(id);
        if (!is_open) {
            result.surface = surface_color(frame.scene->surfaces, frame.material_of(id), normal, to_eye);
        }
        result.distance = static_cast<float>(surfaces.projection.distance(plane.nearness(center)));
        const glm::dvec3 facing = glm::dot(normal, to_eye) < 0 ? -normal : normal;
        result.normal = glm::vec3(surfaces.view_to_world * facing);
        result.object_id = surfaces.object_id(id);
        result.material_id = surfaces.material_id(id);
        result.polygon_id = surfaces.polygon_id(id);
    }
    result.beauty = result.surface * (1 - line) + result.lines;
    return result;
}

}  // namespace burin
