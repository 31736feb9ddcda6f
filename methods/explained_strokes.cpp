#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

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

/// " = ramp over depth, taper 0.5"; nothing for a constant that nothing changes. `factors`: with their names.
std::string equals(const ExplainedStroke& stroke, InkValue value, double result = 0,
                   const std::vector<std::pair<const char*, double>>& factors = {}) {
    const std::string& source = source_of(stroke, value);
    std::string changes;
    double product = 1;
    for (const auto& [name, factor] : factors) {
        if (factor == 1) continue;
        changes += std::string(", ") + name + " " + number(factor);
        product *= factor;
    }
    if (!source.empty()) return " = " + printable(source.starts_with('=') ? source.substr(1) : source, 400) + changes;
    if (changes.empty()) return "";
    const bool is_as_in_sheet = stroke.shader.empty() && stroke.test.empty() && product > 0;
    return is_as_in_sheet ? " = " + number(result / product) + changes : changes;
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

/// The parameters, lets and variables with their values.
std::string names_in(const ExplainedStroke& stroke) {
    std::string text;
    for (const ExplainedName& name : stroke.names) {
        const glm::vec3 value(name.value[0], name.value[1], name.value[2]);
        text += (text.empty() ? "" : ", ") + printable(name.name, 100) + " ";
        if (name.type == ValueType::color) {
            text += hex_of(value);
        } else if (name.type == ValueType::number) {
            text += number(static_cast<double>(value.x));
        } else {
            for (int k = 0; k < 3; ++k) text += (k == 0 ? "(" : " ") + number(static_cast<double>(value[k]));
            text += ")";
        }
    }
    for (const ExplainedVariable& variable : stroke.variables) {
        for (const auto& [component, value] : variable.components) {
            text += (text.empty() ? "" : ", ") + variable.name;
            if (variable.is_triple) text += std::string(".") + "xyz"[component];
            text += " " + number(static_cast<double>(value));
        }
    }
    return text;
}

/// "silhouette of bolt/steel before background, behind 2"
std::string text_of(const ExplainedLine& line) {
    std::string text = std::string(name_of(line.drawn_as)) + " of " + owner(line.front);
    if (line.other.object != line.front.object || line.other_is_behind)
        text += (line.other_is_behind ? " before " : " and ") + owner(line.other);
    if (line.invisibility > 0) text += ", behind " + std::to_string(line.invisibility);
    return text;
}

std::string shares_of(const ExplainedStroke& stroke) {
    std::string text = "    covers " + number(stroke.covers);
    if (std::abs(stroke.area - stroke.covers) > 5e-4) text += " (its opacity over " + number(stroke.area) + ")";
    text += ", shows " + number(stroke.shows);
    for (std::size_t i = 0; i < stroke.erased_by.size(); ++i) {
        const ErasingStroke& by = stroke.erased_by[i];
        text += (i == 0 ? ", " + number(stroke.erased) + " erased by the halo of " : " and of ") + std::string("set ") +
                printable(by.set, 100) + ": " + std::string(name_of(by.drawn_as)) + " of " + owner(by.front) +
                ", chain " + std::to_string(by.chain);
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
    text += ", style " + printable(stroke.style, 100) + ": " + text_of(static_cast<const ExplainedLine&>(stroke)) +
            ", chain " + std::to_string(stroke.chain) + ", s " + number(stroke.s_px) + " of " +
            number(stroke.length_px) + " px\n" + shares_of(stroke);
    const InkValues& ink = stroke.ink;
    const auto width_px = static_cast<double>(ink.width_px), opacity = static_cast<double>(ink.opacity);
    static_assert(kInkValueCount == 4, "each of them has a line");
    text += "\n    width " + number(width_px) + " px" +
            equals(stroke, InkValue::width, width_px, {{"taper", stroke.taper}});
    text += "\n    opacity " + number(opacity) +
            equals(stroke, InkValue::opacity, opacity,
                   {{"min_length", stroke.min_length},
                    {"its crease fades", stroke.fade},
                    {"seen through", stroke.seen},
                    {"short and moved far", stroke.moved}});
    text += "\n    color " + hex_of(ink.color) + equals(stroke, InkValue::color);
    if (ink.offset_px != 0)
        text += "\n    offset " + number(static_cast<double>(ink.offset_px)) + " px" + equals(stroke, InkValue::offset);
    if (!stroke.shader.empty()) text += "\n    changed by shader " + stroke.shader;
    if (!stroke.test.empty()) text += "\n    opacity times test " + stroke.test;
    const std::string names = names_in(stroke);
    return text + (names.empty() ? "" : "\n    where " + names) + "\n";
}

/// Behind many surfaces there may be any number of lines, and edges of classes that nobody asks for.
constexpr std::size_t kMostUndrawn = 12;

std::string text_of(const std::vector<UndrawnLine>& lines) {
    if (lines.empty()) return "";
    std::string text;
    std::size_t shown = 0;
    for (const UndrawnLine& line : lines) {
        if (shown == kMostUndrawn || (!line.is_asked && line.invisibility > 0)) break;
        ++shown;
        text += "    " + text_of(static_cast<const ExplainedLine&>(line));
        if (!line.set.empty()) text += ", set " + printable(line.set, 100) + ", style " + printable(line.style, 100);
        text += ": " + line.reason + "\n";
    }
    const std::string left = std::to_string(lines.size() - shown);
    if (shown == 0) {
        text = "    " + left + (lines.size() == 1 ? " line" : " lines") + " behind surfaces, which the JSON has\n";
    } else if (shown < lines.size()) {
        text += "    and " + left + " more, which the JSON has\n";
    }
    return "near it, but with no ink in it:\n" + text;
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
}

void write_number(JsonWriter& json, const char* key, float number, const ExplainedStroke& stroke, InkValue value) {
    json.key(key).begin_object().key("value").value(static_cast<double>(number));
    write_source(json, stroke, value);
}

void write_names(JsonWriter& json, const std::vector<ExplainedName>& names) {
    json.key("names").begin_object();
    for (const ExplainedName& name : names) {
        json.key(name.name);
        if (name.type == ValueType::number) {
            json.value(static_cast<double>(name.value[0]));
        } else if (name.type == ValueType::color) {
            json.value(hex_of({name.value[0], name.value[1], name.value[2]}));
        } else {
            json.begin_array();
            for (const float part : name.value) json.value(static_cast<double>(part));
            json.end_array();
        }
    }
    json.end_object();
}

void write_sets(JsonWriter& json, const char* key, const std::vector<RefusedSet>& sets) {
    json.key(key).begin_array();
    for (const RefusedSet& set : sets)
        json.begin_object().key("set").value(set.set).key("reason").value(set.reason).end_object();
    json.end_array();
}

void write_line(JsonWriter& json, const ExplainedLine& line) {
    json.key("class").value(name_of(line.drawn_as));
    json.key("front").begin_object();
    write_side(json, line.front);
    json.end_object();
    json.key("other").begin_object();
    write_side(json, line.other);
    json.key("is_behind").value(line.other_is_behind).end_object();
    json.key("invisibility").value(line.invisibility);
}

void write_shares(JsonWriter& json, const ExplainedStroke& stroke) {
    json.key("covers").value(stroke.covers).key("shows").value(stroke.shows);
    json.key("area").value(stroke.area).key("erased").value(stroke.erased);
    json.key("erased_by").begin_array();
    for (const ErasingStroke& by : stroke.erased_by) {
        json.begin_object().key("set").value(by.set).key("class").value(name_of(by.drawn_as));
        json.key("front").begin_object();
        write_side(json, by.front);
        json.end_object().key("chain").value(by.chain).key("share").value(by.share).end_object();
    }
    json.end_array();
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
    json.key("set").value(stroke.set);
    write_sets(json, "earlier_sets", stroke.earlier_sets);
    json.key("style").value(stroke.style);
    write_line(json, stroke);
    json.key("chain").value(stroke.chain).key("copy").value(stroke.copy);
    json.key("s").value(stroke.s_px).key("length").value(stroke.length_px);
    write_shares(json, stroke);
    static_assert(kInkValueCount == 4, "each of them has a key");
    write_number(json, "width", stroke.ink.width_px, stroke, InkValue::width);
    json.key("taper").value(stroke.taper).end_object();
    write_number(json, "opacity", stroke.ink.opacity, stroke, InkValue::opacity);
    json.key("min_length")
        .value(stroke.min_length)
        .key("fade")
        .value(stroke.fade)
        .key("moved")
        .value(stroke.moved)
        .key("seen_through");
    json.value(stroke.seen).end_object();
    write_number(json, "offset", stroke.ink.offset_px, stroke, InkValue::offset);
    json.end_object();
    json.key("color").begin_object().key("value").value(hex_of(stroke.ink.color)).key("linear").begin_array();
    for (int k = 0; k < 3; ++k) json.value(static_cast<double>(stroke.ink.color[k]));
    json.end_array();
    write_source(json, stroke, InkValue::color);
    json.end_object();
    write_name(json, "shader", !stroke.shader.empty(), stroke.shader);
    write_name(json, "test", !stroke.test.empty(), stroke.test);
    write_names(json, stroke.names);
    json.key("variables").begin_object();
    for (const ExplainedVariable& variable : stroke.variables) write_variable(json, variable);
    json.end_object().end_object();
}

void write_undrawn(JsonWriter& json, const UndrawnLine& line) {
    json.begin_object();
    write_name(json, "set", !line.set.empty(), line.set);
    write_name(json, "style", !line.style.empty(), line.style);
    write_line(json, line);
    json.key("distance").value(line.distance_px).key("reason").value(line.reason);
    write_sets(json, "refused_by", line.refused);
    json.end_object();
}

}  // namespace

std::string text_of(const ExplainedPlace& place) {
    std::string text;
    if (place.strokes.empty()) text = "the style sheet draws nothing in this pixel\n";
    for (std::size_t i = 0; i < place.strokes.size(); ++i) text += text_of(i + 1, place.strokes[i]);
    return text + text_of(place.undrawn);
}

std::vector<std::string> reasons_of(const std::vector<ExplainedStroke>& strokes) {
    std::vector<std::string> reasons;
    for (const ExplainedStroke& stroke : strokes) {
        std::string reason = reason_of(stroke);
        if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) reasons.push_back(std::move(reason));
    }
    return reasons;
}

std::string json_of(const ExplainedPlace& place) {
    JsonWriter json;
    json.begin_object().key("pixel").begin_array().value(place.x).value(place.y).end_array();
    json.key("size").begin_array().value(place.width).value(place.height).end_array();
    json.key("strokes").begin_array();
    for (const ExplainedStroke& stroke : place.strokes) write_stroke(json, stroke);
    json.end_array();
    json.key("not_drawn").begin_array();
    for (const UndrawnLine& line : place.undrawn) write_undrawn(json, line);
    json.end_array().end_object();
    return json.text();
}

}  // namespace burin
