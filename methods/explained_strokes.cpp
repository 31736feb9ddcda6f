#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/json_writer.h"
#include "image/image_io.h"
#include "mesh/text_scan.h"
#include "methods/explain_strokes.h"

// What explain_strokes() found, as text and as JSON.

namespace burin {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string hex_of(const glm::vec3& linear) {
    const auto byte = [](float value) {
        return static_cast<unsigned>(std::lround(srgb_from_linear(std::clamp(value, 0.0f, 1.0f)) * 255.0f));
    };
    char text[16];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(linear.r), byte(linear.g), byte(linear.b));
    return text;
}

const std::string& source_of(const ExplainedStroke& stroke, InkValue value) {
    return stroke.sources[static_cast<std::size_t>(value)];
}

/// " = ramp over depth"; nothing for a constant.
std::string equals(const ExplainedStroke& stroke, InkValue value) {
    const std::string& source = source_of(stroke, value);
    if (source.empty()) return "";
    return " = " + printable(source.starts_with('=') ? source.substr(1) : source, 400);
}

std::string owner(const ExplainedSide& side) {
    std::string name = side.object == 0 ? "background" : printable(side.object_name, 100);
    if (side.material != 0 && !side.material_name.empty()) name += "/" + printable(side.material_name, 100);
    return name;
}

std::string the(const ExplainedSide& side) { return side.object == 0 ? "the background" : owner(side); }

/// What makes a line of its class there.
std::string why(const ExplainedStroke& stroke) {
    const std::string other = the(stroke.other);
    switch (stroke.drawn_as) {
        case LineClass::mark:
            return "the model marks this edge as a line";
        case LineClass::border:
            return "its surface ends here, for no other polygon has this edge";
        case LineClass::silhouette:
            return (stroke.is_edge ? "its surface turns away from the eye here, before "
                                   : "its surface ends here, before ") +
                   other;
        case LineClass::intersection:
            return "it and " + other + " pass through each other";
        case LineClass::object:
            return "it and " + other + " are two objects that touch";
        case LineClass::material:
            return "it and " + other + " are two materials that touch";
        case LineClass::crease: {
            const std::string from = ", and creases begin at " + number(stroke.crease_from_deg) + "°";
            if (stroke.dihedral_deg > 0) return "its polygons turn by " + number(stroke.dihedral_deg) + "° here" + from;
            return "its surfaces touch at an angle" + from;
        }
        case LineClass::polygon:
            return "two of its polygons have this edge";
        default:  // a class without words of its own
            return "this class applies to it";
    }
}

std::string reason_of(const ExplainedStroke& stroke) {
    std::string text = std::string(name_of(stroke.drawn_as)) + " of " + owner(stroke.front) + ": " + why(stroke);
    LineClassSet others;
    for (std::size_t i = 0; i < kLineClassCount; ++i) {
        const auto c = static_cast<LineClass>(i);
        if (c != stroke.drawn_as && stroke.classes.has(c)) others |= c;
    }
    if (!others.empty()) text += "; also of class " + to_string(others);
    if (stroke.invisibility > 0) text += "; hidden, for a surface is in front of it";
    return text;
}

std::string variables_in(const ExplainedStroke& stroke) {
    std::string text;
    for (const ExplainedVariable& variable : stroke.variables) {
        for (const auto& [component, value] : variable.components) {
            text += (text.empty() ? "" : ", ") + variable.name;
            if (variable.is_triple) text += std::string(".") + "xyz"[component];
            text += " " + number(static_cast<double>(value));
        }
    }
    return text;
}

std::string text_of(std::size_t rank, const ExplainedStroke& stroke) {
    std::string text = std::to_string(rank) + " set " + printable(stroke.set, 100);
    for (std::size_t i = 0; i < stroke.earlier_sets.size(); ++i) {
        const RefusedSet& earlier = stroke.earlier_sets[i];
        text += (i == 0 ? " (" : "; ") + printable(earlier.set, 100) + ": " + earlier.reason;
    }
    if (!stroke.earlier_sets.empty()) text += ")";
    text += ", style " + printable(stroke.style, 100) + ": " + std::string(name_of(stroke.drawn_as)) + " of " +
            owner(stroke.front);
    if (stroke.other.object != stroke.front.object || stroke.other_is_behind)
        text += (stroke.other_is_behind ? " before " : " and ") + owner(stroke.other);
    if (stroke.invisibility > 0) text += ", behind " + std::to_string(stroke.invisibility);
    text += ", chain " + std::to_string(stroke.chain) + ", s " + number(stroke.s_px) + " of " +
            number(stroke.length_px) + " px\n";
    text += "    covers " + number(stroke.covers) + ", shows " + number(stroke.shows);
    const InkValues& ink = stroke.ink;
    static_assert(kInkValueCount == 4, "each of them has a line");
    text += "\n    width " + number(static_cast<double>(ink.width_px)) + " px" + equals(stroke, InkValue::width);
    text += "\n    opacity " + number(static_cast<double>(ink.opacity)) + equals(stroke, InkValue::opacity);
    text += "\n    color " + hex_of(ink.color) + equals(stroke, InkValue::color);
    if (ink.offset_px != 0)
        text += "\n    offset " + number(static_cast<double>(ink.offset_px)) + " px" + equals(stroke, InkValue::offset);
    if (!stroke.shader.empty()) text += "\n    changed by shader " + stroke.shader;
    if (!stroke.test.empty()) text += "\n    opacity times test " + stroke.test;
    const std::string variables = variables_in(stroke);
    return text + (variables.empty() ? "" : "\n    where " + variables) + "\n";
}

void write_name(JsonWriter& json, const char* key, bool is_there, const std::string& name) {
    json.key(key);
    is_there ? json.value(name) : json.null();
}

void write_side(JsonWriter& json, const ExplainedSide& side) {
    write_name(json, "object", side.object != 0, side.object_name);
    write_name(json, "material", side.material != 0, side.material_name);
}

void write_source(JsonWriter& json, const ExplainedStroke& stroke, InkValue value) {
    const std::string& source = source_of(stroke, value);
    write_name(json, "source", !source.empty(), source);
    json.end_object();
}

void write_number(JsonWriter& json, const char* key, float number, const ExplainedStroke& stroke, InkValue value) {
    json.key(key).begin_object().key("value").value(static_cast<double>(number));
    write_source(json, stroke, value);
}

void write_variable(JsonWriter& json, const ExplainedVariable& variable) {
    json.key(variable.name);
    if (!variable.is_triple) {
        json.value(static_cast<double>(variable.components.front().second));
        return;
    }
    json.begin_object();
    for (const auto& [component, value] : variable.components)
        json.key(std::string_view("xyz").substr(component, 1)).value(static_cast<double>(value));
    json.end_object();
}

void write_stroke(JsonWriter& json, const ExplainedStroke& stroke) {
    json.begin_object();
    json.key("set").value(stroke.set).key("earlier_sets").begin_array();
    for (const RefusedSet& earlier : stroke.earlier_sets)
        json.begin_object().key("set").value(earlier.set).key("reason").value(earlier.reason).end_object();
    json.end_array();
    json.key("style").value(stroke.style).key("class").value(name_of(stroke.drawn_as));
    json.key("front").begin_object();
    write_side(json, stroke.front);
    json.end_object();
    json.key("other").begin_object();
    write_side(json, stroke.other);
    json.key("is_behind").value(stroke.other_is_behind).end_object();
    json.key("invisibility").value(stroke.invisibility);
    json.key("chain").value(stroke.chain).key("copy").value(stroke.copy);
    json.key("s").value(stroke.s_px).key("length").value(stroke.length_px);
    json.key("covers").value(stroke.covers).key("shows").value(stroke.shows);
    static_assert(kInkValueCount == 4, "each of them has a key");
    write_number(json, "width", stroke.ink.width_px, stroke, InkValue::width);
    write_number(json, "opacity", stroke.ink.opacity, stroke, InkValue::opacity);
    write_number(json, "offset", stroke.ink.offset_px, stroke, InkValue::offset);
    json.key("color").begin_object().key("value").value(hex_of(stroke.ink.color)).key("linear").begin_array();
    for (int k = 0; k < 3; ++k) json.value(static_cast<double>(stroke.ink.color[k]));
    json.end_array();
    write_source(json, stroke, InkValue::color);
    write_name(json, "shader", !stroke.shader.empty(), stroke.shader);
    write_name(json, "test", !stroke.test.empty(), stroke.test);
    json.key("variables").begin_object();
    for (const ExplainedVariable& variable : stroke.variables) write_variable(json, variable);
    json.end_object().end_object();
}

}  // namespace

std::string text_of(const std::vector<ExplainedStroke>& strokes) {
    if (strokes.empty()) return "the style sheet draws nothing in this pixel\n";
    std::string text;
    for (std::size_t i = 0; i < strokes.size(); ++i) text += text_of(i + 1, strokes[i]);
    return text;
}

std::vector<std::string> reasons_of(const std::vector<ExplainedStroke>& strokes) {
    std::vector<std::string> reasons;
    for (const ExplainedStroke& stroke : strokes) {
        std::string reason = reason_of(stroke);
        if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) reasons.push_back(std::move(reason));
    }
    return reasons;
}

std::string json_of(const std::vector<ExplainedStroke>& strokes, int x, int y) {
    JsonWriter json;
    json.begin_object().key("pixel").begin_array().value(x).value(y).end_array();
    json.key("strokes").begin_array();
    for (const ExplainedStroke& stroke : strokes) write_stroke(json, stroke);
    json.end_array().end_object();
    return json.text();
}

}  // namespace burin
