#include "methods/abuffer/layer_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/parallel.h"
#include "methods/abuffer/edge_on_screen.h"
#include "methods/abuffer/fast_walk.h"
#include "methods/abuffer/fold_width.h"
#include "methods/abuffer/layer_triangle.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;
/// A triangle lower than this is a fold that is no contour (docs/conventions.md). 1/64 pixel.
constexpr double kThinSubpixels = 4;
/// Wider gaps between patches are no seams. 1 pixel.
constexpr double kWidestCrackSubpixels = 256;
/// So far beyond a wall nothing is left to be asked. Pixels.
constexpr double kPastWallPx = 1.0 / 16;
/// Where there are more on the way to a wall, it is one of very many in a pixel.
constexpr int kMostTrianglesToWall = 96;

}  // namespace

std::vector<HalfEdge> sides_of_possible_lines(const ScreenMesh& mesh, std::uint32_t begin, std::uint32_t end) {
    constexpr std::uint32_t kGroup = 8;
    constexpr std::uint64_t kEdges = 0x0707070707070707u;
    static_assert(std::endian::native == std::endian::little);
    std::vector<HalfEdge> sides;
    std::size_t count = 0;
    for (std::uint32_t first = begin; first < end; first += kGroup) {
        std::uint64_t edges = 0;  // a byte for each triangle
        std::memcpy(&edges, mesh.line_edges + first, std::min(kGroup, end - first));
        if (sides.size() < count + 3 * kGroup) sides.resize(2 * count + 3 * kGroup);
        for (edges &= kEdges; edges != 0; edges &= edges - 1) {  // without other branches: they would be guesses
            const auto bit = static_cast<unsigned>(std::countr_zero(edges));
            const std::uint32_t t = first + bit / 8;
            const bool is_found_from_behind = rank_of_side(mesh.facing[t]) == 2 && mesh.sharp != nullptr && mesh.sharp[t] == 0;
            sides[count] = 3 * t + bit % 8;
            count += is_found_from_behind ? 0 : 1;
        }
    }
    sides.resize(count);
    return sides;
}

class LayerEdgeFinder::Rules {
  public:
    Rules(const Frame& frame, const ScreenSurfaces& screen, PixelRect region, bool has_both_of_seam)
        : surfaces_(frame.surfaces),
          criteria_(frame.criteria),
          fade_(frame.scene->lines.crease_fade()),
          screen_(screen),
          has_both_of_seam_(has_both_of_seam),
          low_(glm::dvec2(region.x0, region.y0) * 256.0),
          high_(glm::dvec2(region.x1, region.y1) * 256.0) {}

    void visit(SurfaceId s, HalfEdge h, std::vector<LayerLine>& lines) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const HalfEdge g = mesh.next_on_edge[h];
        if (g == h) {
            visit_border(s, h, lines);
        } else if (mesh.next_on_edge[g] == h) {
            visit_pair(s, h, g, lines);
        } else {
            visit_ring(s, h, lines);
        }
    }

    std::optional<SurfaceId> solid_at_border(SurfaceId s, HalfEdge h) const {
        const auto solid = past_sliver(s.instance, h);
        if (!solid) return std::nullopt;
        return triangle_of(s, *solid);
    }

  private:
    SurfaceId triangle_of(SurfaceId s, HalfEdge h) const { return {s.instance, h / 3}; }
    std::uint32_t start_of(const Mesh& mesh, HalfEdge h) const { return mesh.triangles[h / 3][h % 3]; }
    std::uint32_t end_of(const Mesh& mesh, HalfEdge h) const { return mesh.triangles[h / 3][(h + 1) % 3]; }
    std::uint32_t apex_of(const Mesh& mesh, HalfEdge h) const { return mesh.triangles[h / 3][(h + 2) % 3]; }

    bool is_on_screen(std::uint32_t instance, std::uint32_t vertex) const {
        return screen_.vertices(instance)[vertex].x != ScreenVertex::kOffScreen;
    }

    /// The longest edge of a triangle that is lower than a negligible fold.
    std::optional<HalfEdge> base_of_thin(SurfaceId s) const {
        const auto& t = surfaces_.mesh_of(s).triangles[s.triangle];
        const ScreenVertex* const v = screen_.vertices(s.instance);
        double squares[3];
        for (unsigned k = 0; k < 3; ++k) {
            const ScreenVertex &a = v[t[k]], &b = v[t[(k + 1) % 3]];
            if (a.x == ScreenVertex::kOffScreen) return std::nullopt;
            const double dx = static_cast<double>(b.x) - a.x, dy = static_cast<double>(b.y) - a.y;
            squares[k] = dx * dx + dy * dy;
        }
        const double longest = std::max(squares[0], std::max(squares[1], squares[2]));
        const auto area = static_cast<double>(doubled_area(v[t[0]], v[t[1]], v[t[2]]));
        if (area * area >= kThinSubpixels * kThinSubpixels * longest) return std::nullopt;
        unsigned base = 0;
        while (squares[base] != longest) ++base;
        return 3 * s.triangle + base;
    }

    HalfEdge longer_of_others(std::uint32_t instance, HalfEdge h) const {
        const Mesh& mesh = *surfaces_.instances[instance].mesh;
        const ScreenVertex* const v = screen_.vertices(instance);
        const HalfEdge one = h - h % 3 + (h + 1) % 3, two = h - h % 3 + (h + 2) % 3;
        const auto square = [&](HalfEdge e) {
            const ScreenVertex &a = v[start_of(mesh, e)], &b = v[end_of(mesh, e)];
            const double dx = static_cast<double>(b.x) - a.x, dy = static_cast<double>(b.y) - a.y;
            return dx * dx + dy * dy;
        };
        return square(two) > square(one) ? two : one;
    }

    /// Whether the triangles of two half-edges of one edge face the eye alike, whichever way they are wound.
    bool face_alike(std::uint32_t instance, HalfEdge h, HalfEdge g) const {
        const Mesh& mesh = *surfaces_.instances[instance].mesh;
        const Facing a = screen_.facing(screen_.number_of({instance, h / 3})), b = screen_.facing(screen_.number_of({instance, g / 3}));
        const bool are_wound_alike = start_of(mesh, h) != start_of(mesh, g), has_side = b == clockwise || b == counterclockwise;
        if (are_wound_alike || !has_side) return a == b;
        return a == (b == clockwise ? counterclockwise : clockwise);
    }

    /// The triangle that counts at an edge: behind thin triangles the next one. Nothing at a thin
    /// triangle's longest edge, if the two others stand for it: they do not where what lies behind faces alike.
    std::optional<HalfEdge> solid_behind(std::uint32_t instance, HalfEdge h) const {
        const Mesh& mesh = *surfaces_.instances[instance].mesh;
        for (int step = 0; step < kMostSlivers; ++step) {
            const auto base = base_of_thin({instance, h / 3});
            if (!base) return h;
            const HalfEdge exit = *base == h ? longer_of_others(instance, h) : *base;
            const HalfEdge g = mesh.next_on_edge[exit];
            const bool is_pair = g != exit && mesh.next_on_edge[g] == exit;
            if (*base == h && step == 0 && !(is_pair && face_alike(instance, exit, g))) return std::nullopt;
            if (!is_pair) return h;
            h = g;
        }
        return h;
    }

    /// The side of the triangle at `h`, with its edge taken in the direction of a to b.
    int side_at(std::uint32_t instance, HalfEdge h, std::uint32_t a, std::uint32_t b) const {
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

    /// Whether the surface ends for the eye at half-edge h, with a wall beyond it that is seen edge-on: where it goes
    /// on behind the wall, that lies deeper, or turns back.
    bool ends_at_wall(std::uint32_t instance, HalfEdge h, HalfEdge beyond) const {
        const SurfaceId own{instance, h / 3};
        const auto has_side = [](Facing facing) { return facing == clockwise || facing == counterclockwise; };
        if (screen_.facing(screen_.number_of({instance, beyond / 3})) != edge_on ||
            !has_side(screen_.facing(screen_.number_of(own)))) {
            return false;
        }
        const Mesh& mesh = surfaces_.mesh_of(own);
        const ScreenVertex* const v = screen_.vertices(instance);
        const auto place = [&](std::uint32_t vertex) { return glm::dvec2(v[vertex].x, v[vertex].y) / double{kSubpixelsPerPixel}; };
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
        const SurfaceWalk walk = walk_surface(surfaces_, own, middle - past, middle + past, criteria_, kMostTrianglesToWall);
        // Where it turns back behind the wall, it gets farthest anywhere on that.
        constexpr double kMiddle = 0.5;
        return walk.end == WalkEnd::fold && std::abs(walk.fraction - kMiddle) <= kNoAdvance;
    }

    /// Of an edge so short that its middle stands for all of it.
    bool is_negligible_fold(std::uint32_t instance, HalfEdge h) const {
        const ScreenMesh mesh = screen_.mesh(instance);
        const ScreenVertex &a = mesh.vertices[mesh.corners[h]], &b = mesh.vertices[mesh.corners[h - h % 3 + (h + 1) % 3]];
        if (a.x == ScreenVertex::kOffScreen || b.x == ScreenVertex::kOffScreen) return false;
        const glm::dvec2 from(a.x, a.y), to(b.x, b.y);
        if (glm::distance(from, to) > kSubpixelsPerPixel) return false;
        const double nearness = 0.5 * (static_cast<double>(a.nearness) + static_cast<double>(b.nearness));
        return !is_fold_wide(mesh, h, 0.5 * (from + to), nearness, 32 * level_slack(surfaces_, nearness));
    }

    void visit_pair(SurfaceId s, HalfEdge h, HalfEdge g, std::vector<LayerLine>& lines) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const auto solid_h = solid_behind(s.instance, h), solid_g = solid_behind(s.instance, g);
        LineClassSet classes;
        double crease_cosine = 1;
        if (mesh.is_marked(h)) classes |= LineClass::mark;
        if (solid_h && solid_g) {
            const std::uint32_t a = start_of(mesh, h), b = end_of(mesh, h);
            const int side_h = side_at(s.instance, *solid_h, a, b), side_g = side_at(s.instance, *solid_g, a, b);
            const bool is_past_sliver = *solid_h != h || *solid_g != g;
            if (side_h != 0 && side_h == side_g && !(is_past_sliver && is_negligible_fold(s.instance, h))) classes |= LineClass::silhouette;
        }
        if (!classes.has(LineClass::silhouette) && (ends_at_wall(s.instance, h, g) || ends_at_wall(s.instance, g, h))) {
            classes |= LineClass::silhouette;
        }
        if (!is_sliver_at(s, h) && !is_sliver_at(s, g)) {
            const std::uint8_t* const sharp = screen_.sharp_edges(s.instance);
            const bool may_have_any = sharp == nullptr || (sharp[h / 3] >> h % 3 & 1) != 0;
            if (may_have_any) classes |= edge_classes(surfaces_, {s, h}, criteria_, &crease_cosine);
        } else if (solid_h && solid_g) {
            classes |= contact_classes(surfaces_, triangle_of(s, *solid_h), triangle_of(s, *solid_g),
                                       middle_px(s, h), criteria_, &crease_cosine);
        }
        add(s, h, classes, crease_cosine, {screen_.number_of(s), screen_.number_of(triangle_of(s, g))}, false, lines);
    }

    /// Of a border: the half-edge itself, or that of the triangle behind its sliver, whose normal says nothing. Nothing if there
    /// is none: a needle that stands by itself or on an edge of others is no surface.
    std::optional<HalfEdge> past_sliver(std::uint32_t instance, HalfEdge h) const {
        const Mesh& mesh = *surfaces_.instances[instance].mesh;
        for (int step = 0; step < kMostSlivers; ++step) {
            if (!is_sliver_at({instance, h / 3}, h)) return h;
            const auto base = base_of_thin({instance, h / 3});
            if (!base) return h;
            const HalfEdge exit = *base == h ? longer_of_others(instance, h) : *base, g = mesh.next_on_edge[exit];
            if (g == exit || mesh.next_on_edge[g] != exit) return std::nullopt;
            h = g;
        }
        return h;
    }

    /// A sliver on an edge where two surfaces or more meet without it: nothing ends at its borders.
    bool is_needle_on_edge(SurfaceId s, HalfEdge h) const {
        if (!is_sliver_at(s, h)) return false;
        const Mesh& mesh = surfaces_.mesh_of(s);
        const auto base = base_of_thin(s);
        if (!base) return false;
        int solids = 0;
        for (HalfEdge g = mesh.next_on_edge[*base]; g != *base; g = mesh.next_on_edge[g]) {
            if (!is_sliver_at(triangle_of(s, g), g)) ++solids;
        }
        return solids > 1;
    }

    /// Most triangles are none in any view.
    bool is_sliver_at(SurfaceId s, HalfEdge h) const {
        return !FastWalker::is_surely_solid(screen_.mesh(s.instance), h / 3) && is_sliver(surfaces_, triangle_of(s, h));
    }

    /// Where more than two triangles meet, those that are in front on either side of the edge make the line, as walks over it
    /// take them: bodies that stand flush have none on their common face.
    void visit_ring(SurfaceId s, HalfEdge h, std::vector<LayerLine>& lines) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const std::uint32_t a = start_of(mesh, h), b = end_of(mesh, h);
        struct Front {
            HalfEdge half_edge = kNoHalfEdge;
            double towards_eye = 0;
        };
        Front fronts[2], edge_on;
        LineClassSet classes;
        for (HalfEdge g = h;;) {
            if (g < h) return;  // the first one of the ring stands for it
            if (mesh.is_marked(g)) classes |= LineClass::mark;
            if (!is_sliver_at(triangle_of(s, g), g)) {  // a needle is nothing that ends there
                const int side = side_at(s.instance, g, a, b);
                const double towards_eye = cosine_to_eye(s.instance, g);
                Front& front = side == 0 ? edge_on : fronts[side > 0 ? 1 : 0];
                if (front.half_edge == kNoHalfEdge || towards_eye > front.towards_eye) front = {g, towards_eye};
            }
            g = mesh.next_on_edge[g];
            if (g == h) break;
        }
        double crease_cosine = 1;
        if (fronts[0].half_edge != kNoHalfEdge && fronts[1].half_edge != kNoHalfEdge) {
            classes |= contact_classes(surfaces_, triangle_of(s, fronts[0].half_edge), triangle_of(s, fronts[1].half_edge),
                                       middle_px(s, h), criteria_, &crease_cosine);
        } else {
            classes |= edge_classes(surfaces_, {s, h}, criteria_, &crease_cosine);
            if (fronts[0].half_edge != fronts[1].half_edge) classes |= LineClass::silhouette;
        }
        // A wall that is seen edge-on and rises towards the eye is in front on one side or the other.
        for (const Front& front : fronts) {
            if (front.half_edge == kNoHalfEdge || edge_on.half_edge == kNoHalfEdge || edge_on.towards_eye <= 0) continue;
            const double cosine = -glm::dot(across_edge(s.instance, front.half_edge), across_edge(s.instance, edge_on.half_edge));
            if (cosine >= criteria_.cos_crease_angle) continue;
            classes |= LineClass::crease;
            crease_cosine = std::min(crease_cosine, cosine);
        }
        const std::uint32_t number = screen_.number_of(s);
        add(s, h, classes, crease_cosine, {number, number}, true, lines);
    }

    /// From an edge into its triangle, in view space: a unit vector.
    glm::dvec3 across_edge(std::uint32_t instance, HalfEdge h) const {
        const Mesh& mesh = surfaces_.mesh_of({instance, h / 3});
        const glm::dvec3 p = surfaces_.view_position(instance, start_of(mesh, h));
        const glm::dvec3 along = surfaces_.view_position(instance, end_of(mesh, h)) - p, v = surfaces_.view_position(instance, apex_of(mesh, h)) - p;
        const glm::dvec3 across = v - along * (glm::dot(v, along) / glm::dot(along, along));
        return across / std::max(glm::length(across), 1e-300);
    }

    /// Of the angle at an edge between its triangle and the way to the eye: of several triangles on one side, the greatest is
    /// the one in front.
    double cosine_to_eye(std::uint32_t instance, HalfEdge h) const {
        const Mesh& mesh = *surfaces_.instances[instance].mesh;
        const glm::dvec3 p = surfaces_.view_position(instance, start_of(mesh, h));
        const glm::dvec3 along = surfaces_.view_position(instance, end_of(mesh, h)) - p;
        const glm::dvec3 v = surfaces_.projection.orthographic ? glm::dvec3(0, 0, 1) : -p;
        const glm::dvec3 to_eye = v - along * (glm::dot(v, along) / glm::dot(along, along));
        return glm::dot(across_edge(instance, h), to_eye) / std::max(glm::length(to_eye), 1e-300);
    }

    /// A part of a border, as shares of edge_on_screen() from its start, and what runs along it.
    struct BorderPart {
        double begin = 0, end = 1;
        std::optional<HalfEdge> partner;
    };

    void visit_border(SurfaceId s, HalfEdge h, std::vector<LayerLine>& lines) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        if (!mesh.is_marked(h) && is_needle_on_edge(s, h)) return;
        const auto edge = edge_on_screen(screen_, s.instance, start_of(mesh, h), end_of(mesh, h));
        if (!edge) return;
        for (const BorderPart& part : parts_of_border(s, h, *edge)) visit_border_part(s, h, *edge, part, lines);
    }

    void visit_border_part(SurfaceId s, HalfEdge h, const EdgeOnScreen& edge, const BorderPart& part, std::vector<LayerLine>& lines) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        LineClassSet classes;
        double crease_cosine = 1;
        if (mesh.is_marked(h)) classes |= LineClass::mark;
        const std::uint32_t number = screen_.number_of(s);
        std::array<std::uint32_t, 2> owners{number, number};
        if (part.partner) {
            const SurfaceId beyond = triangle_of(s, *part.partner);
            const std::uint32_t a = start_of(mesh, h), b = end_of(mesh, h);
            const auto solid_h = past_sliver(s.instance, h), solid_g = past_sliver(s.instance, *part.partner);
            const auto side_of = [&](HalfEdge e, const std::optional<HalfEdge>& solid) {
                if (!solid) return 0;
                return *solid == e ? side_of_edge(screen_, s.instance, a, b, apex_of(mesh, e)) : side_at(s.instance, *solid, a, b);
            };
            const int side_h = side_of(h, solid_h), side_g = side_of(*part.partner, solid_g);
            if (side_h != 0 && side_h == side_g) {
                classes |= LineClass::silhouette;  // one lies on the other, and may hide it
            } else {
                const double own = length_of(mesh, h), other = length_of(mesh, *part.partner);
                const bool is_drawn_as_partner = own < other || (own == other && *part.partner < h);
                if (!has_both_of_seam_ && classes.empty() && is_drawn_as_partner) return;
                owners[1] = screen_.number_of(beyond);
            }
            if (solid_h && solid_g) {
                const glm::dvec2 middle = edge.at(0.5 * (part.begin + part.end)) / double{kSubpixelsPerPixel};
                classes |= contact_classes(surfaces_, triangle_of(s, *solid_h), triangle_of(s, *solid_g), middle, criteria_, &crease_cosine);
            }
        } else {
            classes |= LineClass::border;
        }
        const std::size_t count = lines.size();
        add(s, h, classes, crease_cosine, owners, false, lines);
        if (lines.size() == count || (part.begin == 0 && part.end == 1)) return;
        const bool is_reversed = start_of(mesh, h) > end_of(mesh, h);
        cut(lines.back(), is_reversed ? 1 - part.end : part.begin, is_reversed ? 1 - part.begin : part.end);
    }

    static void cut(LayerLine& line, double begin, double end) {
        const LayerLine whole = line;
        line.edge_begin = begin;
        line.edge_end = end;
        if (begin > 0) {
            line.from = glm::mix(whole.from, whole.to, begin);
            line.nearness_from = whole.nearness_at(begin);
            line.nodes[0] = LayerLine::kNoNode;
        }
        if (end < 1) {
            line.to = glm::mix(whole.from, whole.to, end);
            line.nearness_to = whole.nearness_at(end);
            line.nodes[1] = LayerLine::kNoNode;
        }
    }

    /// Where other patches begin and end beside a border, what runs along it may change.
    std::vector<BorderPart> parts_of_border(SurfaceId s, HalfEdge h, const EdgeOnScreen& edge) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        BorderIndex::SeamCandidates candidates;
        mesh.borders.find_candidates(h, candidates);
        if (candidates.segments().empty()) return {{}};
        const glm::dvec3 a(mesh.positions[start_of(mesh, h)]), along = glm::dvec3(mesh.positions[end_of(mesh, h)]) - a;
        const double square = glm::dot(along, along);
        std::vector<double> ends;
        bool has_crack = false;
        for (const BorderIndex::Segment& other : candidates.segments()) {
            if (!is_crack_beside(s.instance, edge, other.half_edge)) continue;
            has_crack = true;
            for (const glm::vec3& end : {other.a, other.b}) {
                const double in_space = glm::dot(glm::dvec3(end) - a, along) / square;
                if (in_space > edge.begin && in_space < edge.end) ends.push_back(share_on_screen(screen_, edge, in_space));
            }
        }
        if (!has_crack) return {{}};
        std::sort(ends.begin(), ends.end());
        const double shortest = kWidestCrackSubpixels / glm::distance(edge.from, edge.to);  // a crack is no part of its own
        std::vector<BorderPart> parts;
        const auto add_part = [&](double begin, double end) {
            const auto partner = seam_partner(s, h, edge, candidates, 0.5 * (begin + end));
            if (!parts.empty() && parts.back().partner == partner) {
                parts.back().end = end;
            } else {
                parts.push_back({begin, end, partner});
            }
        };
        double begin = 0;
        for (const double end : ends) {
            if (end - begin <= shortest || 1 - end <= shortest) continue;
            add_part(begin, end);
            begin = end;
        }
        add_part(begin, 1);
        return parts;
    }

    /// Whether another border is nearer than a crack is wide, somewhere on the screen; true also for some that are not.
    bool is_crack_beside(std::uint32_t instance, const EdgeOnScreen& edge, HalfEdge h) const {
        const Mesh& mesh = *surfaces_.instances[instance].mesh;
        const auto other = edge_on_screen(screen_, instance, start_of(mesh, h), end_of(mesh, h));
        if (!other) return false;
        const double length = glm::distance(edge.from, edge.to), p = edge.side_of(other->from), q = edge.side_of(other->to);
        const bool is_beyond = std::min(std::abs(p), std::abs(q)) > kWidestCrackSubpixels * length && (p < 0) == (q < 0);
        return !is_beyond;
    }

    double length_of(const Mesh& mesh, HalfEdge h) const {
        return glm::distance(glm::dvec3(mesh.positions[start_of(mesh, h)]),
                             glm::dvec3(mesh.positions[end_of(mesh, h)]));
    }

    /// The border of another patch that runs along, nearer than a pixel and level, at a share of edge_on_screen().
    std::optional<HalfEdge> seam_partner(SurfaceId s, HalfEdge h, const EdgeOnScreen& edge,
                                         const BorderIndex::SeamCandidates& candidates, double on_screen) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const glm::dvec3 a(mesh.positions[start_of(mesh, h)]), b(mesh.positions[end_of(mesh, h)]);
        const auto partner = candidates.nearest(glm::mix(a, b, share_in_space(screen_, edge, on_screen)));
        if (!partner) return std::nullopt;
        const auto other = edge_on_screen(screen_, s.instance, start_of(mesh, *partner), end_of(mesh, *partner));
        if (!other) return std::nullopt;
        const glm::dvec2 place = edge.at(on_screen);
        const glm::dvec2 p = other->from, along = other->to - p;
        const double square = glm::dot(along, along);
        const double t = square > 0 ? std::clamp(glm::dot(place - p, along) / square, 0.0, 1.0) : 0.0;
        if (glm::distance(place, p + along * t) > kWidestCrackSubpixels) return std::nullopt;
        const double own_nearness = edge.nearness_at(on_screen);
        const SurfaceId beyond = triangle_of(s, *partner);
        if (!is_level(own_nearness, other->nearness_at(t), beyond) &&
            !is_level(own_nearness, surfaces_.plane(beyond).nearness(place / double{kSubpixelsPerPixel}) - surfaces_.farthest_nearness, beyond)) {
            return std::nullopt;  // it lies before or behind, as a stair's next tread does
        }
        return partner;
    }

    /// As walks over a seam ask it.
    bool is_level(double nearness_a, double nearness_b, SurfaceId steep) const {
        const auto distance = [&](double nearness) {
            return distance_of(surfaces_.projection, surfaces_.farthest_nearness + nearness);
        };
        const double a = distance(nearness_a);
        return std::abs(a - distance(nearness_b)) <= depth_tolerance(surfaces_, a, surfaces_.plane(steep));
    }

    glm::dvec2 middle_px(SurfaceId s, HalfEdge h) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const auto ends = edge_on_screen(screen_, s.instance, start_of(mesh, h), end_of(mesh, h));
        return ends ? ends->at(0.5) / double{kSubpixelsPerPixel} : glm::dvec2(0.0);
    }

    void add(SurfaceId s, HalfEdge h, LineClassSet classes, double crease_cosine,
             std::array<std::uint32_t, 2> owners, bool has_more, std::vector<LayerLine>& lines) const {
        classes = classes & criteria_.classes;
        if (classes.empty()) return;
        const std::uint8_t opacity = fade_.opacity(classes, crease_cosine);
        if (opacity == 0) return;
        const Mesh& mesh = surfaces_.mesh_of(s);
        // One direction, whichever triangle asks.
        const std::uint32_t a = std::min(start_of(mesh, h), end_of(mesh, h));
        const std::uint32_t b = std::max(start_of(mesh, h), end_of(mesh, h));
        const auto ends = edge_on_screen(screen_, s.instance, a, b);
        if (!ends) return;
        LayerLine line;
        line.from = ends->from;
        line.to = ends->to;
        const glm::dvec2 low = glm::min(line.from, line.to), high = glm::max(line.from, line.to);
        if (line.from == line.to || high.x < low_.x || high.y < low_.y || low.x > high_.x || low.y > high_.y) return;
        line.nearness_from = ends->nearness_from;
        line.nearness_to = ends->nearness_to;
        line.owners = owners;
        line.has_more_owners = has_more;
        line.classes = classes;
        line.drawn_as = *classes.first();
        line.opacity = opacity;
        line.line_key = std::uint64_t{s.instance} << 32 | std::min(h, mesh.next_on_edge[h]);
        if (is_on_screen(s.instance, a)) line.nodes[0] = std::uint64_t{s.instance} << 32 | a;
        if (is_on_screen(s.instance, b)) line.nodes[1] = std::uint64_t{s.instance} << 32 | b;
        lines.push_back(line);
    }

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    CreaseFade fade_;
    const ScreenSurfaces& screen_;
    bool has_both_of_seam_;
    glm::dvec2 low_, high_;
};

LayerEdgeFinder::LayerEdgeFinder(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                                 bool has_both_of_seam)
    : rules_(std::make_unique<const Rules>(frame, screen, region, has_both_of_seam)) {}

LayerEdgeFinder::~LayerEdgeFinder() = default;

void LayerEdgeFinder::find(SurfaceId s, HalfEdge h, std::vector<LayerLine>& lines) const { rules_->visit(s, h, lines); }

std::optional<SurfaceId> LayerEdgeFinder::solid_at_border(SurfaceId s, HalfEdge h) const { return rules_->solid_at_border(s, h); }

std::vector<LayerLine> find_layer_edges(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                                        int threads) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    const LayerEdgeFinder finder(frame, screen, region);
    std::vector<std::vector<LayerLine>> found(chunks.size());
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) {
        for_possible_lines(screen, chunks[c], [&](SurfaceId s, HalfEdge h) { finder.find(s, h, found[c]); });
    });
    std::vector<LayerLine> lines;
    for (const auto& list : found) lines.insert(lines.end(), list.begin(), list.end());
    return lines;
}

}  // namespace burin
