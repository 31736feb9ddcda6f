#pragma once

#include <span>
#include <vector>

#include "abuffer/samples/fast_walk.h"

// Many walks take each step together, by a kernel, before decisions ask for them.

namespace burin {

/// The walks that decisions between many pairs of samples take, made at once by TileKernels::Walk::over_mesh(), where
/// they are ordinary.
class WalksAhead {
  public:
    static constexpr std::size_t kMostPairs = MeshWalks::kMost;

    /// `mesh_walks`: where they are made, each time anew.
    WalksAhead(const ScreenSurfaces& screen, const TileKernels& kernels, FastWalker& walker, MeshWalks& mesh_walks);

    /// Walks between pairs, at most kMostPairs, of which at least one sample shows a surface.
    void walk(std::span<const NeighbourSamples> pairs);

    /// What FastWalker::walk() says about the walks of one of these pairs, from either sample. nullptr: not known, or
    /// without a meaning.
    const KnownWalks& known(std::size_t pair) const { return known_[pair]; }

  private:
    struct Asked {
        std::uint32_t instance, pair;
        std::uint32_t from;  // sample 0 or 1
    };
    void ask(std::size_t pair, std::size_t from);
    void walk_asked();
    void note_end(std::size_t ended, const Asked& asked);

    const ScreenSurfaces& screen_;
    const TileKernels& kernels_;
    FastWalker& walker_;
    MeshWalks& mesh_walks_;
    std::span<const NeighbourSamples> pairs_;
    std::vector<Asked> asked_;
    std::vector<KnownWalks> known_;
    std::vector<FastWalk> walks_;
    std::size_t walk_count_ = 0;
    std::vector<FastWalk::Step> steps_;
    std::size_t step_count_ = 0;
};

}  // namespace burin
