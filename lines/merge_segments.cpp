#include "lines/merge_segments.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace burin {
namespace {

constexpr double kStraightPx = 1.0 / 2048;

/// From left to right, or downwards.
void put_in_order(LineSegment& s) {
    if (s.from.x < s.to.x || (s.from.x == s.to.x && s.from.y < s.to.y)) return;
    std::swap(s.from, s.to);
    std::swap(s.nearness_from, s.nearness_to);
    s.front_on_left = !s.front_on_left;
}

/// What pieces are sorted by, so that few of them are looked at, and none is moved.
struct SortKey {
    std::uint64_t line_key;
    std::uint32_t block, index;
    double from_x;
};

bool is_before(const LineSegment& a, const LineSegment& b) {
    if (a.from.x != b.from.x) return a.from.x < b.from.x;
    if (a.from.y != b.from.y) return a.from.y < b.from.y;
    if (a.to.x != b.to.x) return a.to.x < b.to.x;
    return a.to.y != b.to.y ? a.to.y < b.to.y : a.opacity < b.opacity;
}

bool continues(const LineSegment& a, const LineSegment& b) {
    const bool is_same_line = a.line_key == b.line_key && a.drawn_as == b.drawn_as && a.is_drawn == b.is_drawn &&
                              a.opacity == b.opacity && a.block == b.block;
    if (!is_same_line || a.to != b.from || a.front_on_left != b.front_on_left) return false;
    const glm::dvec2 along = b.to - a.from, bend = a.to - a.from;
    const double area = along.x * bend.y - along.y * bend.x;
    return area * area <= kStraightPx * kStraightPx * glm::dot(along, along) && glm::dot(along, bend) > 0;
}

}  // namespace

void merge_segments(std::vector<LineSegment>& segments) {
    std::vector<SortKey> order(segments.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        put_in_order(segments[i]);
        order[i] = {segments[i].line_key, segments[i].block, i, segments[i].from.x};
    }
    std::sort(order.begin(), order.end(), [&](const SortKey& a, const SortKey& b) {
        if (a.line_key != b.line_key) return a.line_key < b.line_key;
        if (a.block != b.block) return a.block < b.block;
        return a.from_x != b.from_x ? a.from_x < b.from_x : is_before(segments[a.index], segments[b.index]);
    });
    std::vector<LineSegment> merged;
    merged.reserve(segments.size());
    for (const SortKey& key : order) {
        const LineSegment& next = segments[key.index];
        if (!merged.empty() && continues(merged.back(), next)) {
            merged.back().to = next.to;
            merged.back().nearness_to = next.nearness_to;
            merged.back().occludes = merged.back().occludes || next.occludes;
        } else {
            merged.push_back(next);
        }
    }
    segments = std::move(merged);
}

}  // namespace burin
