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
    EXPECT_TRUE(inflated(deflater.compress(bytes), bytes.size()) == bytes) << bytes.size() << " bytes";
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

TEST(Deflate, KnownRunsChangeNothing) {
    Deflater deflater;
    for (std::uint64_t trial = 0; trial < 400; ++trial) {
        Random random(trial);
        Bytes bytes;
        std::vector<Deflater::Run> runs;
        for (int part = random.integer(1, 30); part > 0; --part) {
            for (int i = random.integer(0, 40); i > 0; --i)
                bytes.push_back(static_cast<std::uint8_t>(random.integer(0, 3)));
            if (bytes.size() < 2) continue;
            const std::size_t begin = bytes.size();
            for (int i = random.integer(0, 700); i > 0; --i) bytes.push_back(bytes[bytes.size() - 2]);
            if (random.integer(0, 3) > 0) runs.push_back({begin, bytes.size()});
        }
        const auto plain = deflater.compress(bytes);
        const Bytes without(plain.begin(), plain.end());
        const auto stream = deflater.compress(bytes, runs);
        EXPECT_TRUE(Bytes(stream.begin(), stream.end()) == without) << trial;
        EXPECT_TRUE(inflated(stream, bytes.size()) == bytes) << trial;
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
    for (std::size_t i = bytes.size() - 1; i > 0; --i) std::swap(bytes[i], bytes[random.bits() % (i + 1)]);
    Deflater deflater;
    expect_survives(deflater, bytes);
    // The longest codes one after the other, from each place in a byte.
    for (std::uint8_t more = 0; more < 16; ++more) {
        bytes.push_back(25);
        for (std::uint8_t value = 0; value < 8; ++value) bytes.push_back(value ^ (more & 7));
        expect_survives(deflater, bytes);
    }
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

Bytes noise(Random& random, std::size_t size, std::uint32_t values = 256) {
    Bytes bytes(size);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.bits() % values);
    return bytes;
}

TEST(Deflate, AllShortStringsOfTwoValuesSurvive) {
    Deflater deflater;
    for (std::size_t length = 0; length <= 12; ++length) {
        for (std::uint32_t bits = 0; bits < 1u << length; ++bits) {
            Bytes bytes;
            while (bytes.size() < length) bytes.push_back((bits >> bytes.size() & 1) != 0 ? 255 : 0);
            expect_survives(deflater, bytes);
        }
    }
}

/// Noise alone and between runs. A stored block holds 65535 bytes.
TEST(Deflate, NoiseIsStored) {
    Deflater deflater;
    for (const std::size_t size : {1, 63, 64, 65, 127, 1000, 65534, 65535, 65536, 131070, 131071, 300000}) {
        Random random(size);
        const Bytes alone = noise(random, size);
        expect_survives(deflater, alone);
        const std::size_t blocks = size / 65535 + 1;
        EXPECT_LE(deflater.compress(alone).size(), size + size / 8 * (size < 64) + 20 + 6 * blocks) << size;
        Bytes mixed;
        for (int part = 0; part < 4; ++part) {
            mixed.insert(mixed.end(), 1000, 3);
            const Bytes more = noise(random, size);
            mixed.insert(mixed.end(), more.begin(), more.end());
        }
        expect_survives(deflater, mixed);
    }
}

/// Planes of a picture with grey lines are like that. The search is coarse by then and misses some; most must be met.
TEST(Deflate, CopiesOfNoiseAreFound) {
    Deflater deflater;
    std::size_t packed = 0, all = 0;
    for (std::size_t length = 200; length < 700; ++length) {
        Random random(length);
        const Bytes row = noise(random, length);
        Bytes bytes;
        for (int copy = 0; copy < 6; ++copy) bytes.insert(bytes.end(), row.begin(), row.end());
        expect_survives(deflater, bytes);
        packed += deflater.compress(bytes).size();
        all += bytes.size();
    }
    EXPECT_LT(packed, all * 6 / 10);
}

/// Long after the search has become coarse: runs of bytes and of pairs, from each place on, up to the end.
TEST(Deflate, RunsInNoiseAreFound) {
    Deflater deflater;
    for (std::size_t place = 4000; place < 4040; ++place) {
        for (const std::size_t rest : {0, 1, 7, 8, 15, 16, 17, 1000}) {
            Random random(place);
            Bytes bytes = noise(random, place);
            for (std::size_t i = 0; i < 600; ++i) bytes.push_back(bytes[bytes.size() - 1 - place % 2]);
            const Bytes more = noise(random, rest);
            bytes.insert(bytes.end(), more.begin(), more.end());
            expect_survives(deflater, bytes);
            EXPECT_LT(deflater.compress(bytes).size(), place + rest + 80) << place << ", " << rest;
        }
    }
}

TEST(Deflate, WhatIsNoNoiseIsCodedThoughItHasNoCopies) {
    Deflater deflater;
    Random random(4);
    Bytes bytes = noise(random, 1 << 16, 16);
    EXPECT_LT(deflater.compress(bytes).size(), bytes.size() * 52 / 100);
    // Bytes of many are counted in part: this one in places where it is missed.
    for (std::size_t place = 1; place < 64; place += 2) {
        Bytes rare = bytes;
        rare[place] = 200;
        expect_survives(deflater, rare);
    }
}

/// More sequences than share their codes: blocks of both kinds follow each other.
TEST(Deflate, LongMixturesSurvive) {
    Deflater deflater;
    for (std::uint64_t trial = 0; trial < 4; ++trial) {
        Random random(trial);
        Bytes bytes;
        for (int part = 0; part < 40000; ++part) {
            const bool is_noisy = (part / 10000 + static_cast<int>(trial)) % 2 == 0;
            const Bytes more = noise(random, 1 + random.bits() % (is_noisy ? 200 : 20), is_noisy ? 256 : 4);
            bytes.insert(bytes.end(), more.begin(), more.end());
            bytes.insert(bytes.end(), 10 + random.bits() % 20, static_cast<std::uint8_t>(random.bits()));
        }
        expect_survives(deflater, bytes);
    }
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
