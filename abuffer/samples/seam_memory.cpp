#include "abuffer/samples/seam_memory.h"

#include <limits>

namespace burin {
namespace {

/// Among so many edges the nearest one is found at once.
constexpr std::size_t kFew = 64;

}  // namespace

std::optional<HalfEdge> SeamMemory::partner(const BorderIndex& borders, HalfEdge half_edge, const glm::dvec3& at) {
    if (borders.has_crowds()) {
        const KnownSeams::Along& along = list_in_crowd(borders, half_edge);
        if (along.is_complete) return along.candidates.nearest(at);
    }
    if (entries_.empty()) entries_.resize(kEntries);
    Entry& entry = entries_[half_edge % kEntries];
    const bool is_other = entry.borders != &borders || entry.half_edge != half_edge;
    if (is_other) {
        entry.borders = &borders;
        entry.half_edge = half_edge;
        entry.use = borders.has_crowds() ? Use::has_many : Use::once;
        entry.neighbourhood = {};
    }
    // What is asked for once needs no list, and one of very many is found faster by place.
    if (!is_other && entry.use == Use::once) {
        constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
        borders.find_candidates(half_edge, kAll, entry.candidates);
        entry.use = entry.candidates.segments().size() <= kFew ? Use::has_list : Use::has_many;
        if (entry.use == Use::has_many) entry.candidates = {};
    }
    if (entry.use == Use::has_many) return partner_near_last(entry, at);
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

std::optional<HalfEdge> SeamMemory::partner_near_last(Entry& entry, const glm::dvec3& at) {
    auto answer = entry.neighbourhood.partner_at(at);
    if (!answer.has_answer) {
        entry.neighbourhood = entry.borders->neighbourhood(entry.half_edge, at);
        answer = entry.neighbourhood.partner_at(at);
    }
    // Where several are equally near, seam_partner() chooses the first one.
    return answer.has_answer ? answer.partner : entry.borders->seam_partner(entry.half_edge, at);
}

}  // namespace burin
