#include "image/adler32.h"

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

// Word by word as in RFC 1950, 9.
std::uint32_t adler32(std::span<const std::uint8_t> bytes) {
    Adler32 sum;
    sum.add(bytes);
    return sum.value();
}
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

TEST(Adler32, PiecesAndPairsAddUp) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        std::vector<std::uint8_t> bytes;
        Adler32 sum;
        for (int piece = 0; piece < 6; ++piece) {
            const int most = random.integer(0, 3) == 0 ? 70000 : 20;
            const auto size = static_cast<std::size_t>(random.integer(0, most));
            const bool are_pairs = random.integer(0, 1) == 0;
            const int least = seed % 2 == 0 ? 0 : 250;
            std::vector<std::uint8_t> more(size + 2);
            for (std::uint8_t& byte : more) byte = static_cast<std::uint8_t>(random.integer(least, 255));
            for (std::size_t i = 2; i < more.size() && are_pairs; ++i) more[i] = more[i - 2];
            const std::span piece_bytes = std::span(more).first(size);
            if (are_pairs) {
                sum.add_pairs(more.data(), size);
            } else {
                sum.add(piece_bytes);
            }
            bytes.insert(bytes.end(), piece_bytes.begin(), piece_bytes.end());
        }
        ASSERT_EQ(sum.value(), byte_by_byte(bytes)) << "seed " << seed;
    }
    // More than are summed at once.
    const std::size_t many = (std::size_t{1} << 25) + 3;
    std::vector<std::uint8_t> bytes(many, 255);
    for (std::size_t i = 1; i < many; i += 2) bytes[i] = 254;
    Adler32 sum;
    sum.add_pairs(bytes.data(), many);
    EXPECT_EQ(sum.value(), byte_by_byte(bytes));
}

}  // namespace
}  // namespace burin
