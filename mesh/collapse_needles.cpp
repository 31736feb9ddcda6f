#include "mesh/collapse_needles.h"

#include <algorithm>
#include <tuple>

#include "mesh/vertex_clusters.h"

namespace burin {
namespace {

/// How far apart corners that become one may be, in parts of the reach.
constexpr double kLargestPart = 1.0 / 8;

/// Whether a triangle's other edges are linked without it, or both to others: else it may be all that there is of a strip.
bool is_between_others(const Mesh& mesh, HalfEdge end) {
    const auto links = [&mesh](HalfEdge h) {
        int count = 0;
        for (HalfEdge g = mesh.next_on_edge[h]; g != h; g = mesh.next_on_edge[g]) ++count;
        return count;
    };
    const HalfEdge first = end - end % 3;
    const int one = links(first + (end + 1) % 3), two = links(first + (end + 2) % 3);
    return (one > 0 && two > 0) || one > 1 || two > 1;
}

struct Needle {
    double length;
    glm::vec3 low, high;  // its ends, in an order of their own
    VertexClusters::Pair ends;
};

}  // namespace

std::optional<Mesh> collapse_needles(const Mesh& mesh, const CrackReach& reach) {
    const CrackSides sides(mesh, reach);
    std::vector<Needle> needles;
    for (std::uint32_t i = 0; i < sides.segments().size(); ++i) {
        if (!sides.is_end_of_needle(i) || !is_between_others(mesh, sides.segments()[i].half_edge)) continue;
        const auto& [low, high] = std::minmax(sides.segments()[i].a, sides.segments()[i].b, is_less);
        needles.push_back({sides.length(i), low, high, sides.ends(i)});
    }
    if (needles.empty()) return std::nullopt;
    // The shortest first, whatever the order of the triangles.
    std::sort(needles.begin(), needles.end(), [](const Needle& a, const Needle& b) {
        if (a.length != b.length) return a.length < b.length;
        if (a.low != b.low) return is_less(a.low, b.low);
        return a.high != b.high ? is_less(a.high, b.high) : a.ends < b.ends;
    });
    std::vector<VertexClusters::Pair> pairs;
    for (const Needle& needle : needles) pairs.push_back(needle.ends);
    VertexClusters clusters(mesh, pairs);
    for (const Needle& needle : needles) {
        const double largest = kLargestPart * reach(glm::dvec3(needle.low));
        if (clusters.may_join(needle.ends, largest, true)) clusters.join(needle.ends);
    }
    return clusters.merge();
}

}  // namespace burin
