// What finds boxes that touch.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/screen_boxes.h"
#include "tests/support/kernels.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

TEST(BoxKernels, BoxesThatTouchAreFound) {
    Random random(5);
    const auto box = [&] {
        const auto number = [&](int low, int high) { return static_cast<float>(random.integer(low, high)); };
        ScreenBox b{number(0, 12), number(0, 12), 0, 0, number(0, 4), 0};
        b.x1 = b.x0 + number(0, 6);
        b.y1 = b.y0 + number(0, 6);
        b.high = b.low + number(0, 3);
        return b;
    };
    std::size_t touching = 0;
    for (std::size_t count = 0; count < 40; ++count) {
        ScreenBoxes boxes;
        boxes.resize(count + 7);  // those behind the end are read, but not listed
        for (std::size_t i = 0; i < boxes.size(); ++i) boxes.set(i, box());
        boxes.resize(count);
        const ScreenBox own = box();
        const auto least_x0 = static_cast<float>(random.integer(-5, 6)),
                   least_y0 = static_cast<float>(random.integer(-5, 6));
        for (std::size_t begin = 0; begin <= count; begin += 3) {
            std::vector<std::uint32_t> expected;
            for (std::size_t i = begin; i < count; ++i) {
                const ScreenBox b = boxes[i];
                const bool is_beside = b.x0 > own.x1 || b.x1 < own.x0 || b.y0 > own.y1 || b.y1 < own.y0;
                const bool has_common = b.low < own.high && b.high > own.low;
                if (!is_beside && has_common && b.x0 >= least_x0 && b.y0 >= least_y0) {
                    expected.push_back(static_cast<std::uint32_t>(i));
                }
            }
            touching += expected.size();
            for (const TileKernels* kernels : all_kernels()) {
                std::vector<std::uint32_t> found(count);
                found.resize(kernels->intersect.find_touching(boxes.view(), begin, count, own, least_x0, least_y0,
                                                              found.data()));
                EXPECT_EQ(found, expected) << kernels->name << ' ' << begin << " of " << count;
            }
        }
    }
    EXPECT_GT(touching, 100u);
}

TEST(BoxKernels, OverlapsOfEightAndEightAreFound) {
    Random random(6);
    int overlapping = 0, unconnected = 0;
    for (int round = 0; round < 300; ++round) {
        ScreenBoxes boxes;
        boxes.resize(16);
        std::vector<std::uint32_t> corners[3];
        for (std::size_t i = 0; i < 16; ++i) {
            const auto range = [&](float& low, float& high) {
                low = static_cast<float>(random.integer(0, 6));
                high = low + static_cast<float>(random.integer(0, 6));
            };
            ScreenBox b{};
            range(b.x0, b.x1);
            range(b.y0, b.y1);
            range(b.low, b.high);
            boxes.set(i, b);
            for (auto& list : corners) list.push_back(static_cast<std::uint32_t>(random.integer(0, 20)));
        }
        const std::uint32_t* const corner_lists[3] = {corners[0].data(), corners[1].data(), corners[2].data()};
        const auto a_count = static_cast<std::size_t>(random.integer(1, 8)),
                   b_count = static_cast<std::size_t>(random.integer(1, 8));
        std::uint64_t expected = 0, expected_unconnected = 0;
        for (std::size_t i = 0; i < a_count; ++i) {
            for (std::size_t k = 0; k < b_count; ++k) {
                const ScreenBox a = boxes[i], b = boxes[8 + k];
                const bool overlap =
                    a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1 && a.low < b.high && b.low < a.high;
                bool are_connected = false;
                for (const auto& p : corners) {
                    for (const auto& q : corners) are_connected = are_connected || p[i] == q[8 + k];
                }
                expected |= std::uint64_t{overlap} << (8 * i + k);
                expected_unconnected |= std::uint64_t{overlap && !are_connected} << (8 * i + k);
                overlapping += overlap;
                unconnected += overlap && !are_connected;
            }
        }
        for (const TileKernels* kernels : all_kernels()) {
            EXPECT_EQ(kernels->intersect.find_overlaps(boxes.view(), 0, a_count, 8, b_count), expected)
                << kernels->name;
            EXPECT_EQ(kernels->intersect.find_unconnected(corner_lists, 0, 8, expected), expected_unconnected)
                << kernels->name;
        }
    }
    EXPECT_GT(unconnected, 500);
    EXPECT_GT(overlapping, unconnected + 300);
}

}  // namespace
}  // namespace burin
