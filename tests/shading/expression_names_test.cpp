#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/shading/test_symbols.h"

namespace burin {
namespace {

using namespace test;

/// The values of an expression for the numbers 0 to 4 of a variable.
std::string for_numbers(const std::string& text, const std::string& variable, const NamedValues& others = {}) {
    std::string result;
    for (int number = 0; number < 5; ++number) {
        NamedValues values = others;
        values[variable] = static_cast<float>(number);
        result += value_of(text, values) != 0 ? '1' : '0';
    }
    return result;
}

// Objects: 1 wheel_left, 2 wheel_right, 3 body; 0 is the background, 4 is no object. Classes are counted from 0.

TEST(ExpressionNames, AreComparedWithPatterns) {
    EXPECT_EQ(for_numbers("object == \"body\"", "object"), "00010");
    EXPECT_EQ(for_numbers("\"body\" == object", "object"), "00010");
    EXPECT_EQ(for_numbers("object != \"body\"", "object"), "11101");
    EXPECT_EQ(for_numbers("object == \"wheel*\"", "object"), "01100");
    EXPECT_EQ(for_numbers("object != \"wheel*\"", "object"), "10011");
    EXPECT_EQ(for_numbers("object == \"*\"", "object"), "01110");
    EXPECT_EQ(for_numbers("object == \"nothing\"", "object"), "00000");
    EXPECT_EQ(for_numbers("object == \"*l*t\" or object == \"b*\"", "object"), "01110");
    EXPECT_EQ(for_numbers("object == \"*[bl]o*\"", "object"), "00000");  // brackets are characters as others
    EXPECT_EQ(for_numbers("class == \"silhouette\"", "class"), "00100");
    EXPECT_EQ(for_numbers("class == \"m*r*\"", "class"), "10000");
    EXPECT_EQ(for_numbers("class == \"*r*\"", "class"), "11010");
}

TEST(ExpressionNames, AreNumbersToo) {
    EXPECT_EQ(for_numbers("object == 0", "object"), "10000");
    EXPECT_EQ(for_numbers("object2 != object", "object2", {{"object", 2.0f}}), "11011");
    EXPECT_EQ(for_numbers("object > 1.5", "object"), "00111");
}

TEST(ExpressionNames, CanBeInGroups) {
    EXPECT_EQ(for_numbers("object in wheels", "object"), "01000");
    EXPECT_EQ(for_numbers("not object2 in wheels", "object2"), "10111");
    EXPECT_EQ(for_numbers("material in wheels", "material"), "01000");
    EXPECT_EQ(for_numbers("object in wheels and facing > 1", "object", {{"facing", 2.0f}}), "01000");
}

TEST(ExpressionNames, BetweenTwoInEitherOrder) {
    const std::string text = "between_objects(\"wheel*\", \"body\")";
    EXPECT_EQ(for_numbers(text, "object", {{"object2", 3.0f}}), "01100");
    EXPECT_EQ(for_numbers(text, "object2", {{"object", 3.0f}}), "01100");
    EXPECT_EQ(for_numbers(text, "object2", {{"object", 1.0f}}), "00010");
    EXPECT_EQ(for_numbers("between_materials(\"steel\", \"glass\")", "material", {{"material2", 1.0f}}), "00100");
}

/// A set of many names is looked up, for any number that a column may hold.
TEST(ExpressionNames, LookUpsAreTotal) {
    for (const float number : {-1.0f, -1e30f, 1e30f, 4294967296.0f, HUGE_VALF, -HUGE_VALF, std::nanf("")})
        EXPECT_EQ(value_of("object == \"wheel*\"", {{"object", number}}), 0) << number;
}

TEST(ExpressionNames, NewNamesMustNotBeTaken) {
    EXPECT_EQ(fault_of_name("weight", test_symbols()), std::nullopt);
    EXPECT_EQ(fault_of_name("depth", test_symbols()), "'depth' is a variable");
    EXPECT_EQ(fault_of_name("clamp", test_symbols()), "'clamp' is a function");
    EXPECT_EQ(fault_of_name("ridge", test_symbols()), "'ridge' is a word that later versions use");
    EXPECT_EQ(fault_of_name("and", test_symbols()), "'and' is a word of expressions");
    for (const char* name : {"", "2x", "a-b", "\xC3\xA9", "a b"})
        EXPECT_EQ(fault_of_name(name, test_symbols()), "a name has letters, digits and _, and begins with a letter");
}

}  // namespace
}  // namespace burin
