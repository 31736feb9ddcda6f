#pragma once

#include <vector>

#include "abuffer/tile_kernels.h"

namespace burin {

/// Which of some triangles touch a box on the screen: see BitmapIndex.
class TriangleIndex {
  public:
    /// Of the triangles `listed`, which are then told by their places in that list. What lies beyond `bounds` is taken to be
    /// at its border.
    void make(const TileKernels& kernels, const CrossedTriangle* triangles, const std::uint32_t* listed, std::size_t count,
              const ScreenBox& bounds) {
        constexpr std::size_t kWordsAtOnce = 4;
        index_.x = axis(bounds.x0, bounds.x1);
        index_.y = axis(bounds.y0, bounds.y1);
        index_.nearness = axis(bounds.low, bounds.high);
        index_.words = (count + 64 * kWordsAtOnce - 1) / (64 * kWordsAtOnce) * kWordsAtOnce;
        bits_.assign(BitmapIndex::kTables * BitmapIndex::kSteps * index_.words, 0);
        index_.bits = bits_.data();
        kernels.index_triangles(triangles, listed, count, index_);
    }
    /// Numbers of 64 bits.
    std::size_t words() const { return index_.words; }
    /// Sets the bits of those that touch a box, or lie beside it by less than a step, and reach nearer than its `low`, and no others.
    void find_only(const ScreenBox& box, std::uint64_t* found) const {
        for_words(box, [found](std::size_t i, std::uint64_t bits) { found[i] = bits; });
    }
    /// Sets these bits, too.
    void find(const ScreenBox& box, std::uint64_t* found) const {
        for_words(box, [found](std::size_t i, std::uint64_t bits) { found[i] |= bits; });
    }

  private:
    template <typename Use>
    void for_words(const ScreenBox& box, const Use& use) const {
        const std::uint64_t* const not_right = index_.at(BitmapIndex::begins_x, step(index_.x, box.x1));
        const std::uint64_t* const not_left = index_.at(BitmapIndex::ends_x, step(index_.x, box.x0));
        const std::uint64_t* const not_below = index_.at(BitmapIndex::begins_y, step(index_.y, box.y1));
        const std::uint64_t* const not_above = index_.at(BitmapIndex::ends_y, step(index_.y, box.y0));
        const std::uint64_t* const nearer = index_.at(BitmapIndex::nearest, step(index_.nearness, box.low));
        for (std::size_t i = 0; i < index_.words; ++i) use(i, not_right[i] & not_left[i] & not_below[i] & not_above[i] & nearer[i]);
    }
    static BitmapIndex::Axis axis(float begin, float end) {
        return {begin, end > begin ? static_cast<float>(BitmapIndex::kSteps) / (end - begin) : 0};
    }
    /// As the kernel has it.
    static std::size_t step(const BitmapIndex::Axis& axis, float v) {
        const float steps = (v - axis.from) * axis.steps_per_unit;
        constexpr float kLast = BitmapIndex::kSteps - 1;
        return steps > 0 ? static_cast<std::size_t>(steps < kLast ? steps : kLast) : 0;
    }

    BitmapIndex index_;
    std::vector<std::uint64_t> bits_;
};

}  // namespace burin
