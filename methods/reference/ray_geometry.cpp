#include "methods/reference/ray_geometry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/infinity.h"

namespace burin {
namespace {

std::vector<glm::dvec3> areas_of_polygons(const Mesh& mesh) {
    std::vector<glm::dvec3> areas;
    if (mesh.triangle_polygon.empty()) return areas;
    areas.assign(mesh.polygon_count, glm::dvec3(0.0));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const glm::dvec3 p = mesh.local_position(a);
        areas[mesh.polygon_of(t)] += glm::cross(mesh.local_position(b) - p, mesh.local_position(c) - p);
    }
    return areas;
}

}  // namespace

RayGeometry::RayGeometry(const Frame& frame)
    : projection_(frame.surfaces.projection), coordinate_error_(frame.surfaces.coordinate_error) {
    const Scene& scene = *frame.scene;
    const glm::dmat4 view = frame.camera.to_view();
    for (const Mesh& mesh : scene.meshes) polygon_areas_.push_back(areas_of_polygons(mesh));
    std::uint32_t next_polygon_id = 1;
    for (const SceneObject& source : scene.objects) {
        Object object;
        object.source = &source;
        object.mesh = &scene.meshes[source.mesh];
        object.to_view = view * source.to_world;
        const glm::dvec3 x(object.to_view[0]), y(object.to_view[1]), z(object.to_view[2]);
        object.area_to_view = {glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)};
        object.first_polygon_id = next_polygon_id;
        next_polygon_id += object.mesh->polygon_count;
        objects_.push_back(object);
    }
}

void RayGeometry::corners(Facet f, glm::dvec3 (&corners)[3]) const {
    const auto& t = mesh(f.object).triangles[f.triangle];
    for (std::size_t k = 0; k < 3; ++k) corners[k] = position(f.object, t[k]);
}

double RayGeometry::plane_distance(Facet f, glm::dvec2 pixel) const {
    glm::dvec3 c[3], origin, ray;
    corners(f, c);
    projection_.view_ray(pixel, origin, ray);
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    const double along = glm::dot(normal, ray);
    if (along == 0) return kInfinity;
    const double t = glm::dot(normal, c[0] - origin) / along;
    return projection_.orthographic || t > 0 ? t : kInfinity;
}

double RayGeometry::distance(Facet f, glm::dvec2 pixel) const {
    glm::dvec3 c[3];
    corners(f, c);
    const auto [low, high] = std::minmax({-c[0].z, -c[1].z, -c[2].z});
    return std::clamp(plane_distance(f, pixel), std::max(low, projection_.near_distance), high);
}

double RayGeometry::slope_per_px(Facet f, glm::dvec2 pixel) const {
    const double step = 1.0 / 256;
    const double here = plane_distance(f, pixel);
    const double dx = plane_distance(f, pixel + glm::dvec2(step, 0)) - here;
    const double dy = plane_distance(f, pixel + glm::dvec2(0, step)) - here;
    const double slope = (std::abs(dx) + std::abs(dy)) / step;
    return std::isfinite(slope) ? slope : 0;
}

glm::dvec3 RayGeometry::polygon_normal(Facet f) const {
    const Object& o = objects_[f.object];
    const auto& areas = polygon_areas_[o.source->mesh];
    glm::dvec3 area;
    if (areas.empty()) {
        glm::dvec3 c[3];
        corners(f, c);
        area = glm::cross(c[1] - c[0], c[2] - c[0]);
    } else {
        area = o.area_to_view * areas[o.mesh->polygon_of(f.triangle)];
    }
    return area / std::max(glm::length(area), 1e-300);
}

glm::dvec3 RayGeometry::normal_towards_eye(Facet f, glm::dvec2 pixel) const {
    glm::dvec3 c[3], origin, ray;
    corners(f, c);
    projection_.view_ray(pixel, origin, ray);
    const glm::dvec3 normal = polygon_normal(f);
    return glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), ray) > 0 ? -normal : normal;
}

bool RayGeometry::are_one_around(Facet a, Facet b, glm::dvec2 pixel, double error) const {
    const double here = distance(a, pixel);
    const glm::dvec2 ways[] = {{0.5, 0.0}, {-0.5, 0.0}, {0.0, 0.5}, {0.0, -0.5}};
    return std::all_of(std::begin(ways), std::end(ways), [&](glm::dvec2 way) {
        const double one = plane_distance(a, pixel + way), other = plane_distance(b, pixel + way);
        if (!std::isfinite(one) || !std::isfinite(other)) return true;  // beyond the horizon
        // Towards the eye errors grow with the distance, twice.
        const double farther = std::max(std::abs(one) / here, 1.0);
        return std::abs(one - other) <= error * farther * farther;
    });
}

bool RayGeometry::is_sliver(Facet f) const {
    glm::dvec3 c[3];
    corners(f, c);
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::distance(c[k], c[(k + 1) % 3]));
    const double height = glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / longest;
    const double nearest = std::max(-std::max({c[0].z, c[1].z, c[2].z}), projection_.near_distance);
    return height < longest / 1024 && height < projection_.pixel_size(nearest) / 64;
}

}  // namespace burin
