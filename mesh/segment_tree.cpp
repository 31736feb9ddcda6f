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
    nodes_.reserve(pieces.size() / 2);
    nodes_.emplace_back();
    build(pieces, cut == Cut::across_thin_boxes ? one_per_width(pieces) : glm::vec3(1.0f), 0, 0, places);
}

std::uint32_t SegmentTree::cut(const glm::vec3& weight, std::span<Place> places) {
    glm::vec3 low = places.front().middle, high = low;  // of middles: long pieces say nothing about where to cut
    for (const Place& place : places) {
        low = glm::min(low, place.middle);
        high = glm::max(high, place.middle);
    }
    const glm::vec3 size = weight * (high - low);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto half = static_cast<std::uint32_t>(places.size() / 2);
    std::nth_element(places.begin(), places.begin() + half, places.end(),
                     [&](const Place& p, const Place& q) { return p.middle[axis] < q.middle[axis]; });
    return half;
}

FourBoxes::Box SegmentTree::build(std::span<const SegmentPiece> pieces, const glm::vec3& weight, std::uint32_t node,
                                  std::uint32_t first, std::span<Place> places) {
    if (places.size() > 0xFFF) throw_if_interrupted();
    FourBoxes::Box all;
    std::size_t k = 0;
    const auto add = [&](std::uint32_t begin, std::uint32_t end) {
        const std::span<Place> part = places.subspan(begin, end - begin);
        FourBoxes::Box box;
        std::uint32_t at = first + begin;
        if (part.size() > kLeafSize) {
            at = static_cast<std::uint32_t>(nodes_.size());
            nodes_.emplace_back();
            box = build(pieces, weight, at, first + begin, part);
        } else {
            box = add_leaf(pieces, at, part);
            nodes_[node].piece_count[k] = static_cast<std::uint32_t>(part.size());
        }
        nodes_[node].first[k] = at;
        nodes_[node].boxes.set(k++, box);
        all.low = glm::min(all.low, box.low);
        all.high = glm::max(all.high, box.high);
    };
    const auto add_halves = [&](std::uint32_t begin, std::uint32_t end) {
        if (end - begin <= kLeafSize) return add(begin, end);
        const std::uint32_t half = begin + cut(weight, places.subspan(begin, end - begin));
        add(begin, half);
        add(half, end);
    };
    const auto count = static_cast<std::uint32_t>(places.size());
    if (count <= kLeafSize) {
        add(0, count);
        return all;
    }
    const std::uint32_t half = cut(weight, places);
    add_halves(0, half);
    add_halves(half, count);
    return all;
}

FourBoxes::Box SegmentTree::add_leaf(std::span<const SegmentPiece> pieces, std::uint32_t first,
                                     std::span<const Place> places) {
    FourBoxes::Box box;
    for (const Place& place : places) {
        const SegmentPiece& piece = pieces[place.piece];
        box.low = glm::min(box.low, piece.low);
        box.high = glm::max(box.high, piece.high);
        segments_[first++] = piece.segment;
    }
    return box;
}

}  // namespace burin
