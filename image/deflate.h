#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/unfilled_vector.h"
#include "image/adler32.h"
#include "image/deflate_block.h"

namespace burin {

/// Compresses rows of pixels to zlib streams (RFC 1950 and 1951), which any inflater reads.
///
/// Rendered channels are mostly runs: background, flat fills, constant numbers. General compressors
/// enter every byte of a run into their tables, at some nanoseconds each; here a run of bytes or of
/// pairs of bytes costs what comparing memory costs. What lies between is looked up in a hash table
/// with one place per hash (as LZ4 does), and all is Huffman coded in blocks with codes of their
/// own, or, where much is noise, with the fixed codes, and noise stored as it is.
class Deflater {
  public:
    /// Bytes [begin, end), each of which is the one two before.
    struct Run {
        std::size_t begin, end;
    };

    /// The stream is valid until the next call. It depends on `bytes` alone. Of `runs`, long ones that are known, in
    /// order, not all bytes are looked at.
    std::span<const std::uint8_t> compress(std::span<const std::uint8_t> bytes, std::span<const Run> runs = {});

  private:
    static constexpr int kHashBits = 14;

    void find_sequences(std::span<const std::uint8_t> bytes, std::span<const Run> runs);
    void add(std::size_t literals, std::size_t length, std::size_t distance);

    std::vector<DeflateSequence> sequences_;
    UnfilledVector<std::uint8_t> out_;
    Adler32 sum_;
    std::array<std::uint32_t, std::size_t{1} << kHashBits> newest_;  // place with a hash, plus 1
};

}  // namespace burin
