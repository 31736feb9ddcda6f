#include "abuffer/edges/intersection_lines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "lines/line_decision.h"
#include "mesh/vectors.h"
#include "view/rounded_copies.h"

namespace burin {
namespace {

constexpr std::size_t kChunkPairs = 256;

/// Names the place where an edge of one triangle passes through another one.
std::uint64_t node_of(const Occluder& edge_owner, std::size_t edge, const Occluder& other) {
    const auto mix = [](std::uint64_t h, std::uint64_t value) {  // splitmix64
        h += value + 0x9E3779B97F4A7C15u;
        h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9u;
        h = (h ^ h >> 27) * 0x94D049BB133111EBu;
        return h ^ h >> 31;
    };
    const auto [a, b] = std::minmax(edge_owner.vertices[edge], edge_owner.vertices[(edge + 1) % 3]);
    const std::uint64_t h = mix(mix(edge_owner.instance, std::uint64_t{a} << 32 | b), other.number);
    return h | std::uint64_t{1} << 63;
}

bool is_off_screen(const ScreenTriangle& t) {
    return std::any_of(std::begin(t.corners), std::end(t.corners),
                       [](const ScreenVertex& v) { return v.x == ScreenVertex::kOffScreen; });
}

/// Whether the boxes of two triangles on the screen have a place in common.
bool overlap(const ScreenTriangle& a, const ScreenTriangle& b) {
    const auto are_apart = [&](auto coordinate) {
        const auto range = [&](const ScreenTriangle& t) {
            return std::minmax({coordinate(t.corners[0]), coordinate(t.corners[1]), coordinate(t.corners[2])});
        };
        const auto [a_low, a_high] = range(a);
        const auto [b_low, b_high] = range(b);
        return a_high < b_low || b_high < a_low;
    };
    return !are_apart([](const ScreenVertex& v) { return v.x; }) &&
           !are_apart([](const ScreenVertex& v) { return v.y; }) &&
           !are_apart([](const ScreenVertex& v) { return v.nearness; });
}

}  // namespace

IntersectionLines::IntersectionLines(const Frame& frame, const ScreenSurfaces& screen, PixelRect region)
    : frame_(frame),
      screen_(screen),
      low_(to_subpixels(glm::dvec2(region.x0, region.y0))),
      high_(to_subpixels(glm::dvec2(region.x1, region.y1))) {}

bool IntersectionLines::are_wanted(const LineClassSet& classes) {
    return classes.has_any_of(LineClass::intersection | kClassesBesideIntersection);
}

bool IntersectionLines::is_before(const WholeLine& a, const WholeLine& b) {
    const auto key = [](const WholeLine& l) {
        return std::tuple(l.owners[0], l.owners[1], l.from.x, l.from.y, l.to.x, l.to.y);
    };
    return key(a) < key(b);
}

std::vector<WholeLine> IntersectionLines::of_pairs(std::span<const SurfacePair> pairs, int threads) const {
    std::vector<std::vector<WholeLine>> found((pairs.size() + kChunkPairs - 1) / kChunkPairs);
    parallel_for(found.size(), threads, [&](std::size_t chunk, int) {
        const std::size_t first = chunk * kChunkPairs;
        for (const SurfacePair& pair : pairs.subspan(first, std::min(kChunkPairs, pairs.size() - first))) {
            add_pair(pair, found[chunk]);
        }
    });
    std::vector<WholeLine> lines;
    for (const auto& list : found) lines.insert(lines.end(), list.begin(), list.end());
    // Only parts of triangles that are cut are out of order, or equal.
    std::stable_sort(lines.begin(), lines.end(), is_before);
    const auto is_same = [](const WholeLine& one, const WholeLine& next) { return !is_before(one, next); };
    lines.erase(std::unique(lines.begin(), lines.end(), is_same), lines.end());
    return lines;
}

void IntersectionLines::add_pair(const SurfacePair& pair, std::vector<WholeLine>& lines) const {
    const std::uint32_t a = screen_.number_of(pair.first), b = screen_.number_of(pair.second);
    if (screen_.facing(a) == edge_on || screen_.facing(b) == edge_on) return;
    const ScreenTriangle on_screen_a = screen_.triangle(pair.first), on_screen_b = screen_.triangle(pair.second);
    const bool is_a_off = is_off_screen(on_screen_a), is_b_off = is_off_screen(on_screen_b);
    if (!is_a_off && !is_b_off) {
        if (!overlap(on_screen_a, on_screen_b)) return;
        return add(occluder_of(screen_, pair.first, a), occluder_of(screen_, pair.second, b), lines);
    }
    const auto parts = [&](SurfaceId s, std::uint32_t number, bool is_off) {
        return is_off ? clipped_occluders(screen_, s, number) : std::vector<Occluder>{occluder_of(screen_, s, number)};
    };
    const std::vector<Occluder> parts_of_b = parts(pair.second, b, is_b_off);
    for (const Occluder& part_of_a : parts(pair.first, a, is_a_off)) {
        for (const Occluder& part_of_b : parts_of_b) add(part_of_a, part_of_b, lines);
    }
}

/// How the corners of a triangle lie to the plane of another one, for certain. What counts as certain grows with the
/// nearness, which is great at corners that are cut off beside the eye.
struct IntersectionLines::Passage {
    bool is_behind = false, is_in_front = false;
    std::optional<std::size_t> edge_in_plane;  // the corner where it begins; the third one is not in the plane

    bool is_cut() const { return is_behind && is_in_front; }
};

IntersectionLines::Passage IntersectionLines::passage(const Occluder& plane, const Occluder& corners) const {
    Passage result;
    std::size_t certain_count = 0, certain = 0;
    const auto gap_at = [&](glm::dvec2 p, double nearness) {  // 0: not certain
        const double gap = plane.nearness_at(p) - nearness;
        return std::abs(gap) > plane.slack + corners.slack + level_slack(frame_.surfaces, nearness) ? gap : 0;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 p(corners.x[k], corners.y[k]);
        const double gap = gap_at(p, corners.nearness_at(p));
        result.is_behind |= gap > 0;
        result.is_in_front |= gap < 0;
        if (gap == 0) continue;
        ++certain_count;
        certain = k;
    }
    if (certain_count != 1 || screen_.facing(corners.number) == off_screen) return result;
    // The surface passes through the plane along the edge, if it goes on behind it.
    const std::size_t k = (certain + 1) % 3;
    const auto partner = partner_over(screen_, corners, k);
    if (!partner) return result;
    const ScreenMesh& mesh = screen_.mesh(corners.instance);
    const ScreenVertex& apex = mesh.vertices[mesh.corners[*partner - *partner % 3 + (*partner + 2) % 3]];
    if (apex.x == ScreenVertex::kOffScreen) return result;
    const double beyond = gap_at({apex.x, apex.y}, static_cast<double>(apex.nearness));
    if (result.is_behind ? beyond < 0 : beyond > 0) result.edge_in_plane = k;
    return result;
}

void IntersectionLines::add(const Occluder& a, const Occluder& b, std::vector<WholeLine>& lines) const {
    const Passage of_b = passage(a, b), of_a = passage(b, a);
    WholeLine line;
    bool has_line = false;
    if (of_a.is_cut() && of_b.is_cut()) {
        has_line = cut(a, b, line);
    } else if (of_a.edge_in_plane && (of_b.is_cut() || of_b.edge_in_plane)) {
        has_line = cut_edge(a, *of_a.edge_in_plane, b, line);
    } else if (of_b.edge_in_plane && of_a.is_cut()) {
        has_line = cut_edge(b, *of_b.edge_in_plane, a, line);
    }
    if (!has_line) return;
    const glm::dvec2 low_end = glm::min(line.from, line.to), high_end = glm::max(line.from, line.to);
    if (high_end.x < low_.x || high_end.y < low_.y || low_end.x > high_.x || low_end.y > high_.y) return;
    line.owners = {a.number, b.number};
    line.id = LineId::of_surfaces(a.number, b.number);
    const SurfaceId sa = screen_.surface_of(a.number), sb = screen_.surface_of(b.number);
    if (frame_.surfaces.are_of_one_polygon(sa, sb)) return;
    const glm::dvec2 middle = to_pixels(0.5 * (line.from + line.to));
    const LineClassSet contact = contact_classes(frame_.surfaces, sa, sb, middle, frame_.criteria);
    const LineClassSet classes =
        (LineClass::intersection | (contact & kClassesBesideIntersection)) & frame_.criteria.classes;
    if (classes.empty() || run_along(frame_.surfaces, sa, sb, middle)) return;
    line.classes = classes;
    line.drawn_as = *classes.first();
    lines.push_back(line);
}

/// The part of an edge of one triangle within another one, in whose plane it lies.
bool IntersectionLines::cut_edge(const Occluder& owner, std::size_t corner, const Occluder& other, WholeLine& line) {
    const std::size_t second = (corner + 1) % 3;
    const glm::dvec2 from(owner.x[corner], owner.y[corner]), to(owner.x[second], owner.y[second]);
    double begin = 0, end = 1;
    line.nodes = {WholeLine::node_of_vertex(owner.instance, owner.vertices[corner]),
                  WholeLine::node_of_vertex(owner.instance, owner.vertices[second])};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const glm::dvec2 p(other.x[k], other.y[k]), edge = glm::dvec2(other.x[next], other.y[next]) - p;
        const double first_begin = begin, first_end = end;
        if (!clip_where_positive(cross(edge, from - p), cross(edge, to - p), begin, end)) return false;
        if (begin != first_begin) line.nodes[0] = node_of(other, k, owner);
        if (end != first_end) line.nodes[1] = node_of(other, k, owner);
    }
    line.from = glm::mix(from, to, begin);
    line.to = glm::mix(from, to, end);
    line.nearness_from = owner.nearness_at(line.from);
    line.nearness_to = owner.nearness_at(line.to);
    return true;
}

/// The line in which two triangles pass through each other.
bool IntersectionLines::cut(const Occluder& a, const Occluder& b, WholeLine& line) {
    // Both planes meet where gap(p) = offset + slope.p = 0; from there, the part within both triangles.
    const glm::dvec2 slope(a.per_x - b.per_x, a.per_y - b.per_y);
    const glm::dvec2 origin(a.x[0], a.y[0]);
    const double square = glm::dot(slope, slope);
    if (!(square > 0)) return false;
    const glm::dvec2 foot = origin - slope * ((a.nearness_at(origin) - b.nearness_at(origin)) / square);
    const glm::dvec2 along = glm::dvec2(-slope.y, slope.x) / std::sqrt(square);
    double begin = -1e300, end = 1e300;
    struct Edge {
        const Occluder *owner = nullptr, *other = nullptr;
        std::size_t corner = 0;
        std::uint64_t node() const { return owner != nullptr ? node_of(*owner, corner, *other) : WholeLine::kNoNode; }
    } first, last;  // between which the line runs
    for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = k == 2 ? 0 : k + 1;
            const glm::dvec2 p(own->x[k], own->y[k]);
            const glm::dvec2 edge = glm::dvec2(own->x[next], own->y[next]) - p;
            const double inside = cross(edge, foot - p), change = cross(edge, along);
            if (change == 0) {
                if (inside < 0) return false;
                continue;
            }
            const double t = -inside / change;
            if (change > 0 && t > begin) {
                begin = t;
                first = {own, other, k};
            } else if (change < 0 && t < end) {
                end = t;
                last = {own, other, k};
            }
            if (!(begin < end)) return false;
        }
    }
    line.from = foot + along * begin;
    line.to = foot + along * end;
    line.nearness_from = a.nearness_at(line.from);
    line.nearness_to = a.nearness_at(line.to);
    line.nodes = {first.node(), last.node()};
    return true;
}

}  // namespace burin
