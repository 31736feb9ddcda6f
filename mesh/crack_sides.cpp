#include "mesh/crack_sides.h"

#include <algorithm>

namespace burin {
namespace {

/// How wide a crack may be, in lengths of its sides: at full reach, and at kNarrowPart of it.
constexpr double kWidestPart = 1.0 / 20, kWidestNarrowPart = 1.0 / 3, kNarrowPart = 1.0 / 4;
/// A crack may also be as wide as these parts: of the reach, and of the height of the triangle beside it.
constexpr double kNegligiblePart = 1.0 / 8, kWidestOfHeight = 1.0 / 2;
constexpr double kShortestSide = 1.0 / 64;  // in parts of the reach
/// The short end of a needle: in parts of the reach, and of the needle's other edges.
constexpr double kNeedleEnd = 1.0 / 8, kNeedleEndPart = 1.0 / 3;
/// The greatest cosine between the directions from the edge into the polygons on both sides: beyond it one folds back
/// on the other.
constexpr double kCosLeastAngle = 0.94;
/// A triangle ends where it has a border behind it, by rounding too.
constexpr double kBarely = 1.01;

}  // namespace

CrackSides::CrackSides(const Mesh& mesh, const CrackReach& reach) : mesh_(mesh), segments_(mesh.borders.segments()) {
    lengths_.reserve(segments_.size());
    reach_.reserve(segments_.size());
    for (const BorderIndex::Segment& s : segments_) {
        lengths_.push_back(glm::distance(s.a, s.b));
        reach_.push_back(std::min(reach(s.a), reach(s.b)));
    }
    is_end_of_needle_.resize(segments_.size());
    heights_.resize(segments_.size());
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
        heights_[i] = glm::length(across(i));
        if (lengths_[i] > kNeedleEnd * reach_[i]) continue;
        const glm::dvec3 far = apex(i), a = segments_[i].a, b = segments_[i].b;
        is_end_of_needle_[i] = lengths_[i] <= kNeedleEndPart * std::min(glm::distance(a, far), glm::distance(b, far));
    }
}

double CrackSides::widest(std::uint32_t segment, double length) const {
    const double reach = reach_[segment];
    // Specks have no cracks: there may be thousands of them in one place.
    if (is_end_of_needle_[segment] || lengths_[segment] < kShortestSide * reach) return 0;
    const double by_length =
        std::max(std::min(reach, kWidestPart * length), std::min(kNarrowPart * reach, kWidestNarrowPart * length));
    return std::min(by_length, std::max(kNegligiblePart * reach, kWidestOfHeight * heights_[segment]));
}

std::pair<std::uint32_t, std::uint32_t> CrackSides::ends(std::uint32_t segment) const {
    const HalfEdge h = segments_[segment].half_edge;
    const auto& t = mesh_.triangles[h / 3];
    return {t[h % 3], t[(h + 1) % 3]};
}

/// The triangle's other corner.
std::uint32_t CrackSides::apex_vertex(std::uint32_t segment) const {
    const HalfEdge h = segments_[segment].half_edge;
    return mesh_.triangles[h / 3][(h % 3 + 2) % 3];
}
glm::dvec3 CrackSides::apex(std::uint32_t segment) const { return mesh_.local_position(apex_vertex(segment)); }

/// The vector from the edge to its apex, at a right angle to the edge.
glm::dvec3 CrackSides::across(std::uint32_t segment) const {
    const BorderIndex::Segment& s = segments_[segment];
    const glm::dvec3 a = s.a, along = s.b - a, to_apex = apex(segment) - a;
    return to_apex - along * (glm::dot(to_apex, along) / std::max(glm::dot(along, along), 1e-300));
}

glm::dvec3 CrackSides::inward(std::uint32_t segment) const {
    const glm::dvec3 way = across(segment);
    return way / std::max(glm::length(way), 1e-300);
}

double CrackSides::length_of_directions() const {
    constexpr double kPart = 1.0 / 100;
    glm::dvec3 low = segments_.front().a, high = low;
    for (const BorderIndex::Segment& s : segments_) {
        low = glm::min(low, glm::min(s.a, s.b));
        high = glm::max(high, glm::max(s.a, s.b));
    }
    const glm::dvec3 size = high - low;
    return kPart * std::max({size.x, size.y, size.z});
}

bool CrackSides::all_fold_back(const glm::dvec3& inward, const glm::dvec3& low, const glm::dvec3& high) {
    constexpr double kRounding = 1e-9;
    const glm::dvec3 least = glm::min(inward * low, inward * high);
    return least.x + least.y + least.z > kCosLeastAngle + kRounding;
}

bool CrackSides::are_beside(std::uint32_t s, std::uint32_t t) const {
    return segments_[s].polygon != segments_[t].polygon && glm::dot(inward(s), inward(t)) <= kCosLeastAngle &&
           !(ends_before(s, t) && ends_before(t, s)) && !has_beside(s, apex_vertex(t)) &&
           !has_beside(t, apex_vertex(s));
}

/// Whether a vertex belongs to the triangle at a border or to one next to it.
bool CrackSides::has_beside(std::uint32_t segment, std::uint32_t vertex) const {
    const HalfEdge h = segments_[segment].half_edge;
    for (HalfEdge k = h - h % 3; k < h - h % 3 + 3; ++k) {
        const auto& next = mesh_.triangles[mesh_.next_on_edge[k] / 3];
        if (std::find(next.begin(), next.end(), vertex) != next.end()) return true;
    }
    return false;
}

/// Whether the other border lies on the polygon's side of one, and not on its triangle but behind it.
bool CrackSides::ends_before(std::uint32_t segment, std::uint32_t other) const {
    const BorderIndex::Segment &s = segments_[segment], &t = segments_[other];
    const double to_other = glm::dot(0.5 * (t.a + t.b) - s.a, inward(segment));
    return to_other > 0 && heights_[segment] <= kBarely * to_other;
}

}  // namespace burin
