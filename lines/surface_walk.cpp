#include "lines/surface_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/infinity.h"
#include "kernels/screen_triangle.h"
#include "lines/circle_finder.h"
#include "lines/seam_sight.h"

namespace burin {
namespace {

/// A triangle lower than this (in pixels) and than kSliverHeightPart of its length is a sliver: rounding
/// decides its normal, and it says nothing about the surface.
constexpr double kSliverHeightPx = 1.0 / 64;

/// Projection::homogeneous(). Corners are snapped as the rasterizer snaps them, but not those of triangles that are
/// cut: what snapping moves grows beyond a corner on the way to one behind the eye.
glm::dvec3 homogeneous(const Projection& p, const glm::dvec3& view, bool is_snapped) {
    if (!is_snapped) return p.homogeneous(view);
    const double w = p.orthographic ? 1.0 : -view.z;
    const glm::dvec2 pixel = p.to_pixel(view);
    return glm::dvec3(to_pixels(snap_to_subpixels(pixel.x)), to_pixels(snap_to_subpixels(pixel.y)), 1.0) * w;
}

double nearness_of(const Projection& p, double distance) { return p.orthographic ? -distance : 1 / distance; }

class Walker {
  public:
    /// `sharp`: find_sharp_edges() of the mesh, or nullptr.
    Walker(const SurfaceSet& surfaces, glm::dvec2 from, glm::dvec2 to, const LineCriteria& criteria,
           const std::uint8_t* sharp = nullptr)
        : surfaces_(surfaces),
          criteria_(criteria),
          sharp_(sharp),
          from_(from),
          to_(to),
          line_(glm::cross(glm::dvec3(from, 1.0), glm::dvec3(to, 1.0))),
          along_(to - from),
          length_(glm::length(along_)) {}

    /// `notes_edges`: what it crosses is wanted, too.
    template <bool notes_edges>
    SurfaceWalk walk(SurfaceId start, int most_triangles) {
        SurfaceWalk result;
        result.surface = start;
        const Slice slice = slice_of(start);
        if (!slice.is_cut) return result;
        Place current{start, slice.crossings[slice.crossings[0].fraction < slice.crossings[1].fraction]};
        const HalfEdge first_exit = current.exit.half_edge;
        Place farthest = current;      // where the walk got farthest
        Place before_wall = current;   // where it last got farther at all
        SurfaceId last_solid = start;  // the last triangle that is more than a sliver
        int slivers = 0;               // how many slivers came since
        const double negligible_fold = kNegligibleFoldPx / length_, snapping = kSnappingPx / length_;
        CircleFinder<State> circle;  // polygons that pass an edge several times make some

        for (int steps = 0, steps_on_wall = 0; steps < most_triangles && steps_on_wall < kMostTrianglesOfWall;) {
            if (current.exit.fraction >= 1) {
                if (notes_edges && slivers > 0) note_contact(result, last_solid, current.surface, 1);
                result.end = WalkEnd::arrived;
                result.surface = current.surface;
                return result;
            }
            const Continuation next = continue_over(current);
            if (next.kind == WalkEnd::crack) {
                result.beyond = next.place.surface;
                return ended(result, WalkEnd::crack, current);
            }
            if (next.kind == WalkEnd::border) return ended(result, WalkEnd::border, current);
            const double reached = next.place.exit.fraction;
            const bool turned_back = reached < farthest.exit.fraction - negligible_fold;
            const bool unfolds = current.exit.fraction < farthest.exit.fraction && reached >= farthest.exit.fraction;
            // Slivers say nothing about how steep the surface is.
            const bool sliver = slivers < kMostSlivers && is_sliver_here(next.place.surface);
            const SurfaceId solid = sliver ? last_solid : next.place.surface;
            if (turned_back ||
                (unfolds && !is_level(distance_at(farthest),
                                      distance_between(current, next.place, farthest.exit.fraction), solid))) {
                return ended(result, WalkEnd::fold, before_wall);  // over a seam, too
            }
            bool goes_on = reached > before_wall.exit.fraction + kNoAdvance,
                 is_farthest = reached >= farthest.exit.fraction;
            if (std::abs(reached - before_wall.exit.fraction) < snapping &&
                is_deep(surfaces_.projection, distance_at(before_wall), distance_at(next.place))) {
                const auto part = unsnapped_part(next.place), wall = unsnapped_part(before_wall);
                if (part && wall) goes_on = is_beyond(*part, *wall, along_);
                is_farthest = is_farthest || goes_on;
            }
            ++(std::abs(reached - current.exit.fraction) <= kNoAdvance ? steps_on_wall : steps);
            if (goes_on && current.surface != before_wall.surface &&
                !is_level(distance_at(before_wall), distance_at(current), solid)) {
                return ended(result, WalkEnd::fold, before_wall);
            }
            const SurfaceEdge edge{current.surface, current.exit.half_edge};
            const double at_edge = current.exit.fraction;
            if (sliver) {
                ++slivers;
                if (notes_edges) note(result, mark_of(edge), edge, at_edge);
            } else if (slivers > 0 || next.over_seam) {
                if (notes_edges) note_contact(result, last_solid, next.place.surface, at_edge);
                slivers = 0;
            } else if (notes_edges) {
                note(result, edge_classes_between(edge, {next.place.surface, next.entry}, &result.crease_cosine), edge,
                     at_edge);
            }
            if (!sliver) last_solid = next.place.surface;
            current = next.place;
            if (is_farthest) farthest = current;
            if (goes_on) before_wall = current;
            // Around a wire thinner than a fold that counts: the surface ends where the walk got farthest.
            if (current.exit.half_edge == first_exit) return ended(result, WalkEnd::fold, before_wall);
            if (circle.is_closed_by({current, farthest, before_wall, last_solid, slivers})) return result;
        }
        return result;
    }

    /// Classes of an edge, given the triangle on its other side.
    LineClassSet edge_classes_between(SurfaceEdge a, SurfaceEdge b, double* crease_cosine) const;

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
        const Crossing& other_than(HalfEdge h) const {
            return crossings[0].half_edge == h ? crossings[1] : crossings[0];
        }
        const Crossing& at(HalfEdge h) const { return crossings[0].half_edge == h ? crossings[0] : crossings[1]; }
        bool crosses(HalfEdge h) const {
            return is_cut && (crossings[0].half_edge == h || crossings[1].half_edge == h);
        }
    };
    /// A triangle, and where the walk leaves it.
    struct Place {
        SurfaceId surface;
        Crossing exit;
        bool operator==(const Place& other) const {
            return surface == other.surface && exit.half_edge == other.exit.half_edge;
        }
    };
    /// All that the next step of a walk depends on.
    struct State {
        Place current, farthest, before_wall;
        SurfaceId last_solid;
        int slivers;
        bool operator==(const State&) const = default;
    };
    struct Continuation {
        WalkEnd kind = WalkEnd::border;  // arrived: it goes on; border, crack: it does not
        Place place;
        HalfEdge entry = kNoHalfEdge;
        bool over_seam = false;
    };

    static SurfaceWalk ended(SurfaceWalk result, WalkEnd end, const Place& at) {
        result.end = end;
        result.surface = at.surface;
        result.half_edge = at.exit.half_edge;
        result.fraction = at.exit.fraction;
        return result;
    }

    bool is_sliver_here(SurfaceId s) const {
        const bool may_be_sliver = sharp_ == nullptr || (sharp_[s.triangle] & kMayBeSliver) != 0;
        return may_be_sliver && is_sliver(surfaces_, s);
    }

    Slice slice_of(SurfaceId s) const {
        const Projection& projection = surfaces_.projection;
        glm::dvec3 corners[3];
        surfaces_.view_corners(s, corners);
        const bool is_whole = std::all_of(std::begin(corners), std::end(corners), [&](const glm::dvec3& corner) {
            return needs_no_clipping(projection, corner);
        });
        std::array<glm::dvec3, 3> h;
        std::array<double, 3> side;
        for (std::size_t k = 0; k < 3; ++k) {
            h[k] = homogeneous(projection, corners[k], is_whole);
            side[k] = glm::dot(line_, h[k]);
        }
        Slice slice;
        std::array<glm::dvec3, 2> points;
        std::size_t found = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            // A corner exactly on the line counts to one side, in all triangles alike.
            if ((side[k] >= 0) == (side[next] >= 0)) continue;
            const glm::dvec3 point = (h[k] * side[next] - h[next] * side[k]) / (side[next] - side[k]);
            Crossing& crossing = slice.crossings[found];
            crossing.half_edge = 3 * s.triangle + static_cast<HalfEdge>(k);
            crossing.along_edge = side[k] / (side[k] - side[next]);
            points[found++] = point;
        }
        slice.is_cut = found == 2;
        if (!slice.is_cut) return slice;
        slice.crossings[0].fraction = fraction_of(points[0], points[1]);
        slice.crossings[1].fraction = fraction_of(points[1], points[0]);
        return slice;
    }

    /// Where along the line a point on it lies. If it is behind the eye, infinitely far, where the way to it from
    /// `other` leaves the picture.
    double fraction_of(const glm::dvec3& h, const glm::dvec3& other) const {
        if (h.z > 0) return glm::dot(glm::dvec2(h) / h.z - from_, along_) / (length_ * length_);
        const glm::dvec2 beside_eye = glm::dvec2(h) * other.z - glm::dvec2(other) * h.z;
        return other.z > 0 && glm::dot(beside_eye, along_) < 0 ? -kInfinity : kInfinity;
    }
    glm::dvec2 at(double fraction) const { return from_ + along_ * fraction; }

    /// The triangle that carries on over the edge where a place is left. Where several meet, one that
    /// goes forward is preferred, and among those the one nearest to the eye.
    Continuation continue_over(const Place& from) const {
        Continuation best;
        double best_nearness = -kInfinity;
        const Mesh& mesh = surfaces_.mesh_of(from.surface);
        const HalfEdge exit = from.exit.half_edge;
        const double start = from.exit.fraction;
        for (HalfEdge g = mesh.next_on_edge[exit]; g != exit; g = mesh.next_on_edge[g]) {
            const SurfaceId neighbour{from.surface.instance, g / 3};
            const Slice slice = slice_of(neighbour);
            if (!slice.is_cut) continue;
            const Crossing& other = slice.other_than(g);
            const bool has_best = best.kind == WalkEnd::arrived;
            const bool forward = other.fraction > start;
            const bool best_forward = has_best && best.place.exit.fraction > start;
            if (best_forward && !forward) continue;
            double nearness = 0;
            const bool is_choice = mesh.next_on_edge[g] != exit || has_best;
            if (is_choice) {
                const double middle = 0.5 * (start + std::clamp(other.fraction, -1.0, 2.0));
                nearness = surfaces_.plane(neighbour).nearness(at(middle));
                if (has_best && best_forward == forward && nearness <= best_nearness) continue;
            }
            best = {WalkEnd::arrived, {neighbour, other}, g, false};
            best_nearness = nearness;
        }
        return is_border(from) ? continue_over_seam(from) : best;
    }

    /// Continues a walk over a border edge: another patch of the mesh may have its border there.
    Continuation continue_over_seam(const Place& from) const {
        Continuation none;
        const Mesh& mesh = surfaces_.mesh_of(from.surface);
        const auto& t = mesh.triangles[from.surface.triangle];
        const glm::dvec3 a = mesh.local_position(t[from.exit.half_edge % 3]);
        const glm::dvec3 b = mesh.local_position(t[(from.exit.half_edge + 1) % 3]);
        const auto partner = seam_partner_seen(surfaces_, from.surface.instance, from.exit.half_edge,
                                               glm::mix(a, b, from.exit.along_edge));
        if (!partner) return none;
        const SurfaceId neighbour{from.surface.instance, *partner / 3};
        const Slice slice = slice_of(neighbour);
        if (!slice.crosses(*partner)) return none;
        const Crossing& entry = slice.at(*partner);
        const Crossing& exit = slice.other_than(*partner);
        if (std::abs(entry.fraction - from.exit.fraction) * length_ > kWidestCrackPx ||
            !is_level_at(from.exit.fraction, from.surface, neighbour)) {
            return none;
        }
        const bool forward = exit.fraction > entry.fraction;
        const bool goal_in_gap = forward && entry.fraction >= 1;
        return {goal_in_gap ? WalkEnd::crack : WalkEnd::arrived, {neighbour, exit}, *partner, true};
    }

    /// Where a walk leaves a triangle: on an edge, so that not even a sliver's plane is extended.
    double distance_at(const Place& place) const {
        const auto& t = surfaces_.mesh_of(place.surface).triangles[place.surface.triangle];
        const HalfEdge k = place.exit.half_edge % 3;
        const auto depth = [&](HalfEdge corner) {
            return -surfaces_.view_position(place.surface.instance, t[corner % 3]).z;
        };
        return glm::mix(depth(k), depth(k + 1), place.exit.along_edge);
    }
    /// Where the walk leaves a triangle, with corners where they are, not snapped. Nothing if they are off the screen.
    std::optional<double> unsnapped_part(const Place& place) const {
        const Projection& p = surfaces_.projection;
        const auto& t = surfaces_.mesh_of(place.surface).triangles[place.surface.triangle];
        const HalfEdge k = place.exit.half_edge % 3;
        const glm::dvec3 a = surfaces_.view_position(place.surface.instance, t[k]),
                         b = surfaces_.view_position(place.surface.instance, t[(k + 1) % 3]);
        if (!needs_no_clipping(p, a) || !needs_no_clipping(p, b)) return std::nullopt;
        return part_of_way(along_, p.to_pixel(a) - from_, p.to_pixel(b) - from_);
    }
    /// The distance on the way from where one triangle is left to where the next one is.
    double distance_between(const Place& entry, const Place& exit, double fraction) const {
        const Projection& p = surfaces_.projection;
        const double from = entry.exit.fraction, to = exit.exit.fraction;
        if (!(to < kInfinity)) return distance_at(entry);
        const double nearness = glm::mix(nearness_of(p, distance_at(entry)), nearness_of(p, distance_at(exit)),
                                         (fraction - from) / (to - from));
        return p.distance(nearness);
    }
    /// Whether two distances are one, as far as lines care, where a surface is as steep as a triangle.
    bool is_level(double a, double b, SurfaceId steep) const {
        return std::abs(a - b) <= depth_tolerance(surfaces_, a, surfaces_.plane(steep));
    }
    /// Whether the planes of two triangles are one, as far as lines care.
    bool is_level_at(double fraction, SurfaceId a, SurfaceId b) const {
        const auto distance = [&](SurfaceId s) {
            return distance_of(surfaces_.projection, surfaces_.plane(s).nearness(at(fraction)));
        };
        return is_level(distance(a), distance(b), b);
    }

    bool is_border(const Place& place) const {
        const HalfEdge h = place.exit.half_edge;
        return surfaces_.mesh_of(place.surface).next_on_edge[h] == h;
    }
    LineClassSet mark_of(SurfaceEdge edge) const {
        const bool marked = surfaces_.mesh_of(edge.surface).is_marked(edge.half_edge);
        return marked ? LineClassSet(LineClass::mark) : LineClassSet();
    }

    void note(SurfaceWalk& result, LineClassSet classes, SurfaceEdge edge, double fraction) const {
        const LineClassSet wanted = classes & criteria_.classes;
        if (!wanted.empty() && (result.crossed & criteria_.classes).empty()) {
            result.crossed_edge = edge;
            result.crossed_fraction = fraction;
        }
        result.crossed |= classes;
    }

    /// Slivers lie between a and b: what counts is how those two meet.
    void note_contact(SurfaceWalk& result, SurfaceId a, SurfaceId b, double fraction) const {
        note(result, contact_classes(surfaces_, a, b, at(fraction), criteria_, &result.crease_cosine), {a, kNoHalfEdge},
             fraction);
    }

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    const std::uint8_t* sharp_;
    glm::dvec2 from_, to_;
    glm::dvec3 line_;  // dot(line_, homogeneous point) says on which side of the line it is
    glm::dvec2 along_;
    double length_;
};

LineClassSet Walker::edge_classes_between(SurfaceEdge a, SurfaceEdge b, double* crease_cosine) const {
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
    const double cosine = winding * glm::dot(surfaces_.view_normal(a.surface), surfaces_.view_normal(b.surface));
    add_angle_classes(cosine, criteria_, classes, crease_cosine);
    return classes;
}

}  // namespace

SurfaceWalk walk_surface(const SurfaceSet& surfaces, SurfaceId start, glm::dvec2 from, glm::dvec2 to,
                         const LineCriteria& criteria, int most_triangles) {
    return Walker(surfaces, from, to, criteria).walk<true>(start, most_triangles);
}

SurfaceWalk walk_to_end(const SurfaceSet& surfaces, SurfaceId start, glm::dvec2 from, glm::dvec2 to,
                        const LineCriteria& criteria, int most_triangles, const std::uint8_t* sharp) {
    return Walker(surfaces, from, to, criteria, sharp).walk<false>(start, most_triangles);
}

LineClassSet edge_classes(const SurfaceSet& surfaces, SurfaceEdge edge, const LineCriteria& criteria,
                          double* crease_cosine) {
    const Mesh& mesh = surfaces.mesh_of(edge.surface);
    LineClassSet classes;
    if (mesh.is_marked(edge.half_edge)) classes |= LineClass::mark;
    const Walker walker(surfaces, {0, 0}, {1, 0}, criteria);
    for (HalfEdge g = mesh.next_on_edge[edge.half_edge]; g != edge.half_edge; g = mesh.next_on_edge[g]) {
        classes |= walker.edge_classes_between(edge, {{edge.surface.instance, g / 3}, g}, crease_cosine);
    }
    return classes;
}

LineClassSet contact_classes(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 at,
                             const LineCriteria& criteria, double* crease_cosine) {
    LineClassSet classes;
    if (surfaces.are_of_one_polygon(a, b)) return classes;
    if (surfaces.material_id(a) != surfaces.material_id(b)) classes |= LineClass::material;
    if (surfaces.object_id(a) != surfaces.object_id(b)) return classes | LineClass::object;
    classes |= LineClass::polygon;
    const double cosine = glm::dot(surfaces.normal_towards_eye(a, at), surfaces.normal_towards_eye(b, at));
    add_angle_classes(cosine, criteria, classes, crease_cosine);
    return classes;
}

void add_angle_classes(double cosine, const LineCriteria& criteria, LineClassSet& classes, double* crease_cosine) {
    if (!(cosine < criteria.cos_crease_angle)) return;
    classes |= LineClass::crease;
    if (crease_cosine != nullptr) *crease_cosine = std::min(*crease_cosine, cosine);
}

bool are_flush(const SurfaceSet& surfaces, SurfaceId a, SurfaceId b, glm::dvec2 at, const LineCriteria& criteria) {
    return !a.is_background() && !b.is_background() &&
           (contact_classes(surfaces, a, b, at, criteria) & criteria.classes).empty() && surfaces.coincide(a, b);
}

bool is_sliver(const SurfaceSet& surfaces, SurfaceId s) {
    glm::dvec3 c[3];
    surfaces.view_corners(s, c);
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::distance(c[k], c[(k + 1) % 3]));
    const double height = glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / longest;
    const double nearest = std::max(-std::max({c[0].z, c[1].z, c[2].z}), surfaces.projection.near_distance);
    const double pixel = surfaces.projection.pixel_size(nearest);
    return height < kSliverHeightPart * longest && height < kSliverHeightPx * pixel;
}

double distance_of(const Projection& projection, double nearness) {
    if (!projection.orthographic && nearness <= 0) return kInfinity;
    return projection.distance(nearness);
}

double depth_tolerance(const SurfaceSet& surfaces, double distance, const DepthPlane& plane, double pixels) {
    const Projection& p = surfaces.projection;
    // d(distance)/dx = distance^2 d(nearness)/dx in perspective.
    const double per_nearness = p.orthographic ? 1.0 : distance * distance;
    const double slope = (std::abs(plane.per_x) + std::abs(plane.per_y)) * per_nearness;
    return pixels * p.pixel_size(distance) + slope / kSubpixelsPerPixel;
}

}  // namespace burin
