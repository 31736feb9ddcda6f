#pragma once

#include <cstdint>
#include <vector>

#include "abuffer/sample_tile.h"
#include "abuffer/tile_kernels.h"
#include "lines/surface_set.h"
#include "methods/abuffer/screen/screen_surfaces.h"

namespace burin {

/// Samples of a tile where surfaces are level, noted while they are drawn, and which of them is seen. Buffers are used again.
class Contests {
  public:
    explicit Contests(const ScreenSurfaces& screen) : screen_(screen), noted_(1 << 14) {}

    void clear() { count_ = 0; }
    /// Where kernels note them.
    void put_into(SampleView& view) {
        view.contests = noted_.data();
        view.contest_count = &count_;
        view.contest_capacity = static_cast<std::uint32_t>(noted_.size());
    }
    /// Whether some were not noted for want of room, which there is now.
    bool make_room() {
        if (count_ <= noted_.size()) return false;
        noted_.resize(count_);
        return true;
    }
    /// On the edge of a surface that ends at another one, and where two faces fold over, both are level, and rounding says which
    /// is seen. Of those the one in front wins, and of coincident surfaces the first one, as in resolve_visibility().
    void settle(SampleTile& samples);

  private:
    /// How a triangle that is level with what is seen lies to it.
    struct Relation {
        std::uint32_t loser = ~0u, winner = ~0u;
        bool is_in_front = false;  // but for rounding, wherever both are
        bool folds_over = false;   // in front, at their common edge
        bool comes_first = false;  // they coincide, and it is the first one
        bool any() const { return is_in_front || folds_over || comes_first; }
    };
    const Relation& relation(std::uint32_t loser, std::uint32_t winner);
    bool is_fold_over(std::uint32_t front, std::uint32_t back) const;
    bool may_be_in_front(std::uint32_t front, std::uint32_t back) const;
    SurfaceOrder order(std::uint32_t loser, std::uint32_t winner) const;

    const ScreenSurfaces& screen_;
    std::vector<Contest> noted_;
    std::uint32_t count_ = 0;
    std::vector<std::uint8_t> is_open_;  // per sample: whether a loser may win after all
    std::vector<Relation> relations_;    // some that are known, by a hash
    std::size_t forgotten_ = 0;          // how often one took another's place
};

}  // namespace burin
