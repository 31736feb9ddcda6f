#include "mesh/segment_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/interrupt.h"

namespace burin {
namespace {

constexpr std::uint32_t kLeafSize = 4;

float rounded_down(double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
glm::vec3 rounded_down(const glm::dvec3& p) { return {rounded_down(p.x), rounded_down(p.y), rounded_down(p.z)}; }

/// One over how wide pieces are on average, along each axis. What is asked for is not a point, so none is thinner than
/// a part of the widest.
glm::vec3 one_per_width(std::span<const SegmentPiece> pieces) {
    constexpr double kThinnestPart = 1e-3;
    glm::dvec3 sum(0.0);
    for (const SegmentPiece& piece : pieces) sum += glm::dvec3(piece.high) - glm::dvec3(piece.low);
    const double widest = std::max({sum.x, sum.y, sum.z});
    if (!(widest > 0)) return glm::vec3(1.0f);
    return glm::vec3(1.0 / glm::max(sum / widest, glm::dvec3(kThinnestPart)));
}

}  // namespace

SegmentPiece piece_around(const glm::dvec3& low, const glm::dvec3& high, std::uint32_t segment) {
    return {rounded_down(low), -rounded_down(-high), segment};
}

SegmentTree::SegmentTree(std::span<const SegmentPiece> pieces, Cut cut) {
    if (pieces.empty()) return;
    std::vector<Place> places;
    places.reserve(pieces.size());
    for (std::uint32_t i = 0; i < pieces.size(); ++i) places.push_back({pieces[i].low + pieces[i].high, i});
    segments_.resize(pieces.size());
    nodes_.reserve(pieces.size());
    nodes_.emplace_back();
    build(pieces, cut == Cut::across_thin_boxes ? one_per_width(pieces) : glm::vec3(1.0f), 0, 0, places);
}

void SegmentTree::build(std::span<const SegmentPiece> pieces, const glm::vec3& weight, std::uint32_t node,
                        std::uint32_t first, std::span<Place> places) {
    const auto count = static_cast<std::uint32_t>(places.size());
    if (count > 0xFFF) throw_if_interrupted();
    Node box;
    if (count > kLeafSize) {
        glm::vec3 low = places.front().middle, high = low;  // of middles: long pieces say nothing about where to cut
        for (const Place& place : places) {
            low = glm::min(low, place.middle);
            high = glm::max(high, place.middle);
        }
        const glm::vec3 size = weight * (high - low);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::uint32_t half = count / 2;
        std::nth_element(places.begin(), places.begin() + half, places.end(),
                         [&](const Place& p, const Place& q) { return p.middle[axis] < q.middle[axis]; });
        box.first = static_cast<std::uint32_t>(nodes_.size());
        nodes_.resize(nodes_.size() + 2);
        build(pieces, weight, box.first, first, places.first(half));
        build(pieces, weight, box.first + 1, first + half, places.subspan(half));
        const Node &left = nodes_[box.first], &right = nodes_[box.first + 1];
        box.low = glm::min(left.low, right.low);
        box.high = glm::max(left.high, right.high);
    } else {
        box.first = first;
        box.count = count;
        box.low = glm::vec3(std::numeric_limits<float>::infinity());
        box.high = -box.low;
        for (const Place& place : places) {
            const SegmentPiece& piece = pieces[place.piece];
            box.low = glm::min(box.low, piece.low);
            box.high = glm::max(box.high, piece.high);
            segments_[first++] = piece.segment;
        }
    }
    nodes_[node] = box;
}

}  // namespace burin
