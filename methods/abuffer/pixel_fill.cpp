#include "methods/abuffer/pixel_fill.h"

#include <algorithm>
#include <limits>

#include "shading/surface_shader.h"

namespace burin {

const PixelFiller::Look& PixelFiller::look_of(std::uint32_t number) {
    Look& look = looks_[number % kSlots];
    if (look.number == number) return look;
    const SurfaceSet& surfaces = frame_.surfaces;
    const SurfaceId id = screen_.surface_of(number);
    look.number = number;
    look.object_id = surfaces.object_id(id);
    look.material_id = surfaces.material_id(id);
    look.polygon_id = surfaces.polygon_id(id);
    glm::dvec3 corners[3];
    surfaces.view_corners(id, corners);
    const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const Mesh& mesh = surfaces.mesh_of(id);
    // A polygon of several triangles has one normal; which side is seen, the triangle says.
    const glm::dvec3 normal = mesh.polygon_normals.empty()
                                  ? area / std::max(glm::length(area), 1e-300)
                                  : surfaces.view_normal(id);
    const Facing facing = screen_.facing(number);
    const glm::dvec3 to_corner = surfaces.projection.orthographic ? glm::dvec3(0, 0, -1) : corners[0];
    const bool away = facing == off_screen ? glm::dot(area, to_corner) > 0
                                                           : facing == clockwise;
    const double mirror = glm::dot(surfaces.instance_of(id).normal_to_view * mesh.polygon_area_vector(id.triangle), area) < 0 ? -1.0 : 1.0;
    look.normal = (away ? -1.0 : 1.0) * (mesh.polygon_normals.empty() ? 1.0 : mirror) * normal;
    look.corner = corners[0];
    look.world_normal = glm::vec3(surfaces.view_to_world * look.normal);
    look.nearest = std::max(std::min({-corners[0].z, -corners[1].z, -corners[2].z}), surfaces.projection.near_distance);
    look.farthest = std::max({-corners[0].z, -corners[1].z, -corners[2].z});
    return look;
}

glm::vec4 PixelFiller::color(std::uint32_t number, int x, int y) {
    const Scene& scene = *frame_.scene;
    if (scene.surfaces.shading == SurfaceShading::paper) return glm::vec4(scene.surfaces.paper_color, 1.0f);
    glm::dvec3 origin, ray;
    frame_.surfaces.projection.view_ray({x + 0.5, y + 0.5}, origin, ray);
    const Look& look = look_of(number);
    return surface_color(scene.surfaces, scene.materials[look.material_id - 1], look.normal, -glm::normalize(ray));
}

void PixelFiller::shade(const SampleTile& samples, int x, int y, PixelResult& result) {
    const int s = samples.samples_per_pixel;
    const auto stride = static_cast<std::size_t>(samples.stride);
    const std::size_t first = samples.index(x * s, y * s);
    glm::vec4 sum(0.0f);
    if (frame_.scene->surfaces.shading == SurfaceShading::paper) {
        int covered = 0;
        for (std::size_t row = 0; row < static_cast<std::size_t>(s); ++row) {
            for (std::size_t column = 0; column < static_cast<std::size_t>(s); ++column) {
                covered += samples.ids[first + row * stride + column] != SampleTile::kBackground;
            }
        }
        sum = glm::vec4(frame_.scene->surfaces.paper_color, 1.0f) * static_cast<float>(covered);
    } else {
        std::uint32_t last_id = SampleTile::kBackground;
        glm::vec4 last_color(0.0f);
        for (std::size_t row = 0; row < static_cast<std::size_t>(s); ++row) {
            for (std::size_t column = 0; column < static_cast<std::size_t>(s); ++column) {
                const std::uint32_t id = samples.ids[first + row * stride + column];
                if (id != last_id) {
                    last_id = id;
                    last_color = id == SampleTile::kBackground ? glm::vec4(0.0f) : color(id >> 1, x, y);
                }
                sum += last_color;
            }
        }
    }
    result.surface = sum / static_cast<float>(s * s);
    result.beauty = result.surface;
    // The sample next to the pixel's centre stands for the pixel in depth, normal and numbers.
    const std::uint32_t central = samples.ids[first + static_cast<std::size_t>(s / 2) * (stride + 1)];
    if (central == SampleTile::kBackground) {
        result.distance = std::numeric_limits<float>::infinity();
        result.normal = glm::vec3(0.0f);
        result.object_id = result.material_id = result.polygon_id = 0;
        return;
    }
    const Look& look = look_of(central >> 1);
    glm::dvec3 origin, ray;
    frame_.surfaces.projection.view_ray({x + 0.5, y + 0.5}, origin, ray);
    const double distance = glm::dot(look.normal, look.corner - origin) / glm::dot(look.normal, ray);
    // A triangle seen edge-on may be met anywhere along the ray, or nowhere.
    result.distance = static_cast<float>(std::isfinite(distance) ? std::clamp(distance, look.nearest, look.farthest)
                                                                 : look.nearest);
    result.normal = look.world_normal;
    result.object_id = look.object_id;
    result.material_id = look.material_id;
    result.polygon_id = look.polygon_id;
}

void PixelFiller::fill(const LineTile& tile, Film& film) {
    const PixelRect rect = tile.rect();
    const int x0 = std::max(rect.x0, frame_.crop.x0), x1 = std::min(rect.x1, frame_.crop.x1);
    if (x0 >= x1) return;
    const SampleTile& samples = tile.samples();
    PixelResult result;
    for (int y = std::max(rect.y0, frame_.crop.y0); y < std::min(rect.y1, frame_.crop.y1); ++y) {
        if (tile.is_empty()) {
            film.put_background(x0, x1, y);
            continue;
        }
        for (int x = x0; x < x1; ++x) {
            shade(samples, x, y, result);
            film.put(x, y, result);
        }
    }
}

}  // namespace burin
