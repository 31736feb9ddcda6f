#include "image/row_packer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;
using Bytes = std::vector<std::uint8_t>;

/// Sorts, then goes over all bytes, as OpenEXR does.
Bytes sorted_differences(const Bytes& raw) {
    Bytes bytes;
    for (const std::size_t odd : {0, 1}) {
        for (std::size_t i = odd; i < raw.size(); i += 2) bytes.push_back(raw[i]);
    }
    for (std::size_t i = bytes.size() - 1; i > 0; --i)
        bytes[i] = static_cast<std::uint8_t>(bytes[i] - bytes[i - 1] + 128);
    return bytes;
}

/// A strip of noise and of equal pixels, with blocks missing.
struct Strip {
    std::vector<PixelType> types;
    std::vector<std::size_t> order;
    std::vector<std::unique_ptr<Image>> blocks;
    ImageStrip strip;

    explicit Strip(Random& random) {
        const int width = random.integer(1, 300), height = random.integer(1, 40), block_width = random.integer(1, 100);
        strip.data = {0, 0, width, height};
        strip.block_width = block_width;
        for (int c = random.integer(1, 6); c > 0; --c) {
            types.push_back(static_cast<PixelType>(random.integer(0, 2)));
            for (std::byte& b : strip.background.emplace_back())
                b = static_cast<std::byte>(random.integer(0, 1) * random.integer(0, 255));
        }
        order.resize(types.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::reverse(order.begin(), order.end());
        for (int x = 0; x < width; x += block_width) {
            strip.blocks.push_back(nullptr);
            if (random.integer(0, 1) == 0) continue;
            const PixelRect rect{x, 0, std::min(width, x + block_width), height};
            blocks.push_back(std::make_unique<Image>(rect, rect));
            for (const PixelType type : types) {
                for (std::byte& b : blocks.back()->add("c", type).bytes) b = static_cast<std::byte>(random.bits());
            }
            strip.blocks.back() = blocks.back().get();
        }
    }
    /// Rows as a chunk has them, byte by byte.
    Bytes raw(int first_row, int end_row) const {
        Bytes bytes;
        for (int y = first_row; y < end_row; ++y) {
            for (const std::size_t c : order) {
                for (int x = 0; x < strip.data.width(); ++x) {
                    const std::size_t size = size_of(types[c]);
                    const Image* const block = strip.blocks[static_cast<std::size_t>(x / strip.block_width)];
                    const std::byte* pixel = strip.background[c].data();
                    if (block != nullptr) {
                        const int place = y * block->width() + x % strip.block_width;
                        pixel = block->channels()[c].bytes.data() + static_cast<std::size_t>(place) * size;
                    }
                    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(pixel[i]));
                }
            }
        }
        return bytes;
    }
};

TEST(RowPacker, BytesAreThoseOfOpenExr) {
    UnfilledVector<std::uint8_t> packed;
    std::vector<Deflater::Run> runs;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Strip strip(random);
        const int first = random.integer(0, strip.strip.data.y1 - 1),
                  end = random.integer(first + 1, strip.strip.data.y1);
        const RowPacker packer(strip.strip, strip.types, strip.order, first, end);
        const Bytes wanted = strip.raw(first, end);
        Bytes raw;
        packer.raw(raw);
        EXPECT_TRUE(raw == wanted);
        EXPECT_EQ(packer.size(), wanted.size());
        packer.packed(packed, runs);
        EXPECT_TRUE(Bytes(packed.begin(), packed.end()) == sorted_differences(wanted));
    }
}

TEST(RowPacker, RunsAreInOrderAndRepeatTheBytesTwoBefore) {
    UnfilledVector<std::uint8_t> packed;
    std::vector<Deflater::Run> runs;
    std::size_t in_runs = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Strip strip(random);
        RowPacker(strip.strip, strip.types, strip.order, 0, strip.strip.data.y1).packed(packed, runs);
        std::size_t last = 2;
        for (const auto& [begin, end] : runs) {
            ASSERT_LE(last, begin);
            ASSERT_LT(begin, end);
            ASSERT_LE(end, packed.size());
            EXPECT_TRUE(std::equal(&packed[begin], packed.data() + end, &packed[begin - 2]));
            in_runs += end - begin;
            last = end;
        }
    }
    EXPECT_GT(in_runs, 100000u);
}

}  // namespace
}  // namespace burin
