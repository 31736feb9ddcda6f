#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

// Codes of any length are put together to bytes.

namespace burin {

/// Bits from the lowest on, into memory that is large enough.
class BitWriter {
  public:
    explicit BitWriter(std::uint8_t* out) : out_(out) {}
    /// Puts bits; there may be at most 57 between two calls of flush().
    void put(std::uint64_t bits, std::uint32_t count) {
        pending_ |= bits << count_;
        count_ += count;
    }
    void flush() {
        std::uint64_t bytes = pending_;
        if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
        std::memcpy(out_, &bytes, 8);
        out_ += count_ / 8;
        pending_ >>= count_ & ~7u;
        count_ &= 7;
    }
    /// Bytes as they are, from the next whole byte on.
    void put_bytes(std::span<const std::uint8_t> bytes) {
        out_ = std::copy(bytes.begin(), bytes.end(), finish());
        pending_ = count_ = 0;
    }
    /// The place where whole bytes end.
    std::uint8_t* place() const { return out_; }
    /// Goes on elsewhere, for the memory has moved.
    void move_to(std::uint8_t* out) { out_ = out; }
    /// The byte behind all; the rest of the last one is filled with zeros.
    std::uint8_t* finish() {
        flush();
        return out_ + (count_ > 0 ? 1 : 0);
    }

  private:
    std::uint8_t* out_;
    std::uint64_t pending_ = 0;
    std::uint32_t count_ = 0;
};

}  // namespace burin
