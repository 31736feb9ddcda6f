#include "base/stream_store.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace burin {
namespace {

// From any place on, in any number, and nothing beside it.
template <typename T>
void check_places() {
    std::vector<T> values(300);
    std::iota(values.begin(), values.end(), T{1});
    for (std::size_t first = 0; first < 70; ++first) {
        for (const std::size_t count : {0, 1, 2, 31, 32, 33, 64, 65, 127, 200}) {
            std::vector<T> expected(300, T{7}), copied = expected, filled = expected;
            std::copy_n(values.begin(), count, expected.begin() + static_cast<std::ptrdiff_t>(first));
            stream_copy(values.data(), count, copied.data() + first);
            finish_stream_stores();
            ASSERT_EQ(copied, expected) << first << " " << count;
            std::fill_n(expected.begin() + static_cast<std::ptrdiff_t>(first), count, T{3});
            stream_fill(filled.data() + first, count, T{3});
            finish_stream_stores();
            ASSERT_EQ(filled, expected) << first << " " << count;
        }
    }
}

TEST(StreamStore, PutsWhatOrdinaryStoresPut) {
    check_places<std::uint16_t>();
    check_places<std::uint32_t>();
    check_places<float>();
    check_places<double>();
}

}  // namespace
}  // namespace burin
