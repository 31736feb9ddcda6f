#include "mesh/split_borders.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <vector>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "mesh/edge_links.h"
#include "mesh/near_segment.h"
#include "mesh/point_tree.h"
#include "mesh/residuals.h"
#include "mesh/vertex_clusters.h"

namespace burin {
namespace {

/// Borders run along each other if the cosine of the angle between them is larger.
constexpr double kCosParallel = 0.7;

/// Cuts are as far from a border's ends as this part of its length, or as cracks are wide.
constexpr double kNearestPart = 0.05;

using Segment = BorderIndex::Segment;

/// Where a border is cut.
struct Cut {
    HalfEdge half_edge;
    double share;  // of the way along it, 0..1
};

/// Finds borders with an end where another one may be cut.
class Corners {
  public:
    explicit Corners(const CrackSides& sides) : sides_(sides) {
        if (!sides.mesh().borders.has_crowds()) return;
        // The boxes of borders would tell little.
        per_inward_ = sides.length_of_directions();
        std::vector<Tree::Point> ends;
        ends.reserve(2 * sides.segments().size());
        for (std::uint32_t i = 0; i < sides.segments().size(); ++i) {
            const glm::dvec3 inward = per_inward_ * sides.inward(i);
            for (const glm::dvec3& end : {sides.segments()[i].a, sides.segments()[i].b})
                ends.push_back({{end.x, end.y, end.z, inward.x, inward.y, inward.z}, i});
        }
        ends_ = Tree(std::move(ends));
    }

    /// The numbers of borders, some twice, in no order: all that may be beside one, with an end as near as `most` to
    /// it, but for those whose ends are as near as `least` to its ends.
    void find(std::uint32_t border, double most, double least, std::vector<std::uint32_t>& near) const {
        near.clear();
        const glm::dvec3 a = sides_.segments()[border].a, b = sides_.segments()[border].b;
        if (ends_.is_empty())
            return sides_.mesh().borders.find_in_box(glm::min(a, b) - most, glm::max(a, b) + most, near);
        const NearSegment may_be_near{a, b, most * (1 + 1e-6)};
        const glm::dvec3 inward = sides_.inward(border) / per_inward_;
        const auto is_at = [least](const glm::dvec3& place, const glm::dvec3& low,
                                   const glm::dvec3& high) {  // all of a box
            const glm::dvec3 farthest = glm::max(glm::abs(low - place), glm::abs(high - place));
            return glm::dot(farthest, farthest) < least * least * (1 - 1e-6);
        };
        // Thousands may meet at an end.
        const auto may_cut = [&](const Tree::Coordinates& least_of, const Tree::Coordinates& most_of) {
            const glm::dvec3 low(least_of[0], least_of[1], least_of[2]), high(most_of[0], most_of[1], most_of[2]);
            return may_be_near(low, high) && !is_at(a, low, high) && !is_at(b, low, high) &&
                   !CrackSides::all_fold_back(inward, {least_of[3], least_of[4], least_of[5]},
                                              {most_of[3], most_of[4], most_of[5]});
        };
        ends_.visit(may_cut, [&](std::uint32_t i) {
            near.push_back(i);
            return true;
        });
    }

  private:
    using Tree = PointTree<6>;
    const CrackSides& sides_;
    double per_inward_ = 1;  // by which directions become lengths
    Tree ends_;
};

/// Adds the cuts of one border, in order along it. Returns how many others it looked at.
std::size_t find_cuts(const CrackSides& sides, const Corners& corners, std::uint32_t i,
                      std::vector<std::uint32_t>& near, std::vector<Cut>& cuts) {
    const Segment& s = sides.segments()[i];
    const double length = sides.length(i), most = sides.widest(i, length);
    if (!(most > 0)) return 0;
    const glm::dvec3 a = s.a, b = s.b, along = (b - a) / length;
    const double least = std::min(most, kNearestPart * length);
    corners.find(i, most, least, near);
    const std::size_t first = cuts.size();
    for (const std::uint32_t j : near) {
        const Segment& t = sides.segments()[j];
        const glm::dvec3 way = t.b - t.a;
        if (std::abs(glm::dot(along, way)) < kCosParallel * sides.length(j)) continue;
        const double widest = std::min(most, std::max(sides.widest(i, sides.length(j)), kNearestPart * length));
        const std::size_t before = cuts.size();
        for (const glm::dvec3 corner : {t.a, t.b}) {
            const double at = glm::dot(corner - a, along);
            const bool is_inside =
                at > 0 && at < length && glm::distance(corner, a) > widest && glm::distance(corner, b) > widest;
            if (is_inside && glm::distance(corner, a + at * along) <= widest)
                cuts.push_back({s.half_edge, at / length});
        }
        if (cuts.size() > before && !sides.are_beside(i, j))
            cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(before), cuts.end());
    }
    const auto begin = cuts.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, cuts.end(), [](const Cut& p, const Cut& q) { return p.share < q.share; });
    // Corners of several polygons in one place are one.
    constexpr double kSamePlace = 1e-4;
    const auto end =
        std::unique(begin, cuts.end(), [](const Cut& p, const Cut& q) { return q.share - p.share < kSamePlace; });
    cuts.erase(end, cuts.end());
    return near.size();
}

/// How many ends of others may lie beside borders, all together.
std::size_t most_beside(std::size_t border_count) {
    constexpr std::size_t kMostBeside = 128, kMostInAll = std::size_t{1} << 26;
    return std::min(kMostBeside * border_count, kMostInAll);
}

/// Whether more lie beside some borders all over the mesh: that is told without a look at all borders.
bool is_pile_at_some(const CrackSides& sides, const Corners& corners, std::span<const std::uint32_t> borders) {
    constexpr std::size_t kAsked = 256;
    std::vector<std::uint32_t> near;
    std::vector<Cut> cuts;
    std::size_t looked_at = 0;
    const std::size_t most = most_beside(borders.size()) * kAsked / borders.size();
    for (std::size_t i = 0; i < kAsked && looked_at <= most; ++i) {
        throw_if_interrupted();
        looked_at += find_cuts(sides, corners, borders[i * borders.size() / kAsked], near, cuts);
    }
    return looked_at > most;
}

/// The cuts of all borders, in no order of these; none if there are too many.
std::vector<Cut> find_all_cuts(const CrackSides& sides, int threads) {
    // A corner cuts one border or two. Where there are many more, or ends of hundreds lie beside each border, borders
    // lie in a pile.
    const std::size_t most_cuts = 16 * sides.segments().size(), most_looked_at = most_beside(sides.segments().size());
    const Corners corners(sides);
    const std::span<const std::uint32_t> borders = sides.mesh().borders.by_place();
    if (is_pile_at_some(sides, corners, borders)) return {};
    std::vector<std::vector<Cut>> in_batches(borders.size() / kBordersAtOnce + 1);
    std::atomic<std::size_t> count{0}, looked_at{0};
    const auto is_pile = [&] { return count > most_cuts || looked_at > most_looked_at; };
    parallel_for_batches(borders.size(), kBordersAtOnce, threads,
                         [&](std::size_t batch, std::size_t begin, std::size_t end) {
                             std::vector<std::uint32_t> near;
                             std::vector<Cut>& cuts = in_batches[batch];
                             for (std::size_t b = begin; b < end && !is_pile(); ++b) {
                                 throw_if_interrupted();
                                 const std::size_t before = cuts.size();
                                 looked_at += find_cuts(sides, corners, borders[b], near, cuts);
                                 count += cuts.size() - before;
                             }
                         });
    if (is_pile()) return {};
    std::vector<Cut> cuts;
    for (const std::vector<Cut>& some : in_batches) cuts.insert(cuts.end(), some.begin(), some.end());
    return cuts;
}

/// A triangle, or a part of one, and which edges of the whole one its own three are (3: none).
struct Part {
    std::array<std::uint32_t, 3> corners;
    std::array<std::uint8_t, 3> edges;
};

/// Cuts the part that has edge `edge` into a fan.
void cut_fan(std::vector<Part>& parts, std::uint8_t edge, std::span<const std::uint32_t> points) {
    for (Part& part : parts) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (part.edges[k] != edge) continue;
            const Part whole = part;
            const std::size_t n = (k + 1) % 3, apex = (k + 2) % 3;
            std::vector<Part> fan;
            std::uint32_t from = whole.corners[k];
            for (const std::uint32_t point : points) {
                fan.push_back(
                    {{from, point, whole.corners[apex]}, {edge, 3, fan.empty() ? whole.edges[apex] : std::uint8_t{3}}});
                from = point;
            }
            fan.push_back({{from, whole.corners[n], whole.corners[apex]}, {edge, whole.edges[n], 3}});
            part = fan.front();
            parts.insert(parts.end(), fan.begin() + 1, fan.end());
            return;
        }
    }
}

/// A vertex that cuts an edge of a triangle.
struct PointOnEdge {
    std::uint32_t vertex;
    HalfEdge edge;  ///< 0 to 2
    double share;
};

/// Adds the rows of a part of a triangle of `mesh` to a layer.
void add_rows(const Mesh& mesh, std::uint32_t triangle, const AttributeLayer& from,
              const std::array<std::uint32_t, 3>& corners, std::span<const PointOnEdge> points, AttributeLayer& to) {
    const std::uint32_t* const rows = from.rows.data() + 3 * std::size_t{triangle};
    const auto& own = mesh.triangles[triangle];
    for (const std::uint32_t vertex : corners) {
        const auto point =
            std::find_if(points.begin(), points.end(), [&](const PointOnEdge& p) { return p.vertex == vertex; });
        to.rows.push_back(point != points.end()
                              ? to.add_between(rows[point->edge], rows[(point->edge + 1) % 3], point->share)
                              : rows[std::find(own.begin(), own.end(), vertex) - own.begin()]);
    }
}

}  // namespace

std::optional<Mesh> split_borders(const Mesh& mesh, const CrackReach& reach, int threads) {
    if (!mesh.borders.has_partners()) return std::nullopt;
    std::vector<Cut> cuts = find_all_cuts(CrackSides(mesh, reach), threads);
    std::stable_sort(cuts.begin(), cuts.end(), [](const Cut& p, const Cut& q) { return p.half_edge < q.half_edge; });
    if (cuts.empty()) return std::nullopt;
    Mesh result = with_polygons_of(mesh);
    result.positions = mesh.positions;
    result.residuals = mesh.residuals;
    std::vector<Part> parts;
    std::vector<std::uint32_t> points;
    auto cut = cuts.begin();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        parts.assign(1, {mesh.triangles[t], {0, 1, 2}});
        // The longest edge comes first, whichever corner the triangle begins with.
        const auto first = cut;
        while (cut != cuts.end() && cut->half_edge / 3 == t) ++cut;
        std::vector<PointOnEdge> on_edges;
        const auto corner = [&](HalfEdge h) { return mesh.local_position(mesh.triangles[t][h % 3]); };
        std::array<HalfEdge, 3> edges{3 * t, 3 * t + 1, 3 * t + 2};
        const auto length = [&](HalfEdge h) { return glm::distance(corner(h), corner(h + 1)); };
        if (cut != first)
            std::stable_sort(edges.begin(), edges.end(), [&](HalfEdge g, HalfEdge h) { return length(g) > length(h); });
        for (const HalfEdge h : edges) {
            points.clear();
            for (auto it = first; it != cut; ++it) {
                if (it->half_edge != h) continue;
                points.push_back(static_cast<std::uint32_t>(result.positions.size()));
                if (!mesh.attributes.empty()) on_edges.push_back({points.back(), h % 3, it->share});
                add_position(result, glm::mix(corner(h), corner(h + 1), it->share), mesh.has_residuals());
            }
            if (!points.empty()) cut_fan(parts, static_cast<std::uint8_t>(h % 3), points);
        }
        for (const Part& part : parts) {
            result.triangles.push_back(part.corners);
            result.triangle_polygon.push_back(mesh.polygon_of(t));
            for (std::size_t i = 0; i < mesh.attributes.size(); ++i)
                add_rows(mesh, t, mesh.attributes[i], part.corners, on_edges, result.attributes[i]);
            if (mesh.marked.empty()) continue;
            for (const std::uint8_t edge : part.edges) result.marked.push_back(edge < 3 && mesh.marked[3 * t + edge]);
        }
    }
    result.next_on_edge = link_edges(result.triangles, result.positions.size());
    result.borders = index_borders(result);
    return result;
}

}  // namespace burin
