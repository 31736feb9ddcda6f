#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "abuffer/screen/known_seams.h"
#include "mesh/border_index.h"

// Seam partners are remembered from sample to sample, since looking them up is slow where borders lie in heaps.

namespace burin {

/// BorderIndex::seam_partner() for places that are asked for one after the other along the same edges: remembers which
/// edges run along each of them, or where they are too many, along parts of it.
class SeamMemory {
  public:
    explicit SeamMemory(KnownSeams& known) : known_(known) {}
    /// `share`: where the place is on the edge, 0 to 1.
    std::optional<HalfEdge> partner(const BorderIndex& borders, HalfEdge half_edge, double share, const glm::dvec3& at);

  private:
    static constexpr std::size_t kEntries = 512;
    enum class Use : std::uint8_t { once, has_list, has_many };
    struct Entry {
        const BorderIndex* borders = nullptr;
        HalfEdge half_edge = 0;
        Use use = Use::once;
        BorderIndex::SeamCandidates candidates;
    };
    /// In a heap a tile shows parts of thousands of edges, and most of them are in the next one, too.
    static constexpr std::size_t kLists = std::size_t{1} << 14;
    struct List {
        const BorderIndex* borders = nullptr;
        HalfEdge half_edge = 0;
        std::shared_ptr<const KnownSeams::Along> along;
    };
    const KnownSeams::Along& list_in_crowd(const BorderIndex& borders, HalfEdge half_edge);
    static constexpr std::size_t kStretches = std::size_t{1} << 12;
    struct Stretch {
        const BorderIndex* borders = nullptr;
        HalfEdge half_edge = 0;
        std::uint32_t number = 0;
        bool is_complete = false;
        BorderIndex::SeamCandidates candidates;
    };
    const Stretch& list_along_stretch(const BorderIndex& borders, HalfEdge half_edge, double share);

    KnownSeams& known_;
    std::vector<Entry> entries_;
    std::vector<List> lists_;
    std::vector<Stretch> stretches_;
};

}  // namespace burin
