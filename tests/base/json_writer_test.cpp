#include "base/json_writer.h"

#include <gtest/gtest.h>

#include <limits>

namespace burin {
namespace {

TEST(JsonWriter, WritesNestedValues) {
    JsonWriter json;
    json.begin_object().key("name").value("a \"b\"\n\x01").key("list").begin_array();
    json.value(1).value(2.5).value(true).null().end_array();
    json.key("empty").begin_object().end_object().end_object();
    EXPECT_EQ(json.text(),
              "{\n  \"name\": \"a \\\"b\\\"\\n\\u0001\",\n  \"list\": [\n    1,\n    2.5,\n    true,\n"
              "    null\n  ],\n  \"empty\": {}\n}\n");
}

TEST(JsonWriter, TextsAreUtf8) {
    const auto quoted = [](std::string_view text) {
        JsonWriter json;
        json.begin_array().value(text).end_array();
        std::string result = json.text();
        return result.substr(result.find('"') + 1, result.rfind('"') - result.find('"') - 1);
    };
    for (const std::string text : {"a", "\xC3\xA4", "\xE2\x82\xAC", "\xF0\x9F\x96\x8B", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(quoted(text), text);
    EXPECT_EQ(quoted("Terraind\xE4k"), "Terraind\xC3\xA4k") << "Latin-1";
    EXPECT_EQ(quoted("\xC3"), "\xC3\x83") << "broken off";
    EXPECT_EQ(quoted("\xC0\x80"), "\xC3\x80\xC2\x80") << "longer than it need be";
    EXPECT_EQ(quoted("\xED\xA0\x80"), "\xC3\xAD\xC2\xA0\xC2\x80") << "half of a pair of UTF-16";
    EXPECT_EQ(quoted("\xF4\x90\x80\x80"), "\xC3\xB4\xC2\x90\xC2\x80\xC2\x80") << "beyond Unicode";
}

TEST(JsonWriter, NumbersThatJsonCannotHoldAreNull) {
    JsonWriter json;
    json.begin_array();
    json.value(std::numeric_limits<double>::infinity()).value(std::numeric_limits<double>::quiet_NaN()).end_array();
    EXPECT_EQ(json.text(), "[\n  null,\n  null\n]\n");
}

}  // namespace
}  // namespace burin
