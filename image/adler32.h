#pragma once

#include <cstdint>
#include <span>

namespace burin {

/// The checksum at the end of a zlib stream (RFC 1950, 8.2): in its low half the sum of all bytes, plus 1, in its high half
/// the sum of these sums after each byte, both modulo 65521.
std::uint32_t adler32(std::span<const std::uint8_t> bytes);

}  // namespace burin
