#include "mesh/crack_sides.h"

#include <algorithm>

namespace burin {
namespace {

/// How wide a crack may be, in lengths of its sides: at full reach, and at kNarrowPart of it.
constexpr double kWidestPart = 1.0 / 20, kWidestNarrowPart = 1.0 / 3, kNarrowPart = 1.0 / 2;
/// Of the directions from the edge into the polygons on both sides: beyond that one folds back on the other.
constexpr double kCosLeastAngle = 0.94;

}  // namespace

CrackSides::CrackSides(const Mesh& mesh, const CrackReach& reach) : mesh_(mesh), segments_(mesh.borders.segments()) {
    lengths_.reserve(segments_.size());
    reach_.reserve(segments_.size());
    for (const BorderIndex::Segment& s : segments_) {
        lengths_.push_back(glm::distance(glm::dvec3(s.a), glm::dvec3(s.b)));
        reach_.push_back(std::min(reach(glm::dvec3(s.a)), reach(glm::dvec3(s.b))));
    }
}

double CrackSides::widest(std::uint32_t segment, double length) const {
    const double reach = reach_[segment];
    return std::max(std::min(reach, kWidestPart * length), std::min(kNarrowPart * reach, kWidestNarrowPart * length));
}

std::pair<std::uint32_t, std::uint32_t> CrackSides::ends(std::uint32_t segment) const {
    const HalfEdge h = segments_[segment].half_edge;
    const auto& t = mesh_.triangles[h / 3];
    return {t[h % 3], t[(h + 1) % 3]};
}

/// From the edge into the polygon.
glm::dvec3 CrackSides::inward(std::uint32_t segment) const {
    const BorderIndex::Segment& s = segments_[segment];
    const glm::dvec3 apex(mesh_.positions[mesh_.triangles[s.half_edge / 3][(s.half_edge + 2) % 3]]);
    const glm::dvec3 a(s.a), along = glm::dvec3(s.b) - a, to_apex = apex - a;
    const glm::dvec3 across = to_apex - along * (glm::dot(to_apex, along) / std::max(glm::dot(along, along), 1e-300));
    return across / std::max(glm::length(across), 1e-300);
}

bool CrackSides::are_beside(std::uint32_t s, std::uint32_t t) const {
    return segments_[s].polygon != segments_[t].polygon && glm::dot(inward(s), inward(t)) <= kCosLeastAngle;
}

}  // namespace burin
