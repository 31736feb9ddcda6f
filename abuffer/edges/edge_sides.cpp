#include "abuffer/edges/edge_sides.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "abuffer/edges/fold_width.h"
#include "abuffer/edges/level_walk.h"
#include "abuffer/edges/occluder.h"
#include "abuffer/samples/fast_walk.h"
#include "abuffer/screen/edge_on_screen.h"

namespace burin {
namespace {

/// A triangle lower than this is a fold that is no contour (docs/conventions.md). 1/64 pixel.
constexpr double kThinSubpixels = 4;
/// Shorter edges are no part of a wire: of meshes with very many triangles in a pixel nearly all are. 1/16 pixel.
constexpr std::int64_t kShortestOfWireSubpixels = 16;
/// A walk that is this far beyond a wall need not go on. Pixels.
constexpr double kPastWallPx = 1.0 / 16;
/// Where there are more on the way to a wall, it is one of very many in a pixel.
constexpr int kMostTrianglesToWall = 96;

bool is_off_screen(const ScreenVertex& v) { return v.x == ScreenVertex::kOffScreen; }

/// The square of the distance between two vertices on the screen.
std::int64_t square(const ScreenVertex& a, const ScreenVertex& b) {
    const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
    return dx * dx + dy * dy;
}

/// Whether a triangle on a base is lower than a negligible fold, by its doubled area and the square of the base.
bool is_thin(std::int64_t area, std::int64_t base) {
    const auto exact = static_cast<double>(area);
    return exact * exact < kThinSubpixels * kThinSubpixels * static_cast<double>(base);
}

}  // namespace

inline HalfEdge EdgeSides::base_of_thin(SurfaceId s) const {
    const ScreenMesh& mesh = screen_.mesh(s.instance);
    const std::uint32_t* const corner = mesh.corners + 3 * std::size_t{s.triangle};
    const ScreenVertex &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]], &c = mesh.vertices[corner[2]];
    if (is_off_screen(a) | is_off_screen(b) | is_off_screen(c)) return kNoHalfEdge;
    const std::int64_t ab = square(a, b), bc = square(b, c), longest = std::max(std::max(ab, bc), square(c, a));
    if (!is_thin(doubled_area(a, b, c), longest)) return kNoHalfEdge;
    return 3 * s.triangle + (ab == longest ? 0 : bc == longest ? 1 : 2);
}

EdgeSides::PlainPair EdgeSides::plain_pair(std::uint32_t instance, HalfEdge h, HalfEdge g) const {
    const ScreenMesh& mesh = screen_.mesh(instance);
    const auto corners_from = [&](HalfEdge e) {
        const HalfEdge k = e % 3;
        return std::array{mesh.corners[e], mesh.corners[k == 2 ? e - 2 : e + 1], mesh.corners[k == 0 ? e + 2 : e - 1]};
    };
    const auto has_side = [&](HalfEdge e) {
        return mesh.facing[e / 3] == clockwise || mesh.facing[e / 3] == counterclockwise;
    };
    const auto [from, to, apex] = corners_from(h);
    const auto [other_from, other_to, other_apex] = corners_from(g);
    const bool have_same_ends = (other_from == to && other_to == from) || (other_from == from && other_to == to);
    if (!have_same_ends || !has_side(h) || !has_side(g)) return {};
    const ScreenVertex &a = mesh.vertices[from], &b = mesh.vertices[to], &p = mesh.vertices[apex],
                       &q = mesh.vertices[other_apex];
    const std::int64_t ab = square(a, b), area_h = doubled_area(a, b, p), area_g = doubled_area(a, b, q);
    const bool is_any_thin = is_thin(area_h, std::max(ab, std::max(square(a, p), square(b, p)))) |
                             is_thin(area_g, std::max(ab, std::max(square(a, q), square(b, q))));
    return {!is_any_thin, area_h < 0 ? -1 : 1, area_g < 0 ? -1 : 1};
}

HalfEdge EdgeSides::longer_of_others(std::uint32_t instance, HalfEdge h) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const ScreenVertex* const v = screen_.vertices(instance);
    const HalfEdge one = h - h % 3 + (h + 1) % 3, two = h - h % 3 + (h + 2) % 3;
    const auto length = [&](HalfEdge e) { return square(v[start_of(mesh, e)], v[end_of(mesh, e)]); };
    return length(two) > length(one) ? two : one;
}

bool EdgeSides::face_alike(std::uint32_t instance, HalfEdge h, HalfEdge g) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const Facing a = screen_.facing(screen_.number_of({instance, h / 3})),
                 b = screen_.facing(screen_.number_of({instance, g / 3}));
    const bool are_wound_alike = start_of(mesh, h) != start_of(mesh, g),
               has_side = b == clockwise || b == counterclockwise;
    if (are_wound_alike || !has_side) return a == b;
    return a == (b == clockwise ? counterclockwise : clockwise);
}

bool EdgeSides::is_beside(std::uint32_t instance, HalfEdge edge, std::uint32_t vertex) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const ScreenVertex* const v = screen_.vertices(instance);
    const ScreenVertex &a = v[start_of(mesh, edge)], &b = v[end_of(mesh, edge)], &p = v[vertex];
    if (is_off_screen(a) || is_off_screen(b) || is_off_screen(p)) return false;
    const std::int64_t base = square(a, b);
    return base > kSubpixelsPerPixel * kSubpixelsPerPixel && is_thin(doubled_area(a, b, p), base);
}

HalfEdge EdgeSides::solid_behind(std::uint32_t instance, HalfEdge h) const {
    // A wall may have a hundred triangles on the way, so that of each only the new corner is looked at.
    const ScreenMesh& mesh = screen_.mesh(instance);
    const auto next = [](HalfEdge e) { return e % 3 == 2 ? e - 2 : e + 1; };
    const auto corner = [&](HalfEdge e) -> const ScreenVertex& { return mesh.vertices[mesh.corners[e]]; };
    const ScreenVertex &from = corner(h), &to = corner(next(h));
    if (is_off_screen(from) || is_off_screen(to)) return h;
    const std::int64_t length = square(from, to);
    const bool is_long = length > kSubpixelsPerPixel * kSubpixelsPerPixel;
    HalfEdge last = h;
    std::int64_t entered = length;  // squares of edges' lengths
    for (int step = 0; step < kMostTrianglesToWall; ++step) {
        const HalfEdge one = next(h), two = next(one);
        const ScreenVertex &p = corner(h), &q = corner(one), &apex = corner(two);
        if (is_off_screen(apex)) return h;
        const std::int64_t first = square(q, apex), second = square(apex, p),
                           longest = std::max(std::max(entered, first), second);
        if (!is_thin(doubled_area(p, q, apex), longest)) return h;
        // A wall of many rows may be no wider than one of a single row, if something lies behind it.
        if (step >= kMostSlivers && !(is_long && is_thin(doubled_area(from, to, apex), length))) return last;
        HalfEdge base = kNoHalfEdge;  // of several longest edges the first one of the triangle
        if (entered == longest) base = h;
        if (first == longest) base = std::min(base, one);
        if (second == longest) base = std::min(base, two);
        const HalfEdge exit = base != h ? base : second > first ? two : one;
        const HalfEdge g = mesh.partners[exit];
        const bool is_pair = g != exit && mesh.partners[g] == exit;
        if (base == h && step == 0 && !(is_pair && face_alike(instance, exit, g))) return kNoHalfEdge;
        if (!is_pair) return last;
        h = g;
        entered = exit == one ? first : second;
        if (step < kMostSlivers) last = h;
    }
    return last;
}

int EdgeSides::side_at(std::uint32_t instance, HalfEdge h, std::uint32_t a, std::uint32_t b) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    std::uint32_t p = start_of(mesh, h), q = end_of(mesh, h);
    const auto runs_against = [&] {
        const glm::dvec3 along = surfaces_.view_position(instance, b) - surfaces_.view_position(instance, a);
        const glm::dvec3 own = surfaces_.view_position(instance, q) - surfaces_.view_position(instance, p);
        return glm::dot(along, own) < 0;
    };
    if (p == b || q == a || (p != a && q != b && runs_against())) std::swap(p, q);
    return side_of_edge(screen_, instance, p, q, apex_of(mesh, h));
}

bool EdgeSides::is_turned_over(std::uint32_t instance, HalfEdge h) const {
    if (!is_thin_at(instance, h)) return false;
    const HalfEdge solid = solid_behind(instance, h);
    if (solid == kNoHalfEdge) return true;
    if (is_thin_at(instance, solid)) return false;
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const std::uint32_t a = start_of(mesh, h), b = end_of(mesh, h);
    return side_at(instance, solid, a, b) * side_at(instance, h, a, b) < 0;
}

bool EdgeSides::ends_at_wall(std::uint32_t instance, HalfEdge h, HalfEdge beyond) const {
    const SurfaceId own{instance, h / 3};
    const auto has_side = [](Facing facing) { return facing == clockwise || facing == counterclockwise; };
    if (!has_side(screen_.facing(screen_.number_of(own)))) return false;
    const Mesh& mesh = surfaces_.mesh_of(own);
    // A wall may also lean by less than makes a contour. Where snapping turned triangles of it over, they do not end
    // there.
    const bool is_wall = screen_.facing(screen_.number_of({instance, beyond / 3})) == edge_on
                             ? !is_turned_over(instance, h)
                             : is_beside(instance, h, apex_of(mesh, beyond)) && !is_thin_at(instance, h);
    if (!is_wall) return false;
    const ScreenVertex* const v = screen_.vertices(instance);
    const auto place = [&](std::uint32_t vertex) { return to_pixels(glm::dvec2(v[vertex].x, v[vertex].y)); };
    const glm::dvec2 a = place(start_of(mesh, h)), b = place(end_of(mesh, h)), middle = 0.5 * (a + b);
    if (a == b) return false;
    // The wall leads away from the eye, else this is its foot.
    const std::uint32_t wall_apex = apex_of(mesh, beyond);
    const double along = glm::dot(place(wall_apex) - a, b - a) / glm::dot(b - a, b - a);
    const double edge_nearness = glm::mix(static_cast<double>(v[start_of(mesh, h)].nearness),
                                          static_cast<double>(v[end_of(mesh, h)].nearness), along);
    if (static_cast<double>(v[wall_apex].nearness) > edge_nearness) return false;
    glm::dvec2 out = glm::normalize(glm::dvec2(b.y - a.y, a.x - b.x));
    if (glm::dot(out, place(apex_of(mesh, h)) - a) > 0) out = -out;
    // A short way beyond the wall is enough: a walk that gets there has come past it.
    const glm::dvec2 past = kPastWallPx * out;
    if (surely_goes_on(screen_, instance, h, to_subpixels(middle), out, to_subpixels(kPastWallPx))) return false;
    const SurfaceWalk walk = walk_to_end(surfaces_, own, middle - past, middle + past, criteria_, kMostTrianglesToWall,
                                         screen_.sharp_edges(instance));
    // Where it turns back behind the wall, it gets farthest anywhere on that.
    constexpr double kMiddle = 0.5;
    return walk.end == WalkEnd::fold && std::abs(walk.fraction - kMiddle) <= kNoAdvance;
}

bool EdgeSides::is_negligible_fold(std::uint32_t instance, HalfEdge h) const {
    const ScreenMesh& mesh = screen_.mesh(instance);
    const ScreenVertex &a = mesh.vertices[mesh.corners[h]], &b = mesh.vertices[mesh.corners[h - h % 3 + (h + 1) % 3]];
    if (a.x == ScreenVertex::kOffScreen || b.x == ScreenVertex::kOffScreen) return false;
    const glm::dvec2 from(a.x, a.y), to(b.x, b.y);
    if (glm::distance(from, to) > kSubpixelsPerPixel) return false;
    const double nearness = 0.5 * (static_cast<double>(a.nearness) + static_cast<double>(b.nearness));
    return !is_fold_wide(mesh, h, 0.5 * (from + to), nearness, 32 * level_slack(surfaces_, nearness));
}

bool EdgeSides::is_front_of_wire(std::uint32_t instance, HalfEdge h) const {
    const ScreenMesh& mesh = screen_.mesh(instance);
    const ScreenVertex &a = mesh.vertices[mesh.corners[h]], &b = mesh.vertices[mesh.corners[h - h % 3 + (h + 1) % 3]];
    if (is_off_screen(a) || is_off_screen(b) || square(a, b) <= kShortestOfWireSubpixels * kShortestOfWireSubpixels)
        return false;
    const glm::dvec2 middle = 0.5 * (glm::dvec2(a.x, a.y) + glm::dvec2(b.x, b.y));
    const double nearness = 0.5 * (static_cast<double>(a.nearness) + static_cast<double>(b.nearness));
    return ring_around(mesh, h, middle, nearness, level_slack(surfaces_, nearness, kCertainPx)) == Ring::in_front;
}

std::optional<HalfEdge> EdgeSides::past_sliver(std::uint32_t instance, HalfEdge h) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    for (int step = 0; step < kMostSlivers; ++step) {
        if (!is_sliver_at({instance, h / 3}, h)) return h;
        const HalfEdge base = base_of_thin({instance, h / 3});
        if (base == kNoHalfEdge) return h;
        const HalfEdge exit = base == h ? longer_of_others(instance, h) : base, g = mesh.next_on_edge[exit];
        if (g == exit || mesh.next_on_edge[g] != exit) return std::nullopt;
        h = g;
    }
    return h;
}

bool EdgeSides::are_neighbours(std::uint32_t instance, HalfEdge h, HalfEdge g) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const HalfEdge first = h - h % 3;
    const auto leads_there = [&](HalfEdge own) { return mesh.next_on_edge[own] / 3 == g / 3; };
    return h / 3 == g / 3 || leads_there(first) || leads_there(first + 1) || leads_there(first + 2);
}

bool EdgeSides::is_needle_on_edge(SurfaceId s, HalfEdge h) const {
    if (!is_sliver_at(s, h)) return false;
    const Mesh& mesh = surfaces_.mesh_of(s);
    const HalfEdge base = base_of_thin(s);
    if (base == kNoHalfEdge) return false;
    int solids = 0;
    for (HalfEdge g = mesh.next_on_edge[base]; g != base; g = mesh.next_on_edge[g]) {
        if (!is_sliver_at(SurfaceId{s.instance, g / 3}, g)) ++solids;
    }
    return solids > 1;
}

bool EdgeSides::is_sliver_at(SurfaceId s, HalfEdge h) const {
    return !FastWalker::is_surely_solid(screen_.mesh(s.instance), h / 3) &&
           is_sliver(surfaces_, SurfaceId{s.instance, h / 3});
}

glm::dvec3 EdgeSides::across_edge(std::uint32_t instance, HalfEdge h) const {
    const Mesh& mesh = surfaces_.mesh_of({instance, h / 3});
    const glm::dvec3 p = surfaces_.view_position(instance, start_of(mesh, h));
    const glm::dvec3 along = surfaces_.view_position(instance, end_of(mesh, h)) - p,
                     v = surfaces_.view_position(instance, apex_of(mesh, h)) - p;
    const glm::dvec3 across = v - along * (glm::dot(v, along) / glm::dot(along, along));
    return across / std::max(glm::length(across), 1e-300);
}

double EdgeSides::cosine_to_eye(std::uint32_t instance, HalfEdge h) const {
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const glm::dvec3 p = surfaces_.view_position(instance, start_of(mesh, h));
    const glm::dvec3 along = surfaces_.view_position(instance, end_of(mesh, h)) - p;
    const glm::dvec3 v = surfaces_.projection.orthographic ? glm::dvec3(0, 0, 1) : -p;
    const glm::dvec3 to_eye = v - along * (glm::dot(v, along) / glm::dot(along, along));
    return glm::dot(across_edge(instance, h), to_eye) / std::max(glm::length(to_eye), 1e-300);
}

}  // namespace burin
