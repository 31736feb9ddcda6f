#pragma once

#include <algorithm>
#include <cstddef>
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
    /// So many are noted at a time, unless more are allowed: 32 MB.
    static constexpr std::size_t kMostNoted = std::size_t{1} << 22;

    explicit Contests(const ScreenSurfaces& screen, std::size_t most = kMostNoted) : screen_(screen), most_(most), noted_(std::min(std::size_t{1} << 14, most)) {}

    void clear() { count_ = 0; }
    std::size_t count() const { return count_; }
    std::size_t room() const { return noted_.size(); }
    /// Where kernels note them.
    void put_into(SampleView& view) {
        view.contests = noted_.data();
        view.contest_count = &count_;
        view.contest_capacity = static_cast<std::uint32_t>(noted_.size());
    }
    bool has_room() const { return count_ <= noted_.size(); }
    /// Whether there are more than are to be noted at a time.
    bool are_too_many() const { return count_ > most_; }
    /// Room for those that were not noted, and some more.
    void make_room() {
        noted_ = {};
        noted_.resize(std::size_t{count_} + count_ / 8);
    }
    /// Those from `first` on were noted in a view that begins with the sample `offset`.
    void move_from(std::size_t first, std::size_t offset) {
        for (std::size_t i = first; i < std::min(std::size_t{count_}, noted_.size()); ++i) noted_[i].sample += static_cast<std::uint32_t>(offset);
    }
    /// On the edge of a surface that ends at another one, and where two faces fold over, both are level, and rounding says which
    /// is seen. Of those the one in front wins, and of coincident surfaces the first one, as in resolve_visibility().
    /// Only of samples before `end`.
    void settle(SampleTile& samples, std::size_t end);

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
    std::size_t most_;
    std::vector<Contest> noted_;
    std::uint32_t count_ = 0;
    std::vector<std::uint8_t> is_open_;  // per sample: whether a loser may win after all
    std::vector<Relation> relations_;    // some that are known, by a hash
    std::size_t forgotten_ = 0;          // how often one took another's place
};

}  // namespace burin
