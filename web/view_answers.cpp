#include "web/view_answers.h"

#include <array>
#include <cstdlib>
#include <string_view>

#include "base/json_writer.h"
#include "mesh/text_scan.h"
#include "scene/parameter_text.h"
#include "shading/sheet/sheet_symbols.h"
#include "web/command_text.h"

namespace burin {
namespace {

JsonWriter begin_answer(const char* kind, std::int64_t number) {
    JsonWriter json(JsonWriter::Layout::one_line);
    json.begin_object().key("kind").value(kind).key("number").value(number);
    return json;
}

void write_point(JsonWriter& json, const char* name, const glm::dvec3& p) {
    json.key(name).begin_array().value(p.x).value(p.y).value(p.z).end_array();
}

void write_notes(JsonWriter& json, const std::vector<std::string>& notes) {
    json.key("notes").begin_array();
    for (const std::string& note : notes) json.value(printable(note, 400));
    json.end_array();
}

void write_parameters(JsonWriter& json, const StyleSheet& sheet) {
    json.key("parameters").begin_array();
    for (const SheetParameter& p : sheet.parameters) {
        json.begin_object().key("name").value(p.name).key("text").value(text_of_parameter(p));
        if (p.value.kind == StyleValue::Kind::number) {
            json.key("value").value(p.value.number).key("unit").value(suffix_of(p.value.unit));
            if (p.least) json.key("min").value(*p.least);
            if (p.most) json.key("max").value(*p.most);
        }
        json.end_object();
    }
    json.end_array();
}

/// What the page shows of the sheet in use.
void write_sheet(JsonWriter& json, const StyleSheet* sheet) {
    json.key("sheet");
    if (sheet == nullptr) {
        json.null();
        return;
    }
    json.begin_object().key("summary").value(sheet->summary);
    json.key("says_crease").value(sheet->crease_angle_deg.has_value());
    if (sheet->crease_angle_deg)
        json.key("crease_angle").value(0.5 * ((*sheet->crease_angle_deg)[0] + (*sheet->crease_angle_deg)[1]));
    write_parameters(json, *sheet);
    json.end_object();
}

void write_look(JsonWriter& json, const Look& look) {
    json.key("look").begin_object();
    json.key("lines").begin_array();
    for (int i = 0; i < kLineClassCount; ++i) {
        if (look.classes.has(static_cast<LineClass>(i))) json.value(name_of(static_cast<LineClass>(i)));
    }
    json.end_array();
    json.key("crease_angle").value(look.crease_angle_deg).key("width").value(look.width_px);
    json.key("hidden").value(word_of(look.hidden)).key("shading").value(look.shading);
    json.key("style").value(look.style).key("sheet").value(look.sheet);
    json.key("parameters").begin_object();
    for (const auto& [key, value] : look.parameters) json.key(key).value(value);
    json.end_object().end_object();
}

std::string with_bytes(const std::string& text, std::string_view bytes) {
    std::string answer;
    answer.reserve(4 + text.size() + bytes.size());
    for (int shift = 0; shift < 32; shift += 8) answer += static_cast<char>(text.size() >> shift & 0xFF);
    answer += text;
    answer += bytes;
    return answer;
}

/// A place in the edited sheet: "sheet:12:3: message".
struct SheetPlace {
    std::uint64_t line = 0, column = 0;
    std::string_view message;
};

std::uint64_t take_number(std::string_view& text) {
    std::uint64_t number = 0;
    std::size_t digits = 0;
    for (; digits < text.size() && digits < 9 && text[digits] >= '0' && text[digits] <= '9'; ++digits)
        number = number * 10 + static_cast<std::uint64_t>(text[digits] - '0');
    if (digits == 0 || !text.substr(digits).starts_with(':')) return 0;
    text.remove_prefix(digits + 1);
    return number;
}

std::optional<SheetPlace> sheet_place(std::string_view what) {
    constexpr std::string_view kBegin = "sheet:";
    if (!what.starts_with(kBegin)) return std::nullopt;
    what.remove_prefix(kBegin.size());
    SheetPlace place;
    place.line = take_number(what);
    if (place.line > 0) place.column = take_number(what);
    while (what.starts_with(' ')) what.remove_prefix(1);
    place.message = what;
    return place;
}

}  // namespace

std::string hello_answer(const ViewedScene& scene, const Look& look, const StyleSheet* sheet) {
    JsonWriter json = begin_answer("hello", 0);
    json.key("name").value(scene.name());
    write_point(json, "low", scene.box().low);
    write_point(json, "high", scene.box().high);
    write_point(json, "axis", scene.axis());
    json.key("classes").begin_array();
    for (const std::string_view name : kLineClassNames) json.value(name);
    json.end_array();
    write_look(json, look);
    write_sheet(json, sheet);
    json.key("styles").begin_array();
    for (const ChosenSheet& s : scene.tables().sheets()) {
        json.begin_object().key("name").value(s.name).key("summary").value(s.summary).key("text").value(s.text);
        json.end_object();
    }
    json.end_array();
    write_notes(json, scene.notes());
    json.end_object();
    return json.text();
}

std::string look_answer(std::int64_t number, const StyleSheet* sheet) {
    JsonWriter json = begin_answer("look", number);
    write_sheet(json, sheet);
    json.end_object();
    return json.text();
}

std::string view_answer(std::int64_t number, const View& view) {
    JsonWriter json = begin_answer("view", number);
    write_point(json, "eye", view.eye);
    write_point(json, "target", view.target);
    write_point(json, "up", view.up);
    json.key("fov").value(view.fov_deg).key("height");
    view.height_of_view ? json.value(*view.height_of_view) : json.null();
    json.end_object();
    return json.text();
}

std::string explain_answer(std::int64_t number, const ExplainedPixel& pixel) {
    JsonWriter json = begin_answer("explain", number);
    json.key("x").value(std::int64_t{pixel.x}).key("y").value(std::int64_t{pixel.y}).key("reasons").begin_array();
    for (const std::string& reason : pixel.reasons) json.value(reason);
    json.end_array();
    json.key("lines").value(pixel.lines).key("fragments").value(pixel.fragments).end_object();
    return json.text();
}

std::string command_answer(std::int64_t number, const std::optional<std::string>& command, const std::string& name) {
    JsonWriter json = begin_answer("command", number);
    json.key("command").value(
        command.value_or("burin render " + in_shell(name + "-view.toml") + " -o " + in_shell(name + "-view.png")));
    json.key("needs_scene").value(!command.has_value()).end_object();
    return json.text();
}

std::string error_answer(std::int64_t number, const std::string& what) {
    JsonWriter json = begin_answer("error", number);
    if (const auto place = sheet_place(what)) {
        json.key("message").value(printable(std::string(place->message), 2000));
        json.key("line").value(place->line).key("column").value(place->column);
    } else {
        json.key("message").value(printable(what, 2000));
    }
    json.end_object();
    return json.text();
}

std::string frame_answer(const ViewMessage& message, const DrawnView& drawn) {
    JsonWriter json = begin_answer("frame", message.number);
    json.key("format").value(drawn.picture.format);
    json.key("width").value(message.view.width).key("height").value(message.view.height);
    json.key("full").value(message.is_full);
    json.key("draw_ms").value(drawn.draw_s * 1e3).key("encode_ms").value(drawn.encode_s * 1e3);
    write_notes(json, drawn.notes);
    json.end_object();
    const auto* const bytes = reinterpret_cast<const char*>(drawn.picture.bytes.data());
    return with_bytes(json.text(), {bytes, drawn.picture.bytes.size()});
}

std::string file_answer(const ViewMessage& message, const std::string& name, const std::vector<std::string>& notes,
                        const std::string& file) {
    static constexpr std::array<std::array<const char*, 2>, 3> kKinds = {
        {{".png", "image/png"}, {".svg", "image/svg+xml"}, {"-view.toml", "application/toml"}}};
    const auto& [suffix, type] = kKinds[static_cast<std::size_t>(message.format)];
    JsonWriter json = begin_answer("file", message.number);
    json.key("name").value(name + suffix).key("type").value(type);
    write_notes(json, notes);
    json.end_object();
    return with_bytes(json.text(), file);
}

}  // namespace burin
