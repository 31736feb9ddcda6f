#include "render/motion.h"

#include <algorithm>

namespace burin {

glm::vec2 motion_at(const SurfaceSet& now, const SurfaceSet& next, SurfaceId surface, glm::dvec2 place) {
    glm::dvec3 corners[3], origin, ray;
    now.view_corners(surface, corners);
    now.projection.view_ray(place, origin, ray);
    const glm::dvec3 a = corners[1] - corners[0], b = corners[2] - corners[0], area = glm::cross(a, b);
    const double facing = glm::dot(area, ray);
    glm::dvec3 point = (corners[0] + corners[1] + corners[2]) / 3.0;  // of a triangle seen edge-on
    if (facing != 0) {  // as the layer Z has it: no nearer and no farther than the triangle
        const double distance = glm::dot(area, corners[0] - origin) / facing;
        const double nearest = std::min({-corners[0].z, -corners[1].z, -corners[2].z}),
                     farthest = std::max({-corners[0].z, -corners[1].z, -corners[2].z});
        point = origin + ray * std::clamp(distance, nearest, farthest);
    }
    // The same combination of the corners in the next frame.
    const glm::dvec3 from_corner = point - corners[0];
    const double square = glm::dot(area, area);
    if (!(square > 0)) return glm::vec2(0.0f);
    const double of_a = glm::dot(glm::cross(from_corner, b), area) / square,
                 of_b = glm::dot(glm::cross(a, from_corner), area) / square;
    next.view_corners(surface, corners);
    const glm::dvec3 moved = corners[0] + of_a * (corners[1] - corners[0]) + of_b * (corners[2] - corners[0]);
    if (!next.projection.orthographic && !(-moved.z > 0)) return glm::vec2(0.0f);
    const glm::dvec2 way = next.projection.to_pixel(moved) - now.projection.to_pixel(point);
    return {static_cast<float>(way.x), static_cast<float>(-way.y)};
}

SurfaceSet surfaces_later(const Frame& frame, std::span<const glm::dmat4> to_world, std::span<const Mesh* const> meshes,
                          const Camera& camera) {
    SurfaceSet later = frame.surfaces;
    later.projection = camera.projection(frame.width, frame.height, frame.surfaces.projection.near_distance);
    later.view_to_world = glm::dmat3(camera.to_world);
    const glm::dmat4 world_to_view = camera.to_view();
    for (std::size_t i = 0; i < later.instances.size(); ++i) {
        SurfaceInstance& instance = later.instances[i];
        const Mesh* const mesh = i < meshes.size() ? meshes[i] : nullptr;
        if (mesh != nullptr && mesh->triangles == instance.mesh->triangles) instance.mesh = mesh;
        const glm::dmat4& own = to_world.empty() ? frame.scene->objects[i].to_world : to_world[i];
        instance.to_view = world_to_view * own;
        instance.to_view[3] = instance.to_view * glm::dvec4(instance.mesh->origin, 1.0);
    }
    return later;
}

}  // namespace burin
