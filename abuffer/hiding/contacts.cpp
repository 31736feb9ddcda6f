#include "abuffer/hiding/contacts.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "abuffer/screen/face_plane.h"

namespace burin {
namespace {

/// How far from a line its triangles are compared with others at its depth. 2 pixels.
constexpr double kBesideSubpixels = 2 * kSubpixelsPerPixel;

/// Doubled areas are off by less than this, (1/256 pixel)^2.
constexpr double kAreaRounding = 1;

double doubled_area(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}
glm::dvec2 place_of(const ScreenVertex& v) { return {v.x, v.y}; }

/// False for nearly all triangles that do not cover a place, which need not be set up. `turn`: 1 if the corners run
/// clockwise, or -1.
bool may_cover(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, double turn, glm::dvec2 place) {
    return turn * doubled_area(a, b, place) >= -kAreaRounding && turn * doubled_area(b, c, place) >= -kAreaRounding &&
           turn * doubled_area(c, a, place) >= -kAreaRounding;
}

}  // namespace

bool Contacts::is_seen_instead(const WholeLine& line, double begin, double end, const Occluder& t, double level) const {
    const auto at = touching_place(line, begin, end, t, level);
    if (!at) return false;
    const bool is_border = line.owners[0] == line.owners[1];
    for (const std::uint32_t owner : line.owners) {
        const SurfaceId s = screen_.surface_of(owner);
        const bool are_neighbours = have_vertex_in_common(s, t);
        if (are_neighbours && !is_border) return false;
        const auto beside = place_beside(s, owner, *at);
        if (!beside) continue;
        const double gap = screen_.nearness_of(owner, *beside) - t.nearness_at(*beside);
        if (gap > level || (gap >= -level && (are_neighbours || is_seen_first(owner, t.number, gap)))) return false;
    }
    return true;
}

bool Contacts::is_in_front(const WholeLine& line, double begin, double end, const Occluder& t, double level) const {
    for (const std::uint32_t owner : line.owners) {
        if (have_vertex_in_common(screen_.surface_of(owner), t)) return false;
    }
    const auto touching = touching_place(line, begin, end, t, level);
    if (!touching) return false;
    const glm::dvec2 middle = line.at(0.5 * (begin + end)), along = glm::normalize(line.to - line.from);
    bool is_any_behind = false;
    for (const std::uint32_t owner : line.owners) {
        const SurfaceId s = screen_.surface_of(owner);
        const auto beside = place_beside(s, owner, *touching);
        if (!beside) continue;
        const glm::dvec2 right(-along.y, along.x), side = glm::dot(*beside - *touching, right) < 0 ? -right : right;
        const auto cover = what_covers(middle + kToOneSideSubpixels * side, t, Over::any_edge);
        if (!cover) return false;
        const double gap = screen_.nearness_of(owner, *beside) - cover->nearness_at(*beside);
        if (gap > level) return false;
        bool is_behind = true;
        if (gap >= -level) {
            const SurfaceOrder order = screen_.surfaces().order(s, screen_.surface_of(cover->number));
            const bool is_coincident = order.are_coincident();
            const bool is_seen =
                is_coincident ? owner < cover->number : order.is_in_front() || (gap > 0 && !order.is_behind());
            if (!order.have_common_place || is_seen) return false;
            is_behind = !is_coincident ||
                        s.instance != t.instance;  // within a mesh, what lies flat on another part has no outline
        }
        is_any_behind = is_any_behind || is_behind;
    }
    return is_any_behind;
}

bool Contacts::is_flush(const WholeLine& line, double begin, double end, const Occluder& t, double level,
                        const LineCriteria& criteria, bool on_one_side) const {
    if (line.classes.has(LineClass::mark)) return false;
    const auto touching = touching_place(line, begin, end, t, level);
    if (!touching) return false;
    const glm::dvec2 middle = line.at(0.5 * (begin + end)), along = glm::normalize(line.to - line.from);
    const glm::dvec2 right = kToOneSideSubpixels * glm::dvec2(-along.y, along.x);
    const SurfaceSet& surfaces = screen_.surfaces();
    // Mostly one side is not covered: the triangle itself tells which it may be, before those at the line are looked
    // at.
    const glm::dvec2 places[2] = {middle - right, middle + right};
    const std::size_t first = t.covers(places[0]) ? 1 : 0;
    std::optional<Occluder> covers[2];
    for (const std::size_t side : {first, 1 - first}) {
        covers[side] = what_covers(places[side], t, Over::plain_edges, &criteria);
        if (!covers[side]) return false;
    }
    // What is asked last takes longest.
    struct Level {
        SurfaceId own, other;
        glm::dvec2 place, covered;
    };
    Level levels[2];
    int level_count = 0;
    for (const std::uint32_t owner : line.owners) {
        const SurfaceId s = screen_.surface_of(owner);
        const auto beside = place_beside(s, owner, *touching);
        if (!beside) continue;
        const std::size_t side = glm::dot(*beside - *touching, right) < 0 ? 0 : 1;
        const Occluder& cover = *covers[side];
        const double gap = screen_.nearness_of(owner, *beside) - cover.nearness_at(*beside);
        if (gap > level) return false;
        if (gap >= -level)
            levels[level_count++] = {s, screen_.surface_of(cover.number), to_pixels(*beside), to_pixels(places[side])};
    }
    if (level_count == 0) return false;
    bool is_any_flush = false;
    for (int i = 0; i < level_count; ++i) {
        const auto& [own, other, place, covered] = levels[i];
        if (!surfaces.order_near(own, other, place).are_coincident()) {
            if (rises_in_front(surfaces, own, FacePlane(surfaces, other))) return false;
            continue;
        }
        if (!(contact_classes(surfaces, own, other, place, criteria) & criteria.classes).empty()) return false;
        if (laps_narrowly(line, own, {other, covered}, middle)) return false;
        if (on_one_side && !have_bodies_on_one_side(own, other)) return false;
        is_any_flush = true;
    }
    return is_any_flush;
}

bool Contacts::is_in_plane(const WholeLine& line, double begin, double end, const Occluder& t, double certain) const {
    const auto lead = [&](double at) { return t.nearness_at(line.at(at)) - line.nearness_at(at); };
    if (std::max(lead(begin), lead(end)) >= certain) return false;
    const SurfaceSet& surfaces = screen_.surfaces();
    const SurfaceId other = screen_.surface_of(t.number);
    const glm::dvec2 place = to_pixels(line.at(0.5 * (begin + end)));
    return std::any_of(line.owners.begin(), line.owners.end(), [&](std::uint32_t owner) {
        return surfaces.order_near(screen_.surface_of(owner), other, place).are_coincident();
    });
}

/// Whether a face that ends at a line laps over another one there by a narrow strip alone.
bool Contacts::laps_narrowly(const WholeLine& line, SurfaceId own, const FacePlace& other, glm::dvec2 middle) const {
    if (!line.is_edge()) return false;
    return burin::laps_narrowly(screen_.surfaces(), own, line.id.half_edge(), other, to_pixels(middle));
}

std::optional<LineClassSet> Contacts::classes_of_contact(const WholeLine& line, const Occluder& t,
                                                         const LineCriteria& criteria, double& begin,
                                                         double& end) const {
    const std::uint32_t owner = line.owners[0];
    const SurfaceId own = screen_.surface_of(owner), other = screen_.surface_of(t.number);
    const auto centre = centre_of(own, owner);
    if (!centre) return std::nullopt;
    const glm::dvec2 along = glm::normalize(line.to - line.from), right(-along.y, along.x);
    const glm::dvec2 beyond = kToOneSideSubpixels * (glm::dot(*centre - line.from, right) < 0 ? right : -right);
    WholeLine beside = line;
    beside.from += beyond;
    beside.to += beyond;
    constexpr double kAnyDepth = -1e300;
    if (!clip_where_hidden(beside, kAnyDepth, t, begin, end)) return std::nullopt;
    const SurfaceSet& surfaces = screen_.surfaces();
    const auto distance = [&](double nearness) {
        return distance_of(surfaces.projection, surfaces.farthest_nearness + nearness);
    };
    const DepthPlane plane = surfaces.plane(other);
    // What is left of the tolerances, which hardly change, at either end of the line.
    const double here = distance(line.nearness_at(0.5 * (begin + end)));
    const double behind = depth_tolerance(surfaces, here, plane),
                 in_front = depth_tolerance(surfaces, here, plane, kLevelPx);
    const auto farther_at = [&](double part) {
        return distance(t.nearness_at(line.at(part))) - distance(line.nearness_at(part));
    };
    const double from = begin, length = end - begin, at_begin = farther_at(begin), at_end = farther_at(end);
    double first = 0, last = 1;
    if (!clip_where_positive(behind - at_begin, behind - at_end, first, last) ||
        !clip_where_positive(in_front + at_begin, in_front + at_end, first, last)) {
        return std::nullopt;
    }
    begin = from + first * length;
    end = from + last * length;
    const glm::dvec2 at = line.at(0.5 * (begin + end));
    return contact_classes(surfaces, own, other, to_pixels(at), criteria) & criteria.classes;
}

/// Whether the bodies of two faces are both towards the eye, both away from it, or both faces are sheets. Of faces near
/// each other on one surface this is told without looking at their whole body.
bool Contacts::have_bodies_on_one_side(SurfaceId a, SurfaceId b) const {
    const SurfaceSet& surfaces = screen_.surfaces();
    const auto faces_eye = [&](SurfaceId s) {
        const bool is_mirrored = glm::determinant(glm::dmat3(surfaces.instance_of(s).to_view)) < 0;
        return FacePlane(surfaces, s).is_counterclockwise != is_mirrored;
    };
    const bool faces_alike = faces_eye(a) == faces_eye(b);
    if (faces_alike && a.instance == b.instance && surfaces.instance_of(a).body_sides->are_same(a.triangle, b.triangle))
        return true;
    const auto side = [&](SurfaceId s) -> int { return surfaces.instance_of(s).body_sides->of(s.triangle); };
    return side(a) == (faces_alike ? side(b) : -side(b));
}

/// A triangle or one of its neighbours, over any edge or those that are no lines, whichever is at a place. Of what is
/// cut, as a floor that reaches behind the eye, all parts.
std::optional<Occluder> Contacts::what_covers(glm::dvec2 place, const Occluder& t, Over over,
                                              const LineCriteria* criteria) const {
    if (t.covers(place)) return t;
    const ScreenMesh& mesh = screen_.mesh(t.instance);
    const SurfaceId own = screen_.surface_of(t.number);
    if (screen_.facing(t.number) == off_screen) {
        if (const auto part = part_at(place, own)) return part;
    }
    const HalfEdge first = 3 * own.triangle;
    const unsigned line_edges = mesh.line_edges[own.triangle];
    for (unsigned k = 0; k < 3; ++k) {
        const HalfEdge h = first + k;
        if ((line_edges >> k & 1) == 0) {
            // The neighbour faces alike, and lies beyond the edge: its third corner tells.
            const std::size_t from = screen_.facing(t.number) == clockwise ? k : 2 - k, to = from == 2 ? 0 : from + 1;
            const glm::dvec2 a(t.x[from], t.y[from]), b(t.x[to], t.y[to]);
            if (doubled_area(a, b, place) > kAreaRounding) continue;
            const HalfEdge g = mesh.partners[h];
            if (!may_cover(b, a, place_of(mesh.vertices[mesh.corners[g % 3 == 0 ? g + 2 : g - 1]]), 1, place)) continue;
        } else if (over == Over::plain_edges && (mesh.sharp == nullptr || (mesh.sharp[own.triangle] >> k & 1) != 0)) {
            if (const auto other = what_covers_in_plane(place, own, h, *criteria)) return other;
            continue;
        }
        const SurfaceId s{t.instance, mesh.partners[h] / 3};
        if (s.triangle == own.triangle) continue;
        if (const auto part = part_at(place, s)) return part;
    }
    return std::nullopt;
}

/// What is at a place of the faces beyond an edge of more than two polygons that go on in the plane of one of them:
/// bodies that stand flush and share corners have no line between them.
std::optional<Occluder> Contacts::what_covers_in_plane(glm::dvec2 place, SurfaceId own, HalfEdge h,
                                                       const LineCriteria& criteria) const {
    const ScreenMesh& mesh = screen_.mesh(own.instance);
    if (mesh.partners[mesh.partners[h]] == h) return std::nullopt;
    const glm::dvec2 at = to_pixels(place);
    for (HalfEdge g = mesh.partners[h]; g != h; g = mesh.partners[g]) {
        const SurfaceId s{own.instance, g / 3};
        auto part = part_at(place, s);
        if (!part) continue;
        const LineClassSet classes = contact_classes(screen_.surfaces(), own, s, at, criteria);
        if ((classes & criteria.classes).empty() && !classes.has(LineClass::crease)) return part;
    }
    return std::nullopt;
}

/// A triangle where it covers a place, or the part of it that does if it is cut.
std::optional<Occluder> Contacts::part_at(glm::dvec2 place, SurfaceId s) const {
    const std::uint32_t number = screen_.number_of(s);
    const Facing facing = screen_.facing(number);
    if (facing == edge_on) return std::nullopt;
    if (facing == off_screen) {
        for (const Occluder& part : clipped_occluders(screen_, s, number)) {
            if (part.covers(place)) return part;
        }
        return std::nullopt;
    }
    const auto& [a, b, c] = screen_.triangle(s).corners;
    if (!may_cover(place_of(a), place_of(b), place_of(c), facing == clockwise ? 1 : -1, place)) return std::nullopt;
    const Occluder triangle = occluder_of(screen_, s, number);
    return triangle.covers(place) ? std::optional(triangle) : std::nullopt;
}

/// Where a line comes nearest to the plane of `t`, if it is level with it there.
std::optional<glm::dvec2> Contacts::touching_place(const WholeLine& line, double begin, double end, const Occluder& t,
                                                   double level) const {
    const auto gap_at = [&](double part) { return std::abs(t.nearness_at(line.at(part)) - line.nearness_at(part)); };
    const double at_begin = gap_at(begin), at_end = gap_at(end);
    if (std::min(at_begin, at_end) > level) return std::nullopt;
    return line.at(at_begin < at_end ? begin : end);
}

/// A place on a triangle at a line, beside a place on the line. Nothing if the triangle is seen edge-on.
std::optional<glm::dvec2> Contacts::place_beside(SurfaceId s, std::uint32_t owner, glm::dvec2 at) const {
    if (screen_.facing(owner) == edge_on) return std::nullopt;
    const auto centre = centre_of(s, owner);
    if (!centre) return std::nullopt;
    const glm::dvec2 inward = *centre - at;
    return at + inward * std::min(1.0, kBesideSubpixels / glm::length(inward));
}

bool Contacts::have_vertex_in_common(SurfaceId s, const Occluder& t) const {
    if (s.instance != t.instance) return false;
    const auto& v = screen_.surfaces().mesh_of(s).triangles[s.triangle];
    return std::find_first_of(v.begin(), v.end(), t.vertices.begin(), t.vertices.end()) != v.end();
}

/// Whether `one` is seen where `other` lies at about its depth, nearer by `gap` than that. Of neighbours that have no
/// more than slivers in common each is, whichever comes first.
bool Contacts::is_seen_first(std::uint32_t one, std::uint32_t other, double gap) const {
    const SurfaceOrder order = screen_.surfaces().order(screen_.surface_of(one), screen_.surface_of(other));
    if (!order.have_common_place) return true;
    return order.are_coincident() ? one < other : order.is_in_front() || (gap > 0 && !order.is_behind());
}

/// A place within what is on the screen of a triangle.
std::optional<glm::dvec2> Contacts::centre_of(SurfaceId s, std::uint32_t number) const {
    if (screen_.facing(number) != off_screen) {
        const auto [a, b, c] = screen_.triangle(s).corners;
        return (glm::dvec2(a.x, a.y) + glm::dvec2(b.x, b.y) + glm::dvec2(c.x, c.y)) / 3.0;
    }
    const ScreenPolygon polygon = screen_.surfaces().screen_polygon(s);
    if (polygon.count == 0) return std::nullopt;
    glm::dvec2 sum(0.0);
    for (int i = 0; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        sum += glm::dvec2(p.x, p.y);
    }
    return sum / static_cast<double>(polygon.count);
}

}  // namespace burin
