#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abuffer/samples/sample_tile.h"
#include "abuffer/screen/screen_surfaces.h"
#include "kernels/tile_kernels.h"
#include "view/order_memory.h"

// Where surfaces are level at a sample, more than nearness decides which of them is seen.

namespace burin {

/// Samples of a tile where surfaces are level, noted while they are drawn, and which of them is seen. Buffers are used
/// again.
class Contests {
  public:
    /// Where more are level with what is seen at a sample, the nearest of them take part, and of
    /// equally near ones the first. Six were the most in all scenes and models tried.
    static constexpr std::size_t kMostAtSample = 32;
    /// At most this many of a tile are noted before they are selected, unless more are allowed: 3 MB. While they are
    /// selected they take 13 MB, and as much again to sort them.
    static constexpr std::size_t kMostNoted = std::size_t{1} << 18;

    explicit Contests(const ScreenSurfaces& screen, std::size_t most = kMostNoted)
        : screen_(screen), most_(most), noted_(std::min(std::size_t{1} << 14, most)) {}

    /// Begins a tile, before it is drawn. All that are level are noted.
    void clear() {
        count_ = 0;
        is_selecting_ = false;
    }
    /// Draws a tile again that has too many of them, with `sample_count` samples: from now on only those that take part
    /// are kept.
    void begin_selecting(std::size_t sample_count);
    bool is_selecting() const { return is_selecting_; }
    std::size_t count() const { return count_; }
    std::size_t room() const { return noted_.size(); }
    /// Tells kernels where to note contests.
    void put_into(SampleView& view) {
        view.contests = noted_.data();
        view.contest_count = &count_;
        view.contest_capacity = static_cast<std::uint32_t>(noted_.size());
        view.last_nearness = is_selecting_ ? last_nearness_.data() : nullptr;
        view.last_ids = is_selecting_ ? last_ids_.data() : nullptr;
    }
    bool has_room() const { return count_ <= noted_.size(); }
    /// Whether there are more than are to be noted at a time.
    bool are_too_many() const { return count_ > most_; }
    /// Room for those that were not noted, and some more.
    void make_room() {
        noted_ = {};
        noted_.resize(std::size_t{count_} + count_ / 8);
    }
    /// While it is selecting: makes room for `more`, which is at most the number of the tile's samples.
    void make_room_for(std::size_t more) {
        if (count_ + more > noted_.size()) keep_nearest();
    }
    /// How many more there is room for.
    std::size_t room_left() const { return noted_.size() - count_; }
    /// While it is selecting, per sample: the nearness of the last one that takes part, if there
    /// are kMostAtSample; else minus infinity. What is farther can neither be seen nor take part.
    /// And its id.
    const float* last_nearness() const { return last_nearness_.data(); }
    const std::uint32_t* last_ids() const { return last_ids_.data(); }
    /// On the edge of a surface that ends at another one, and where two faces fold over, both are level, and rounding
    /// says which is seen. The one in front wins then, and of coincident surfaces the first one, as in
    /// resolve_visibility().
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
    void keep_nearest();
    const Relation& relation(std::uint32_t loser, std::uint32_t winner);
    bool is_fold_over(std::uint32_t front, std::uint32_t back) const;
    bool may_be_in_front(std::uint32_t front, std::uint32_t back) const;
    SurfaceOrder order(std::uint32_t loser, std::uint32_t winner);

    const ScreenSurfaces& screen_;
    std::size_t most_;
    std::vector<Contest> noted_;
    std::uint32_t count_ = 0;
    bool is_selecting_ = false;
    std::vector<float> last_nearness_;
    std::vector<std::uint32_t> last_ids_;
    std::vector<Contest> by_sample_;  // room to sort in
    std::vector<std::uint32_t> first_of_sample_;
    std::vector<std::uint8_t> is_open_;  // per sample: whether a loser may win after all
    std::vector<Relation> relations_;    // some that are known, by a hash
    std::size_t forgotten_ = 0;          // how often one took another's place
    OrderMemory orders_;                 // what are_rounded_copies() compared
};

}  // namespace burin
