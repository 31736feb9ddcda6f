#include "methods/abuffer/seam_memory.h"

namespace burin {

std::optional<HalfEdge> SeamMemory::partner(const BorderIndex& borders, HalfEdge half_edge, const glm::dvec3& at) {
    if (entries_.empty()) entries_.resize(kEntries);
    Entry& entry = entries_[half_edge % kEntries];
    if (entry.borders != &borders || entry.half_edge != half_edge) {
        entry.borders = &borders;
        entry.half_edge = half_edge;
        borders.find_candidates(half_edge, entry.candidates);
    }
    return entry.candidates.nearest(at);
}

}  // namespace burin
