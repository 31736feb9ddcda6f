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
    const double x0 = -p.center_px.x / p.focal_px, y0 = p.center_px.y / p.focal_px, step = 1 / p.focal_px;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &a = corners_[(k + 1) % 3], &b = corners_[(k + 2) % 3];
        // In an orthographic view, places are seen as from a plane at a distance of 1.
        const glm::dvec3 edge = p.orthographic ? glm::cross(glm::dvec3(a.x, a.y, 1), glm::dvec3(b.x, b.y, 1)) * side
                                               : glm::cross(a, b) * -side;
        const double depth = p.orthographic ? edge.z : -edge.z;
        weights_[k] = {edge.x * x0 + edge.y * y0 + depth, edge.x * step, -edge.y * step};
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

ShadedTriangle::Weights ShadedTriangle::weights_at(glm::dvec2 pixel) const {
    Weights weights{};
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        weights.of[k] = std::max(weights_[k][0] + pixel.x * weights_[k][1] + pixel.y * weights_[k][2], 0.0);
        sum += weights.of[k];
    }
    if (!(sum > 0)) return {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 1};  // edge-on
    weights.scale = 1 / sum;
    return weights;
}

glm::dvec3 ShadedTriangle::shadow_place(glm::dvec2 pixel) const {
    const auto [weights, scale] = weights_at(pixel);
    const glm::dvec3 place = (weights[0] * corners_[0] + weights[1] * corners_[1] + weights[2] * corners_[2]) * scale;
    if (!is_smooth_) return place;
    glm::dvec3 moved = place;
    for (int k = 0; k < 3; ++k) {
        const double below = std::min(glm::dot(place - corners_[k], normals_[k]), 0.0);  // the plane at the corner
        moved -= normals_[k] * (weights[k] * scale * below);
    }
    return moved;
}

SurfacePlace ShadedTriangle::at(glm::dvec2 pixel, bool with_changes) const {
    const auto [weights, scale] = weights_at(pixel);
    SurfacePlace place{};
    place.position = (weights[0] * corners_[0] + weights[1] * corners_[1] + weights[2] * corners_[2]) * scale;
    if (with_changes) {
        for (int i = 0; i < 2; ++i) {
            const double a = weights_[0][i + 1], b = weights_[1][i + 1], c = weights_[2][i + 1];
            place.position_change[i] =
                (a * corners_[0] + b * corners_[1] + c * corners_[2] - place.position * (a + b + c)) * scale;
        }
    }
    if (!is_smooth_) {
        place.normal = normals_[0];
        return place;
    }
    const glm::dvec3 mean = (weights[0] * normals_[0] + weights[1] * normals_[1] + weights[2] * normals_[2]) * scale;
    const double length = glm::length(mean);
    place.normal = mean / std::max(length, 1e-300);
    if (!with_changes || !(length > 0)) return place;
    for (int i = 0; i < 2; ++i) {
        const double a = weights_[0][i + 1], b = weights_[1][i + 1], c = weights_[2][i + 1];
        const glm::dvec3 change = (a * normals_[0] + b * normals_[1] + c * normals_[2]) * (scale / length);
        place.normal_change[i] = change - place.normal * glm::dot(place.normal, change);
    }
    return place;
}

}  // namespace burin
