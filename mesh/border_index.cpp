#include "mesh/border_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// How near a seam's other side must be, in lengths of the edge.
constexpr double kReachPart = 0.05;

glm::dvec3 direction_of(const BorderIndex::Segment& s) { return s.b - s.a; }

bool are_nearly_parallel(const glm::dvec3& along, double length, const BorderIndex::Segment& other) {
    const glm::dvec3 way = direction_of(other);
    return std::abs(glm::dot(along, way)) > 0.9 * length * glm::length(way);
}

/// The segment nearest to a point so far, the first one of several, and how near others must be.
struct Nearest {
    double reach;
    std::optional<HalfEdge> partner;

    void offer(const BorderIndex::Segment& other, const glm::dvec3& at) {
        const double distance = distance_to_segment(at, other.a, other.b);
        if (distance < reach || (distance == reach && partner && other.half_edge < *partner)) {
            reach = distance;
            partner = other.half_edge;
        }
    }
};

/// Whether a box may be so near to a point; the margin keeps rounding from hiding an equally near one.
bool is_box_near(const glm::dvec3& p, const glm::vec3& low, const glm::vec3& high, double reach) {
    const glm::dvec3 outside = glm::max(glm::max(glm::dvec3(low) - p, p - glm::dvec3(high)), glm::dvec3(0.0));
    return glm::dot(outside, outside) <= reach * reach * (1 + 1e-9);
}

/// Whether a box touches another one.
struct TouchedBox {
    glm::dvec3 low, high;
    bool operator()(const glm::dvec3& other_low, const glm::dvec3& other_high) const {
        return glm::all(glm::lessThanEqual(other_low, high)) && glm::all(glm::lessThanEqual(low, other_high));
    }
};

/// In single precision, no larger and no smaller; most numbers come from there.
float rounded_down(double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}
glm::vec3 rounded_down(const glm::dvec3& p) { return {rounded_down(p.x), rounded_down(p.y), rounded_down(p.z)}; }
glm::vec3 rounded_up(const glm::dvec3& p) { return -rounded_down(-p); }

}  // namespace

BorderIndex::BorderIndex(std::vector<Segment> segments) : segments_(std::move(segments)) {
    if (segments_.empty()) return;
    std::vector<Place> places;
    places.reserve(segments_.size());
    for (std::uint32_t i = 0; i < segments_.size(); ++i) places.push_back({glm::vec3(segments_[i].a) + glm::vec3(segments_[i].b), i});
    order_.resize(segments_.size());
    nodes_.reserve(segments_.size());
    nodes_.emplace_back();
    build(0, 0, places);
}

void BorderIndex::build(std::uint32_t node, std::uint32_t first, std::span<Place> places) {
    const auto count = static_cast<std::uint32_t>(places.size());
    if (count > 0xFFFF) throw_if_interrupted();
    Node box;
    if (count > kLeafSize) {
        glm::vec3 low = places.front().middle, high = low;  // of middles: long segments say nothing about where to cut
        for (const Place& place : places) {
            low = glm::min(low, place.middle);
            high = glm::max(high, place.middle);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::uint32_t half = count / 2;
        std::nth_element(places.begin(), places.begin() + half, places.end(),
                         [&](const Place& p, const Place& q) { return p.middle[axis] < q.middle[axis]; });
        box.first = static_cast<std::uint32_t>(nodes_.size());
        nodes_.resize(nodes_.size() + 2);
        build(box.first, first, places.first(half));
        build(box.first + 1, first + half, places.subspan(half));
        const Node &left = nodes_[box.first], &right = nodes_[box.first + 1];
        box.low = glm::min(left.low, right.low);
        box.high = glm::max(left.high, right.high);
    } else {
        box.first = first;
        box.count = count;
        box.low = glm::vec3(std::numeric_limits<float>::infinity());
        box.high = -box.low;
        for (const Place& place : places) {
            const Segment& s = segments_[place.segment];
            box.low = glm::min(box.low, rounded_down(glm::min(s.a, s.b)));
            box.high = glm::max(box.high, rounded_up(glm::max(s.a, s.b)));
            order_[first++] = place.segment;
        }
    }
    nodes_[node] = box;
}

const BorderIndex::Segment* BorderIndex::find(HalfEdge half_edge) const {
    const auto own = std::lower_bound(segments_.begin(), segments_.end(), half_edge,
                                      [](const Segment& s, HalfEdge h) { return s.half_edge < h; });
    return own == segments_.end() || own->half_edge != half_edge ? nullptr : &*own;
}

template <typename MayBeNear, typename Visit>
void BorderIndex::visit_leaves(const MayBeNear& may_be_near, const Visit& visit) const {
    std::uint32_t stack[64];  // halving 2^32 segments takes 32 levels
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const Node& node = nodes_[stack[--top]];
        if (!may_be_near(node.low, node.high)) continue;
        if (node.count == 0) {
            stack[top++] = node.first;
            stack[top++] = node.first + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
    }
}

template <typename MayBeNear, typename Visit>
void BorderIndex::search(const Segment& own, const MayBeNear& may_be_near, const Visit& visit) const {
    const glm::dvec3 along = direction_of(own);
    const double length = glm::length(along);
    visit_leaves(may_be_near, [&](std::uint32_t i) {
        const Segment& other = segments_[i];
        const bool may_be = other.polygon != own.polygon && may_be_near(glm::min(other.a, other.b), glm::max(other.a, other.b));
        if (may_be && are_nearly_parallel(along, length, other)) visit(other);
    });
}

void BorderIndex::find_in_box(const glm::dvec3& low, const glm::dvec3& high, std::vector<std::uint32_t>& found) const {
    if (nodes_.empty()) return;
    visit_leaves(TouchedBox{low, high}, [&](std::uint32_t i) { found.push_back(i); });
}

std::optional<HalfEdge> BorderIndex::seam_partner(HalfEdge half_edge, const glm::dvec3& at) const {
    const Segment* const own = find(half_edge);
    if (own == nullptr) return std::nullopt;
    Nearest nearest{kReachPart * glm::length(direction_of(*own)), {}};
    const glm::dvec3 along = direction_of(*own);
    const double length = glm::length(along);
    visit_leaves([&](const glm::vec3& low, const glm::vec3& high) { return is_box_near(at, low, high, nearest.reach); },
                 [&](std::uint32_t i) {  // a look at its box would take as long as its distance
                     const Segment& other = segments_[i];
                     if (other.polygon != own->polygon && are_nearly_parallel(along, length, other)) nearest.offer(other, at);
                 });
    return nearest.partner;
}

void BorderIndex::find_candidates(HalfEdge half_edge, SeamCandidates& candidates) const {
    candidates.segments_.clear();
    const Segment* const own = find(half_edge);
    if (own == nullptr) return;
    candidates.reach_ = kReachPart * glm::length(direction_of(*own));
    const double margin = candidates.reach_ * (1 + 1e-6);
    const TouchedBox may_be_near{glm::min(own->a, own->b) - margin, glm::max(own->a, own->b) + margin};
    search(*own, may_be_near, [&](const Segment& other) { candidates.segments_.push_back(other); });
}

std::optional<HalfEdge> BorderIndex::SeamCandidates::nearest(const glm::dvec3& at) const {
    Nearest nearest{reach_, {}};
    for (const Segment& other : segments_) nearest.offer(other, at);
    return nearest.partner;
}

}  // namespace burin
