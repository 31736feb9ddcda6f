#include "mesh/row_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "tests/mesh/plain_decimal.h"
#include "tests/support/random.h"

namespace burin::row_scan_test {
namespace {

using test::Random;

/// A row in a text that has what a scan may look at around it.
struct Row {
    std::string text;
    const char* begin;
    const char* end;
    Row(const std::string& row, char around)
        : text(std::string(kRowReachBack, around) + row + std::string(kRowReach, around)),
          begin(text.data() + kRowReachBack),
          end(begin + row.size()) {}
};

/// Three numbers, one after the other, with one space or at last a line feed behind each.
template <typename Value>
const char* scan_one_by_one(const char* p, std::array<Value, 3>& values, const char* (*scan)(const char*, Value&)) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (k > 0 && *p++ != ' ') return nullptr;
        p = scan(p, values[k]);
        if (p == nullptr || (*p != ' ' && *p != '\n')) return nullptr;
    }
    return p;
}

std::string digits(Random& random, int least, int most) {
    std::string text;
    for (int i = random.integer(least, most); i > 0; --i) text += static_cast<char>('0' + random.integer(0, 9));
    return text;
}

/// A row of `number` three times, and now and then a character of it is another one.
template <typename Number>
std::string row_of(Random& random, const Number& number) {
    static constexpr char kCharacters[] = "0123456789..--+ \t\r\nex/\xFF";
    std::string row = number();
    for (int k = 0; k < 2; ++k) row += " " + number();
    row += random.integer(0, 1) == 0 ? "\n" : " \n";
    if (random.integer(0, 2) == 0) {
        row[static_cast<std::size_t>(random.integer(0, static_cast<int>(row.size()) - 1))] =
            kCharacters[random.integer(0, static_cast<int>(sizeof kCharacters) - 2)];
    }
    return row;
}

TEST(RowScan, ReadsThreeIntegersLikeOneAfterTheOther) {
    int taken = 0;
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        Random random(seed);
        const std::string text = row_of(random, [&] { return digits(random, 1, 8); });
        for (const char around : {' ', '7', '\n'}) {
            const Row row(text, around);
            std::array<std::uint32_t, 3> expected{};
            std::array<std::uint32_t, 4> values{};
            const char* const next = scan_three_integers(row.begin, values.data());
            const char* const end = scan_one_by_one(row.begin, expected, scan_plain_integer);
#ifdef __SSE2__
            ASSERT_EQ(next, end) << "seed " << seed << ": " << text;
#endif
            if (next == nullptr) continue;
            ASSERT_TRUE(std::equal(expected.begin(), expected.end(), values.begin()))
                << "seed " << seed << ": " << text;
            ++taken;
        }
    }
#ifdef __SSE2__
    EXPECT_GT(taken, 100000);
#endif
}

TEST(RowScan, ReadsThreeDecimalsLikeOneAfterTheOther) {
    int taken = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        Random random(seed);
        const bool is_short = random.integer(0, 1) == 0;
        const std::string text = row_of(random, [&] {
            const std::string sign = random.integer(0, 1) == 0 ? "-" : "";
            return sign + (is_short ? digits(random, 1, 2) : digits(random, 1, 8)) + "." +
                   digits(random, 1, is_short ? 6 : 12);
        });
        for (const char around : {' ', '7', '\n', '-'}) {
            const Row row(text, around);
            std::array<double, 3> expected{}, values{};
            const char* const next = scan_three_decimals(row.begin, values.data());
            const char* const end = scan_one_by_one(row.begin, expected, test::plain_decimal);
            refused += next == nullptr && end != nullptr ? 1 : 0;
            if (next == nullptr) continue;
            ASSERT_EQ(next, end) << "seed " << seed << ": " << text;
            for (std::size_t k = 0; k < 3; ++k) {
                ASSERT_EQ(std::bit_cast<std::uint64_t>(values[k]), std::bit_cast<std::uint64_t>(expected[k]))
                    << "seed " << seed << ": " << text;
            }
            ++taken;
        }
    }
#ifdef __SSE2__
    EXPECT_EQ(refused, 0);
    EXPECT_GT(taken, 100000);
#endif
}

#ifdef __SSE2__
TEST(RowScan, TakesTheRowsThatFilesHave) {
    std::array<double, 3> v{};
    for (const std::string text :
         {"0.0 0.0 0.0", "-0.0323963 0.056575 -0.0503375", "1234567.12345678 -1234567.12345678 -1234567.12345678",
          "-0.00123456 -12.345678 9.9"}) {
        for (const char behind : {' ', '\n'}) {
            const Row row(text, behind);
            ASSERT_EQ(scan_three_decimals(row.begin, v.data()), row.end) << text;
        }
    }
    EXPECT_EQ(v, (std::array{-0.00123456, -12.345678, 9.9}));
}
#endif

}  // namespace
}  // namespace burin::row_scan_test
