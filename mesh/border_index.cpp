#include "mesh/border_index.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"

namespace burin {
namespace {

/// Cells may share a key: that costs time, not correctness.
std::uint64_t key_of(const std::array<std::int64_t, 3>& c) {
    return static_cast<std::uint64_t>(c[0]) * 0x9E3779B97F4A7C15u ^
           static_cast<std::uint64_t>(c[1]) * 0xC2B2AE3D27D4EB4Fu ^
           static_cast<std::uint64_t>(c[2]) * 0x165667B19E3779F9u;
}

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = b - a;
    const double length2 = glm::dot(d, d);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * d);
}

}  // namespace

BorderIndex::BorderIndex(std::vector<Segment> segments) : segments_(std::move(segments)) {
    if (segments_.empty()) return;
    double total = 0;
    low_ = segments_[0].a;
    for (const Segment& s : segments_) {
        total += static_cast<double>(glm::distance(s.a, s.b));
        low_ = glm::min(low_, glm::dvec3(glm::min(s.a, s.b)));
    }
    cell_size_ = std::max(total / static_cast<double>(segments_.size()), 1e-300);
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const glm::dvec3 a(segments_[i].a), b(segments_[i].b);
        const int steps = static_cast<int>(std::min(2 * glm::distance(a, b) / cell_size_, 1000.0)) + 1;
        for (int k = 0; k <= steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            places_.emplace_back(key_of(cell_of(glm::mix(a, b, t))), i);
        }
    }
    std::sort(places_.begin(), places_.end());
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
}

BorderIndex::Cell BorderIndex::cell_of(const glm::dvec3& p) const {
    const glm::dvec3 c = glm::floor(glm::clamp((p - low_) / cell_size_, -1e15, 1e15));
    return {static_cast<std::int64_t>(c.x), static_cast<std::int64_t>(c.y),
            static_cast<std::int64_t>(c.z)};
}

std::optional<HalfEdge> BorderIndex::seam_partner(HalfEdge half_edge, const glm::dvec3& at) const {
    const auto own = std::lower_bound(segments_.begin(), segments_.end(), half_edge,
                                      [](const Segment& s, HalfEdge h) { return s.half_edge < h; });
    if (own == segments_.end() || own->half_edge != half_edge) return std::nullopt;
    const glm::dvec3 along = glm::dvec3(own->b) - glm::dvec3(own->a);
    const double length = glm::length(along);
    double reach = std::min(0.05 * length, cell_size_);
    std::optional<HalfEdge> partner;
    const Cell center = cell_of(at);
    for (int i = 0; i < 27; ++i) {
        const Cell cell{center[0] + i % 3 - 1, center[1] + i / 3 % 3 - 1, center[2] + i / 9 - 1};
        const std::uint64_t key = key_of(cell);
        auto it = std::lower_bound(places_.begin(), places_.end(),
                                   std::pair<std::uint64_t, std::uint32_t>(key, 0));
        for (; it != places_.end() && it->first == key; ++it) {
            const Segment& other = segments_[it->second];
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
