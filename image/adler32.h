#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// A zlib stream ends with a checksum, which is computed here as bytes come.

namespace burin {

/// The checksum at the end of a zlib stream (RFC 1950, 8.2), of bytes that come piece by piece: in its low half the sum
/// of all bytes, plus 1, in its high half the sum of these sums after each byte, both modulo 65521.
class Adler32 {
  public:
    void add(std::span<const std::uint8_t> bytes);
    /// `count` bytes, which are the first two at `pair` by turns: takes as long for many as for few.
    void add_pairs(const std::uint8_t* pair, std::size_t count);
    std::uint32_t value() const { return b_ << 16 | a_; }

  private:
    std::uint32_t a_ = 1, b_ = 0;
};

}  // namespace burin
