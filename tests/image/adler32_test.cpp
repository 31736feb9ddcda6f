#include "image/adler32.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

// Word by word as in RFC 1950, 9.
std::uint32_t byte_by_byte(std::span<const std::uint8_t> bytes) {
    std::uint32_t s1 = 1, s2 = 0;
    for (const std::uint8_t byte : bytes) {
        s1 = (s1 + byte) % 65521;
        s2 = (s2 + s1) % 65521;
    }
    return (s2 << 16) + s1;
}

TEST(Adler32, IsTheSumOfSums) {
    EXPECT_EQ(adler32({}), 1u);
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const int most = seed % 3 == 0 ? 40 : 20000;
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(random.integer(0, most)));
        const int least = seed % 2 == 0 ? 0 : 255;  // the largest sums
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.integer(least, 255));
        ASSERT_EQ(adler32(bytes), byte_by_byte(bytes)) << "seed " << seed << ", " << bytes.size() << " bytes";
    }
}

}  // namespace
}  // namespace burin
