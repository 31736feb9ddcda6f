// The rows of model files, read many at once, beside one number after the other.
#include "mesh/row_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/row_scan.h"
#include "tests/mesh/plain_decimal.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

std::vector<const RowKernels*> all_kernels() {
    std::vector<const RowKernels*> kernels{&baseline_row_kernels()};
    for (const RowKernels* const fast : {avx2_row_kernels(), avx512_row_kernels()}) {
        if (fast != nullptr) kernels.push_back(fast);
    }
    return kernels;
}

std::string digits(Random& random, int least, int most) {
    std::string text;
    for (int i = random.integer(least, most); i > 0; --i) text += static_cast<char>('0' + random.integer(0, 9));
    return text;
}
std::string decimal(Random& random, int most) {
    const std::string sign = random.integer(0, 1) == 0 ? "-" : "";
    return sign + digits(random, 1, most) + "." + digits(random, 1, most);
}

/// Rows of three numbers behind `head`. Some texts have long numbers, and in some a character is another one.
template <typename Number>
std::string rows_of(Random& random, const std::string& head, const Number& number) {
    static constexpr char kCharacters[] = "0123456789..--+ \t\r\nex/\xFF";
    const int most = random.integer(0, 3) == 0 ? 10 : 6;
    std::string text;
    for (int row = random.integer(0, 12); row > 0; --row) {
        text += head + number(most);
        for (int k = 0; k < 2; ++k) text += " " + number(most);
        text += random.integer(0, 1) == 0 ? "\n" : " \n";
    }
    if (!text.empty() && random.integer(0, 1) == 0) {
        text[static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()) - 1))] =
            kCharacters[random.integer(0, static_cast<int>(sizeof kCharacters) - 2)];
    }
    return text;
}

/// What the kernels are to read from `p` on; values behind the others.
template <typename Value>
std::size_t read_one_by_one(const char*& p, const char* limit, std::size_t max_rows, std::string_view head,
                            std::vector<Value>& values, const char* (*scan)(const char*, Value&)) {
    const char* row = p;
    for (std::size_t count = 0; count < max_rows; ++count) {
        if (row >= limit || std::string_view(row, head.size()) != head) return count;
        const char* q = row + head.size();
        Value three[3];
        for (int k = 0; k < 3; ++k) {
            if (k > 0 && *q++ != ' ') return count;
            q = scan(q, three[k]);
            if (q == nullptr) return count;
        }
        const char* const feed = *q == ' ' ? q + 1 : q;
        if (*feed != '\n') return count;
        values.insert(values.end(), three, three + 3);
        p = q;
        row = feed + 1;
    }
    return max_rows;
}

template <typename Value>
void compare(std::uint64_t seed, const std::string& rows, std::string_view head,
             std::size_t (*RowKernels::*member)(const char*&, const char*, std::size_t, Value*),
             const char* (*scan)(const char*, Value&), std::size_t& read) {
    Random random(~seed);
    const char around = "7 \n-."[random.integer(0, 4)];
    const std::string text = std::string(kRowReachBack, around) + rows + std::string(kRowReach, around);
    const char* const begin = text.data() + kRowReachBack;
    const char* const limit = begin + (random.integer(0, 3) > 0 ? static_cast<int>(rows.size())
                                                                : random.integer(0, static_cast<int>(rows.size())));
    const auto max_rows = static_cast<std::size_t>(random.integer(0, 3) > 0 ? 12 : random.integer(0, 12));
    const char* expected_end = begin;
    std::vector<Value> expected;
    const std::size_t expected_count = read_one_by_one(expected_end, limit, max_rows, head, expected, scan);
    for (const RowKernels* const kernels : all_kernels()) {
        constexpr Value kUntouched{77};
        std::vector<Value> values(3 * max_rows + 1, kUntouched);
        const char* end = begin;
        const std::size_t count = (kernels->*member)(end, limit, max_rows, values.data());
#ifndef __SSE2__
        if (kernels == &baseline_row_kernels()) continue;
#endif
        ASSERT_EQ(count, expected_count) << "seed " << seed << ": " << rows;
        ASSERT_EQ(end - begin, expected_end - begin) << "seed " << seed << ": " << rows;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            ASSERT_EQ(values[i], expected[i]) << "seed " << seed << ": " << rows;
            ASSERT_EQ(std::signbit(static_cast<double>(values[i])), std::signbit(static_cast<double>(expected[i])))
                << "seed " << seed << ": " << rows;
        }
        ASSERT_EQ(values[3 * max_rows], kUntouched);
        read += count;
    }
}

TEST(RowKernels, ReadTrianglesLikeOneNumberAfterTheOther) {
    std::size_t read = 0;
    for (std::uint64_t seed = 0; seed < 30000; ++seed) {
        Random random(seed);
        const std::string rows = rows_of(random, "3 ", [&](int most) { return digits(random, 1, most); });
        ASSERT_NO_FATAL_FAILURE(compare(seed, rows, "3 ", &RowKernels::triangles, scan_plain_integer, read));
    }
    EXPECT_GT(read, 50000u);
}

TEST(RowKernels, ReadPositionsLikeOneNumberAfterTheOther) {
    std::size_t read = 0;
    for (std::uint64_t seed = 0; seed < 30000; ++seed) {
        Random random(seed);
        const std::string rows = rows_of(random, "", [&](int most) { return decimal(random, most); });
        ASSERT_NO_FATAL_FAILURE(compare(seed, rows, "", &RowKernels::positions, test::plain_decimal, read));
    }
    EXPECT_GT(read, 50000u);
}

}  // namespace
}  // namespace burin
