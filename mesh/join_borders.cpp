#include "mesh/join_borders.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vector>

#include "base/interrupt.h"
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
constexpr double kBarely = 1 + 1e-9;

bool is_before(const Crack& a, const Crack& b) {
    if (a.width != b.width) return a.width < b.width;
    for (std::size_t i = 0; i < a.place.size(); ++i) {
        const glm::dvec3 &p = a.place[i], &q = b.place[i];
        if (p != q) return is_less(p, q);
    }
    return a.joins < b.joins;
}

/// Finds borders by their middles.
class Middles {
  public:
    explicit Middles(const BorderIndex& borders) : borders_(borders) {
        if (!borders.has_crowds()) return;
        // The boxes of borders would tell little.
        std::vector<SegmentPiece> middles;
        middles.reserve(borders.segments().size());
        for (std::uint32_t i = 0; i < borders.segments().size(); ++i) {
            const glm::vec3 middle(0.5 * (borders.segments()[i].a + borders.segments()[i].b));
            middles.push_back({middle, middle, i});
        }
        tree_ = SegmentTree(middles);
    }

    /// The numbers of all with a middle within `reach` of a place, and others.
    void find(const glm::dvec3& place, double reach, std::vector<std::uint32_t>& near) const {
        near.clear();
        if (tree_.is_empty()) return borders_.find_in_box(place - reach, place + reach, near);
        // Middles were rounded.
        const glm::dvec3 around = reach * (1 + 1e-6) + 1e-6 * glm::abs(place), low = place - around,
                         high = place + around;
        const auto may_be_near = [&](const glm::vec3& box_low, const glm::vec3& box_high) {
            return glm::all(glm::lessThanEqual(glm::dvec3(box_low), high)) &&
                   glm::all(glm::lessThanEqual(low, glm::dvec3(box_high)));
        };
        tree_.visit_leaves(may_be_near, [&](std::uint32_t i) {
            near.push_back(i);
            return true;
        });
    }

  private:
    const BorderIndex& borders_;
    SegmentTree tree_;
};

/// All cracks that are narrow enough, the narrowest first.
std::vector<Crack> find_cracks(const CrackSides& sides) {
    std::vector<Crack> cracks, beside;
    std::vector<std::uint32_t> near;
    const Middles middles(sides.mesh().borders);
    std::vector<bool> is_in_pile(sides.segments().size());
    std::size_t asked = 0;
    for (const std::uint32_t i : sides.mesh().borders.by_place()) {
        if ((asked++ & 0xF) == 0) throw_if_interrupted();
        const double widest = sides.widest(i, sides.length(i));
        if (!(widest > 0)) continue;
        const Segment& s = sides.segments()[i];
        beside.clear();
        // Thousands may meet at an end.
        const glm::dvec3 middle = 0.5 * (s.a + s.b);
        middles.find(middle, widest, near);
        for (const std::uint32_t j : near) {
            if (j == i) continue;
            const Segment& t = sides.segments()[j];
            const glm::dvec3 off = 0.5 * (t.a + t.b) - middle;
            if (glm::dot(off, off) > kBarely * widest * widest) continue;  // most lie in boxes that merely overlap
            const double opposite = std::max(glm::distance(s.a, t.b), glm::distance(s.b, t.a));
            const double along = std::max(glm::distance(s.a, t.a), glm::distance(s.b, t.b));
            Crack crack;
            crack.width = std::min(opposite, along);
            if (crack.width > std::min(widest, sides.widest(j, sides.length(j))) || !sides.are_beside(i, j)) continue;
            crack.place = {s.a, s.b, t.a, t.b};
            if (is_less(t.a, s.a) || (t.a == s.a && is_less(t.b, s.b))) crack.place = {t.a, t.b, s.a, s.b};
            const auto [sa, sb] = sides.ends(i);
            const auto [ta, tb] = sides.ends(j);
            crack.joins = {std::pair(sa, opposite <= along ? tb : ta), std::pair(sb, opposite <= along ? ta : tb)};
            crack.sides = {i, j};
            beside.push_back(crack);
            if (beside.size() > kMostBeside) break;
        }
        is_in_pile[i] = beside.size() > kMostBeside;
        if (is_in_pile[i]) continue;
        std::copy_if(beside.begin(), beside.end(), std::back_inserter(cracks),
                     [](const Crack& c) { return c.sides[0] < c.sides[1]; });
    }
    std::erase_if(cracks, [&](const Crack& c) { return is_in_pile[c.sides[0]] || is_in_pile[c.sides[1]]; });
    std::sort(cracks.begin(), cracks.end(), is_before);
    return cracks;
}

}  // namespace

std::optional<Mesh> join_borders(const Mesh& mesh, const CrackReach& reach) {
    const std::vector<Crack> cracks = find_cracks(CrackSides(mesh, reach));
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
