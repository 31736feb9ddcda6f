#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "mesh/border_index.h"

// Which borders run along a border is remembered for the whole frame, since listing them takes long in a heap.

namespace burin {

/// Lists of BorderIndex::find_along(), as all threads of a frame ask for them: where the lines of a border are found,
/// and where samples beside it are joined over a seam. It may forget some.
class KnownSeams {
  public:
    /// What runs along a border, if that is few.
    struct Along {
        static constexpr std::size_t kFew = 32;
        bool is_complete = false;  ///< if not, there are more than kFew, and `candidates` is empty
        BorderIndex::SeamCandidates candidates;
    };
    std::shared_ptr<const Along> along(const BorderIndex& borders, HalfEdge half_edge);

  private:
    static constexpr std::size_t kMost = std::size_t{1} << 17, kMutexes = 256;
    struct Entry {
        const BorderIndex* borders = nullptr;
        HalfEdge half_edge = 0;
        std::shared_ptr<const Along> along;
    };
    std::once_flag has_room_;
    std::vector<Entry> entries_;
    std::array<std::mutex, kMutexes> mutexes_;
};

}  // namespace burin
