#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/tile_kernels.h"
#include "lines/line_piece.h"

// Many short pieces become few long ones, which are drawn faster.

namespace burin {

/// PieceMerger joins pieces of one line and block that continue each other, as far as they lie on one straight line
/// to within 1/2048 pixel: strokes of long pieces are drawn faster than those of many short ones.
class PieceMerger {
  public:
    explicit PieceMerger(const TileKernels& kernels) : kernels_(kernels) {}

    /// Puts the merged pieces behind what `merged` has, block by block, and in each block line by line. Turns some of
    /// the pieces round.
    void merge(std::span<LinePiece> pieces, std::vector<LinePiece>& merged);

  private:
    void sort(std::span<std::uint32_t> order, std::span<const LinePiece> pieces) const;
    bool sort_few(std::span<std::uint32_t> order, std::span<const LinePiece> pieces) const;

    const TileKernels& kernels_;
    std::vector<std::uint32_t> order_;  // numbers of pieces
};

/// PieceIndex finds the pieces of one line in a block, or all in the block, among pieces that a PieceMerger left.
class PieceIndex {
  public:
    /// `merged` must stay. Buffers are used again.
    void set(std::span<const LinePiece> merged);

    std::span<const LinePiece> in_block(std::uint32_t block) const;
    std::span<const LinePiece> of_line(std::uint32_t block, LineId line) const;

  private:
    /// What pieces are found by: a few of these lie side by side where a piece takes more than one line of the cache.
    struct Key {
        LineId line;
        std::uint32_t block;
    };
    std::size_t first_not_before(std::uint32_t block, LineId line) const;

    std::span<const LinePiece> merged_;
    std::vector<Key> keys_;
    static constexpr std::size_t kBuckets = 256;  // blocks of a tile are in different ones
    std::array<std::uint32_t, kBuckets + 1> begin_{};
};

}  // namespace burin
