#include "lines/narrow_lap.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace burin {
namespace {

/// A lap narrower than this, in pixels, is a contact, if the two edges are at less than 30 degrees.
constexpr double kNarrowPx = 2;
constexpr double kCosAlong = 0.866;
/// The facets of a rim cross those of the hole around it, over and over: at less than 16 degrees if there are 12 of
/// them or more, and they lap by less than a twelfth of their length. That goes for them at any size.
constexpr double kCosOfFacets = 0.961, kCosOfParallels = 0.99996;
constexpr double kNarrowPart = 1.0 / 12;
/// A face leaves its plane where it bends by more than 10 degrees.
constexpr double kCosBend = 0.985;
/// The way over a lap begins beside the edge, and the own face has to go on by as much beyond the other one's edge. In
/// pixels.
constexpr double kBesidePx = 1.0 / 64;

}  // namespace

bool laps_narrowly(const SurfaceSet& surfaces, SurfaceId own, HalfEdge edge, const FacePlace& other, glm::dvec2 at) {
    const Projection& p = surfaces.projection;
    const auto end_of = [&](std::uint32_t instance, HalfEdge h, HalfEdge k) {
        return surfaces.view_position(instance, surfaces.mesh_of({instance, h / 3}).triangles[h / 3][(h + k) % 3]);
    };
    const glm::dvec3 from = end_of(own.instance, edge, 0), to = end_of(own.instance, edge, 1);
    const double length = glm::distance(from, to);
    const glm::dvec3 along = (to - from) / std::max(length, 1e-300);
    glm::dvec3 corners[3], origin, ray;
    surfaces.view_corners(own, corners);
    const glm::dvec3 to_middle = (corners[0] + corners[1] + corners[2]) / 3.0 - from,
                     across = to_middle - glm::dot(to_middle, along) * along;
    const glm::dvec3 inward = across / std::max(glm::length(across), 1e-300), normal = glm::cross(along, inward);
    p.view_ray(at, origin, ray);
    const double facing = glm::dot(normal, ray);
    if (facing == 0) return false;
    const glm::dvec3 place = origin + ray * (glm::dot(normal, from - origin) / facing);
    const double pixel = p.pixel_size(-place.z), reach = std::max(kNarrowPx * pixel, kNarrowPart * length);
    const glm::dvec3 begin = place + kBesidePx * pixel * inward, end = place + reach * inward;
    if (!(pixel > 0) || !needs_no_clipping(p, begin) || !needs_no_clipping(p, end)) return false;
    const glm::dvec2 begin_px = p.to_pixel(begin), end_px = p.to_pixel(end);
    if (begin_px == end_px) return false;
    LineCriteria bends;
    bends.classes = LineClass::crease;
    bends.cos_crease_angle = kCosBend;
    // Where a face ends on the way, or leaves its plane.
    struct End {
        SurfaceEdge edge;
        double fraction = 1;
    };
    const auto end_of_face = [&](const FacePlace& start, glm::dvec2 goal,
                                 SurfaceId* arrived = nullptr) -> std::optional<End> {
        const SurfaceWalk walk = walk_surface(surfaces, start.surface, start.pixel, goal, bends);
        if (arrived != nullptr && walk.end == WalkEnd::arrived) *arrived = walk.surface;
        if (walk.crossed.has(LineClass::crease) && walk.crossed_edge.half_edge != kNoHalfEdge)
            return End{walk.crossed_edge, walk.crossed_fraction};
        if (walk.end != WalkEnd::fold && walk.end != WalkEnd::border) return std::nullopt;
        return End{{walk.surface, walk.half_edge}, walk.fraction};
    };
    SurfaceId beneath = other.surface;
    if (glm::distance(other.pixel, begin_px) > 2 * kBesidePx) {
        beneath = kBackground;
        if (end_of_face(other, begin_px, &beneath) || beneath.is_background()) return false;
    }
    const auto other_end = end_of_face({beneath, begin_px}, end_px);
    if (!other_end) return false;
    const SurfaceEdge& e = other_end->edge;
    const glm::dvec3 other_from = end_of(e.surface.instance, e.half_edge, 0),
                     other_to = end_of(e.surface.instance, e.half_edge, 1);
    const double cosine =
        std::abs(glm::dot(along, other_to - other_from)) / std::max(glm::distance(other_from, other_to), 1e-300);
    const double lap = other_end->fraction * reach;
    const bool is_narrow = (cosine >= kCosAlong && lap <= kNarrowPx * pixel) ||
                           (cosine >= kCosOfFacets && cosine <= kCosOfParallels && lap <= kNarrowPart * length);
    if (!is_narrow) return false;
    const double beyond = other_end->fraction + 2 * kBesidePx / glm::distance(begin_px, end_px);
    return !end_of_face({own, begin_px}, glm::mix(begin_px, end_px, beyond));
}

}  // namespace burin
