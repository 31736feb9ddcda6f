#include "lines/merge_segments.h"

#include <algorithm>
#include <array>
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

/// Blocks are put in order by a few bits of their place first: of those of one tile, hardly two have the same.
constexpr std::size_t kBuckets = 256;
std::size_t bucket_of(std::uint32_t block) { return (block >> 16 & 15u) << 4 | (block & 15u); }

bool is_block_before(std::uint32_t a, std::uint32_t b) {
    const std::size_t p = bucket_of(a), q = bucket_of(b);
    return p != q ? p < q : a < b;
}

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

void SegmentMerger::merge(std::vector<LineSegment>& segments) {
    std::array<std::uint32_t, kBuckets + 1> begin{};
    for (LineSegment& s : segments) {
        put_in_order(s);
        ++begin[bucket_of(s.block) + 1];
    }
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    order_.resize(segments.size());
    auto next = begin;
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
        const LineSegment& s = segments[i];
        order_[next[bucket_of(s.block)]++] = {s.line_key, s.block, i, s.from.x};
    }
    for (std::size_t i = 0; i < kBuckets; ++i) {
        std::sort(order_.begin() + begin[i], order_.begin() + begin[i + 1], [&](const Key& a, const Key& b) {
            if (a.line_key != b.line_key || a.block != b.block) {
                return a.block != b.block ? a.block < b.block : a.line_key < b.line_key;
            }
            return a.from_x != b.from_x ? a.from_x < b.from_x : is_before(segments[a.index], segments[b.index]);
        });
    }
    merged_.clear();
    for (const Key& key : order_) {
        const LineSegment& next_one = segments[key.index];
        if (!merged_.empty() && continues(merged_.back(), next_one)) {
            merged_.back().to = next_one.to;
            merged_.back().nearness_to = next_one.nearness_to;
            merged_.back().occludes = merged_.back().occludes || next_one.occludes;
        } else {
            merged_.push_back(next_one);
        }
    }
    segments.swap(merged_);
}

std::span<const LineSegment> segments_in_block(std::span<const LineSegment> merged, std::uint32_t block) {
    const auto first = std::partition_point(merged.begin(), merged.end(),
                                            [&](const LineSegment& s) { return is_block_before(s.block, block); });
    auto last = first;
    while (last != merged.end() && last->block == block) ++last;
    return {first, last};
}

std::span<const LineSegment> segments_of_line(std::span<const LineSegment> merged, std::uint32_t block,
                                              std::uint64_t line_key) {
    const auto first = std::partition_point(merged.begin(), merged.end(), [&](const LineSegment& s) {
        return s.block != block ? is_block_before(s.block, block) : s.line_key < line_key;
    });
    auto last = first;
    while (last != merged.end() && last->block == block && last->line_key == line_key) ++last;
    return {first, last};
}

}  // namespace burin
