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

TEST(JsonWriter, NumbersThatJsonCannotHoldAreNull) {
    JsonWriter json;
    json.begin_array();
    json.value(std::numeric_limits<double>::infinity()).value(std::numeric_limits<double>::quiet_NaN()).end_array();
    EXPECT_EQ(json.text(), "[\n  null,\n  null\n]\n");
}

}  // namespace
}  // namespace burin
