#include "mesh/index_set.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/random.h"

namespace burin {
namespace {

TEST(IndexSet, FindsWhatAnOrderedSetFinds) {
    for (const std::uint32_t limit : {1u, 2u, 63u, 64u, 65u, 4095u, 4096u, 4097u, 300000u}) {
        test::Random random(limit);
        IndexSet set(limit);
        std::set<std::uint32_t> expected;
        const auto any = [&] { return static_cast<std::uint32_t>(random.integer(0, static_cast<int>(limit) - 1)); };
        for (int step = 0; step < 20000; ++step) {
            const std::uint32_t i = any();
            const bool mostly_erases = step / 500 % 2 == 1;  // sparse and dense in turn
            if (random.integer(0, 9) < (mostly_erases ? 2 : 7)) {
                set.insert(i);
                expected.insert(i);
            } else {
                const auto next = expected.lower_bound(i);
                const std::uint32_t gone = next == expected.end() ? i : *next;
                set.erase(gone);
                expected.erase(gone);
            }
            const std::uint32_t from = any();
            const auto found = expected.lower_bound(from);
            ASSERT_EQ(set.find_from(from), found == expected.end() ? IndexSet::kNone : *found)
                << "limit " << limit << ", step " << step << ", from " << from;
        }
        for (const std::uint32_t i : expected) set.erase(i);
        EXPECT_EQ(set.find_from(0), IndexSet::kNone) << limit;
    }
}

}  // namespace
}  // namespace burin
