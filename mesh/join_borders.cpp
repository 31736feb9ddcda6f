#include "mesh/join_borders.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "mesh/point_tree.h"
#include "mesh/vertex_clusters.h"

namespace burin {
namespace {

using Segment = BorderIndex::Segment;

/// Two borders that are to be one: which vertices become one.
struct Crack {
    double width;
    std::array<glm::dvec3, 4> place;  // tells cracks of one width apart
    std::array<VertexClusters::Pair, 2> joins;
    std::array<std::uint32_t, 2> sides;  // segments
};

/// Where a border has more others beside it, it is one of a pile.
constexpr std::size_t kMostBeside = 64;
/// What rounding may do.
constexpr double kRoundedUp = 1 + 1e-9;

bool is_before(const Crack& a, const Crack& b) {
    if (a.width != b.width) return a.width < b.width;
    for (std::size_t i = 0; i < a.place.size(); ++i) {
        const glm::dvec3 &p = a.place[i], &q = b.place[i];
        if (p != q) return is_less(p, q);
    }
    return a.joins < b.joins;
}

/// Finds borders by their middles, directions and polygons.
class Middles {
  public:
    explicit Middles(const CrackSides& sides) : sides_(sides) {
        if (!sides.mesh().borders.has_crowds()) return;
        // The boxes of borders would tell little.
        per_inward_ = sides.length_of_directions();
        std::vector<Tree::Point> points;
        points.reserve(sides.segments().size());
        for (std::uint32_t i = 0; i < sides.segments().size(); ++i) {
            const Segment& s = sides.segments()[i];
            const glm::dvec3 middle = 0.5 * (s.a + s.b), half = 0.5 * (s.b - s.a),
                             inward = per_inward_ * sides.inward(i);
            points.push_back({{middle.x, middle.y, middle.z, half.x, half.y, half.z, inward.x, inward.y, inward.z}, i});
        }
        tree_ = Tree(std::move(points));
    }

    /// The numbers of all borders that may be beside one, no end of theirs farther than `reach` from one of its own,
    /// and others.
    void find(std::uint32_t border, double reach, std::vector<std::uint32_t>& near) const {
        near.clear();
        const Segment& s = sides_.segments()[border];
        const glm::dvec3 middle = 0.5 * (s.a + s.b);
        if (tree_.is_empty()) return sides_.mesh().borders.find_in_box(middle - reach, middle + reach, near);
        const glm::dvec3 half = 0.5 * (s.b - s.a), inward = sides_.inward(border) / per_inward_;
        const double around = reach * (1 + 1e-6);
        const auto touches = [around](const glm::dvec3& place, const glm::dvec3& low, const glm::dvec3& high) {
            return glm::all(glm::lessThanEqual(low, place + around)) &&
                   glm::all(glm::lessThanEqual(place - around, high));
        };
        // Thousands may have one middle, as needles through a point do, and thousands lie over each other in a pile.
        const auto may_be_near = [&](const Tree::Coordinates& low, const Tree::Coordinates& high) {
            const auto part = [](const Tree::Coordinates& c, std::size_t k) {
                return glm::dvec3(c[k], c[k + 1], c[k + 2]);
            };
            return touches(middle, part(low, 0), part(high, 0)) &&
                   (touches(half, part(low, 3), part(high, 3)) || touches(-half, part(low, 3), part(high, 3))) &&
                   !CrackSides::all_fold_back(inward, part(low, 6), part(high, 6));
        };
        tree_.visit(may_be_near, [&](std::uint32_t i) {
            near.push_back(i);
            return true;
        });
    }

  private:
    using Tree = PointTree<9>;
    const CrackSides& sides_;
    double per_inward_ = 1;  // by which directions become lengths
    Tree tree_;
};

/// Finds what is beside one border.
class BesideFinder {
  public:
    BesideFinder(const CrackSides& sides, const Middles& middles) : sides_(sides), middles_(middles) {}

    /// The cracks between a border and others; more than kMostBeside, though not all, where it is one of a pile.
    const std::vector<Crack>& cracks_of(std::uint32_t i) {
        beside_.clear();
        const double widest = sides_.widest(i, sides_.length(i));
        if (!(widest > 0)) return beside_;
        const Segment& s = sides_.segments()[i];
        const glm::dvec3 middle = 0.5 * (s.a + s.b);
        middles_.find(i, widest, near_);
        for (const std::uint32_t j : near_) {
            if (j == i) continue;
            const Segment& t = sides_.segments()[j];
            const glm::dvec3 off = 0.5 * (t.a + t.b) - middle;
            if (glm::dot(off, off) > kRoundedUp * widest * widest) continue;  // most lie in boxes that merely overlap
            const double opposite = std::max(glm::distance(s.a, t.b), glm::distance(s.b, t.a));
            const double along = std::max(glm::distance(s.a, t.a), glm::distance(s.b, t.b));
            Crack crack;
            crack.width = std::min(opposite, along);
            if (crack.width > std::min(widest, sides_.widest(j, sides_.length(j))) || !sides_.are_beside(i, j))
                continue;
            crack.place = {s.a, s.b, t.a, t.b};
            if (is_less(t.a, s.a) || (t.a == s.a && is_less(t.b, s.b))) crack.place = {t.a, t.b, s.a, s.b};
            const auto [sa, sb] = sides_.ends(i);
            const auto [ta, tb] = sides_.ends(j);
            crack.joins = {std::pair(sa, opposite <= along ? tb : ta), std::pair(sb, opposite <= along ? ta : tb)};
            crack.sides = {i, j};
            beside_.push_back(crack);
            if (beside_.size() > kMostBeside) break;
        }
        return beside_;
    }

  private:
    const CrackSides& sides_;
    const Middles& middles_;
    std::vector<std::uint32_t> near_;
    std::vector<Crack> beside_;
};

/// All cracks that are narrow enough, the narrowest first.
std::vector<Crack> find_cracks(const CrackSides& sides, int threads) {
    const Middles middles(sides);
    const std::span<const std::uint32_t> borders = sides.mesh().borders.by_place();
    std::vector<std::uint8_t> is_in_pile(sides.segments().size());
    std::vector<std::vector<Crack>> in_batches(borders.size() / kBordersAtOnce + 1);
    parallel_for_batches(borders.size(), kBordersAtOnce, threads,
                         [&](std::size_t batch, std::size_t begin, std::size_t end) {
                             BesideFinder finder(sides, middles);
                             for (std::size_t b = begin; b < end; ++b) {
                                 throw_if_interrupted();
                                 const std::vector<Crack>& beside = finder.cracks_of(borders[b]);
                                 is_in_pile[borders[b]] = beside.size() > kMostBeside;
                                 if (is_in_pile[borders[b]]) continue;
                                 std::copy_if(beside.begin(), beside.end(), std::back_inserter(in_batches[batch]),
                                              [](const Crack& c) { return c.sides[0] < c.sides[1]; });
                             }
                         });
    std::vector<Crack> cracks;
    for (const std::vector<Crack>& some : in_batches) {
        std::copy_if(some.begin(), some.end(), std::back_inserter(cracks),
                     [&](const Crack& c) { return !is_in_pile[c.sides[0]] && !is_in_pile[c.sides[1]]; });
    }
    std::sort(cracks.begin(), cracks.end(), is_before);
    return cracks;
}

}  // namespace

std::optional<Mesh> join_borders(const Mesh& mesh, const CrackReach& reach, int threads) {
    if (!mesh.borders.has_partners()) return std::nullopt;
    const std::vector<Crack> cracks = find_cracks(CrackSides(mesh, reach), threads);
    if (cracks.empty()) return std::nullopt;
    std::vector<VertexClusters::Pair> pairs;
    for (const Crack& crack : cracks) pairs.insert(pairs.end(), crack.joins.begin(), crack.joins.end());
    VertexClusters clusters(mesh, pairs);
    for (const Crack& crack : cracks) {
        double largest = reach(crack.place[0]);
        for (const glm::dvec3& place : crack.place) largest = std::min(largest, reach(place));
        if (!clusters.may_join(crack.joins[0], largest) || !clusters.may_join(crack.joins[1], largest)) continue;
        clusters.join(crack.joins[0]);
        clusters.join(crack.joins[1]);
    }
    return clusters.merge();
}

}  // namespace burin
