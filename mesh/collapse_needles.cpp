#include "mesh/collapse_needles.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "mesh/vertex_clusters.h"

namespace burin {
namespace {

/// How far apart corners that become one may be, in parts of the reach.
constexpr double kLargestPart = 1.0 / 8;

/// Whether a triangle's other edges are linked without it, or both to others: else it may be all that there is of a
/// strip.
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
    glm::dvec3 low, high;  // its ends, in an order of their own
    VertexClusters::Pair ends;
    std::uint32_t triangle;
};

/// Per triangle, the first one of those that it is connected to over edges.
std::vector<std::uint32_t> connected_parts(const Mesh& mesh) {
    std::vector<std::uint32_t> part(mesh.triangles.size());
    std::iota(part.begin(), part.end(), 0u);
    const auto root = [&part](std::uint32_t t) {
        while (part[t] != t) t = part[t] = part[part[t]];
        return t;
    };
    for (HalfEdge h = 0; h < mesh.next_on_edge.size(); ++h) {
        const std::uint32_t a = root(h / 3), b = root(mesh.next_on_edge[h] / 3);
        part[std::max(a, b)] = std::min(a, b);
    }
    for (std::uint32_t t = 0; t < part.size(); ++t) part[t] = root(t);
    return part;
}

/// A body of nothing but needles, such as a tube or a cone that is open and thin, would be lost.
void keep_thin_parts(const Mesh& mesh, std::vector<Needle>& needles) {
    const std::vector<std::uint32_t> part = connected_parts(mesh);
    std::vector<std::uint32_t> size(part.size()), count(part.size());
    for (const std::uint32_t p : part) ++size[p];
    for (const Needle& needle : needles) ++count[part[needle.triangle]];
    std::erase_if(
        needles, [&](const Needle& needle) { return 2 * count[part[needle.triangle]] >= size[part[needle.triangle]]; });
}

}  // namespace

std::optional<Mesh> collapse_needles(const Mesh& mesh, const CrackReach& reach) {
    const CrackSides sides(mesh, reach);
    std::vector<Needle> needles;
    for (std::uint32_t i = 0; i < sides.segments().size(); ++i) {
        if (!sides.is_end_of_needle(i) || !is_between_others(mesh, sides.segments()[i].half_edge)) continue;
        const auto& [low, high] = std::minmax(sides.segments()[i].a, sides.segments()[i].b, is_less);
        needles.push_back({sides.length(i), low, high, sides.ends(i), sides.segments()[i].half_edge / 3});
    }
    if (!needles.empty()) keep_thin_parts(mesh, needles);
    if (needles.empty()) return std::nullopt;
    // The shortest come first, whatever the order of the triangles.
    std::sort(needles.begin(), needles.end(), [](const Needle& a, const Needle& b) {
        if (a.length != b.length) return a.length < b.length;
        if (a.low != b.low) return is_less(a.low, b.low);
        return a.high != b.high ? is_less(a.high, b.high) : a.ends < b.ends;
    });
    std::vector<VertexClusters::Pair> pairs;
    for (const Needle& needle : needles) pairs.push_back(needle.ends);
    VertexClusters clusters(mesh, pairs);
    for (const Needle& needle : needles) {
        const double largest = kLargestPart * reach(needle.low);
        if (clusters.may_join(needle.ends, largest, true)) clusters.join(needle.ends);
    }
    return clusters.merge();
}

}  // namespace burin
