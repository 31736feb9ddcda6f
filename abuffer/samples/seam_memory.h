#pragma once

#include <optional>
#include <vector>

#include "mesh/border_index.h"

// Seam partners are remembered from sample to sample, since looking them up is slow where borders lie in heaps.

namespace burin {

/// BorderIndex::seam_partner() for places that are asked for one after the other along the same few edges: remembers
/// which edges run along each of them, or in a crowd what is nearest to the last place.
class SeamMemory {
  public:
    std::optional<HalfEdge> partner(const BorderIndex& borders, HalfEdge half_edge, const glm::dvec3& at);

  private:
    static constexpr std::size_t kEntries = 512;
    enum class Use : std::uint8_t { once, has_list, has_many };
    struct Entry {
        const BorderIndex* borders = nullptr;
        HalfEdge half_edge = 0;
        Use use = Use::once;
        BorderIndex::SeamCandidates candidates;
        BorderIndex::Neighbourhood neighbourhood;  ///< where many run along an edge
    };
    static std::optional<HalfEdge> partner_in_crowd(Entry& entry, const glm::dvec3& at);

    std::vector<Entry> entries_;
};

}  // namespace burin
