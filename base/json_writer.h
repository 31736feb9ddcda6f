#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace burin {

/// Writes indented JSON text, one value after the other.
///
///     JsonWriter json;
///     json.begin_object().key("name").value("cube").key("triangles").value(12).end_object();
///     json.text();   // "{\n  \"name\": \"cube\",\n  \"triangles\": 12\n}\n"
///
/// Numbers that JSON cannot hold (NaN, infinities) become null.
class JsonWriter {
  public:
    enum class Layout : bool { indented, one_line };
    explicit JsonWriter(Layout layout = Layout::indented) : layout_(layout) {}

    JsonWriter& begin_object();
    JsonWriter& end_object();
    JsonWriter& begin_array();
    JsonWriter& end_array();
    JsonWriter& key(std::string_view name);
    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    JsonWriter& value(double number);
    JsonWriter& value(std::uint64_t number);
    JsonWriter& value(std::int64_t number);
    JsonWriter& value(int number) { return value(static_cast<std::int64_t>(number)); }
    JsonWriter& value(unsigned number) { return value(static_cast<std::uint64_t>(number)); }
    JsonWriter& value(bool truth);
    JsonWriter& null();

    /// The text so far, with a final line feed.
    std::string text() const { return text_ + "\n"; }

  private:
    void before_value();
    void line_break();
    JsonWriter& close(char bracket);

    Layout layout_;
    std::string text_;
    std::vector<bool> has_items_;  // one per open bracket
    bool after_key_ = false;
};

}  // namespace burin
