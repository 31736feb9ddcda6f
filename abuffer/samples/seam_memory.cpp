#include "abuffer/samples/seam_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin {
namespace {

/// Among so many edges the nearest one is found at once.
constexpr std::size_t kFew = 64;
/// How long a part of an edge is for which edges are listed, in reaches of a partner.
constexpr double kReachesOfStretch = 8;

}  // namespace

std::optional<HalfEdge> SeamMemory::partner(const BorderIndex& borders, HalfEdge half_edge, double share,
                                            const glm::dvec3& at) {
    if (!borders.has_partners()) return std::nullopt;
    const auto nearest_in_stretch = [&] {
        const Stretch& stretch = list_along_stretch(borders, half_edge, share);
        return stretch.is_complete ? stretch.candidates.nearest(at) : borders.seam_partner(half_edge, at);
    };
    if (borders.has_crowds()) {
        const KnownSeams::Along& along = list_in_crowd(borders, half_edge);
        return along.is_complete ? along.candidates.nearest(at) : nearest_in_stretch();
    }
    if (entries_.empty()) entries_.resize(kEntries);
    Entry& entry = entries_[half_edge % kEntries];
    const bool is_other = entry.borders != &borders || entry.half_edge != half_edge;
    if (is_other) {
        entry.borders = &borders;
        entry.half_edge = half_edge;
        entry.use = Use::once;
    }
    // What is asked for once needs no list, and one of very many is found faster by place.
    if (!is_other && entry.use == Use::once) {
        constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
        borders.find_candidates(half_edge, kAll, entry.candidates);
        entry.use = entry.candidates.segments().size() <= kFew ? Use::has_list : Use::has_many;
        if (entry.use == Use::has_many) entry.candidates = {};
    }
    if (entry.use == Use::has_many) return nearest_in_stretch();
    return entry.use == Use::has_list ? entry.candidates.nearest(at) : borders.seam_partner(half_edge, at);
}

/// What runs along an edge.
const KnownSeams::Along& SeamMemory::list_in_crowd(const BorderIndex& borders, HalfEdge half_edge) {
    if (lists_.empty()) lists_.resize(kLists);
    List& list = lists_[half_edge % kLists];
    if (list.borders != &borders || list.half_edge != half_edge) {
        list.borders = &borders;
        list.half_edge = half_edge;
        list.along = known_.along(borders, half_edge);
    }
    return *list.along;
}

/// What runs along the part of an edge that a place is on.
const SeamMemory::Stretch& SeamMemory::list_along_stretch(const BorderIndex& borders, HalfEdge half_edge,
                                                          double share) {
    if (stretches_.empty()) stretches_.resize(kStretches);
    const double count = std::ceil(1 / (kReachesOfStretch * borders.reach_part()));
    const double number = std::clamp(std::floor(share * count), 0.0, count - 1);
    const auto index = static_cast<std::uint32_t>(number);
    Stretch& stretch = stretches_[(half_edge * 2654435761u + index) % kStretches];
    if (stretch.borders == &borders && stretch.half_edge == half_edge && stretch.number == index) return stretch;
    stretch.borders = &borders;
    stretch.half_edge = half_edge;
    stretch.number = index;
    stretch.is_complete = borders.find_along(half_edge, {number / count, (number + 1) / count}, BorderIndex::kMostNear,
                                             stretch.candidates);
    return stretch;
}

}  // namespace burin
