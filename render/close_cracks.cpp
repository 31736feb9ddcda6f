#include "render/close_cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/stitch_cracks.h"

namespace burin {
namespace {

constexpr double kWidestCrackPx = 1;

/// What the size of a pixel at a place of the mesh takes: its distance from the eye, and how much the mesh is enlarged.
struct Placing {
    glm::dvec3 per_position;  // of the distance
    double distance;          // at 0
    double scale;             // at least that of any direction
};

Placing placing_of(const glm::dmat4& to_view, const glm::dvec3& origin) {
    const glm::dvec3 row(to_view[0].z, to_view[1].z, to_view[2].z);
    const glm::dmat3 linear(to_view);
    const double x = glm::length(linear[0]), y = glm::length(linear[1]), z = glm::length(linear[2]);
    const double largest = std::max({x, y, z});
    // Of directions at right angles the largest, of others no more than all together.
    const double skew = std::abs(glm::dot(linear[0], linear[1])) + std::abs(glm::dot(linear[1], linear[2])) + std::abs(glm::dot(linear[0], linear[2]));
    const double scale = skew <= 1e-6 * largest * largest ? largest : std::sqrt(x * x + y * y + z * z);
    return {-row, -(glm::dot(row, origin) + to_view[3].z), scale};
}

/// Whether anything of it is.
bool is_before_the_eye(const Placing& placing, const Mesh& mesh) {
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (glm::dot(placing.per_position, mesh.local_position(v)) + placing.distance > 0) return true;
    }
    return false;
}

}  // namespace

void close_cracks(Scene& scene, const Camera& camera, int width, int height) {
    const Projection projection = camera.projection(width, height, 0);
    const glm::dmat4 world_to_view = camera.to_view();
    std::vector<std::vector<Placing>> placings(scene.meshes.size());
    for (const SceneObject& object : scene.objects) {
        const Mesh& mesh = scene.meshes[object.mesh];
        if (mesh.borders.segments().size() < 2) continue;
        const Placing placing = placing_of(world_to_view * object.to_world, mesh.origin);
        if (projection.orthographic || is_before_the_eye(placing, mesh)) placings[object.mesh].push_back(placing);
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (placings[i].empty()) continue;
        const auto reach = [&](const glm::dvec3& position) {
            double least = std::numeric_limits<double>::max();
            for (const Placing& p : placings[i]) {
                const double distance = glm::dot(p.per_position, position) + p.distance;
                // What is beside or behind the eye may pass by it on its way to the other end of an edge.
                const double pixel = projection.orthographic || distance > 0 ? projection.pixel_size(distance) : 0;
                least = std::min(least, pixel / p.scale);
            }
            return kWidestCrackPx * least;
        };
        if (auto stitched = stitch_cracks(scene.meshes[i], reach)) scene.meshes[i] = std::move(*stitched);
    }
}

}  // namespace burin
