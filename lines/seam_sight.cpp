#include "lines/seam_sight.h"

#include <cmath>

namespace burin {
namespace {

/// Corners are snapped after they were projected, and moved a trifle.
constexpr double kAroundPx = 1.5 * kWidestCrackPx;
/// Among fewer borders, what is in reach is found as fast by place alone.
constexpr std::size_t kManyBorders = std::size_t{1} << 14;

/// By how much a matrix lengthens what lies in the plane of x and y, at most.
double most_lengthened(const glm::dmat3& m) {
    const double xx = glm::dot(m[0], m[0]), yy = glm::dot(m[1], m[1]), xy = glm::dot(m[0], m[1]);
    return std::sqrt(0.5 * (xx + yy + std::hypot(xx - yy, 2 * xy)));
}

}  // namespace

std::optional<BorderIndex::Sight> sight_through(const SurfaceSet& surfaces, std::uint32_t instance,
                                                const glm::dvec3& at) {
    const Projection& p = surfaces.projection;
    const glm::dmat4& to_view = surfaces.instances[instance].to_view;
    const glm::dmat3 turn(to_view), back = glm::inverse(turn);
    const glm::dvec3 seen = turn * at + glm::dvec3(to_view[3]);
    const double distance = -seen.z;
    if (!p.orthographic && !(distance > p.near_distance)) return std::nullopt;
    const glm::dvec3 ray = back * (p.orthographic ? glm::dvec3(0, 0, -1) : seen);
    BorderIndex::Sight sight;
    sight.direction = ray / glm::length(ray);
    const double per_distance = kAroundPx * most_lengthened(back) * std::max(p.pixel_aspect, 1.0) / p.focal_px;
    sight.radius = p.orthographic ? per_distance : per_distance * distance;
    sight.growth = p.orthographic ? 0.0 : per_distance * std::abs((turn * sight.direction).z);
    const bool is_known =
        std::isfinite(sight.radius) && std::isfinite(sight.growth) && std::isfinite(glm::length(sight.direction));
    return is_known ? std::optional(sight) : std::nullopt;
}

std::optional<HalfEdge> seam_partner_seen(const SurfaceSet& surfaces, std::uint32_t instance, HalfEdge border,
                                          const glm::dvec3& at) {
    const BorderIndex& borders = surfaces.instances[instance].mesh->borders;
    if (!borders.has_crowds() || borders.segments().size() < kManyBorders) return borders.seam_partner(border, at);
    const auto sight = sight_through(surfaces, instance, at);
    return sight ? borders.seam_partner(border, at, *sight) : borders.seam_partner(border, at);
}

}  // namespace burin
