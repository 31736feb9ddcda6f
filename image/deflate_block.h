#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "image/bit_writer.h"
#include "image/huffman.h"

// Sequences of literals and copies become blocks of a deflate stream: the second half of Deflater.

namespace burin {

/// Literal bytes, and then a copy of `length` bytes from `distance` bytes before.
struct DeflateSequence {
    std::uint32_t literals;
    std::uint32_t length;  // any, 0 = none
    std::uint32_t distance;
};

/// Sequences that are coded together, as blocks of a deflate stream (RFC 1951), none of which is its last: with codes
/// of their own, or with the fixed codes and noise stored between them.
class DeflateBlock {
  public:
    /// `bytes`: what the sequences stand for.
    DeflateBlock(std::span<const DeflateSequence> sequences, const std::uint8_t* bytes);
    void put(BitWriter& out) const;
    /// What put() writes at most.
    std::size_t most_bytes() const;
    /// Behind the bytes.
    const std::uint8_t* end() const { return end_; }

    /// A last block, which is empty.
    static void put_last(BitWriter& out);

  private:
    struct Codes {
        LiteralCode literals;
        DistanceCode distances;
    };
    static const Codes& fixed_codes();

    /// Puts all sequences with these codes. `stored_from`: as many literals at once, or more, are stored between blocks
    /// of the codes, which must be the fixed ones then.
    void put_sequences(BitWriter& out, const Codes& codes, std::uint32_t stored_from) const;

    std::span<const DeflateSequence> sequences_;
    const std::uint8_t* bytes_;
    const std::uint8_t* end_;
    std::array<std::uint32_t, 288> coded_{};  // how often symbols occur
    std::array<std::uint32_t, 30> distances_{};
    std::array<std::uint32_t, 256> storable_{};  // bytes that may be stored, which takes stored_bits_
    std::uint64_t stored_bits_ = 0;
    std::size_t literals_ = 0, pieces_ = 0;  // how many there are, of copies
};

}  // namespace burin
