#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "kernels/cache_line.h"

// The nearest surface at each sample is what lines are found from.

namespace burin {

/// What is visible at every sample of a rectangle of an image's sample grid: Patel's resolved
/// extended masks of all its pixels at once, because each of them is a window of the one grid.
///
/// Sample (column, row) of the grid lies at ((column + 1/2) / s, (row + 1/2) / s) pixels for s samples
/// per pixel and axis. An id is the number of a triangle (31 bits) above one bit that says that the
/// triangle is plain: no edge of it can be a line, no other surface is level with it at the sample, and it is not so
/// steep that one could pass through it before the next sample without being level at either.
struct SampleTile {
    static constexpr std::uint32_t kBackground = 0xFFFFFFFEu;
    /// Rows are this many samples longer than asked for, and there are as many rows more, so that
    /// eight samples of four rows can be handled at once.
    static constexpr int kPadding = 8;

    int first_column = 0, first_row = 0;  ///< on the image's grid
    int columns = 0, rows = 0;
    int stride = 0;
    int samples_per_pixel = 4;
    std::vector<float, CacheLineAllocator<float>> nearness;
    std::vector<std::uint32_t, CacheLineAllocator<std::uint32_t>> ids;

    void reset(int column, int row, int column_count, int row_count, int per_pixel) {
        first_column = column;
        first_row = row;
        columns = column_count;
        rows = row_count;
        samples_per_pixel = per_pixel;
        stride = (columns + 2 * kPadding - 1) / kPadding * kPadding;
        const auto size = static_cast<std::size_t>(stride) * static_cast<std::size_t>(rows + kPadding);
        fill(nearness, size, -std::numeric_limits<float>::infinity());
        fill(ids, size, kBackground);
    }
    /// Block after block as a copy of the first one: memcpy() has wider vectors than what is compiled here.
    template <typename List>
    static void fill(List& list, std::size_t size, const typename List::value_type& value) {
        constexpr std::size_t kBlock = 1024;
        list.resize(size);
        const std::size_t first = std::min(kBlock, size);
        std::fill_n(list.data(), first, value);
        for (std::size_t at = first; at < size; at += kBlock) {
            std::memcpy(list.data() + at, list.data(), std::min(kBlock, size - at) * sizeof value);
        }
    }
    std::size_t index(int column, int row) const {  // on the image's grid
        return static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(stride) +
               static_cast<std::size_t>(column - first_column);
    }
};

}  // namespace burin
