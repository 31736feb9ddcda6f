#include "render/close_cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "base/interrupt.h"
#include "mesh/box.h"
#include "mesh/stitch_cracks.h"

namespace burin {
namespace {

constexpr double kWidestCrackPx = 1;

/// What the size of a pixel at a place of the mesh takes: its distance from the eye, and how much the mesh is enlarged.
struct Placing {
    glm::dvec3 per_position;  // of the distance
    double distance;          // at 0
    double scale;             // at least that of any direction

    auto operator<=>(const Placing& other) const {
        const auto numbers = [](const Placing& p) {
            return std::tuple(p.per_position.x, p.per_position.y, p.per_position.z, p.distance, p.scale);
        };
        return numbers(*this) <=> numbers(other);
    }
    bool operator==(const Placing& other) const { return (*this <=> other) == 0; }
};

Placing placing_of(const glm::dmat4& to_view, const glm::dvec3& origin) {
    const glm::dvec3 row(to_view[0].z, to_view[1].z, to_view[2].z);
    const glm::dmat3 linear(to_view);
    const double x = glm::length(linear[0]), y = glm::length(linear[1]), z = glm::length(linear[2]);
    const double largest = std::max({x, y, z});
    // Axes at right angles enlarge by no more than the largest of them, others by no more than all together.
    const double skew = std::abs(glm::dot(linear[0], linear[1])) + std::abs(glm::dot(linear[1], linear[2])) +
                        std::abs(glm::dot(linear[0], linear[2]));
    const double scale = skew <= 1e-6 * largest * largest ? largest : std::sqrt(x * x + y * y + z * z);
    return {-row, -(glm::dot(row, origin) + to_view[3].z), scale};
}

/// Bounds of the distances of all places within a box, in whatever way they are rounded.
struct Distances {
    double low, high;
};
Distances distances_of(const Placing& placing, const Box& box) {
    const glm::dvec3 a = placing.per_position * box.low, b = placing.per_position * box.high;
    const glm::dvec3 low = glm::min(a, b), high = glm::max(a, b), size = glm::max(glm::abs(a), glm::abs(b));
    const double rounding = 1e-12 * (size.x + size.y + size.z + std::abs(placing.distance));
    return {low.x + low.y + low.z + placing.distance - rounding,
            high.x + high.y + high.z + placing.distance + rounding};
}

/// Whether anything of a mesh lies before the eye. `box` is around the mesh.
bool is_before_the_eye(const Placing& placing, const Mesh& mesh, const Box& box) {
    if (distances_of(placing, box).high < 0) return false;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (glm::dot(placing.per_position, mesh.local_position(v)) + placing.distance > 0) return true;
    }
    return false;
}

/// Leaves the placings that matter where the mesh is: the size of a pixel is the least of all.
void drop_far_ones(std::vector<Placing>& placings, const Box& box, const Projection& projection) {
    std::sort(placings.begin(), placings.end());
    placings.erase(std::unique(placings.begin(), placings.end()), placings.end());
    const auto pixel = [&](const Placing& p, double distance) {
        return projection.orthographic || distance > 0 ? projection.pixel_size(distance) / p.scale : 0;
    };
    constexpr double kRounding = 1e-9;
    double least = std::numeric_limits<double>::infinity();
    for (const Placing& p : placings) least = std::min(least, pixel(p, distances_of(p, box).high) * (1 + kRounding));
    std::erase_if(placings, [&](const Placing& p) { return pixel(p, distances_of(p, box).low) > least; });
}

}  // namespace

void close_cracks(Scene& scene, const Camera& camera, int width, int height, int threads, ReplacedMeshes* replaced) {
    const Projection projection = camera.projection(width, height, 0);
    const glm::dmat4 world_to_view = camera.to_view();
    std::vector<std::vector<Placing>> placings(scene.meshes.size());
    std::vector<Box> boxes(scene.meshes.size());
    for (const SceneObject& object : scene.objects) {
        throw_if_interrupted();
        const Mesh& mesh = scene.meshes[object.mesh];
        if (mesh.borders.segments().size() < 2) continue;
        Box& box = boxes[object.mesh];
        if (box.is_empty()) box = box_of(mesh);
        const Placing placing = placing_of(world_to_view * object.to_world, mesh.origin);
        if (projection.orthographic || is_before_the_eye(placing, mesh, box)) placings[object.mesh].push_back(placing);
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (placings[i].empty()) continue;
        drop_far_ones(placings[i], boxes[i], projection);
        const auto reach = [&](const glm::dvec3& position) {
            throw_if_interrupted();
            double least = std::numeric_limits<double>::max();
            for (const Placing& p : placings[i]) {
                const double distance = glm::dot(p.per_position, position) + p.distance;
                // What is beside or behind the eye may pass by it on its way to the other end of an edge.
                const double pixel = projection.orthographic || distance > 0 ? projection.pixel_size(distance) : 0;
                least = std::min(least, pixel / p.scale);
            }
            return kWidestCrackPx * least;
        };
        if (auto stitched = stitch_cracks(scene.meshes[i], reach, threads))
            replace_mesh(scene, i, std::move(*stitched), replaced);
    }
}

}  // namespace burin
