#include "image/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <vector>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using Bytes = std::vector<std::uint8_t>;

/// What zlib makes of our stream.
Bytes inflated(std::span<const std::uint8_t> stream, std::size_t size) {
    Bytes bytes(size + 1);  // room for a byte too many
    uLongf length = bytes.size();
    EXPECT_EQ(uncompress(bytes.data(), &length, stream.data(), stream.size()), Z_OK);
    bytes.resize(length);
    return bytes;
}

void expect_survives(Deflater& deflater, const Bytes& bytes) {
    EXPECT_TRUE(inflated(deflater.compress(bytes), bytes.size()) == bytes)
        << bytes.size() << " bytes";
}

TEST(Deflate, RunsOfEveryLengthSurvive) {
    Deflater deflater;
    for (std::size_t length = 0; length < 1100; ++length) {
        expect_survives(deflater, Bytes(length, 7));
        Bytes pairs(length);
        for (std::size_t i = 0; i < length; ++i) pairs[i] = i % 2 == 0 ? 128 : 0;
        expect_survives(deflater, pairs);
    }
}

TEST(Deflate, RandomMixturesSurvive) {
    Deflater deflater;
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        Random random(trial);
        Bytes bytes;
        const std::size_t size = random.bits() % 200000;
        while (bytes.size() < size) {
            const std::size_t length = 1 + random.bits() % (random.bits() % 4 == 0 ? 20000 : 60);
            const std::uint32_t kind = random.bits() % 4;
            const std::uint32_t value = random.bits();
            // A distance at or beyond the window's end now and then.
            const std::size_t distance = kind == 3 ? 32766 + value % 5 : 1 + value % 40000;
            for (std::size_t i = 0; i < length; ++i) {
                if (kind == 0) {
                    bytes.push_back(static_cast<std::uint8_t>(random.bits()));  // noise
                } else if (kind == 1 || distance > bytes.size()) {
                    bytes.push_back(static_cast<std::uint8_t>(value));
                } else {
                    bytes.push_back(bytes[bytes.size() - distance]);
                }
            }
        }
        expect_survives(deflater, bytes);
    }
}

/// Frequencies like Fibonacci's numbers make the deepest Huffman trees, deeper than codes may be.
TEST(Deflate, RareBytesGetCodesOfAllowedLengths) {
    Bytes bytes;
    std::size_t count = 1, before = 1;
    for (std::uint8_t value = 0; value < 26; ++value) {
        bytes.insert(bytes.end(), count, value);
        before = std::exchange(count, count + before);
    }
    Random random(1);
    for (std::size_t i = bytes.size() - 1; i > 0; --i)
        std::swap(bytes[i], bytes[random.bits() % (i + 1)]);
    Deflater deflater;
    expect_survives(deflater, bytes);
}

TEST(Deflate, RunsTakeNextToNothingAndNoiseNoMoreThanItself) {
    Deflater deflater;
    const Bytes flat(1 << 20, 128);
    EXPECT_LT(deflater.compress(flat).size(), flat.size() / 500);
    Bytes noise(1 << 16);
    Random random(2);
    for (std::uint8_t& b : noise) b = static_cast<std::uint8_t>(random.bits());
    EXPECT_LT(deflater.compress(noise).size(), noise.size() + noise.size() / 100);
}

TEST(Deflate, AStreamDependsOnItsBytesAlone) {
    Deflater used, fresh;
    Bytes bytes(50000);
    Random random(3);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.bits() % 5);
    used.compress(Bytes(70000, 3));
    const auto a = used.compress(bytes), b = fresh.compress(bytes);
    EXPECT_TRUE(Bytes(a.begin(), a.end()) == Bytes(b.begin(), b.end()));
}

}  // namespace
}  // namespace burin
