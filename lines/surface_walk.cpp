#include "lines/surface_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace burin {
namespace {

constexpr int kMaxSteps = 96;
/// A fold that turns back by less than this is no contour. Pixels.
constexpr double kNegligibleFoldPx = 1.0 / 64;
/// A triangle that the walk crosses over less than this says nothing about the surface. Pixels.
constexpr double kSliverPx = 1.0 / 256;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A screen position (x, y) as (x w, y w, w); w is the distance from the eye, or 1 in an
/// orthographic view. Linear in view space, also behind the eye. Corners that can be seen are
/// snapped as the rasterizer snaps them.
glm::dvec3 homogeneous(const Projection& p, const glm::dvec3& view) {
    const double w = p.orthographic ? 1.0 : -view.z;
    const bool in_front = -view.z > p.near_distance;
    if (in_front || p.orthographic) {
        const glm::dvec2 pixel = p.to_pixel(view);
        if (std::abs(pixel.x - p.center_px.x) <= kGuardBandPx &&
            std::abs(pixel.y - p.center_px.y) <= kGuardBandPx) {
            return glm::dvec3(snap_to_subpixels(pixel.x) / kSubpixelsPerPixel,
                              snap_to_subpixels(pixel.y) / kSubpixelsPerPixel, 1.0) * w;
        }
    }
    return {p.center_px.x * w + p.focal_px * view.x, p.center_px.y * w - p.focal_px * view.y, w};
}

class Walker {
  public:
    Walker(const SurfaceSet& surfaces, glm::dvec2 from, glm::dvec2 to, const LineCriteria& criteria)
        : surfaces_(surfaces),
          criteria_(criteria),
          from_(from),
          to_(to),
          line_(glm::cross(glm::dvec3(from, 1.0), glm::dvec3(to, 1.0))),
          along_(to - from),
          length_(glm::length(along_)) {}

    SurfaceWalk walk(SurfaceId start) {
        SurfaceWalk result;
        result.surface = start;
        Slice slice = slice_of(start);
        if (!slice.is_cut) return result;
        Crossing exit = slice.crossings[0].fraction > slice.crossings[1].fraction ? slice.crossings[0]
                                                                                  : slice.crossings[1];
        SurfaceId current = start;
        SurfaceId last_solid = start;  // the last triangle that is more than a sliver
        bool over_slivers = false;     // there were others since
        SurfaceId farthest_surface = start;
        Crossing farthest = exit;
        const double negligible_fold = kNegligibleFoldPx / length_;

        for (int step = 0; step < kMaxSteps; ++step) {
            if (exit.fraction >= 1) {
                if (over_slivers) note_contact(result, last_solid, current, 1);
                result.end = WalkEnd::arrived;
                result.surface = current;
                return result;
            }
            const Continuation next = continue_over(current, exit);
            const bool turned_back =
                next.found && next.exit.fraction < farthest.fraction - negligible_fold;
            const bool unfolds = next.found && exit.fraction < farthest.fraction &&
                                 next.exit.fraction >= farthest.fraction;
            if (!next.found || turned_back ||
                (unfolds && !is_level(farthest_surface, next.surface, farthest.fraction))) {
                const bool border = is_border({farthest_surface, farthest.half_edge});
                result.end = border ? WalkEnd::border : WalkEnd::fold;
                result.surface = farthest_surface;
                result.half_edge = farthest.half_edge;
                result.along_edge = farthest.along_edge;
                result.fraction = farthest.fraction;
                return result;
            }
            const SurfaceEdge edge{current, exit.half_edge};
            const bool is_sliver =
                std::abs(next.exit.fraction - exit.fraction) * length_ < kSliverPx;
            if (is_sliver) {
                over_slivers = true;
                note(result, edge_classes(surfaces_, edge, criteria_) & LineClass::mark, edge,
                     exit.fraction);
            } else if (over_slivers) {
                note_contact(result, last_solid, next.surface, exit.fraction);
                over_slivers = false;
            } else {
                note(result, edge_classes_between(edge, {next.surface, next.entry}), edge,
                     exit.fraction);
            }
            if (!is_sliver) last_solid = next.surface;
            current = next.surface;
            exit = next.exit;
            if (exit.fraction >= farthest.fraction) {
                farthest = exit;
                farthest_surface = current;
            }
        }
        return result;
    }

    /// Classes of an edge, given the triangle on its other side.
    LineClassSet edge_classes_between(SurfaceEdge a, SurfaceEdge b) const;

  private:
    /// Where the walking line crosses an edge.
    struct Crossing {
        HalfEdge half_edge = kNoHalfEdge;
        double fraction = 0;    // along the line
        double along_edge = 0;  // along the edge
    };
    /// The two edges of a triangle that the line crosses.
    struct Slice {
        bool is_cut = false;
        Crossing crossings[2];
    };
    struct Continuation {
        bool found = false;
        SurfaceId surface;
        HalfEdge entry = kNoHalfEdge;
        Crossing exit;
    };

    Slice slice_of(SurfaceId s) const {
        const auto& t = surfaces_.mesh_of(s).triangles[s.triangle];
        std::array<glm::dvec3, 3> h;
        std::array<double, 3> side;
        for (std::size_t k = 0; k < 3; ++k) {
            h[k] = homogeneous(surfaces_.projection, surfaces_.view_position(s.instance, t[k]));
            side[k] = glm::dot(line_, h[k]);
        }
        Slice slice;
        int found = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            // A corner exactly on the line counts to one side, in all triangles alike.
            if ((side[k] >= 0) == (side[next] >= 0)) continue;
            const glm::dvec3 point =
                (h[k] * side[next] - h[next] * side[k]) / (side[next] - side[k]);
            Crossing& crossing = slice.crossings[found++];
            crossing.half_edge = 3 * s.triangle + static_cast<HalfEdge>(k);
            crossing.fraction = fraction_of(point);
            crossing.along_edge = side[k] / (side[k] - side[next]);
        }
        slice.is_cut = found == 2;
        return slice;
    }

    /// Where along the line a point on it lies; infinitely far if it is behind the eye.
    double fraction_of(const glm::dvec3& h) const {
        if (!(h.z > 0)) return kInfinity;
        return glm::dot(glm::dvec2(h) / h.z - from_, along_) / (length_ * length_);
    }
    glm::dvec2 at(double fraction) const { return from_ + along_ * fraction; }

    /// The triangle that carries on over an edge. Where several meet, one that goes forward is
    /// preferred, and among those the one nearest to the eye.
    Continuation continue_over(SurfaceId current, const Crossing& exit) const {
        Continuation best;
        double best_nearness = -kInfinity;
        const Mesh& mesh = surfaces_.mesh_of(current);
        for (HalfEdge g = mesh.next_on_edge[exit.half_edge]; g != exit.half_edge;
             g = mesh.next_on_edge[g]) {
            const SurfaceId neighbour{current.instance, g / 3};
            const Slice slice = slice_of(neighbour);
            if (!slice.is_cut) continue;
            const Crossing& other =
                slice.crossings[0].half_edge == g ? slice.crossings[1] : slice.crossings[0];
            const bool forward = other.fraction > exit.fraction;
            const bool best_forward = best.found && best.exit.fraction > exit.fraction;
            if (best.found && best_forward && !forward) continue;
            double nearness = 0;
            const bool is_choice = mesh.next_on_edge[g] != exit.half_edge || best.found;
            if (is_choice) {
                const double ahead = std::min(std::max(other.fraction, -1.0), 2.0);
                const double middle = 0.5 * (exit.fraction + ahead);
                nearness = surfaces_.plane(neighbour).nearness(at(middle));
                if (best.found && best_forward == forward && nearness <= best_nearness) continue;
            }
            best = {true, neighbour, g, other};
            best_nearness = nearness;
        }
        return best;
    }

    /// Whether two triangles are equally far from the eye at a place, as far as lines care.
    bool is_level(SurfaceId a, SurfaceId b, double fraction) const {
        const Projection& p = surfaces_.projection;
        const glm::dvec2 place = at(fraction);
        const DepthPlane plane_b = surfaces_.plane(b);
        const double distance_a = distance_of(p, surfaces_.plane(a).nearness(place));
        const double distance_b = distance_of(p, plane_b.nearness(place));
        return std::abs(distance_a - distance_b) <= depth_tolerance(surfaces_, distance_a, plane_b);
    }

    bool is_border(SurfaceEdge edge) const {
        return surfaces_.mesh_of(edge.surface).next_on_edge[edge.half_edge] == edge.half_edge;
    }

    static void note(SurfaceWalk& result, LineClassSet classes, SurfaceEdge edge, double fraction) {
        if (classes.empty()) return;
        if (result.crossed.empty()) {
            result.crossed_edge = edge;
            result.crossed_fraction = fraction;
        }
        result.crossed |= classes;
    }

    /// Slivers lie between a and b: what counts is how those two meet.
    void note_contact(SurfaceWalk& result, SurfaceId a, SurfaceId b, double fraction) const {
        note(result, contact_classes(surfaces_, a, b, at(fraction), criteria_), {a, kNoHalfEdge},
             fraction);
    }

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    glm::dvec2 from_, to_;
    glm::dvec3 line_;  // dot(line_, homogeneous point) says on which side of the line it is
    glm::dvec2 along_;
    double length_;
};

LineClassSet Walker::edge_classes_between(SurfaceEdge a, SurfaceEdge b) const {
    const Mesh& mesh = surfaces_.mesh_of(a.surface);
    LineClassSet classes;
    if (mesh.is_marked(a.half_edge)) classes |= LineClass::mark;
    if (mesh.polygon_of(a.surface.triangle) == mesh.polygon_of(b.surface.triangle)) return classes;
    classes |= LineClass::polygon;
    if (surfaces_.material_id(a.surface) != surfaces_.material_id(b.surface)) {
        classes |= LineClass::material;
    }
    const auto start_of = [&mesh](HalfEdge h) { return mesh.triangles[h / 3][h % 3]; };
    const double winding = start_of(a.half_edge) == start_of(b.half_edge) ? -1.0 : 1.0;
    const double cosine =
        winding * glm::dot(surfaces_.view_normal(a.surface), surfaces_.view_normal(b.surface));
    if (cosine < criteria_.cos_crease_angle) classes |= LineClass::crease;
    return classes;
}

}  // namespace

SurfaceWalk walk_surface(const SurfaceSet& surfaces, SurfaceId start, glm::dvec2 from,
                         glm::dvec2 to, const LineCriteria& criteria) {
    return Walker(surfaces, from, to, criteria).walk(start);
}

LineClassSet edge_classes(const SurfaceSet& surfaces, SurfaceEdge edge,
                          const LineCriteria& criteria) {
    const Mesh& mesh = surfaces.mesh_of(edge.surface);
    LineClassSet classes;
    if (mesh.is_marked(edge.half_edge)) classes |= LineClass::mark;
    const Walker walker(surfaces, {0, 0}, {1, 0}, criteria);
    for (HalfEdge g = mesh.next_on_edge[edge.half_edge]; g != edge.half_edge;
         g = mesh.next_on_edge[g]) {
        classes |= walker.edge_classes_between(edge, {{edge.surface.instance, g / 3}, g});
    }
    return classes;
}

std::optional<SeamNeighbour> seam_neighbour(const SurfaceSet& surfaces, const SurfaceWalk& walk,
                                            glm::dvec2 from, glm::dvec2 to) {
    const Mesh& mesh = surfaces.mesh_of(walk.surface);
    const auto& t = mesh.triangles[walk.half_edge / 3];
    const glm::dvec3 a(mesh.positions[t[walk.half_edge % 3]]);
    const glm::dvec3 b(mesh.positions[t[(walk.half_edge + 1) % 3]]);
    const auto partner = mesh.borders.seam_partner(walk.half_edge, glm::mix(a, b, walk.along_edge));
    if (!partner) return std::nullopt;

    SeamNeighbour neighbour;
    neighbour.surface = {walk.surface.instance, *partner / 3};
    const Projection& p = surfaces.projection;
    glm::dvec3 corners[3];  // of the neighbour, its border edge first
    for (std::uint32_t k = 0; k < 3; ++k) {
        const auto& corner = mesh.triangles[*partner / 3][(*partner + k) % 3];
        corners[k] = surfaces.view_position(walk.surface.instance, corner);
        if (!p.orthographic && -corners[k].z <= p.near_distance) return neighbour;
    }
    const glm::dvec2 edge_a = p.to_pixel(corners[0]), edge_b = p.to_pixel(corners[1]);
    const glm::dvec2 apex = p.to_pixel(corners[2]);
    const glm::dvec2 along = edge_b - edge_a;
    const glm::dvec2 place = glm::mix(from, to, walk.fraction);
    const double length2 = glm::dot(along, along);
    const double t_near =
        length2 > 0 ? std::clamp(glm::dot(place - edge_a, along) / length2, 0.0, 1.0) : 0.0;
    const glm::dvec2 nearest = edge_a + t_near * along;
    if (glm::distance(place, nearest) > 1) return neighbour;
    // The neighbour lies ahead if its apex is on the side of its border that the walk leads to.
    const glm::dvec2 inwards(-along.y, along.x);
    const bool ahead = glm::dot(inwards, apex - edge_a) * glm::dot(inwards, to - from) > 0;
    const double own = distance_of(p, surfaces.plane(walk.surface).nearness(place));
    const DepthPlane plane = surfaces.plane(neighbour.surface);
    const double gap = distance_of(p, plane.nearness(nearest)) - own;
    neighbour.continues = ahead && std::abs(gap) <= depth_tolerance(surfaces, own, plane);
    return neighbour;
}

LineClassSet contact_classes(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 at,
                             const LineCriteria& criteria) {
    LineClassSet classes;
    if (surfaces.polygon_id(a) == surfaces.polygon_id(b)) return classes;
    if (surfaces.material_id(a) != surfaces.material_id(b)) classes |= LineClass::material;
    if (surfaces.object_id(a) != surfaces.object_id(b)) return classes | LineClass::object;
    classes |= LineClass::polygon;
    // Seen from one side, both normals point towards the eye.
    glm::dvec3 origin, ray;
    surfaces.projection.view_ray(at, origin, ray);
    glm::dvec3 normal_a = surfaces.view_normal(a);
    glm::dvec3 normal_b = surfaces.view_normal(b);
    if (glm::dot(normal_a, ray) > 0) normal_a = -normal_a;
    if (glm::dot(normal_b, ray) > 0) normal_b = -normal_b;
    if (glm::dot(normal_a, normal_b) < criteria.cos_crease_angle) classes |= LineClass::crease;
    return classes;
}

double distance_of(const Projection& projection, double nearness) {
    if (!projection.orthographic && nearness <= 0) return kInfinity;
    return projection.distance(nearness);
}

double depth_tolerance(const SurfaceSet& surfaces, double distance, const DepthPlane& plane) {
    const Projection& p = surfaces.projection;
    // d(distance)/dx = distance^2 d(nearness)/dx in perspective.
    const double per_nearness = p.orthographic ? 1.0 : distance * distance;
    const double slope = (std::abs(plane.per_x) + std::abs(plane.per_y)) * per_nearness;
    return 2 * p.pixel_size(distance) + slope / kSubpixelsPerPixel;
}

}  // namespace burin
