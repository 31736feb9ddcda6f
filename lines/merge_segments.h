#pragma once

#include <span>
#include <vector>

#include "lines/line_segment.h"

namespace burin {

/// Joins pieces of one line and block that continue each other, as far as they lie on one straight line to
/// within 1/2048 pixel: strokes of long pieces are drawn faster than those of many short ones.
class SegmentMerger {
  public:
    /// Puts them behind what `merged` has, block by block, and in each block line by line. Turns some of the pieces round.
    void merge(std::span<LineSegment> pieces, std::vector<LineSegment>& merged);

  private:
    /// What pieces are sorted by, so that few of them are looked at, and none is moved.
    struct Key {
        std::uint64_t line_key, from_x;  // in_order()
        std::uint32_t block, index;
    };

    static void sort(std::span<Key> keys, std::span<const LineSegment> pieces);

    std::vector<Key> order_;
};

/// Those of one line in a block, or all in the block, among pieces that a SegmentMerger left.
std::span<const LineSegment> segments_in_block(std::span<const LineSegment> merged, std::uint32_t block);
std::span<const LineSegment> segments_of_line(std::span<const LineSegment> merged, std::uint32_t block,
                                              std::uint64_t line_key);

}  // namespace burin
