#pragma once

#include <span>
#include <vector>

#include "lines/line_segment.h"

namespace burin {

/// Joins pieces of one line and block that continue each other, as far as they lie on one straight line to
/// within 1/2048 pixel: strokes of long pieces are drawn faster than those of many short ones.
class SegmentMerger {
  public:
    /// Leaves the pieces block by block, and in each block line by line.
    void merge(std::vector<LineSegment>& segments);

  private:
    /// What pieces are sorted by, so that few of them are looked at, and none is moved.
    struct Key {
        std::uint64_t line_key;
        std::uint32_t block, index;
        double from_x;
    };

    std::vector<Key> order_;
    std::vector<LineSegment> merged_;
};

/// Those of one line in a block, or all in the block, among pieces that a SegmentMerger left.
std::span<const LineSegment> segments_in_block(std::span<const LineSegment> merged, std::uint32_t block);
std::span<const LineSegment> segments_of_line(std::span<const LineSegment> merged, std::uint32_t block,
                                              std::uint64_t line_key);

}  // namespace burin
