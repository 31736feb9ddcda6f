#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/shading/random_expression.h"

namespace burin {
namespace {

using namespace test;

std::string mutated(std::string text, Random& random) {
    static const std::vector<std::string> parts{"(",
                                                ")",
                                                ",",
                                                "?",
                                                ":",
                                                "1e999",
                                                "not ",
                                                "--",
                                                "^",
                                                "C",
                                                ".x",
                                                "#12",
                                                "mm",
                                                "and",
                                                "\"",
                                                "in",
                                                "depht",
                                                "==",
                                                "fbm(P",
                                                "ring",
                                                "class == \"",
                                                "object in wheels",
                                                "ramp(\"sky\",",
                                                "1e-400",
                                                "world",
                                                "hsv(",
                                                "%",
                                                "\xC3\xA9",
                                                "deep",
                                                "shade",
                                                "attr(\"",
                                                "if(1,"};
    const auto place = [&] { return static_cast<std::size_t>(random.integer(0, static_cast<int>(text.size()))); };
    for (int k = random.integer(1, 4); k > 0 && !text.empty(); --k) {
        const std::size_t at = place();
        switch (random.integer(0, 6)) {
            case 0:
                text.erase(at, static_cast<std::size_t>(random.integer(1, 5)));
                break;
            case 1:
                text.insert(at, 1, static_cast<char>(random.integer(0, 255)));
                break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(random.integer(0, 255));
                break;
            case 3:
            case 4:
                if (at < text.size()) text[at] = text[place() % text.size()];
                break;
            case 5:
                text.insert(at, parts[static_cast<std::size_t>(random.integer(0, static_cast<int>(parts.size()) - 1))]);
                break;
            default: {
                const std::string part = text.substr(at, static_cast<std::size_t>(random.integer(0, 30)));
                text.insert(place(), part);
            }
        }
    }
    return text;
}

/// Whatever the text is, it has a program that runs, or an error with a place in the text.
TEST(ExpressionMutations, EndInAProgramOrAnError) {
    constexpr std::uint64_t kTrials = 100000;
    constexpr std::size_t kSamples = 20;
    std::vector<std::string> texts;
    for (std::uint64_t i = 0; i < 400; ++i) {
        Random random(i);
        texts.push_back(written(random_expression(random, random.integer(1, 4), i % 3 == 0, true), random));
        texts.push_back(std::string(static_cast<std::size_t>(random.integer(0, 4200)), "(-!^?:1+ n"[i % 10]));
    }
    std::size_t programs = 0, faults = 0;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
        Random random(trial);
        // The long ones take most of the time, so there are few.
        const bool is_long = random.integer(0, 31) == 0;
        const auto which = static_cast<std::size_t>(2 * random.integer(0, 399)) + (is_long ? 1 : 0);
        const std::string text = mutated(texts[which], random);
        try {
            const ExpressionProgram program =
                compile_expression(text, test_symbols(), {.is_color = random.integer(0, 2) == 0});
            const Columns columns(program, kSamples, true, trial);
            evaluate_in_batches(program, columns, kSamples, kSamples, best_expression_kernels());
            ++programs;
        } catch (const ExpressionError& error) {
            ASSERT_GE(error.column(), 1u) << text;
            ASSERT_LE(error.column(), text.size() + 1) << text << "\n" << error.what();
            ASSERT_STRNE(error.what(), "");
            ++faults;
        }
    }
    EXPECT_GT(programs, kTrials / 50);
    EXPECT_GT(faults, kTrials / 2);
}

/// What takes long is refused, or does not take long: texts as long as may be, made to need much of one thing.
TEST(ExpressionMutations, LongTextsTakeBoundedWork) {
    for (const std::string part : {"fbm(P,8)+", "s+", "C*", "1?", "\"a\"==class or ", "min(s,", "(", "#123456+",
                                   "shade*", "object in wheels or ", "hsv(s,t,1)+", "ramp(\"sky\",s)*",
                                   "between_objects(\"*a*b*c*d*\",\"*\")+", "depht+", "attr(\"a\")+", "0.0000001"}) {
        std::string text;
        while (text.size() + part.size() < kMostExpressionCharacters) text += part;
        fault_of(text);
        fault_of(text + "1");
    }
}

}  // namespace
}  // namespace burin
