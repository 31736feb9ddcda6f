#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "tests/shading/test_symbols.h"

namespace burin {
namespace {

using namespace test;

std::string repeated(std::string_view part, std::size_t times) {
    std::string text;
    for (std::size_t i = 0; i < times; ++i) text += part;
    return text;
}

struct WrongText {
    std::string text, fault;
};

TEST(ExpressionErrors, SayWhereAndWhat) {
    const std::string name_needed = "a text can only be compared with a name, as in class == \"crease\"";
    const std::string text_no_value = "a text is no value: compare it with a name, as in class == \"crease\"";
    const std::string no_color =
        "a number is needed here, but the expression is a colour: take .r, .g, .b or luminance()";
    const std::vector<WrongText> wrong{
        // the specification's own
        {"clamp(3 - , 1, 2)", "11: a value is missing before ','"},
        {"depht + 1", "1: unknown variable 'depht', did you mean 'depth'?"},
        {"1 + (2", "7: ')' expected before the end"},
        {"C * 2", "1: " + no_color},
        {"1 < t < 2", "7: comparisons cannot be chained: use 'and'"},
        {"sin(3)", "1: angles are in degrees here: use sind()"},
        // words
        {"", "1: a value is missing at the end"},
        {"   ", "4: a value is missing at the end"},
        {"1 $ 2", "3: unexpected '$'"},
        {"1 \xC3\xA9 2", "3: unexpected character"},
        {"\xC3\xA9", "1: unexpected character"},
        {"\"\xC3\xA9\" + $", "7: unexpected '$'"},
        {"1 && 2", "3: unexpected '&&': use 'and'"},
        {"1 || 2", "3: unexpected '||': use 'or'"},
        {"!1", "1: unexpected '!': use 'not', or '!=' for different"},
        {"s = 1", "3: unexpected '=': use '==' for equal"},
        {"class == 'crease'", "10: unexpected ''': texts stand in double quotes"},
        {"class == \"crease", "10: the text that begins here does not end: '\"' is missing"},
        {"#12345", "1: a colour has six hexadecimal digits, as #1a2b3c"},
        {"#12345g", "1: a colour has six hexadecimal digits, as #1a2b3c"},
        {"1 + #1234567", "5: a colour has six hexadecimal digits, as #1a2b3c"},
        {"1e39", "1: the number is too large: the largest is 3.4e38"},
        {"1 + " + repeated("9", 400), "5: the number is too large: the largest is 3.4e38"},
        {"3cm", "2: unknown unit 'cm': give px, mm, pt or world"},
        {"1 + 2e", "6: unknown unit 'e': give px, mm, pt or world"},
        {"3 mm", "3: an operator is missing before 'mm'"},
        {"mm", "1: a unit stands right behind a number, as 2mm"},
        // grammar
        {"1 2", "3: an operator is missing before '2'"},
        {"1)", "2: ')' has no '('"},
        {"(1, 2)", "3: ')' expected before ','"},
        {"+1", "1: a value is missing before '+'"},
        {"1 * * 2", "5: a value is missing before '*'"},
        {"1 + not 2", "5: 'not' needs brackets here: (not ...)"},
        {"1 and", "6: a value is missing at the end"},
        {"and 1", "1: a value is missing before 'and'"},
        {"1 ? 2", "6: ':' expected before the end"},
        {"min(1, 2", "9: ')' expected before the end"},
        {"min(1,)", "7: a value is missing before ')'"},
        {"C.q", "3: a component is one of .x .y .z or .r .g .b"},
        {"C.rg", "3: a component is one of .x .y .z or .r .g .b"},
        {"1 == 2 != 3", "8: comparisons cannot be chained: use 'and'"},
        {"object in", "10: the name of a group is missing after 'in'"},
        {"object in 3", "11: the name of a group is missing after 'in'"},
        {"[1]", "1: unexpected bracket: use '('"},
        // names
        {"1 + foo", "5: unknown variable 'foo'"},
        {"facng * facing", "1: unknown variable 'facng', did you mean 'facing'?"},
        {"whidth", "1: unknown variable 'whidth', did you mean 'width'?"},
        {repeated("x", 100), "1: unknown variable '" + repeated("x", 40) + "...'"},
        {"k1 + 1", "1: 'k1' is not in this version"},
        {"ridge(2)", "1: 'ridge' is not in this version"},
        {"sind", "1: 'sind' is a function: write sind(x)"},
        {"depth(2)", "1: 'depth' is not a function: an operator is missing before '('"},
        {"fade", "1: 'fade' is a ramp: write ramp(\"fade\", x)"},
        {"wheels", "1: 'wheels' is a group: write object in wheels"},
        {"true", "1: 'true' is written 1"},
        {"smothstep(0, 1, t)", "1: unknown function 'smothstep', did you mean 'smoothstep'?"},
        {"2 * lerp(0, 1, t)", "5: there is no lerp(): use mix(a, b, t)"},
        {"atan2(1, 2)", "1: angles are in degrees here: use atan2d(y, x)"},
        {"foo(1)", "1: unknown function 'foo'"},
        // functions
        {"clamp(1, 2)", "1: clamp(x, low, high) takes 3 values, not 2"},
        {"1 + noise()", "5: noise(x, seed) takes 1 to 2 values, not 0"},
        {"abs(1, 2)", "1: abs(x) takes 1 value, not 2"},
        {"min(1)", "1: min(a, b, ...) takes 2 or more values, not 1"},
        {"attr(3)", "6: attr(\"name\") needs a text here, in double quotes"},
        {"attr(\"\")", "6: the name of a vertex attribute is missing"},
        {"abs(\"x\")", "5: abs(x) needs a value here, not a text"},
        {"ramp(\"fad\", t)", "6: unknown ramp 'fad', did you mean 'fade'?"},
        {"ramp(\"fade\", C)", "14: where a ramp is looked at must be a number, not a colour"},
        {"fbm(P, t)", "8: the number of octaves must be a whole number from 1 to 8 that does not vary"},
        {"fbm(P, 9)", "8: the number of octaves must be a whole number from 1 to 8 that does not vary"},
        {"fbm(P, 1.5)", "8: the number of octaves must be a whole number from 1 to 8 that does not vary"},
        {"fbm(s, 2)", "5: where fbm() is looked at must be a colour or a vector, as C or P"},
        {"luminance(1)", "11: what luminance() is of must be a colour or a vector, as C or P"},
        {"dot(P, 1)", "8: what dot() takes must be a colour or a vector, as C or P"},
        {"rgb(1, 2, C)", "11: a part of rgb() must be a number, not a colour"},
        {"if(P, 1, 2)", "4: a condition must be a number, not a vector"},
        // types
        {"C", "1: " + no_color},
        {"P", "1: a number is needed here, but the expression is a vector: take .x, .y, .z or length()"},
        {"1 + C.r * C", "1: " + no_color},
        {"C < 1", "1: what is compared must be a number, not a colour"},
        {"1 < C", "5: what is compared must be a number, not a colour"},
        {"C ? 1 : 2", "1: a condition must be a number, not a colour"},
        {"1 and (P + 1)", "8: a condition must be a number, not a vector"},
        {"not C", "5: what 'not' turns round must be a number, not a colour"},
        {"t.x", "3: a number has no components: only colours and vectors have"},
        {"\"crease\"", "1: " + text_no_value},
        {"1 + \"crease\"", "5: " + text_no_value},
        {"(1 ? \"a\" : 2)", "6: " + text_no_value},
        {"depth == \"crease\"", "10: " + name_needed},
        {"class < \"crease\"", "9: what is compared must be a number, not a text"},
        {"class == \"creese\"", "10: unknown class 'creese', did you mean 'crease'?"},
        {"\"creese\" != class", "1: unknown class 'creese', did you mean 'crease'?"},
        {"class == \"ridge\"", "10: 'ridge' is not in this version"},
        {"object == body", "11: unknown variable 'body'; names stand in double quotes: object == \"body\""},
        {"1 and steel != material2",
         "7: unknown variable 'steel'; names stand in double quotes: material2 != \"steel\""},
        {"class == mark", "10: unknown variable 'mark'; names stand in double quotes: class == \"mark\""},
        {"depth == body", "10: unknown variable 'body'"},
        {"object < body", "10: unknown variable 'body'"},
        {"object + 1 == body", "15: unknown variable 'body'"},
        {"object == material", "8: names of kind 'object' and 'material' cannot be compared"},
        {"object in wheel", "11: unknown group 'wheel', did you mean 'wheels'?"},
        {"object in metals", "11: the group 'metals' is one of kind 'material', not 'object'"},
        {"depth in wheels", "1: only a name can be in a group, as in: object in 'wheels'"},
        {"between_objects(1, \"a\")", "17: between_objects(\"a\", \"b\") needs a text here, in double quotes"},
        // lets
        {"1 + wrong", "5: in 'wrong', column 4: a value is missing at the end"},
        {"ring", "1: in 'ring', column 5: in 'gnir', column 1: 'ring' is made of itself"},
    };
    for (const WrongText& example : wrong) EXPECT_EQ(fault_of(example.text), example.fault) << example.text;
}

TEST(ExpressionErrors, LimitsAreErrors) {
    const std::string too_long = "4097: the expression is longer than 4096 characters: move parts of it into [let]";
    const std::string too_deep = ": the expression is nested more than 64 levels deep: move parts of it into [let]";
    EXPECT_EQ(fault_of("1" + repeated(" ", 4095)), "");
    EXPECT_EQ(fault_of("1" + repeated(" ", 4096)), too_long);
    EXPECT_EQ(fault_of("\"" + repeated("\xC3\xA9", 4094) + "\" == class").substr(0, 5), "4097:");
    EXPECT_EQ(fault_of(repeated("(", 63) + "1" + repeated(")", 63)), "");
    EXPECT_EQ(fault_of(repeated("(", 64) + "1" + repeated(")", 64)), "65" + too_deep);
    EXPECT_EQ(fault_of(repeated("-", 63) + "1"), "");
    EXPECT_EQ(fault_of(repeated("-", 64) + "1"), "64" + too_deep);
    EXPECT_EQ(fault_of("1" + repeated("^1", 63)), "");
    EXPECT_EQ(fault_of("1" + repeated("^1", 64)), "128" + too_deep);
    EXPECT_EQ(fault_of(repeated("not ", 63) + "1"), "");
    EXPECT_EQ(fault_of(repeated("not ", 64) + "1"), "253" + too_deep);
    EXPECT_EQ(fault_of(repeated("abs(", 63) + "1" + repeated(")", 63)), "");
    EXPECT_EQ(fault_of(repeated("1?1:", 63) + "1"), "");
    EXPECT_EQ(fault_of(repeated("1?1:", 64) + "1"), "255" + too_deep);
    EXPECT_EQ(fault_of("1" + repeated("+1", 2047)), "");  // long, not deep

    // Operations that are left: folded and equal ones do not count.
    std::string sum = "s";
    for (int i = 0; i < 500; ++i) sum += "*t+" + std::to_string(i);
    EXPECT_EQ(fault_of(sum), "");
    sum = "s";
    for (int i = 0; i < 520; ++i) sum += "*t+" + std::to_string(i);
    EXPECT_EQ(fault_of(sum), "1: the expression has more than 1024 operations: make it shorter");
    EXPECT_EQ(fault_of(repeated("fbm(P,8)+", 400) + "1"), "");
    std::string many = "1";
    for (int i = 0; i < 250; ++i) many += "+fbm(P*" + std::to_string(i) + ",8)";
    EXPECT_EQ(fault_of(many), "1: the expression has more than 1024 operations: make it shorter");

    // As many values wait for each other as levels allow.
    std::string wide;
    for (int i = 0; i < 31; ++i) wide += "sind(s+" + std::to_string(i) + ")*(t+";
    EXPECT_EQ(fault_of(wide + "1" + repeated(")", 31)), "");
}

TEST(ExpressionErrors, TooManyValuesAtOnce) {
    // Each let is a value that stays until it is used a second time.
    ExpressionSymbols symbols = test_symbols();
    std::string text = "0", back;
    for (int i = 0; i < 70; ++i) {
        const std::string name = "l" + std::to_string(i);
        symbols.lets.push_back({name, "s + " + std::to_string(i)});
        text += " + " + name;
        back += " - " + name + " * depth";
    }
    text += " + t * (0" + back + ")";
    try {
        compile_expression(text, symbols, {});
        FAIL();
    } catch (const ExpressionError& error) {
        EXPECT_STREQ(error.what(), "the expression needs more than 64 values at once: make it shorter");
        EXPECT_EQ(error.column(), 1u);
    }
}

TEST(ExpressionErrors, VariablesThatVaryTooMuch) {
    EXPECT_EQ(fault_of("qi > 0 and depth > 3", {.highest_rate = ValueRate::piece}),
              "12: 'depth' changes along a line; use it in width or opacity");
    EXPECT_EQ(fault_of("qi > 0 and C.r > 3 and object in wheels", {.highest_rate = ValueRate::piece}), "");
    EXPECT_EQ(fault_of("length_px + qi", {.highest_rate = ValueRate::chain}),
              "13: 'qi' changes along a line; here a value is needed that is the same for a whole line");
    EXPECT_EQ(fault_of("length_px + frame", {.highest_rate = ValueRate::chain}), "");
    EXPECT_EQ(fault_of("length_px", {.highest_rate = ValueRate::frame}),
              "1: 'length_px' changes from line to line; here a value is needed that is the same for all");
    EXPECT_EQ(fault_of("1 + shade", {.highest_rate = ValueRate::piece}),
              "5: 'shade' changes along a line; use it in width or opacity");
    EXPECT_EQ(fault_of("2world", {.highest_rate = ValueRate::piece}),
              "1: 'px_size' changes along a line; use it in width or opacity");
    EXPECT_EQ(fault_of("attr(\"wear\")", {.highest_rate = ValueRate::piece}),
              "6: 'attr' changes along a line; use it in width or opacity");
}

}  // namespace
}  // namespace burin
