#include "shading/ink/surface_values.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

/// The share of the way from one place to another that is nearest to a third.
double share_between(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& place) {
    const glm::dvec3 way = to - from;
    const double square = glm::dot(way, way);
    const double share = square > 0 ? glm::dot(place - from, way) / square : 0;
    return share > 0 ? std::min(share, 1.0) : 0.0;
}

}  // namespace

SurfaceValues::SurfaceValues(const SurfaceSet& surfaces, const SurfaceNeeds& needs,
                             std::span<const MeshCurvature* const> curvatures)
    : surfaces_(surfaces), needs_(needs), curvatures_(curvatures) {
    if (!needs.kr) return;
    for (const SurfaceInstance& instance : surfaces.instances)
        from_view_.push_back(glm::inverse(glm::dmat3(instance.to_view)));
}

std::array<double, 3> SurfaceValues::weights_on_edge(const FrontFace& front, const glm::dvec3& place) const {
    const Mesh& mesh = surfaces_.mesh_of(front.surface);
    const std::size_t k = front.half_edge % 3, next = (k + 1) % 3;
    const auto& t = mesh.triangles[front.half_edge / 3];
    const double share = share_between(surfaces_.view_position(front.surface.instance, t[k]),
                                       surfaces_.view_position(front.surface.instance, t[next]), place);
    std::array<double, 3> weights{};
    weights[k] = 1 - share;
    weights[next] = share;
    return weights;
}

std::array<double, 3> SurfaceValues::weights_at(SurfaceId surface, const glm::dvec3& place) const {
    glm::dvec3 corners[3];
    surfaces_.view_corners(surface, corners);
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    std::array<double, 3> weights{};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        weights[k] = std::max(glm::dot(glm::cross(b - a, place - a), normal), 0.0);
        sum += weights[k];
    }
    if (!(sum > 0) || !std::isfinite(sum)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (double& weight : weights) weight /= sum;
    return weights;
}

void SurfaceValues::write(const LinePiece& piece, const FrontFace& front, std::span<float> to) const {
    const std::size_t columns = needs_.column_count();
    for (std::size_t end = 0; end < 2; ++end) {
        const std::span<float> own = to.subspan(end * columns, columns);
        if (front.surface.is_background()) {
            std::fill(own.begin(), own.end(), 0.0f);
            continue;
        }
        glm::dvec3 origin, direction;
        surfaces_.projection.view_ray(end == 0 ? piece.from : piece.to, origin, direction);
        const double depth = surfaces_.projection.distance(end == 0 ? piece.nearness_from : piece.nearness_to);
        const glm::dvec3 place = origin + direction * depth;
        const bool is_on_edge = front.half_edge != kNoHalfEdge && front.half_edge / 3 == front.surface.triangle;
        write_at(front.surface, is_on_edge ? weights_on_edge(front, place) : weights_at(front.surface, place),
                 -direction / glm::length(direction), own);
    }
}

void SurfaceValues::write_at(SurfaceId surface, const std::array<double, 3>& weights, const glm::dvec3& eye,
                             std::span<float> to) const {
    std::fill(to.begin(), to.end(), 0.0f);
    if (needs_.kr && curvatures_[surface.instance] != nullptr) {
        const glm::dvec3 normal = surfaces_.view_normal(surface);
        to[0] = static_cast<float>(radial_curvature(*curvatures_[surface.instance], surface.triangle, weights,
                                                    from_view_[surface.instance],
                                                    glm::dot(normal, eye) < 0 ? -normal : normal, eye));
    }
    const Mesh& mesh = surfaces_.mesh_of(surface);
    const auto write_layer = [&](AttributeKind kind, const std::string& name, std::size_t column) {
        if (const AttributeLayer* const layer = find_layer(mesh.attributes, kind, name))
            attribute_at(*layer, surface.triangle, weights, &to[column]);
    };
    if (needs_.uv) write_layer(AttributeKind::uv, {}, needs_.uv_column());
    if (needs_.color) write_layer(AttributeKind::color, {}, needs_.color_column());
    for (std::size_t i = 0; i < needs_.attributes.size(); ++i)
        write_layer(AttributeKind::named, needs_.attributes[i], needs_.attribute_column() + i);
}

}  // namespace burin
