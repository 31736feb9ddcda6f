#include "mesh/digit_scan.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <string>

#include "mesh/text_scan.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

std::string padded(const std::string& text, char with = ' ') { return text + std::string(kScanReach, with); }

TEST(DigitScan, CountsDigitsBeforeAnyOtherByte) {
    for (int byte = 0; byte < 256; ++byte) {
        const char c = static_cast<char>(byte);
        for (int at = 0; at < 8; ++at) {
            for (const char behind : {'0', '9', ' ', '\xFF', '\xCF'}) {
                std::string text =
                    std::string("90909090").substr(0, static_cast<std::size_t>(at)) + c + std::string(8, behind);
                int expected = 0;
                while (expected < 8 && is_digit(text[static_cast<std::size_t>(expected)])) ++expected;
                ASSERT_EQ(count_digits(load_eight(text.data())), expected) << "byte " << byte << " at " << at;
            }
        }
    }
}

TEST(DigitScan, GivesTheValueOfOneToEightDigits) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const int count = random.integer(1, 8);
        std::string text;
        for (int i = 0; i < count; ++i) text += static_cast<char>('0' + random.integer(0, 9));
        for (const char behind : {'0', '9', ' ', '\xFF'}) {
            ASSERT_EQ(value_of_digits(load_eight(padded(text, behind).data()), count), std::stoul(text)) << text;
        }
    }
}

TEST(DigitScan, AcceptsPlainNumbersAndNothingElse) {
    double value = 0;
    for (const std::string text :
         {"0", "7", "-7", "1234567", "-1234567.12345678", "0.1", "000.5", "-0", "3.00000000"}) {
        const std::string p = padded(text);
        ASSERT_EQ(scan_plain_decimal(p.data(), value), p.data() + text.size()) << text;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
            << text;
    }
    for (const std::string text :
         {"", "-", "+1", "--1", ".5", "5.", "12345678", "0.123456789", "1e5", "1.5E5", "1.5.5", "x", "nan"}) {
        EXPECT_EQ(scan_plain_decimal(padded(text).data(), value), nullptr) << text;
    }
    std::uint32_t integer = 0;
    EXPECT_EQ(scan_plain_integer(padded("12345678").data(), integer), nullptr);
    EXPECT_EQ(scan_plain_integer(padded("-1").data(), integer), nullptr);
}

// Near the end of a text scan_number never takes the way of digit_scan.h.
TEST(DigitScan, ChangesNothingThatScanNumberReads) {
    int plain = 0;
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        Random random(seed);
        static constexpr char kCharacters[] = "0123456789012345678901234567890123456789....--+eE x";
        std::string text(static_cast<std::size_t>(random.integer(0, 20)), ' ');
        for (char& c : text) c = kCharacters[random.integer(0, static_cast<int>(sizeof kCharacters) - 2)];
        const std::string p = padded(text);
        double expected = 0, value = 0;
        const char* const end = scan_number(text.data(), text.data() + text.size(), expected);
        const char* const next = scan_number(p.data(), p.data() + p.size(), value);
        ASSERT_EQ(next == nullptr, end == nullptr) << text;
        if (end == nullptr) continue;
        ASSERT_EQ(next - p.data(), end - text.data()) << text;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected)) << text;
        plain += scan_plain_decimal(p.data(), value) != nullptr;
    }
    EXPECT_GT(plain, 10000);
}

}  // namespace
}  // namespace burin
