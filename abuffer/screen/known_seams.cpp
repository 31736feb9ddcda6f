#include "abuffer/screen/known_seams.h"

namespace burin {

std::shared_ptr<const KnownSeams::Along> KnownSeams::along(const BorderIndex& borders, HalfEdge half_edge) {
    std::call_once(has_room_, [&] { entries_.resize(kMost); });  // most meshes have no heaps of borders
    const std::size_t place = half_edge % kMost;
    Entry& entry = entries_[place];
    std::mutex& mutex = mutexes_[place % kMutexes];
    {
        const std::lock_guard lock(mutex);
        if (entry.borders == &borders && entry.half_edge == half_edge) return entry.along;
    }
    BorderIndex::SeamCandidates candidates;  // two threads may do so at a time, and find the same
    const bool is_complete = borders.find_along(half_edge, Along::kFew, candidates);
    const auto found = std::make_shared<const Along>(Along{is_complete, candidates});  // a copy has no room to grow
    const std::lock_guard lock(mutex);
    entry = {&borders, half_edge, found};
    return found;
}

}  // namespace burin
