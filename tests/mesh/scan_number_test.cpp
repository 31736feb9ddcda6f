#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "mesh/text_scan.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

/// The value of the whole text, NaN with a zero payload if it does not end there or is no number.
struct Scanned {
    double value = 0;
    std::ptrdiff_t length = -1;  // -1: no number
};
Scanned scan(const std::string& text) {
    Scanned result;
    const char* const next = scan_number(text.data(), text.data() + text.size(), result.value);
    if (next != nullptr) result.length = next - text.data();
    return result;
}

TEST(ScanNumber, AgreesWithStrtodToTheBit) {
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        Random random(seed);
        double value = std::bit_cast<double>(random.bits64());
        if (!std::isfinite(value)) continue;
        // Any bits, or such numbers as stand in models.
        if (seed % 4 == 1) value = random.real(-100, 100);
        if (seed % 4 == 2) value = std::ldexp(random.real(-1, 1), random.integer(-1074, 1023));
        if (seed % 4 == 3) value = random.integer(-100000, 100000) / 1000.0;
        for (const char* format : {"%.17g", "%.9g", "%g", "%e", "%.0f", "%.3f", "%.15e", "%+.12f"}) {
            char text[400];
            std::snprintf(text, sizeof text, format, value);
            const std::string printed = text;
            const Scanned scanned = scan(printed);
            ASSERT_EQ(scanned.length, static_cast<std::ptrdiff_t>(printed.size()))
                << "seed " << seed << ": " << printed;
            ASSERT_EQ(std::bit_cast<std::uint64_t>(scanned.value),
                      std::bit_cast<std::uint64_t>(std::strtod(text, nullptr)))
                << "seed " << seed << ": " << printed;
        }
    }
}

TEST(ScanNumber, AgreesWithStrtodOnRandomDigits) {
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        Random random(seed);
        std::string text = random.integer(0, 1) == 1 ? "-" : "";
        const int digits = random.integer(1, 25);
        const int point = random.integer(0, 30);
        for (int i = 0; i < digits; ++i) {
            if (i == point) text += '.';
            text += static_cast<char>('0' + random.integer(0, 9));
        }
        if (random.integer(0, 1) == 1) text += "e" + std::to_string(random.integer(-30, 30));
        const Scanned scanned = scan(text);
        ASSERT_EQ(scanned.length, static_cast<std::ptrdiff_t>(text.size())) << "seed " << seed << ": " << text;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(scanned.value),
                  std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)))
            << "seed " << seed << ": " << text;
    }
}

TEST(ScanNumber, ReadsAllFormsOfDecimals) {
    const auto expect = [](const std::string& text, double value) {
        const Scanned scanned = scan(text);
        EXPECT_EQ(scanned.length, static_cast<std::ptrdiff_t>(text.size())) << text;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(scanned.value), std::bit_cast<std::uint64_t>(value)) << text;
    };
    expect("+1", 1);
    expect("-1", -1);
    expect(".5", 0.5);
    expect("+.5", 0.5);
    expect("5.", 5);
    expect("-.5e-3", -0.0005);
    expect("0", 0);
    expect("-0", -0.0);
    expect("-0.0e5", -0.0);
    expect("000000000000000000000001", 1);
    expect("1E5", 1e5);
    expect("1e+5", 1e5);
    expect("1e0005", 1e5);
    expect("1e00000000000000000005", 1e5);
    expect("9007199254740993", 9007199254740992.0);  // halfway, to even
    expect("123456789012345e22", 123456789012345e22);
    expect("123456789012345e23", 123456789012345e23);
    expect("4.9406564584124654e-324", std::numeric_limits<double>::denorm_min());
    expect("1.7976931348623157e308", std::numeric_limits<double>::max());
    expect(std::string(400, '1'), std::strtod(std::string(400, '1').c_str(), nullptr));
    expect("0." + std::string(400, '3'), 1.0 / 3);
    expect("0." + std::string(400, '0') + "1e401", 1);
    expect("1" + std::string(400, '0') + "e-400", 1);
}

TEST(ScanNumber, TooLargeIsInfiniteAndTooSmallIsZero) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const char* text : {"1e400", "1e9999", "1e10000", "1e99999999999999999999", "2e308"}) {
        EXPECT_EQ(scan(text).value, kInfinity) << text;
        EXPECT_EQ(scan("-" + std::string(text)).value, -kInfinity) << text;
        EXPECT_EQ(scan(text).length, static_cast<std::ptrdiff_t>(std::string(text).size())) << text;
    }
    for (const char* text : {"1e-400", "1e-9999", "1e-10000", "1e-99999999999999999999", "2e-324"}) {
        EXPECT_EQ(scan(text).value, 0) << text;
        EXPECT_EQ(scan(text).length, static_cast<std::ptrdiff_t>(std::string(text).size())) << text;
    }
}

TEST(ScanNumber, StopsBehindTheNumber) {
    EXPECT_EQ(scan("1e").length, 1) << "the 'e' belongs to no exponent";
    EXPECT_EQ(scan("1e+").length, 1);
    EXPECT_EQ(scan("0x10").length, 1) << "no hexadecimal numbers";
    EXPECT_EQ(scan("1.5.5").length, 3);
    EXPECT_EQ(scan("7 8").length, 1);
    EXPECT_EQ(scan("12/3").value, 12);
    EXPECT_EQ(scan("1e5e5").value, 1e5);
}

TEST(ScanNumber, RefusesWhatIsNoNumber) {
    for (const char* text :
         {"", "abc", "+", "-", ".", "+.", "-.", "e5", ".e5", "+-1", "-+1", "++1", "--1", " 1", "\t1"}) {
        EXPECT_EQ(scan(text).length, -1) << text;
    }
}

TEST(ScanNumber, ReadsNoFurtherThanTheEnd) {
    const std::string text = "123456";
    for (std::size_t size = 0; size <= text.size(); ++size) {
        double value = 0;
        const char* const next = scan_number(text.data(), text.data() + size, value);
        if (size == 0) {
            EXPECT_EQ(next, nullptr);
        } else {
            EXPECT_EQ(next, text.data() + size);
            EXPECT_EQ(value, std::strtod(text.substr(0, size).c_str(), nullptr));
        }
    }
}

TEST(ScanInteger, ReadsSignsAndRefusesWhatDoesNotFit) {
    const auto scan_int = [](const std::string& text, std::int64_t& value) {
        const char* const next = scan_integer(text.data(), text.data() + text.size(), value);
        return next == text.data() + text.size();
    };
    std::int64_t value = 0;
    EXPECT_TRUE(scan_int("+12", value) && value == 12);
    EXPECT_TRUE(scan_int("-12", value) && value == -12);
    EXPECT_TRUE(scan_int("9223372036854775807", value) && value == std::numeric_limits<std::int64_t>::max());
    EXPECT_TRUE(scan_int("-9223372036854775808", value) && value == std::numeric_limits<std::int64_t>::min());
    for (const char* bad : {"", "+", "-", "+-1", "-+1", "x", "1.0", "9223372036854775808", "-9223372036854775809"}) {
        EXPECT_FALSE(scan_int(bad, value)) << bad;
    }
}

TEST(LineScanner, SplitsAtBlanks) {
    LineScanner scan(" word\t1.5 -7 the rest of it \r");
    double number = 0;
    std::int64_t integer = 0;
    EXPECT_EQ(scan.word(), "word");
    EXPECT_FALSE(scan.integer(integer)) << "1.5 is none, and stays";
    EXPECT_TRUE(scan.number(number) && number == 1.5);
    EXPECT_TRUE(scan.integer(integer) && integer == -7);
    EXPECT_FALSE(scan.number(number));
    EXPECT_EQ(scan.rest(), "the rest of it");
    EXPECT_TRUE(LineScanner(" \t\r").at_end());
    EXPECT_EQ(LineScanner("").word(), "");
}

TEST(LineReader, CountsLines) {
    LineReader lines("a\n\nc");
    std::string_view line;
    EXPECT_TRUE(lines.next(line) && line == "a");
    EXPECT_EQ(lines.rest(), "\nc");
    EXPECT_TRUE(lines.next(line) && line.empty());
    EXPECT_TRUE(lines.next(line) && line == "c");
    EXPECT_EQ(lines.line_number(), 3u);
    EXPECT_FALSE(lines.next(line));
    EXPECT_FALSE(LineReader("").next(line));
}

}  // namespace
}  // namespace burin
