#include "abuffer/samples/fast_walk.h"

#include <algorithm>
#include <cmath>

#include "lines/seam_sight.h"

namespace burin {
namespace {

bool is_sharp(const ScreenMesh& mesh, HalfEdge h) {
    return mesh.sharp == nullptr || (mesh.sharp[h / 3] >> h % 3 & 1) != 0;
}

}  // namespace

/// The line that is walked along, and the triangle looked at. `u` runs along the line, `v` across.
class FastWalker::Way {
  public:
    Way(const ScreenMesh& mesh, const NeighbourSamples& pair, bool backwards)
        : mesh_(mesh),
          down_(pair.down),
          across_(pair.down ? pair.x : pair.y),
          origin_((pair.down ? pair.y : pair.x) + (backwards ? pair.pitch : 0)),
          per_unit_((backwards ? -1.0 : 1.0) / pair.pitch) {}

    /// Returns false where the triangle reaches off the screen.
    bool look_at(std::uint32_t triangle) {
        const std::uint32_t* const corners = mesh_.corners + 3 * static_cast<std::size_t>(triangle);
        bool is_on = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const ScreenVertex& p = mesh_.vertices[corners[k]];
            is_on &= p.x != ScreenVertex::kOffScreen;
            u_[k] = down_ ? p.y : p.x;
            v_[k] = down_ ? p.x : p.y;
            side_[k] = v_[k] > across_;  // samples on a vertex lie a trifle further right and down
        }
        return is_on;
    }
    bool crosses(std::uint32_t k) const { return side_[k] != side_[next(k)]; }
    /// Where edge k crosses the line.
    double fraction(std::uint32_t k) const {
        const std::uint32_t n = next(k);
        const double u = u_[k] + static_cast<double>(across_ - v_[k]) * (u_[n] - u_[k]) / (v_[n] - v_[k]);
        return (u - origin_) * per_unit_;
    }
    /// Where along the edge that is: 0 = at corner k.
    double along_edge(std::uint32_t k) const { return static_cast<double>(across_ - v_[k]) / (v_[next(k)] - v_[k]); }
    /// Nearness on an edge that the line crosses, of any triangle.
    double nearness_at(HalfEdge h) const {
        const auto vertex = [&](HalfEdge k) -> const ScreenVertex& {
            return mesh_.vertices[mesh_.corners[h - h % 3 + k % 3]];
        };
        const ScreenVertex &p = vertex(h % 3), &q = vertex(h % 3 + 1);
        const std::int32_t from = down_ ? p.x : p.y, to = down_ ? q.x : q.y;
        return glm::mix(static_cast<double>(p.nearness), static_cast<double>(q.nearness),
                        static_cast<double>(across_ - from) / (to - from));
    }
    /// Nearness on the way through a triangle, from where the one before is left to where this one is.
    double nearness_between(const FastWalk::Step& before, const FastWalk::Step& step, double fraction_of_way) const {
        return glm::mix(nearness_at(before.exit), nearness_at(step.exit),
                        (fraction_of_way - before.left) / (step.left - before.left));
    }
    /// The step through the triangle that is entered over half-edge `entry`.
    FastWalk::Step step_from(HalfEdge entry, double entered) const {
        const std::uint32_t t = entry / 3, k = entry - 3 * t, n = next(k), apex = next(n);
        const std::uint32_t exit = side_[apex] == side_[k] ? n : apex;
        return {t, 3 * t + exit, entered, fraction(exit)};
    }
    /// The step through the triangle in which the walk begins.
    FastWalk::Step first_step(std::uint32_t t) const {
        constexpr double kBefore = FastWalk::kBefore;
        FastWalk::Step step{t, kNoHalfEdge, kBefore, kBefore};
        const std::uint8_t facing = mesh_.facing[t];
        if (facing == clockwise || facing == counterclockwise) {
            const std::uint32_t k = exit_edge(side_, exit_begins_beyond(facing, down_) != (per_unit_ < 0));
            if (k < 3) step = {t, 3 * t + k, kBefore, fraction(k)};
            return step;
        }
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (crosses(k) && fraction(k) > step.left) step = {t, 3 * t + k, kBefore, fraction(k)};
        }
        return step;
    }
    /// The place on the way, in 1/256 pixel.
    glm::dvec2 at(double fraction_of_way) const {
        const double along = origin_ + fraction_of_way / per_unit_;
        return down_ ? glm::dvec2(across_, along) : glm::dvec2(along, across_);
    }
    double length_px() const { return to_pixels(std::abs(1 / per_unit_)); }

  private:
    static std::uint32_t next(std::uint32_t k) { return k == 2 ? 0 : k + 1; }

    const ScreenMesh& mesh_;
    bool down_;
    std::int32_t across_;
    double origin_, per_unit_;
    std::int32_t u_[3] = {}, v_[3] = {};
    bool side_[3] = {};
};

FastWalk::Stop FastWalk::stop_at(double goal) const {
    const Step* step = steps;
    while (step != steps + step_count && step->left < goal) ++step;
    if (step == steps + step_count) return {false, triangle, fraction};
    // A goal in the gap of a seam is where the step before ends.
    if (step != steps && step->entered >= goal) return {false, step[-1].triangle, step[-1].left};
    return {true, step->triangle, goal};
}

void FastWalker::walk(const NeighbourSamples& pair, bool backwards, FastWalk& result, bool passes_goal) {
    const SurfaceId start = pair.surfaces[backwards ? 1 : 0];
    const std::uint32_t instance = start.instance;
    const ScreenMesh& mesh = screen_.mesh(instance);
    Way way(mesh, pair, backwards);
    result.end = FastWalk::unsure;
    result.crossed = {};
    result.crease_cosine = 1;
    result.step_count = 0;
    FastWalk::Step* const steps = steps_[backwards ? 1 : 0];
    result.steps = steps;
    if (!way.look_at(start.triangle)) return;
    const FastWalk::Step* current = &(steps[0] = way.first_step(start.triangle));
    if (current->exit == kNoHalfEdge) return;
    const FastWalk::Step* farthest = current;     // the walk may turn back by a trifle
    const FastWalk::Step* before_wall = current;  // where it last got farther at all
    const FastWalk::Step* known_wall = nullptr;   // the last one whose place was asked for
    std::optional<double> wall_part;              // and that
    const double negligible_fold = to_subpixels(kNegligibleFoldPx) / pair.pitch;
    const HalfEdge first_exit = current->exit;
    Slivers slivers{start.triangle};
    const double snapping = to_subpixels(kSnappingPx) / pair.pitch;
    const auto end_at = [&result](FastWalk::End end, const FastWalk::Step& at) {
        result.end = end;
        result.triangle = at.triangle;
        result.half_edge = at.exit;
        result.fraction = at.left;
    };
    for (result.step_count = 1; result.step_count < FastWalk::kMaxSteps; ++result.step_count) {
        if (current->left > 1 || (current->left == 1 && !passes_goal)) {
            end_at(FastWalk::arrived, *current);
            // Lines are asked for only at the two surfaces of the pair.
            if (SurfaceId{instance, current->triangle} == pair.surfaces[backwards ? 0 : 1])
                note_lines(pair, backwards, result);
            return;
        }
        FastWalk::Step& next = steps[result.step_count];
        const HalfEdge entry = mesh.partners[current->exit];
        const bool over_seam = entry == current->exit;
        if (over_seam) {
            Way beyond(mesh, pair, backwards);
            const FastWalk::End end = step_over_seam(way, instance, *current, beyond, next);
            if (end == FastWalk::unsure) return;
            if (end != FastWalk::arrived) {
                result.beyond = next.triangle;
                return end_at(end, *current);
            }
            way.look_at(next.triangle);
        } else {
            // An edge that is not sharp has one partner.
            if ((is_sharp(mesh, current->exit) && mesh.partners[entry] != current->exit) || !way.look_at(entry / 3))
                return;
            next = way.step_from(entry, current->left);
        }
        const bool unfolds = current->left < farthest->left && next.left >= farthest->left;
        const bool sliver = is_sliver_on_way({instance, next.triangle}, slivers);
        const SurfaceId solid{instance, sliver ? slivers.last_solid : next.triangle};
        if (next.left < farthest->left - negligible_fold ||
            (unfolds &&
             !is_level(way.nearness_at(farthest->exit), way.nearness_between(*current, next, farthest->left), solid))) {
            return end_at(FastWalk::fold, *before_wall);
        }
        bool goes_on = next.left > before_wall->left + kNoAdvance, is_farthest = next.left >= farthest->left;
        if (std::abs(next.left - before_wall->left) < snapping) {
            if (are_apart(way.nearness_at(before_wall->exit), way.nearness_at(next.exit))) {
                const glm::dvec2 from = to_pixels(way.at(0)), along = to_pixels(way.at(1)) - from;
                if (known_wall != before_wall) wall_part = unsnapped_part(instance, before_wall->exit, from, along);
                known_wall = before_wall;
                const auto part = unsnapped_part(instance, next.exit, from, along);
                if (part && wall_part) goes_on = is_beyond(*part, *wall_part, along);
                is_farthest = is_farthest || goes_on;
            }
        }
        if (goes_on && current != before_wall &&
            !is_level(way.nearness_at(before_wall->exit), way.nearness_at(current->exit), solid)) {
            return end_at(FastWalk::fold, *before_wall);
        }
        slivers.enter(next.triangle, sliver);
        current = &next;
        if (is_farthest) farthest = current;
        if (goes_on) before_wall = current;
        if (current->exit == first_exit) return;  // around a wire
    }
}

WalkLimits FastWalker::limits(std::int32_t pitch) const {
    const Projection& p = surfaces_.projection;
    constexpr double kRounding = 1e-6;  // as in are_apart()
    const double deep = (kDepthTolerancePx - kRounding) / p.focal_px;
    return {1.0 / pitch,
            kNoAdvance,
            to_subpixels(kSnappingPx) / pitch,
            to_subpixels(kNegligibleFoldPx) / pitch,
            deep * (p.orthographic ? 1.0 : surfaces_.farthest_nearness),
            p.orthographic ? 0.0 : deep};
}

void FastWalker::note_lines(const NeighbourSamples& pair, bool backwards, FastWalk& result) {
    const std::uint32_t instance = pair.surfaces[backwards ? 1 : 0].instance;
    const ScreenMesh& mesh = screen_.mesh(instance);
    const Way way(mesh, pair, backwards);
    Slivers slivers{result.steps[0].triangle};
    const auto note_contact_at = [&](std::uint32_t triangle, double fraction) {
        note_contact(instance, slivers.last_solid, triangle, way.at(fraction), fraction, result);
    };
    for (int k = 1; k < result.step_count; ++k) {
        const FastWalk::Step& from = result.steps[k - 1];
        const std::uint32_t next = result.steps[k].triangle;
        const bool sliver = is_sliver_on_way({instance, next}, slivers);
        if (sliver) {
            const bool is_mark = surfaces_.instances[instance].mesh->is_marked(from.exit);
            if (is_mark) note(LineClass::mark, {{instance, from.triangle}, from.exit}, from.left, result);
        } else if (slivers.count > 0 || mesh.partners[from.exit] == from.exit) {  // or over a seam
            note_contact_at(next, from.left);
        } else if (is_sharp(mesh, from.exit)) {
            note_edge(instance, from, result);
        }
        slivers.enter(next, sliver);
    }
    if (slivers.count > 0) note_contact_at(result.triangle, 1);
}

/// Steps from a border to another patch of the mesh. `arrived`: the walk goes on with the step `next`.
FastWalk::End FastWalker::step_over_seam(const Way& way, std::uint32_t instance, const FastWalk::Step& from,
                                         Way& beyond, FastWalk::Step& next) {
    const auto entry = seam_beyond(instance, from.exit, way.along_edge(from.exit % 3));
    if (!entry) return FastWalk::border;
    if (!beyond.look_at(*entry / 3)) return FastWalk::unsure;
    if (!beyond.crosses(*entry % 3)) return FastWalk::border;
    const double entered = beyond.fraction(*entry % 3);
    const glm::dvec2 border_px = to_pixels(way.at(from.left));
    const auto nearness = [&](SurfaceId s) { return plane(s).nearness(border_px) - surfaces_.farthest_nearness; };
    if (std::abs(entered - from.left) * way.length_px() > kWidestCrackPx ||
        !is_level(nearness({instance, from.triangle}), nearness({instance, *entry / 3}), {instance, *entry / 3})) {
        return FastWalk::border;
    }
    next = beyond.step_from(*entry, entered);
    const bool is_forward = next.left > entered;
    if (!is_forward) next.entered = from.left;
    return is_forward && entered >= 1 ? FastWalk::crack : FastWalk::arrived;
}

void FastWalker::note(LineClassSet classes, SurfaceEdge edge, double fraction, FastWalk& result) const {
    const LineClassSet wanted = classes & criteria_.classes;
    if (!wanted.empty() && result.crossed.empty()) {
        result.crossed_edge = edge;
        result.crossed_fraction = fraction;
    }
    result.crossed |= wanted;
}

LineClassSet FastWalker::edge_classes(SurfaceEdge edge, double* crease_cosine) {
    constexpr std::size_t kKnownEdges = 256;
    if (known_edges_.empty()) known_edges_.resize(kKnownEdges, {{kBackground, kNoHalfEdge}, {}, 1});
    KnownEdge& known = known_edges_[edge.half_edge % kKnownEdges];
    if (known.edge.half_edge != edge.half_edge || known.edge.surface != edge.surface) {
        known = {edge, {}, 1};
        known.classes = burin::edge_classes(surfaces_, edge, criteria_, &known.crease_cosine);
    }
    *crease_cosine = std::min(*crease_cosine, known.crease_cosine);
    return known.classes;
}

bool FastWalker::is_sliver_on_way(SurfaceId s, const Slivers& before) const {
    return !is_surely_solid(screen_.mesh(s.instance), s.triangle) && before.count < kMostSlivers &&
           is_sliver(surfaces_, s);
}

void FastWalker::note_edge(std::uint32_t instance, const FastWalk::Step& left, FastWalk& result) {
    const SurfaceEdge edge{{instance, left.triangle}, left.exit};
    note(edge_classes(edge, &result.crease_cosine), edge, left.left, result);
}

void FastWalker::note_contact(std::uint32_t instance, std::uint32_t a, std::uint32_t b, glm::dvec2 subpixel,
                              double fraction, FastWalk& result) const {
    const SurfaceId on{instance, a}, to{instance, b};
    const glm::dvec2 at = to_pixels(subpixel);
    note(contact_classes(surfaces_, on, to, at, criteria_, &result.crease_cosine), {on, kNoHalfEdge}, fraction, result);
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
    const glm::dvec3 a = mesh.local_position(k), b = mesh.local_position(n);
    return seams_.partner(mesh.borders, border, part, glm::mix(a, b, part));
}

DepthPlane FastWalker::plane(SurfaceId s) const {
    const ScreenMesh& mesh = screen_.mesh(s.instance);
    const std::uint32_t* const corners = mesh.corners + 3 * static_cast<std::size_t>(s.triangle);
    const ScreenVertex &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]], &c = mesh.vertices[corners[2]];
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
    plane.at_origin = surfaces_.farthest_nearness + qa - (plane.per_x * a.x + plane.per_y * a.y) / kSubpixelsPerPixel;
    return plane;
}

/// Where a walk crosses an edge, with its ends where they are, not snapped. Nothing if they are off the screen.
std::optional<double> FastWalker::unsnapped_part(std::uint32_t instance, HalfEdge edge, glm::dvec2 from,
                                                 glm::dvec2 along) {
    const std::uint32_t* const corners = screen_.mesh(instance).corners;
    const UnsnappedPlaces::Place a = places_.of(surfaces_, instance, corners[edge]);
    const UnsnappedPlaces::Place& b = places_.of(surfaces_, instance, corners[edge % 3 == 2 ? edge - 2 : edge + 1]);
    if (a.needs_clipping || b.needs_clipping) return std::nullopt;
    return part_of_way(along, a.pixel - from, b.pixel - from);
}

/// is_deep() between two places. Mostly their nearness says that it is not so, which takes no division.
bool FastWalker::are_apart(double nearness_a, double nearness_b) const {
    const Projection& p = surfaces_.projection;
    const double a = surfaces_.farthest_nearness + nearness_a, b = surfaces_.farthest_nearness + nearness_b;
    constexpr double kRounding = 1e-6;
    if (std::abs(a - b) * p.focal_px < (kDepthTolerancePx - kRounding) * (p.orthographic ? 1.0 : std::min(a, b)))
        return false;
    return is_deep(p, distance_of(p, a), distance_of(p, b));
}

/// Whether two places are equally far from the eye, as far as lines care, where a surface is as steep as a triangle.
bool FastWalker::is_level(double nearness_a, double nearness_b, SurfaceId steep) const {
    const auto distance = [&](double nearness) {
        return distance_of(surfaces_.projection, surfaces_.farthest_nearness + nearness);
    };
    const double a = distance(nearness_a);
    return std::abs(a - distance(nearness_b)) <= depth_tolerance(surfaces_, a, plane(steep));
}

}  // namespace burin
