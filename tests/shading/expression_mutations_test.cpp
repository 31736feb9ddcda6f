#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/parallel.h"
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

/// Of trials: how many had a program, and how many an error.
struct Endings {
    std::uint64_t programs = 0, faults = 0;
};

/// Compiles mutations of texts, and runs what has a program. Stops at an error without a place in its text.
void end_in_a_program_or_an_error(const std::vector<std::string>& texts, std::uint64_t first_seed,
                                  std::uint64_t end_seed, Endings& endings) {
    constexpr std::size_t kSamples = 20;
    for (std::uint64_t seed = first_seed; seed < end_seed; ++seed) {
        Random random(seed);
        // The long ones take most of the time, so there are few.
        const bool is_long = random.integer(0, 31) == 0;
        const auto which = static_cast<std::size_t>(2 * random.integer(0, 399)) + (is_long ? 1 : 0);
        const std::string text = mutated(texts[which], random);
        try {
            const ExpressionProgram program =
                compile_expression(text, test_symbols(), {.is_color = random.integer(0, 2) == 0});
            const Columns columns(program, kSamples, true, seed);
            evaluate_in_batches(program, columns, kSamples, kSamples, best_expression_kernels());
            ++endings.programs;
        } catch (const ExpressionError& error) {
            ASSERT_GE(error.column(), 1u) << "seed " << seed << ": " << text;
            ASSERT_LE(error.column(), text.size() + 1) << "seed " << seed << ": " << text << "\n" << error.what();
            ASSERT_STRNE(error.what(), "") << "seed " << seed;
            ++endings.faults;
        }
    }
}

/// Whatever the text is, it has a program that runs, or an error with a place in the text.
TEST(ExpressionMutations, EndInAProgramOrAnError) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    constexpr std::uint64_t kTrials = 100000;  // which take many times as long
#else
    constexpr std::uint64_t kTrials = 1000000;
#endif
    constexpr std::uint64_t kAtOnce = 10000;
    std::vector<std::string> texts;
    for (std::uint64_t i = 0; i < 400; ++i) {
        Random random(i);
        texts.push_back(written(random_expression(random, random.integer(1, 4), i % 3 == 0, true), random));
        texts.push_back(std::string(static_cast<std::size_t>(random.integer(0, 4200)), "(-!^?:1+ n"[i % 10]));
    }
    std::vector<Endings> parts(kTrials / kAtOnce);
    parallel_for(parts.size(), 2, [&](std::size_t i, int) {
        end_in_a_program_or_an_error(texts, i * kAtOnce, (i + 1) * kAtOnce, parts[i]);
    });
    Endings all;
    for (const Endings& part : parts) {
        all.programs += part.programs;
        all.faults += part.faults;
    }
    EXPECT_EQ(all.programs + all.faults, kTrials);
    EXPECT_GT(all.programs, kTrials / 50);
    EXPECT_GT(all.faults, kTrials / 2);
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
