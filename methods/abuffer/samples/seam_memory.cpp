#include "methods/abuffer/samples/seam_memory.h"

namespace burin {

std::optional<HalfEdge> SeamMemory::partner(const BorderIndex& borders, HalfEdge half_edge, const glm::dvec3& at) {
    if (entries_.empty()) entries_.resize(kEntries);
    Entry& entry = entries_[half_edge % kEntries];
    const bool is_other = entry.borders != &borders || entry.half_edge != half_edge;
    if (is_other) entry = {&borders, half_edge, Use::once, {}};
    // What is asked for once needs no list, and one of very many is found faster by place.
    if (!is_other && entry.use == Use::once) {
        constexpr std::size_t kFew = 32;
        borders.find_candidates(half_edge, entry.candidates);
        entry.use = entry.candidates.segments().size() <= kFew ? Use::has_list : Use::has_many;
        if (entry.use == Use::has_many) entry.candidates = {};
    }
    if (entry.use != Use::has_list) return borders.seam_partner(half_edge, at);
    return entry.candidates.nearest(at);
}

}  // namespace burin
