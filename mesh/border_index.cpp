#include "mesh/border_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

constexpr std::uint32_t kLeafSize = 4;

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = b - a;
    const double length2 = glm::dot(d, d);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * d);
}

double distance_to_box(const glm::dvec3& p, const glm::vec3& low, const glm::vec3& high) {
    const glm::dvec3 outside = glm::max(glm::dvec3(low) - p, p - glm::dvec3(high));
    return glm::length(glm::max(outside, glm::dvec3(0.0)));
}

}  // namespace

BorderIndex::BorderIndex(std::vector<Segment> segments)
    : segments_(std::move(segments)), order_(segments_.size()) {
    if (segments_.empty()) return;
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(segments_.size());
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(order_.size()));
}

void BorderIndex::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
    if (count > 0xFFFF) throw_if_interrupted();
    const auto begin = order_.begin() + first;
    Node box;
    box.low = glm::min(segments_[*begin].a, segments_[*begin].b);
    box.high = glm::max(segments_[*begin].a, segments_[*begin].b);
    for (auto it = begin; it != begin + count; ++it) {
        const Segment& s = segments_[*it];
        box.low = glm::min(box.low, glm::min(s.a, s.b));
        box.high = glm::max(box.high, glm::max(s.a, s.b));
    }
    box.first = first;
    box.count = count;
    if (count > kLeafSize) {
        const glm::vec3 size = box.high - box.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::uint32_t half = count / 2;
        std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t i, std::uint32_t j) {
            return segments_[i].a[axis] + segments_[i].b[axis] < segments_[j].a[axis] + segments_[j].b[axis];
        });
        box.first = static_cast<std::uint32_t>(nodes_.size());
        box.count = 0;
        nodes_.resize(nodes_.size() + 2);
        build(box.first, first, half);
        build(box.first + 1, first + half, count - half);
    }
    nodes_[node] = box;
}

std::optional<HalfEdge> BorderIndex::seam_partner(HalfEdge half_edge, const glm::dvec3& at) const {
    const auto own = std::lower_bound(segments_.begin(), segments_.end(), half_edge,
                                      [](const Segment& s, HalfEdge h) { return s.half_edge < h; });
    if (own == segments_.end() || own->half_edge != half_edge) return std::nullopt;
    const glm::dvec3 along = glm::dvec3(own->b) - glm::dvec3(own->a);
    const double length = glm::length(along);
    double reach = 0.05 * length;
    std::optional<HalfEdge> partner;
    std::uint32_t stack[64];  // halving 2^32 segments takes 32 levels
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const Node& node = nodes_[stack[--top]];
        // The margin keeps rounding from hiding an equally near one.
        if (distance_to_box(at, node.low, node.high) > reach * (1 + 1e-12)) continue;
        if (node.count == 0) {
            stack[top++] = node.first;
            stack[top++] = node.first + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Segment& other = segments_[order_[i]];
            if (other.polygon == own->polygon) continue;
            const glm::dvec3 a(other.a), b(other.b);
            if (std::abs(glm::dot(along, b - a)) <= 0.9 * length * glm::length(b - a)) continue;
            const double distance = distance_to_segment(at, a, b);
            const bool is_better =
                distance < reach || (distance == reach && partner && other.half_edge < *partner);
            if (is_better) {
                reach = distance;
                partner = other.half_edge;
            }
        }
    }
    return partner;
}

}  // namespace burin
