#include "shading/expression/glob.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

TEST(Glob, Patterns) {
    EXPECT_TRUE(matches_glob("wheel*", "wheel_left"));
    EXPECT_TRUE(matches_glob("wheel*", "wheel"));
    EXPECT_FALSE(matches_glob("wheel*", "Wheel"));
    EXPECT_FALSE(matches_glob("wheel", "wheels"));
    EXPECT_TRUE(matches_glob("w?eel", "wheel"));
    EXPECT_FALSE(matches_glob("w?eel", "weel"));
    EXPECT_TRUE(matches_glob("*a*b", "xxaybab"));
    EXPECT_FALSE(matches_glob("*a*b", "xxayba"));
    EXPECT_TRUE(matches_glob("", ""));
    EXPECT_FALSE(matches_glob("", "a"));
    EXPECT_TRUE(matches_glob("**", ""));
}

bool matches_slowly(std::string_view pattern, std::string_view name) {
    if (pattern.empty()) return name.empty();
    if (pattern[0] == '*')
        return matches_slowly(pattern.substr(1), name) || (!name.empty() && matches_slowly(pattern, name.substr(1)));
    return !name.empty() && (pattern[0] == '?' || pattern[0] == name[0]) &&
           matches_slowly(pattern.substr(1), name.substr(1));
}

TEST(Glob, AgreesWithTheDefinition) {
    std::size_t matches = 0;
    for (std::uint64_t trial = 0; trial < 20000; ++trial) {
        Random random(trial);
        std::string pattern, name;
        for (int i = random.integer(0, 6); i > 0; --i) pattern += "ab*?*"[random.integer(0, 4)];
        for (int i = random.integer(0, 8); i > 0; --i) name += "ab"[random.integer(0, 1)];
        ASSERT_EQ(matches_glob(pattern, name), matches_slowly(pattern, name)) << pattern << " " << name;
        matches += matches_glob(pattern, name);
    }
    EXPECT_GT(matches, 2000u);
}

TEST(Glob, ListsAreReadFromLeftToRight) {
    EXPECT_TRUE(matches_globs({"wheel*", "!wheel_spare"}, "wheel_left"));
    EXPECT_FALSE(matches_globs({"wheel*", "!wheel_spare"}, "wheel_spare"));
    EXPECT_TRUE(matches_globs({"wheel*", "!wheel_*", "wheel_spare"}, "wheel_spare"));
    EXPECT_TRUE(matches_globs({"!glass"}, "body"));
    EXPECT_FALSE(matches_globs({"!glass"}, "glass"));
    EXPECT_FALSE(matches_globs({}, "glass"));
}

TEST(Glob, AListThatIsMadeReadyTakesTheSame) {
    std::size_t taken = 0, plain = 0;
    for (std::uint64_t trial = 0; trial < 5000; ++trial) {
        Random random(trial);
        const bool has_globs = random.integer(0, 1) == 0;
        std::vector<std::string> patterns(static_cast<std::size_t>(random.integer(0, 8)));
        for (std::string& pattern : patterns)
            for (int i = random.integer(1, 3); i > 0; --i) pattern += "abab*?!"[random.integer(0, has_globs ? 6 : 3)];
        const GlobList list(patterns);
        plain += are_plain_names(patterns);
        for (const char* name : {"", "a", "b", "ab", "ba", "aab", "bab", "!a"}) {
            ASSERT_EQ(list.takes(name), matches_globs(patterns, name)) << trial << " " << name;
            taken += list.takes(name);
        }
    }
    EXPECT_GT(taken, 2000u);
    EXPECT_GT(plain, 2000u);
}

}  // namespace
}  // namespace burin
