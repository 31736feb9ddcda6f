#include "shading/surface/shaded_triangle.h"

#include <algorithm>

namespace burin {
ShadedTriangle::ShadedTriangle(const ShadedSurfaces& shaded, SurfaceId id) : id_(id) {
    const SurfaceSet& surfaces = shaded.surfaces();
    const Projection& p = surfaces.projection;
    object_id_ = surfaces.object_id(id);
    material_id_ = surfaces.material_id(id);
    color_ = shaded.material(material_id_).color;
    surfaces.view_corners(id, corners_);

    // The ray through a pixel (x, y) has a direction, or an origin, that is affine in x and y. What it meets is where
    // the weights have that direction, or that origin, as their sum of corners.
    const glm::dvec3 area = glm::cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
    const double facing = p.orthographic ? area.z : -glm::dot(area, corners_[0]);
    const double side = facing < 0 ? -1 : 1;
    const glm::dvec2 focal = p.focal_xy_px();
    const double x0 = -p.center_px.x / focal.x, y0 = p.center_px.y / focal.y;
    const glm::dvec2 step = 1.0 / focal;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &a = corners_[(k + 1) % 3], &b = corners_[(k + 2) % 3];
        // In an orthographic view, places are seen as from a plane at a distance of 1.
        const glm::dvec3 edge = p.orthographic ? glm::cross(glm::dvec3(a.x, a.y, 1), glm::dvec3(b.x, b.y, 1)) * side
                                               : glm::cross(a, b) * -side;
        const double depth = p.orthographic ? edge.z : -edge.z;
        weights_[k] = {edge.x * x0 + edge.y * y0 + depth, edge.x * step.x, -edge.y * step.y};
    }

    const glm::dvec3 own = surfaces.view_normal(id);
    const bool is_own_away = glm::dot(own, area) < 0;
    const glm::dvec3 flat = own * (is_own_away ? -side : side);
    std::fill(std::begin(normals_), std::end(normals_), flat);
    const SmoothMesh* const smooth = shaded.smooth(id.instance);
    if (smooth == nullptr) return;
    const glm::dmat3& to_view = surfaces.instance_of(id).normal_to_view;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 normal = to_view * glm::dvec3(smooth->normals[3 * std::size_t{id.triangle} + k]);
        const double length = glm::length(normal);
        if (!(length > 0)) continue;  // a tip has none
        normals_[k] = normal * ((glm::dot(normal, flat) < 0 ? -1 : 1) / length);
        is_smooth_ = is_smooth_ || normals_[k] != flat;
    }
}

glm::dvec3 ShadedTriangle::shadow_place(glm::dvec2 pixel) const {
    const auto [weights, scale] = weights_at(pixel);
    const glm::dvec3 place = mean_of(corners_, weights) * scale;
    if (!is_smooth_) return place;
    glm::dvec3 moved = place;
    for (int k = 0; k < 3; ++k) {
        const double below = std::min(glm::dot(place - corners_[k], normals_[k]), 0.0);  // the plane at the corner
        moved -= normals_[k] * (weights[k] * scale * below);
    }
    return moved;
}

std::array<std::array<double, 3>, 2> ShadedTriangle::share_changes_at(glm::dvec2 pixel) const {
    const auto [weights, scale] = weights_at(pixel);
    std::array<std::array<double, 3>, 2> changes{};
    for (int i = 0; i < 2; ++i) {
        const double sum = weights_[0][i + 1] + weights_[1][i + 1] + weights_[2][i + 1];
        for (std::size_t k = 0; k < 3; ++k)
            changes[static_cast<std::size_t>(i)][k] = (weights_[k][i + 1] - weights[k] * scale * sum) * scale;
    }
    return changes;
}

SurfaceChanges ShadedTriangle::changes_at(glm::dvec2 pixel, const SurfacePlace& place) const {
    const auto [weights, scale] = weights_at(pixel);
    SurfaceChanges changes{};
    const double length = is_smooth_ ? glm::length(mean_of(normals_, weights)) : 0;
    for (int i = 0; i < 2; ++i) {
        const double change[3] = {weights_[0][i + 1], weights_[1][i + 1], weights_[2][i + 1]};
        changes.position[i] =
            (mean_of(corners_, change) - place.position * (change[0] + change[1] + change[2])) * scale;
        if (!(length > 0)) continue;
        const glm::dvec3 normal = mean_of(normals_, change) * (1 / length);
        changes.normal[i] = normal - place.normal * glm::dot(place.normal, normal);
    }
    return changes;
}

}  // namespace burin
