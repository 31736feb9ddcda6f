#include "base/suggestion.h"

#include <gtest/gtest.h>

namespace burin {
namespace {

TEST(Suggestion, DistanceCountsCharacters) {
    EXPECT_EQ(edit_distance("", ""), 0u);
    EXPECT_EQ(edit_distance("width", "width"), 0u);
    EXPECT_EQ(edit_distance("width", ""), 5u);
    EXPECT_EQ(edit_distance("widht", "width"), 1u);  // neighbours changed places
    EXPECT_EQ(edit_distance("lenght", "length"), 1u);
    EXPECT_EQ(edit_distance("iwdht", "width"), 2u);
    EXPECT_EQ(edit_distance("ca", "abc"), 3u);
    EXPECT_EQ(edit_distance("shpe", "shape"), 1u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
}

TEST(Suggestion, ShortWordsAreNotNearBecauseTheyAreShort) {
    const std::vector<std::string> known{"base", "dash", "caps", "kr"};
    EXPECT_EQ(closest_word("name", known), std::nullopt);
    EXPECT_EQ(closest_word("cpas", known), "caps");
    EXPECT_EQ(closest_word("dahs", known), "dash");
    EXPECT_EQ(closest_word("dsh", known), "dash");
    EXPECT_EQ(closest_word("kf", known), "kr");
}

TEST(Suggestion, OnlyWhatIsNear) {
    const std::vector<std::string> known{"--line-width", "--lines", "--layers"};
    EXPECT_EQ(closest_word("--line-widht", known), "--line-width");
    EXPECT_EQ(closest_word("--line", known), "--lines");
    EXPECT_EQ(closest_word("--output", known), std::nullopt);
    EXPECT_EQ(closest_word("--lnies", known, 1), "--lines");
    EXPECT_EQ(closest_word("--lneis", known, 1), std::nullopt);
    EXPECT_EQ(closest_word("lenght", {"light", "length"}), "length");
    EXPECT_EQ(closest_word("x", {}), std::nullopt);
}

}  // namespace
}  // namespace burin
