#include "mesh/collapse_needles.h"

#include <algorithm>
#include <tuple>

#include "mesh/vertex_clusters.h"

namespace burin {
namespace {

/// How far apart corners that become one may be, in parts of the reach.
constexpr double kLargestPart = 1.0 / 8;

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
        if (!sides.is_end_of_needle(i)) continue;
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
