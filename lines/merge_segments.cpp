#include "lines/merge_segments.h"

#include <algorithm>
#include <cmath>
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

bool is_before(const LineSegment& a, const LineSegment& b) {
    if (a.line_key != b.line_key) return a.line_key < b.line_key;
    if (a.block != b.block) return a.block < b.block;
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
    for (LineSegment& s : segments) put_in_order(s);
    std::sort(segments.begin(), segments.end(), is_before);
    std::size_t kept = 0;
    for (std::size_t i = 1; i < segments.size(); ++i) {
        if (continues(segments[kept], segments[i])) {
            segments[kept].to = segments[i].to;
            segments[kept].nearness_to = segments[i].nearness_to;
            segments[kept].occludes = segments[kept].occludes || segments[i].occludes;
        } else {
            segments[++kept] = segments[i];
        }
    }
    if (!segments.empty()) segments.resize(kept + 1);
}

}  // namespace burin
