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
/// them or more, and they lap by less than a twelfth of the longer one. That goes for them at any size.
constexpr double kCosOfFacets = 0.961, kCosOfParallels = 0.99996;
/// Facets that are parallel are told from sides of boards by those beside them: these bend by at most 31 degrees, and
/// are at most four times as long or as short.
constexpr double kCosOfRim = 0.857, kMostUneven = 4;
/// So many triangles around a vertex, or at an edge, are looked at to find the facet beside one.
constexpr int kMostTurns = 64;
constexpr double kNarrowPart = 1.0 / 12;
/// The edge of the other face may be 8 times as long as the own one. A longer edge allows a wider lap, so the other
/// face's end is looked for that much farther away.
constexpr double kMostTimesLonger = 8;
/// A face leaves its plane where it bends by more than 10 degrees.
constexpr double kCosBend = 0.985;
/// The way over a lap begins beside the edge, and the own face has to go on by as much beyond the other one's edge. In
/// pixels.
constexpr double kBesidePx = 1.0 / 64;

/// The edges at which faces of one mesh end, which is where they bend.
class Rim {
  public:
    Rim(const SurfaceSet& surfaces, std::uint32_t instance)
        : surfaces_(surfaces), instance_(instance), mesh_(surfaces.mesh_of({instance, 0})) {
        bends_.classes = LineClass::crease;
        bends_.cos_crease_angle = kCosBend;
    }
    const LineCriteria& bends() const { return bends_; }
    glm::dvec3 corner(HalfEdge h, HalfEdge k) const {
        return surfaces_.view_position(instance_, mesh_.triangles[h / 3][(h + k) % 3]);
    }
    /// Whether an edge of a triangle is one of many that a curve was cut into. `h`: any half-edge on it.
    bool is_facet(HalfEdge h, std::uint32_t triangle) const {
        for (int k = 0; h / 3 != triangle; ++k) {
            if (k == kMostTurns) return false;
            h = mesh_.next_on_edge[h];
        }
        return goes_on(h, 1) && goes_on(h, 2);
    }

  private:
    /// Whether the edge at one of its ends is the next facet of the same curve. `step`: to the next edge of a triangle,
    /// or the one before.
    bool goes_on(HalfEdge h, HalfEdge step) const {
        const std::optional<HalfEdge> next = edge_after(h, step);
        if (!next) return false;
        const glm::dvec3 own = corner(h, 1) - corner(h, 0), other = corner(*next, 1) - corner(*next, 0);
        const double length = glm::length(own), other_length = glm::length(other);
        const double cosine = glm::dot(own, other) / std::max(length * other_length, 1e-300);
        return cosine >= kCosOfRim && cosine <= kCosOfParallels && length <= kMostUneven * other_length &&
               other_length <= kMostUneven * length;
    }
    /// The next edge of the face around one of its ends.
    std::optional<HalfEdge> edge_after(HalfEdge h, HalfEdge step) const {
        const auto beside = [step](HalfEdge e) { return e - e % 3 + (e % 3 + step) % 3; };
        HalfEdge next = beside(h);
        for (int k = 0; k < kMostTurns; ++k) {
            const HalfEdge partner = mesh_.next_on_edge[next];
            const bool ends = partner == next || mesh_.next_on_edge[partner] != next ||
                              edge_classes(surfaces_, {{instance_, next / 3}, next}, bends_).has(LineClass::crease);
            if (ends) return next;
            // The partner of a polygon that is wound the other way runs from the same vertex.
            if (mesh_.triangles[partner / 3][partner % 3] == mesh_.triangles[next / 3][next % 3]) return std::nullopt;
            next = beside(partner);
        }
        return std::nullopt;
    }

    const SurfaceSet& surfaces_;
    std::uint32_t instance_;
    const Mesh& mesh_;
    LineCriteria bends_;
};

}  // namespace

bool laps_narrowly(const SurfaceSet& surfaces, SurfaceId own, HalfEdge edge, const FacePlace& other, glm::dvec2 at) {
    const Projection& p = surfaces.projection;
    const Rim rim(surfaces, own.instance);
    const glm::dvec3 from = rim.corner(edge, 0), to = rim.corner(edge, 1);
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
    const double pixel = p.pixel_size(-place.z),
                 reach = std::max(kNarrowPx * pixel, kMostTimesLonger * kNarrowPart * length);
    const glm::dvec3 begin = place + kBesidePx * pixel * inward, end = place + reach * inward;
    if (!(pixel > 0) || !needs_no_clipping(p, begin) || !needs_no_clipping(p, end)) return false;
    const glm::dvec2 begin_px = p.to_pixel(begin), end_px = p.to_pixel(end);
    if (begin_px == end_px) return false;
    // Where a face ends on the way, or leaves its plane.
    struct End {
        SurfaceEdge edge;
        double fraction = 1;
    };
    const auto end_of_face = [&](const FacePlace& start, glm::dvec2 goal,
                                 SurfaceId* arrived = nullptr) -> std::optional<End> {
        const SurfaceWalk walk = walk_surface(surfaces, start.surface, start.pixel, goal, rim.bends());
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
    const Rim other_rim(surfaces, e.surface.instance);
    const glm::dvec3 other_from = other_rim.corner(e.half_edge, 0), other_to = other_rim.corner(e.half_edge, 1);
    const double other_length = glm::distance(other_from, other_to);
    const double cosine = std::abs(glm::dot(along, other_to - other_from)) / std::max(other_length, 1e-300);
    const double lap = other_end->fraction * reach;
    const bool is_narrow = (cosine >= kCosAlong && lap <= kNarrowPx * pixel) ||
                           (cosine >= kCosOfFacets && lap <= kNarrowPart * std::max(length, other_length) &&
                            (cosine <= kCosOfParallels || (rim.is_facet(edge, own.triangle) &&
                                                           other_rim.is_facet(e.half_edge, e.surface.triangle))));
    if (!is_narrow) return false;
    const double beyond = other_end->fraction + 2 * kBesidePx / glm::distance(begin_px, end_px);
    return !end_of_face({own, begin_px}, glm::mix(begin_px, end_px, beyond));
}

}  // namespace burin
