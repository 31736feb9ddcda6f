#include "methods/abuffer/fast_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin {
namespace {

constexpr int kMaxSteps = 24;
/// surface_walk.cpp's.
constexpr double kNegligibleFoldPx = 1.0 / 64;
constexpr double kWidestCrackPx = 1;

/// A triangle, and where the walk leaves it.
struct Place {
    std::uint32_t triangle = 0;
    HalfEdge exit = kNoHalfEdge;
    double fraction = -1e300;
};

/// The line that is walked along, and the triangle looked at. `u` runs along the line, `v` across.
class Way {
  public:
    Way(const ScreenMesh& mesh, const NeighbourSamples& pair, bool backwards)
        : mesh_(mesh),
          down_(pair.down),
          across_(pair.down ? pair.x : pair.y),
          origin_((pair.down ? pair.y : pair.x) + (backwards ? pair.pitch : 0)),
          per_unit_((backwards ? -1.0 : 1.0) / pair.pitch) {}

    /// False where it reaches off the screen.
    bool look_at(std::uint32_t triangle) {
        const std::uint32_t* const corners = mesh_.corners + 3 * static_cast<std::size_t>(triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            const ScreenVertex& p = mesh_.vertices[corners[k]];
            if (p.x == ScreenVertex::kOffScreen) return false;
            u_[k] = down_ ? p.y : p.x;
            v_[k] = down_ ? p.x : p.y;
            side_[k] = v_[k] > across_;  // samples on a vertex lie a trifle further right and down
        }
        return true;
    }
    bool crosses(std::uint32_t k) const { return side_[k] != side_[next(k)]; }
    /// Where edge k crosses the line.
    double fraction(std::uint32_t k) const {
        const std::uint32_t n = next(k);
        const double u = u_[k] + static_cast<double>(across_ - v_[k]) * (u_[n] - u_[k]) / (v_[n] - v_[k]);
        return (u - origin_) * per_unit_;
    }
    /// The same along the edge: 0 = at corner k.
    double along_edge(std::uint32_t k) const { return static_cast<double>(across_ - v_[k]) / (v_[next(k)] - v_[k]); }
    /// Where a triangle is left that was entered over its edge `entry`.
    Place left_from(std::uint32_t triangle, std::uint32_t entry) const {
        const std::uint32_t n = next(entry), apex = next(n);
        const std::uint32_t k = side_[apex] == side_[entry] ? n : apex;
        return {triangle, 3 * triangle + k, fraction(k)};
    }
    /// Where the triangle is left in which the walk begins.
    Place left_at_first(std::uint32_t triangle) const {
        Place place{triangle};
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (!crosses(k)) continue;
            const double at = fraction(k);
            if (at > place.fraction) place = {triangle, 3 * triangle + k, at};
        }
        return place;
    }
    /// In 1/256 pixel.
    glm::dvec2 at(double fraction_of_way) const {
        const double along = origin_ + fraction_of_way / per_unit_;
        return down_ ? glm::dvec2(across_, along) : glm::dvec2(along, across_);
    }

  private:
    static std::uint32_t next(std::uint32_t k) { return k == 2 ? 0 : k + 1; }

    const ScreenMesh& mesh_;
    bool down_;
    std::int32_t across_;
    double origin_, per_unit_;
    std::int32_t u_[3] = {}, v_[3] = {};
    bool side_[3] = {};
};

}  // namespace

FastWalk FastWalker::walk(const NeighbourSamples& pair, bool backwards, double goal) {
    FastWalk result;
    const SurfaceId start = screen_.surface_of(backwards ? pair.second : pair.first);
    const std::uint32_t instance = start.instance;
    const ScreenMesh& mesh = screen_.mesh(instance);
    Way way(mesh, pair, backwards);
    if (!way.look_at(start.triangle)) return result;
    Place current = way.left_at_first(start.triangle);
    if (current.exit == kNoHalfEdge) return result;
    const double pitch_px = static_cast<double>(pair.pitch) / kSubpixelsPerPixel;
    const double negligible_fold = kNegligibleFoldPx / pitch_px;
    Place farthest = current;  // the walk may turn back by a trifle
    std::uint32_t last_solid = start.triangle;
    bool over_slivers = false;

    const auto ended = [&](FastWalk::End end, const Place& at) {
        result.end = end;
        result.triangle = at.triangle;
        result.half_edge = at.exit;
        result.fraction = at.fraction;
        return result;
    };
    const auto note = [&](LineClassSet classes, HalfEdge edge, std::uint32_t triangle, double fraction) {
        const LineClassSet wanted = classes & criteria_.classes;
        if (!wanted.empty() && result.crossed.empty()) {
            result.crossed_edge = {{instance, triangle}, edge};
            result.crossed_fraction = fraction;
        }
        result.crossed |= wanted;
    };
    const auto note_contact = [&](std::uint32_t with, double fraction) {
        note(contact_classes(surfaces_, {instance, last_solid}, {instance, with},
                             way.at(fraction) / double{kSubpixelsPerPixel}, criteria_, &result.crease_cosine),
             kNoHalfEdge, last_solid, fraction);
    };
    for (int step = 0; step < kMaxSteps; ++step) {
        if (current.fraction >= goal) {
            if (over_slivers) note_contact(current.triangle, goal);
            result.end = FastWalk::arrived;
            result.triangle = current.triangle;
            return result;
        }
        HalfEdge entry = mesh.partners[current.exit];
        const bool over_seam = entry == current.exit;
        if (over_seam) {
            const auto seam = seam_beyond(instance, current.exit, way.along_edge(current.exit % 3));
            if (!seam) return ended(FastWalk::border, current);
            entry = *seam;
        } else if (mesh.partners[entry] != current.exit) {
            return result;
        }
        if (!way.look_at(entry / 3)) return result;
        Place next;
        if (over_seam) {
            if (!way.crosses(entry % 3)) return ended(FastWalk::border, current);
            const double entered = way.fraction(entry % 3);
            if (std::abs(entered - current.fraction) * pitch_px > kWidestCrackPx ||
                !is_level({instance, current.triangle}, {instance, entry / 3}, way.at(current.fraction))) {
                return ended(FastWalk::border, current);
            }
            next = way.left_from(entry / 3, entry % 3);
            if (next.fraction > entered && entered >= goal) {
                result.beyond = next.triangle;
                return ended(FastWalk::crack, current);
            }
        } else {
            next = way.left_from(entry / 3, entry % 3);
        }
        const bool unfolds = current.fraction < farthest.fraction && next.fraction >= farthest.fraction;
        if (next.fraction < farthest.fraction - negligible_fold ||
            (unfolds && !is_level({instance, farthest.triangle}, {instance, next.triangle}, way.at(farthest.fraction)))) {
            return ended(FastWalk::fold, farthest);
        }
        const HalfEdge edge = current.exit;
        const bool is_sharp = mesh.sharp == nullptr || (mesh.sharp[current.triangle] >> edge % 3 & 1) != 0;
        const bool sliver =
            !is_surely_solid(mesh, next.triangle) && is_sliver(surfaces_, {instance, next.triangle});
        if (sliver) {
            over_slivers = true;
            const Mesh& own = *surfaces_.instances[instance].mesh;
            if (own.is_marked(edge)) note(LineClass::mark, edge, current.triangle, current.fraction);
        } else if (over_slivers || over_seam) {
            note_contact(next.triangle, current.fraction);
            over_slivers = false;
        } else if (is_sharp) {
            note(edge_classes(surfaces_, {{instance, current.triangle}, edge}, criteria_, &result.crease_cosine), edge,
                 current.triangle, current.fraction);
        }
        if (!sliver) last_solid = next.triangle;
        current = next;
        if (next.fraction >= farthest.fraction) farthest = next;
    }
    return result;
}

/// The edge of another patch of the mesh that runs along a border at a place, `along` 0..1 on the screen.
std::optional<HalfEdge> FastWalker::seam_beyond(std::uint32_t instance, HalfEdge border, double along) {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const auto& t = mesh.triangles[border / 3];
    const std::uint32_t k = t[border % 3], n = t[(border + 1) % 3];
    const ScreenVertex* const vertices = screen_.vertices(instance);
    const double qk = surfaces_.farthest_nearness + static_cast<double>(vertices[k].nearness);
    const double qn = surfaces_.farthest_nearness + static_cast<double>(vertices[n].nearness);
    // Where that is on the edge in space.
    const double part = surfaces_.projection.orthographic ? along : along * qn / ((1 - along) * qk + along * qn);
    const glm::dvec3 a(mesh.positions[k]), b(mesh.positions[n]);
    return seams_.partner(mesh.borders, border, glm::mix(a, b, part));
}

DepthPlane FastWalker::plane(SurfaceId s) const {
    const ScreenTriangle t = screen_.triangle(s);
    const ScreenVertex &a = t.corners[0], &b = t.corners[1], &c = t.corners[2];
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double area = ux * vy - uy * vx;
    const double qa = static_cast<double>(a.nearness);
    const double qb = static_cast<double>(b.nearness) - qa, qc = static_cast<double>(c.nearness) - qa;
    DepthPlane plane;
    plane.lowest = surfaces_.farthest_nearness + qa + std::min({0.0, qb, qc});
    plane.highest = surfaces_.farthest_nearness + qa + std::max({0.0, qb, qc});
    plane.at_origin = plane.highest;
    if (area == 0) return plane;
    plane.per_x = (qb * vy - qc * uy) / area * kSubpixelsPerPixel;
    plane.per_y = (qc * ux - qb * vx) / area * kSubpixelsPerPixel;
    plane.at_origin = surfaces_.farthest_nearness + qa -
                      (plane.per_x * a.x + plane.per_y * a.y) / kSubpixelsPerPixel;
    return plane;
}

bool FastWalker::is_level(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const {
    const glm::dvec2 at = subpixel / double{kSubpixelsPerPixel};
    const DepthPlane plane_b = plane(b);
    const double distance = distance_of(surfaces_.projection, plane(a).nearness(at));
    const double other = distance_of(surfaces_.projection, plane_b.nearness(at));
    return std::abs(distance - other) <= depth_tolerance(surfaces_, distance, plane_b);
}

}  // namespace burin
