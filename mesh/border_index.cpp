#include "mesh/border_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/near_segment.h"

namespace burin {
namespace {

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = b - a;
    const double length2 = glm::dot(d, d);
    const double t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * d);
}

/// How near a seam's other side must be, in lengths of the edge, unless borders lie in a heap.
constexpr double kWidestReachPart = 0.05;

glm::dvec3 direction_of(const BorderIndex::Segment& s) { return s.b - s.a; }

constexpr double kCosParallel = DirectedSegments::kCosParallel;

bool are_nearly_parallel(const glm::dvec3& along, double length, const BorderIndex::Segment& other) {
    const glm::dvec3 way = direction_of(other);
    return std::abs(glm::dot(along, way)) > kCosParallel * length * glm::length(way);
}

/// Whether one may be a partner of the other, wherever it is.
bool may_be_partners(const BorderIndex::Segment& own, const glm::dvec3& along, double length,
                     const BorderIndex::Segment& other) {
    return other.polygon != own.polygon && are_nearly_parallel(along, length, other);
}

/// Whether a box touches another one.
struct TouchedBox {
    glm::dvec3 low, high;
    bool operator()(const glm::dvec3& other_low, const glm::dvec3& other_high) const {
        return glm::all(glm::lessThanEqual(other_low, high)) && glm::all(glm::lessThanEqual(low, other_high));
    }
    FourBoxes::AreNear operator()(const FourBoxes& boxes) const {
        FourBoxes::AreNear near{true, true, true, true};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double least = low[static_cast<int>(axis)], most = high[static_cast<int>(axis)];
            for (std::size_t k = 0; k < FourBoxes::kCount; ++k) {
                near[k] = near[k] & (static_cast<double>(boxes.low[axis][k]) <= most) &
                          (least <= static_cast<double>(boxes.high[axis][k]));
            }
        }
        return near;
    }
};

/// Whether two segments come as near to each other as `margin`, but for rounding.
bool are_near(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, double margin) {
    const glm::dvec3 u = b - a, v = d - c, w = a - c;
    const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), area = uu * vv - uv * uv;
    // Most pass each other: already the straight lines through them are too far apart, whatever rounding does.
    constexpr double kMore = 1 + 1e-6, kByRounding = 1e-14;
    const glm::dvec3 across = glm::cross(u, v);
    if (std::abs(glm::dot(w, across)) >
        kMore * margin * glm::length(across) + kByRounding * std::sqrt(uu * vv) * (glm::length(w) + margin))
        return false;
    if (area > 0) {
        const double s = std::clamp((uv * glm::dot(v, w) - vv * glm::dot(u, w)) / area, 0.0, 1.0);
        if (distance_to_segment(a + s * u, c, d) <= margin) return true;
    }
    return distance_to_segment(a, c, d) <= margin || distance_to_segment(b, c, d) <= margin ||
           distance_to_segment(c, a, b) <= margin || distance_to_segment(d, a, b) <= margin;
}

SegmentPiece whole_of(const BorderIndex::Segment& s, std::uint32_t number) {
    return piece_around(glm::min(s.a, s.b), glm::max(s.a, s.b), number);
}

/// A set of some numbers.
class NumberSet {
  public:
    std::size_t count() const { return count_; }
    /// Returns false if the number was there already. There must not be more than half as many as there are places.
    bool add(std::uint32_t number) {
        constexpr std::uint32_t kSpread = 2654435769u;
        for (std::uint32_t i = number * kSpread >> (32 - kShift);; i = (i + 1) % kPlaces) {
            if (numbers_[i] == number) return false;
            if (numbers_[i] != kNone) continue;
            numbers_[i] = number;
            ++count_;
            return true;
        }
    }

  private:
    static constexpr int kShift = 10;
    static constexpr std::uint32_t kPlaces = 1u << kShift, kNone = 0xFFFFFFFFu;
    static_assert(2 * (BorderIndex::kMostNear + 1) <= kPlaces);
    std::array<std::uint32_t, kPlaces> numbers_ = filled();
    std::size_t count_ = 0;

    static std::array<std::uint32_t, kPlaces> filled() {
        std::array<std::uint32_t, kPlaces> none;
        none.fill(kNone);
        return none;
    }
};

}  // namespace

/// The segment nearest to a point so far, the first one of several, and how near others must be.
struct BorderIndex::Nearest {
    double reach;
    std::optional<HalfEdge> partner;

    void offer(const Segment& other, const glm::dvec3& at) {
        const double distance = distance_to_segment(at, other.a, other.b);
        if (distance < reach || (distance == reach && partner && other.half_edge < *partner)) {
            reach = distance;
            partner = other.half_edge;
        }
    }
};

BorderIndex::BorderIndex(std::vector<Segment> segments) : segments_(std::move(segments)) {
    std::vector<SegmentPiece> all;
    all.reserve(segments_.size());
    for (std::uint32_t i = 0; i < segments_.size(); ++i) all.push_back(whole_of(segments_[i], i));
    whole_ = SegmentTree(all);
    if (is_crowded()) {
        std::vector<DirectedSegments::Ends> ends;
        ends.reserve(segments_.size());
        for (const Segment& s : segments_) ends.push_back({s.a, s.b});
        directed_ = DirectedSegments(ends);
        std::vector<PointTree<6, float>::Point> boxes;
        boxes.reserve(all.size());
        for (const SegmentPiece& p : all)
            boxes.push_back({{p.low.x, p.low.y, p.low.z, p.high.x, p.high.y, p.high.z}, p.segment});
        boxes_ = PointTree<6, float>(std::move(boxes));
    }
    reach_part_ = has_several_polygons() ? (has_crowds() ? reach_part_in_crowd() : kWidestReachPart) : 0;
}

bool BorderIndex::has_several_polygons() const {
    return std::any_of(segments_.begin(), segments_.end(),
                       [&](const Segment& s) { return s.polygon != segments_.front().polygon; });
}

/// The reach, in lengths of the edge, at which few borders are near an edge on average: the widest one, halved as often
/// as that takes. It is counted at the middles of 64 segments all over the mesh. In a heap, looking at all borders in
/// the widest reach would take time that grows with their square, and which of them is nearest would mean nothing.
double BorderIndex::reach_part_in_crowd() const {
    constexpr std::size_t kAsked = 64, kFew = 4;
    constexpr int kMostHalvings = 24;
    double part = kWidestReachPart;
    for (int halvings = 0; halvings < kMostHalvings; ++halvings, part /= 2) {
        std::size_t in_reach = 0;
        std::vector<std::uint32_t> seen;
        for (std::size_t i = 0; i < kAsked && in_reach <= kFew * kAsked; ++i) {
            seen.clear();
            const Segment& own = segments_[by_place()[i * segments_.size() / kAsked]];
            const glm::dvec3 along = direction_of(own), middle = 0.5 * (own.a + own.b);
            const double length = glm::length(along), reach = part * length;
            double left = reach;
            visit_nearest(along / length, middle, left, [&](std::uint32_t k) {
                const Segment& other = segments_[k];
                if (in_reach > kFew * kAsked || !may_be_partners(own, along, length, other)) return;
                if (distance_to_segment(middle, other.a, other.b) > reach ||
                    std::find(seen.begin(), seen.end(), k) != seen.end())
                    return;
                seen.push_back(k);
                if (++in_reach > kFew * kAsked) left = 0;
            });
        }
        if (in_reach <= kFew * kAsked) break;
    }
    return part;
}

/// Whether long segments run through each other's boxes, so that these tell little: asked of some segments all over the
/// mesh.
bool BorderIndex::is_crowded() const {
    constexpr std::size_t kAsked = 64, kMany = 24;
    if (segments_.size() <= kAsked) return false;
    std::size_t looked_at = 0;
    for (std::size_t i = 0; i < kAsked; ++i) {
        const Segment& s = segments_[by_place()[i * segments_.size() / kAsked]];
        const glm::dvec3 middle = 0.5 * (s.a + s.b);
        whole_.visit_leaves(TouchedBox{middle, middle}, [&](std::uint32_t) { return ++looked_at <= kMany * kAsked; });
    }
    return looked_at > kMany * kAsked;
}

const BorderIndex::Segment* BorderIndex::find(HalfEdge half_edge) const {
    const auto own = std::lower_bound(segments_.begin(), segments_.end(), half_edge,
                                      [](const Segment& s, HalfEdge h) { return s.half_edge < h; });
    return own == segments_.end() || own->half_edge != half_edge ? nullptr : &*own;
}

void BorderIndex::find_in_box(const glm::dvec3& low, const glm::dvec3& high, std::vector<std::uint32_t>& found) const {
    visit_boxes(low, high, [&](std::uint32_t i) {
        found.push_back(i);
        return true;
    });
}

/// Calls visit(number) for all segments whose boxes touch a box, and for some beside it, until it says false.
template <typename Visit>
void BorderIndex::visit_boxes(const glm::dvec3& low, const glm::dvec3& high, const Visit& visit) const {
    if (boxes_.is_empty()) return whole_.visit_leaves(TouchedBox{low, high}, visit);
    using Coordinates = PointTree<6, float>::Coordinates;
    const auto may_touch = [touches = TouchedBox{low, high}](const Coordinates& least, const Coordinates& most) {
        return touches({least[0], least[1], least[2]}, {most[3], most[4], most[5]});
    };
    boxes_.visit(may_touch, visit);
}

std::optional<HalfEdge> BorderIndex::seam_partner(HalfEdge half_edge, const glm::dvec3& at) const {
    const Segment* const own = find(half_edge);
    if (own == nullptr || !has_partners()) return std::nullopt;
    Nearest nearest{reach_part_ * glm::length(direction_of(*own)), {}};
    find_nearest(*own, at, nearest);
    return nearest.partner;
}

/// Calls visit(number) for all segments along a direction that may be as near to a point as `reach`, which visit() may
/// lower meanwhile, and for others.
template <typename Visit>
void BorderIndex::visit_nearest(const glm::dvec3& direction, const glm::dvec3& at, const double& reach,
                                const Visit& visit) const {
    if (has_crowds()) return directed_.visit_nearest(direction, at, reach, visit);
    whole_.visit_nearest(at, reach, visit);
}

/// The nearest one, if it is nearer than the one that is known, or that far and comes first.
void BorderIndex::find_nearest(const Segment& own, const glm::dvec3& at, Nearest& nearest) const {
    const glm::dvec3 along = direction_of(own);
    const double length = glm::length(along);
    visit_nearest(along / length, at, nearest.reach,
                  [&](std::uint32_t i) {  // a look at its box would take as long as its distance
                      const Segment& other = segments_[i];
                      if (may_be_partners(own, along, length, other)) nearest.offer(other, at);
                  });
}

std::optional<HalfEdge> BorderIndex::seam_partner(HalfEdge half_edge, const glm::dvec3& at, const Sight& sight) const {
    const Segment* const own = find(half_edge);
    if (own == nullptr || !has_partners()) return std::nullopt;
    const glm::dvec3 along = direction_of(*own);
    const double length = glm::length(along);
    Nearest nearest{reach_part_ * length, {}};
    // A segment that is nearly parallel to the edge, passes within `reach` of the place, and within `radius` of the
    // line of sight, does so at a distance of at most (reach + radius) / sine from the place: the sine of the least
    // angle between it and the line of sight.
    constexpr double kLeastSine = 1.0 / 8, kSineOfParallel = 0.436;  // a trifle more than sqrt(1 - kCosParallel^2)
    const double cosine = std::min(std::abs(glm::dot(along, sight.direction)) / length, 1.0);
    const double sine = std::sqrt(1 - cosine * cosine) * kCosParallel - cosine * kSineOfParallel;
    const double per_radius = 1 - sight.growth / sine;
    if (!(sine > kLeastSine) || !(per_radius > 0.5)) {  // seen end-on
        find_nearest(*own, at, nearest);
        return nearest.partner;
    }
    const double radius = (sight.radius + sight.growth * nearest.reach / sine) / per_radius;
    if (sight.radius >= nearest.reach) {  // all in reach are seen near the place
        find_nearest(*own, at, nearest);
        return nearest.partner;
    }
    const double along_sight = (nearest.reach + radius) / sine;
    const glm::dvec3 from = at - along_sight * sight.direction, to = at + along_sight * sight.direction;
    double farthest = along_sight + radius;
    const auto offer_if_seen = [&](std::uint32_t i) {
        const Segment& other = segments_[i];
        if (!may_be_partners(*own, along, length, other)) return;
        if (!(distance_to_segment(at, other.a, other.b) <= nearest.reach) ||
            !are_near(from, to, other.a, other.b, radius))
            return;
        nearest.offer(other, at);
        farthest = (nearest.reach + radius) / sine + radius;
    };
    if (has_crowds()) {
        directed_.visit_nearest(along / length, at, farthest, from, to, radius, offer_if_seen);
    } else {
        whole_.visit_nearest(at, farthest, NearSegment{from, to, radius}, offer_if_seen);
    }
    // A segment that is seen elsewhere may be nearer.
    if (nearest.partner) find_nearest(*own, at, nearest);
    return nearest.partner;
}

bool BorderIndex::find_candidates(HalfEdge half_edge, std::size_t most, SeamCandidates& candidates) const {
    candidates.segments_.clear();
    const Segment* const own = find(half_edge);
    if (own == nullptr) return true;
    const glm::dvec3 along = direction_of(*own);
    const double length = glm::length(along);
    candidates.reach_ = reach_part_ * length;
    const double margin = candidates.reach_ * (1 + 1e-6);
    const TouchedBox may_be_near{glm::min(own->a, own->b) - margin, glm::max(own->a, own->b) + margin};
    std::size_t count = 0;
    visit_boxes(may_be_near.low, may_be_near.high, [&](std::uint32_t i) {
        const Segment& other = segments_[i];
        if (!may_be_near(glm::min(other.a, other.b), glm::max(other.a, other.b))) return true;
        if (++count > most) return false;
        if (may_be_partners(*own, along, length, other)) candidates.segments_.push_back(other);
        return true;
    });
    if (count > most) candidates.segments_.clear();
    return count <= most;
}

bool BorderIndex::find_near(HalfEdge half_edge, std::size_t most, SeamCandidates& candidates) const {
    return list_near(half_edge, {}, most, false, candidates);
}

bool BorderIndex::find_along(HalfEdge half_edge, std::size_t most, SeamCandidates& candidates) const {
    return find_along(half_edge, {}, most, candidates);
}

bool BorderIndex::find_along(HalfEdge half_edge, Stretch stretch, std::size_t most, SeamCandidates& candidates) const {
    return list_near(half_edge, stretch, most, true, candidates);
}

/// Lists the candidates within reach of a part of an edge; counts all segments there, or only those that may be
/// partners.
bool BorderIndex::list_near(HalfEdge half_edge, Stretch stretch, std::size_t most, bool counts_partners_only,
                            SeamCandidates& candidates) const {
    candidates.segments_.clear();
    const Segment* const own = find(half_edge);
    if (own == nullptr) return true;
    const glm::dvec3 along = direction_of(*own);
    const double length = glm::length(along);
    candidates.reach_ = reach_part_ * length;
    const double margin = candidates.reach_ * (1 + 1e-3);  // a trifle more, for rounding
    const glm::dvec3 a = glm::mix(own->a, own->b, stretch.begin), b = glm::mix(own->a, own->b, stretch.end);
    most = std::min(most, kMostNear);
    NumberSet seen;
    const auto look_at = [&](std::uint32_t i) {
        const Segment& other = segments_[i];
        const bool may_be_partner = may_be_partners(*own, along, length, other);
        if (counts_partners_only && !may_be_partner) return true;
        if (!are_near(a, b, other.a, other.b, margin) || !seen.add(i)) return true;
        if (seen.count() > most) return false;
        if (may_be_partner) candidates.segments_.push_back(other);
        return true;
    };
    if (!has_crowds()) {
        whole_.visit_leaves(NearSegment(a, b, margin), look_at);
    } else if (counts_partners_only) {
        directed_.visit_along(along / length, a, b, margin, look_at);
    } else {
        directed_.visit_near(a, b, margin, look_at);
    }
    if (seen.count() > most) candidates.segments_.clear();
    return seen.count() <= most;
}

std::optional<HalfEdge> BorderIndex::SeamCandidates::nearest(const glm::dvec3& at) const {
    Nearest nearest{reach_, {}};
    for (const Segment& other : segments_) nearest.offer(other, at);
    return nearest.partner;
}

}  // namespace burin
