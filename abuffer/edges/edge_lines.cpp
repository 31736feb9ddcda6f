#include "abuffer/edges/edge_lines.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "abuffer/edges/border_parts.h"
#include "abuffer/edges/edge_sides.h"
#include "abuffer/edges/fold_width.h"
#include "abuffer/screen/edge_on_screen.h"
#include "base/parallel.h"
#include "base/unfilled_vector.h"

namespace burin {
namespace {

/// Prefetches the vertices of both triangles at an edge.
void ask_for_vertices(const ScreenMesh& mesh, HalfEdge h) {
    for (const HalfEdge side : {h, mesh.partners[h]}) {
        const std::uint32_t* const corners = mesh.corners + (side - side % 3);
        for (std::size_t k = 0; k < 3; ++k) __builtin_prefetch(mesh.vertices + corners[k]);
    }
}

/// A contour is found from the side that comes first in this order, so that half of a surface without sharp edges need
/// not be read.
constexpr unsigned rank_of_side(std::uint8_t facing) {
    constexpr unsigned kRanks = 1 << 2 * counterclockwise | 2 << 2 * clockwise;
    return kRanks >> 2 * facing & 3;
}

/// The sides of edges of some triangles that may be lines in this view: that are sharp, or whose triangles do not face
/// one way. One side of a contour may be missing. The facing of all triangles must be known. Returns how many there
/// are, the first ones of `sides`.
std::size_t find_sides_of_possible_lines(const ScreenMesh& mesh, std::uint32_t begin, std::uint32_t end,
                                         UnfilledVector<HalfEdge>& sides) {
    constexpr std::uint32_t kGroup = 64, kWord = 8;
    constexpr std::uint64_t kFirstEdges = 0x0101010101010101u, kToOneByte = 0x0102040810204080u;
    static_assert(std::endian::native == std::endian::little);
    std::size_t count = 0;
    const bool has_sharp = mesh.sharp != nullptr;
    const std::uint8_t* const sharp = has_sharp ? mesh.sharp : mesh.line_edges;
    for (std::uint32_t first = begin; first < end; first += kGroup) {
        std::uint8_t edges_of[kGroup] = {};
        const std::uint8_t* own = mesh.line_edges + first;
        if (end - first < kGroup) own = std::copy(own, own + (end - first), edges_of) - (end - first);
        std::uint64_t with_edges = 0;  // a bit for each triangle
        for (std::uint32_t k = 0; k < kGroup; k += kWord) {
            std::uint64_t edges;  // a byte for each
            std::memcpy(&edges, own + k, sizeof edges);
            const std::uint64_t has_any = (edges | edges >> 1 | edges >> 2) & kFirstEdges;
            with_edges |= (has_any * kToOneByte >> 56) << k;
        }
        if (sides.size() < count + 3 * kGroup) sides.resize(2 * count + 3 * kGroup);
        for (; with_edges != 0; with_edges &= with_edges - 1) {  // without other branches, which would be unpredictable
            const std::uint32_t t = first + static_cast<std::uint32_t>(std::countr_zero(with_edges));
            const bool is_found_from_behind = has_sharp & (rank_of_side(mesh.facing[t]) == 2) & (sharp[t] == 0);
            const unsigned edges = mesh.line_edges[t] & (is_found_from_behind - 1u);
            for (unsigned k = 0; k < 3; ++k) {
                sides[count] = 3 * t + k;
                count += edges >> k & 1;
            }
        }
    }
    return count;
}

/// `sides`: used for each call.
std::vector<HalfEdge> possible_lines(const ScreenMesh& mesh, std::uint32_t begin, std::uint32_t end,
                                     UnfilledVector<HalfEdge>& sides) {
    const std::size_t side_count = find_sides_of_possible_lines(mesh, begin, end, sides);
    std::size_t count = 0;
    // What is on the other side of an edge may lie anywhere in memory.
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < side_count; ++i) {
        if (i + 2 * kAhead < side_count) __builtin_prefetch(mesh.partners + sides[i + 2 * kAhead]);
        if (i + kAhead < side_count && !is_surely_pair(mesh, sides[i + kAhead])) {
            __builtin_prefetch(mesh.partners + mesh.partners[sides[i + kAhead]]);
        }
        const HalfEdge h = sides[i], g = mesh.partners[h];
        const bool is_pair = is_surely_pair(mesh, h) || (g != h && mesh.partners[g] == h);
        const unsigned own = rank_of_side(mesh.facing[h / 3]), other = rank_of_side(mesh.facing[g / 3]);
        const bool is_found_from_other =
            is_pair & ((own > other) | ((own == other) & (g < h)));  // a branch would be unpredictable
        sides[count] = is_pair ? std::min(h, g) : h;                 // no side that is still to be looked at
        count += is_found_from_other ? 0 : 1;
    }
    return {sides.data(), sides.data() + count};
}

}  // namespace

PossibleLines::PossibleLines(const ScreenSurfaces& screen, int threads)
    : chunks(screen.chunks_of_triangles(kChunkTriangles)), edges(chunks.size()) {
    std::vector<UnfilledVector<HalfEdge>> sides(static_cast<std::size_t>(resolve_thread_count(threads)));
    parallel_for_parts(chunks.size(), threads, [&](std::size_t c, int worker) {
        edges[c] = possible_lines(screen.mesh(chunks[c].instance), chunks[c].begin, chunks[c].end,
                                  sides[static_cast<std::size_t>(worker)]);
    });
}

class EdgeLineFinder::Rules {
  public:
    Rules(const Frame& frame, const ScreenSurfaces& screen, PixelRect region, bool has_both_of_seam)
        : surfaces_(frame.surfaces),
          criteria_(frame.criteria),
          sides_(screen, frame.criteria),
          fade_(frame.scene->lines.crease_fade()),
          screen_(screen),
          has_both_of_seam_(has_both_of_seam),
          low_(to_subpixels(glm::dvec2(region.x0, region.y0))),
          high_(to_subpixels(glm::dvec2(region.x1, region.y1))) {}

    void visit(SurfaceId s, HalfEdge h, std::vector<WholeLine>& lines, bool walls) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const HalfEdge g = mesh.next_on_edge[h];
        if (g == h) {
            visit_border(s, h, lines);
        } else if (mesh.next_on_edge[g] == h) {
            visit_pair(s, h, g, lines, walls);
        } else {
            visit_ring(s, h, lines);
        }
    }

    void visit_loose(std::uint32_t instance, HalfEdge number, std::vector<WholeLine>& lines) const {
        const auto [a, b] = surfaces_.instances[instance].mesh->loose_edge(number);
        WholeLine* const line = add_on_screen(instance, ends_in_order(screen_, instance, a, b), lines);
        if (line == nullptr) return;
        line->owners = {WholeLine::kNoOwner, WholeLine::kNoOwner};
        line->classes = line->drawn_as = LineClass::mark;
        line->id = LineId::of_edge(instance, number);
    }

    std::optional<SurfaceId> solid_at_border(SurfaceId s, HalfEdge h) const {
        const auto solid = sides_.past_sliver(s.instance, h);
        if (!solid) return std::nullopt;
        return triangle_of(s, *solid);
    }

  private:
    SurfaceId triangle_of(SurfaceId s, HalfEdge h) const { return {s.instance, h / 3}; }
    bool is_on_screen(std::uint32_t instance, std::uint32_t vertex) const {
        return screen_.vertices(instance)[vertex].x != ScreenVertex::kOffScreen;
    }

    void visit_pair(SurfaceId s, HalfEdge h, HalfEdge g, std::vector<WholeLine>& lines, bool walls) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const std::uint32_t a = start_of(mesh, h), b = end_of(mesh, h);
        LineClassSet classes;
        double crease_cosine = 1;
        int front_side = 0;
        bool is_wire = false;
        HalfEdge solid_h = h, solid_g = g;
        if (mesh.is_marked(h)) classes |= LineClass::mark;
        if (const EdgeSides::PlainPair pair = sides_.plain_pair(s.instance, h, g); pair.is_plain) {
            if (pair.side_h == pair.side_g) front_side = pair.side_h;
            if (front_side != 0) classes |= LineClass::silhouette;
        } else {
            solid_h = sides_.solid_behind(s.instance, h);
            solid_g = sides_.solid_behind(s.instance, g);
            if (solid_h != kNoHalfEdge && solid_g != kNoHalfEdge) {
                const int side_h = sides_.side_at(s.instance, solid_h, a, b),
                          side_g = sides_.side_at(s.instance, solid_g, a, b);
                const bool is_past_sliver = solid_h != h || solid_g != g;
                if (side_h != 0 && side_h == side_g && !(is_past_sliver && sides_.is_negligible_fold(s.instance, h)))
                    front_side = side_h;
            }
            if (front_side != 0) {
                classes |= LineClass::silhouette;
            } else if (const HalfEdge at_wall = walls ? half_edge_at_wall(s.instance, h, g) : kNoHalfEdge;
                       at_wall != kNoHalfEdge) {
                classes |= LineClass::silhouette;  // the wall may lie on either side, and is not in front
                front_side = sides_.side_at(s.instance, at_wall, a, b);
            }
            is_wire = sides_.is_front_of_wire(s.instance, h);
            if (is_wire) classes |= LineClass::silhouette;
        }
        if (!sides_.is_sliver_at(s, h) && !sides_.is_sliver_at(s, g)) {
            const std::uint8_t* const sharp = screen_.sharp_edges(s.instance);
            const bool may_have_any = sharp == nullptr || (sharp[h / 3] >> h % 3 & 1) != 0;
            if (may_have_any) classes |= edge_classes(surfaces_, {s, h}, criteria_, &crease_cosine);
        } else if (solid_h != kNoHalfEdge && solid_g != kNoHalfEdge) {
            classes |= contact_classes(surfaces_, triangle_of(s, solid_h), triangle_of(s, solid_g), middle_px(s, h),
                                       criteria_, &crease_cosine);
        }
        add(s, h, classes, crease_cosine, {screen_.number_of(s), screen_.number_of(triangle_of(s, g))}, false,
            front_side, lines, is_wire);
    }

    /// The half-edge whose surface ends at a wall that begins behind the other.
    HalfEdge half_edge_at_wall(std::uint32_t instance, HalfEdge h, HalfEdge g) const {
        return sides_.ends_at_wall(instance, h, g) ? h : sides_.ends_at_wall(instance, g, h) ? g : kNoHalfEdge;
    }

    /// Where more than two triangles meet, those that are in front on either side of the edge make the line, as walks
    /// over it take them: bodies that stand flush have none on their common face.
    void visit_ring(SurfaceId s, HalfEdge h, std::vector<WholeLine>& lines) const {
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
            if (!sides_.is_sliver_at(triangle_of(s, g), g)) {  // a needle is nothing that ends there
                const int side = sides_.side_at(s.instance, g, a, b);
                const double towards_eye = sides_.cosine_to_eye(s.instance, g);
                Front& front = side == 0 ? edge_on : fronts[side > 0 ? 1 : 0];
                if (front.half_edge == kNoHalfEdge || towards_eye > front.towards_eye) front = {g, towards_eye};
            }
            g = mesh.next_on_edge[g];
            if (g == h) break;
        }
        double crease_cosine = 1;
        if (fronts[0].half_edge != kNoHalfEdge && fronts[1].half_edge != kNoHalfEdge) {
            classes |= contact_classes(surfaces_, triangle_of(s, fronts[0].half_edge),
                                       triangle_of(s, fronts[1].half_edge), middle_px(s, h), criteria_, &crease_cosine);
        } else {
            classes |= edge_classes(surfaces_, {s, h}, criteria_, &crease_cosine);
            if (fronts[0].half_edge != fronts[1].half_edge) classes |= LineClass::silhouette;
        }
        // A wall that is seen edge-on and rises towards the eye is in front on one side or the other.
        for (const Front& front : fronts) {
            if (front.half_edge == kNoHalfEdge || edge_on.half_edge == kNoHalfEdge || edge_on.towards_eye <= 0)
                continue;
            const double cosine = -glm::dot(sides_.across_edge(s.instance, front.half_edge),
                                            sides_.across_edge(s.instance, edge_on.half_edge));
            add_angle_classes(cosine, criteria_, classes, &crease_cosine);
        }
        const std::uint32_t number = screen_.number_of(s);
        add(s, h, classes, crease_cosine, {number, number}, true, 0, lines);
    }

    void visit_border(SurfaceId s, HalfEdge h, std::vector<WholeLine>& lines) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        if (!mesh.is_marked(h) && sides_.is_needle_on_edge(s, h)) return;
        const auto edge = edge_on_screen(screen_, s.instance, start_of(mesh, h), end_of(mesh, h));
        if (!edge) return;
        for (const BorderPart& part : parts_of_border(screen_, s, h, *edge))
            visit_border_part(s, h, *edge, part, lines);
    }

    void visit_border_part(SurfaceId s, HalfEdge h, const EdgeOnScreen& edge, const BorderPart& part,
                           std::vector<WholeLine>& lines) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        LineClassSet classes;
        double crease_cosine = 1;
        int front_side = 0;
        if (mesh.is_marked(h)) classes |= LineClass::mark;
        const std::uint32_t number = screen_.number_of(s);
        std::array<std::uint32_t, 2> owners{number, number};
        // Both borders of one narrow strip are no crack.
        const bool is_strip =
            part.partner &&
            other_side_of_strip(screen_.mesh(s.instance), h, edge.at(0.5 * (part.begin + part.end))) == *part.partner;
        if (part.partner && !is_strip) {
            const SurfaceId beyond = triangle_of(s, *part.partner);
            const std::uint32_t a = start_of(mesh, h), b = end_of(mesh, h);
            auto solid_h = sides_.past_sliver(s.instance, h), solid_g = sides_.past_sliver(s.instance, *part.partner);
            if (solid_h && solid_g && sides_.are_neighbours(s.instance, *solid_h, *solid_g)) {
                // The two borders are sides of one narrow strip, which ends here all the same.
                solid_h = h;
                solid_g = part.partner;
            }
            const auto side_of = [&](HalfEdge e, const std::optional<HalfEdge>& solid) {
                if (!solid) return 0;
                return *solid == e ? side_of_edge(screen_, s.instance, a, b, apex_of(mesh, e))
                                   : sides_.side_at(s.instance, *solid, a, b);
            };
            const int side_h = side_of(h, solid_h), side_g = side_of(*part.partner, solid_g);
            if (side_h != 0 && side_h == side_g) {
                classes |= LineClass::silhouette;  // one lies on the other, and may hide it
                front_side = side_h;
            } else {
                const double own = length_of(mesh, h), other = length_of(mesh, *part.partner);
                const bool is_drawn_as_partner = own < other || (own == other && *part.partner < h);
                if (!has_both_of_seam_ && classes.empty() && is_drawn_as_partner) return;
                owners[1] = screen_.number_of(beyond);
            }
            if (solid_h && solid_g) {
                const glm::dvec2 middle = to_pixels(edge.at(0.5 * (part.begin + part.end)));
                classes |= contact_classes(surfaces_, triangle_of(s, *solid_h), triangle_of(s, *solid_g), middle,
                                           criteria_, &crease_cosine);
            }
        } else {
            classes |= LineClass::border;
        }
        const std::size_t count = lines.size();
        add(s, h, classes, crease_cosine, owners, false, front_side, lines, is_strip);
        if (lines.size() == count || (part.begin == 0 && part.end == 1)) return;
        const bool is_reversed =
            ends_in_order(screen_, s.instance, start_of(mesh, h), end_of(mesh, h)).first != start_of(mesh, h);
        cut(lines.back(), is_reversed ? 1 - part.end : part.begin, is_reversed ? 1 - part.begin : part.end);
    }

    static void cut(WholeLine& line, double begin, double end) {
        const WholeLine whole = line;
        line.edge_begin = begin;
        line.edge_end = end;
        if (begin > 0) {
            line.from = whole.at(begin);
            line.nearness_from = whole.nearness_at(begin);
            line.nodes[0] = WholeLine::kNoNode;
        }
        if (end < 1) {
            line.to = whole.at(end);
            line.nearness_to = whole.nearness_at(end);
            line.nodes[1] = WholeLine::kNoNode;
        }
    }

    double length_of(const Mesh& mesh, HalfEdge h) const {
        return glm::distance(mesh.local_position(start_of(mesh, h)), mesh.local_position(end_of(mesh, h)));
    }

    glm::dvec2 middle_px(SurfaceId s, HalfEdge h) const {
        const Mesh& mesh = surfaces_.mesh_of(s);
        const auto ends = edge_on_screen(screen_, s.instance, start_of(mesh, h), end_of(mesh, h));
        return ends ? to_pixels(ends->at(0.5)) : glm::dvec2(0.0);
    }

    /// `front_side`: of the way from the half-edge's start.
    void add(SurfaceId s, HalfEdge h, LineClassSet classes, double crease_cosine, std::array<std::uint32_t, 2> owners,
             bool has_more, int front_side, std::vector<WholeLine>& lines, bool is_wire = false) const {
        classes = classes & criteria_.classes;
        if (classes.empty()) return;
        const std::uint8_t opacity = fade_.opacity(classes, crease_cosine);
        if (opacity == 0) return;
        const Mesh& mesh = surfaces_.mesh_of(s);
        // The line gets one direction, whichever triangle asks.
        const auto vertices = ends_in_order(screen_, s.instance, start_of(mesh, h), end_of(mesh, h));
        WholeLine* const added = add_on_screen(s.instance, vertices, lines);
        if (added == nullptr) return;
        WholeLine& line = *added;
        line.owners = owners;
        line.has_more_owners = has_more;
        line.is_wire = is_wire;
        line.front_side = static_cast<std::int8_t>(vertices.first == start_of(mesh, h) ? front_side : -front_side);
        line.classes = classes;
        line.drawn_as = *classes.first();
        line.opacity = opacity;
        line.id = LineId::of_edge(s.instance, std::min(h, mesh.next_on_edge[h]));
    }

    /// A line between two vertices. nullptr if it does not touch the region or is a dot.
    WholeLine* add_on_screen(std::uint32_t instance, std::pair<std::uint32_t, std::uint32_t> vertices,
                             std::vector<WholeLine>& lines) const {
        const auto [a, b] = vertices;
        const auto ends = edge_on_screen(screen_, instance, a, b);
        if (!ends) return nullptr;
        const glm::dvec2 low = glm::min(ends->from, ends->to), high = glm::max(ends->from, ends->to);
        if (ends->from == ends->to || high.x < low_.x || high.y < low_.y || low.x > high_.x || low.y > high_.y)
            return nullptr;
        WholeLine& line = lines.emplace_back();
        line.from = ends->from;
        line.to = ends->to;
        line.nearness_from = ends->nearness_from;
        line.nearness_to = ends->nearness_to;
        if (is_on_screen(instance, a)) line.nodes[0] = WholeLine::node_of_vertex(instance, a);
        if (is_on_screen(instance, b)) line.nodes[1] = WholeLine::node_of_vertex(instance, b);
        return &line;
    }

    const SurfaceSet& surfaces_;
    const LineCriteria& criteria_;
    EdgeSides sides_;
    CreaseFade fade_;
    const ScreenSurfaces& screen_;
    bool has_both_of_seam_;
    glm::dvec2 low_, high_;
};

EdgeLineFinder::EdgeLineFinder(const Frame& frame, const ScreenSurfaces& screen, PixelRect region,
                               bool has_both_of_seam)
    : rules_(std::make_unique<const Rules>(frame, screen, region, has_both_of_seam)) {}

EdgeLineFinder::~EdgeLineFinder() = default;

void EdgeLineFinder::find(SurfaceId s, HalfEdge h, std::vector<WholeLine>& lines, bool walls) const {
    rules_->visit(s, h, lines, walls);
}

void EdgeLineFinder::find_loose(std::uint32_t instance, HalfEdge number, std::vector<WholeLine>& lines) const {
    rules_->visit_loose(instance, number, lines);
}

std::optional<SurfaceId> EdgeLineFinder::solid_at_border(SurfaceId s, HalfEdge h) const {
    return rules_->solid_at_border(s, h);
}

std::vector<LooseChunk> chunks_of_loose_edges(const ScreenSurfaces& screen, LineClassSet classes) {
    std::vector<LooseChunk> chunks;
    if (!classes.has(LineClass::mark)) return chunks;
    const auto& instances = screen.surfaces().instances;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const Mesh& mesh = *instances[i].mesh;
        if (mesh.loose_edges.empty() || !screen.is_shown(i)) continue;
        const HalfEdge last = mesh.loose_number(mesh.loose_edges.size());
        for (HalfEdge first = mesh.loose_number(0); first < last; first += kChunkTriangles) {
            chunks.push_back({i, first, first + std::min(kChunkTriangles, last - first)});
            if (last - first <= kChunkTriangles) break;  // the next one may be no number
        }
    }
    return chunks;
}

std::vector<WholeLine> find_edge_lines(const Frame& frame, const ScreenSurfaces& screen, const PossibleLines& possible,
                                       PixelRect region, int threads) {
    const EdgeLineFinder finder(frame, screen, region);
    const std::vector<LooseChunk> loose = chunks_of_loose_edges(screen, frame.criteria.classes);
    std::vector<std::vector<WholeLine>> found(possible.chunks.size() + loose.size());
    parallel_for(loose.size(), threads, [&](std::size_t c, int) {
        std::vector<WholeLine>& lines = found[possible.chunks.size() + c];
        for (HalfEdge number = loose[c].begin; number < loose[c].end; ++number)
            finder.find_loose(loose[c].instance, number, lines);
    });
    parallel_for(possible.chunks.size(), threads, [&](std::size_t c, int) {
        const std::uint32_t instance = possible.chunks[c].instance;
        const ScreenMesh& mesh = screen.mesh(instance);
        const std::vector<HalfEdge>& edges = possible.edges[c];
        // Both triangles at an edge, and their corners, lie anywhere in memory.
        constexpr std::size_t kAhead = 16;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (i + kAhead < edges.size()) __builtin_prefetch(mesh.partners + edges[i + kAhead]);
            __builtin_prefetch(mesh.corners + edges[i]);
            __builtin_prefetch(mesh.corners + mesh.partners[edges[i]]);
        }
        found[c].reserve(edges.size());  // nearly all are lines
        for (std::size_t i = 0; i < edges.size() + kAhead; ++i) {
            if (i < edges.size()) ask_for_vertices(mesh, edges[i]);
            if (i >= kAhead) finder.find({instance, edges[i - kAhead] / 3}, edges[i - kAhead], found[c]);
        }
    });
    std::vector<WholeLine> lines;
    std::size_t count = 0;
    for (const auto& list : found) count += list.size();
    lines.reserve(count);
    for (const auto& list : found) lines.insert(lines.end(), list.begin(), list.end());
    return lines;
}

}  // namespace burin
