#include "lines/line_class.h"

#include <gtest/gtest.h>

namespace burin {
namespace {

TEST(LineClass, NamesAndNumbersBelongTogether) {
    for (int i = 0; i < kLineClassCount; ++i) {
        const auto c = static_cast<LineClass>(i);
        EXPECT_EQ(line_class_named(name_of(c)), c);
    }
    EXPECT_FALSE(line_class_named("outline").has_value());
    EXPECT_FALSE(line_class_named("").has_value());
}

TEST(LineClass, PriorityIsTheOrderOfTheConventions) {
    EXPECT_EQ(to_string(LineClassSet::all()), "mark,border,silhouette,intersection,object,material,crease,polygon");
    EXPECT_EQ((LineClass::crease | LineClass::silhouette).first(), LineClass::silhouette);
    EXPECT_EQ((LineClass::polygon | LineClass::object).first(), LineClass::object);
    EXPECT_FALSE(LineClassSet().first().has_value());
}

TEST(LineClassSet, IsASet) {
    for (unsigned a = 0; a < 1u << kLineClassCount; ++a) {
        const auto set = LineClassSet::from_bits(a);
        EXPECT_EQ(set | set, set);
        EXPECT_EQ(set & LineClassSet::all(), set);
        EXPECT_EQ(set.empty(), a == 0);
        int members = 0;
        for (int i = 0; i < kLineClassCount; ++i) members += set.has(static_cast<LineClass>(i));
        EXPECT_EQ(members, __builtin_popcount(a));
    }
}

}  // namespace
}  // namespace burin
