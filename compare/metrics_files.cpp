#include "compare/metrics_files.h"

#include <cstdio>

#include "base/json_writer.h"
#include "compare/method_notes.h"
#include "methods/method_table.h"

namespace burin {
namespace {

void write_classes(JsonWriter& json, LineClassSet classes) {
    json.begin_array();
    for (std::size_t i = 0; i < kLineClassCount; ++i) {
        if (classes.has(static_cast<LineClass>(i))) json.value(kLineClassNames[i]);
    }
    json.end_array();
}

void write_rect(JsonWriter& json, PixelRect r) {
    json.begin_array().value(r.x0).value(r.y0).value(r.x1).value(r.y1).end_array();
}

void write_numbers(JsonWriter& json, const char* key, const std::vector<double>& numbers) {
    json.key(key).begin_array();
    for (const double n : numbers) json.value(n);
    json.end_array();
}

std::string_view word_for(Better better) {
    switch (better) {
        case Better::lower:
            return "lower";
        case Better::higher:
            return "higher";
        case Better::near_zero:
            return "near_zero";
        case Better::near_one:
            return "near_one";
        case Better::none:
            break;
    }
    return "none";
}

void write_row(JsonWriter& json, const ComparisonRow& row) {
    json.key("asked_width_px").value(row.asked_width_px);
    json.key("truth_width_px").value(row.truth_width_px);
    for (std::size_t i = 0; i < kMetricCount; ++i) {
        json.key(metric_table()[i].key);
        if (const auto& value = row.values.values[i]) {
            json.value(*value);
        } else {
            json.null();
        }
    }
    json.key("curves");
    if (!row.curves) {
        json.null();
    } else {
        const ChartCurves& c = *row.curves;
        json.begin_object();
        write_numbers(json, "width_px_by_degree", c.width_px);
        write_numbers(json, "rmse_by_degree", c.rmse);
        write_numbers(json, "within_bin_sd_by_degree", c.within_bin_sd);
        json.key("profile_first_u_px").value(c.profile.first_u);
        json.key("profile_step_px").value(LineSpread::kBin_px);
        write_numbers(json, "profile_coverage", c.profile.mean);
        json.key("modulation_step_cycles_per_px").value(Modulation::kStep);
        write_numbers(json, "modulation", c.modulation);
        write_numbers(json, "gap_px", c.gaps_px);
        write_numbers(json, "leak_share_by_gap", c.leak_share);
        json.end_object();
    }
    write_numbers(json, "coverage_by_frame", row.frame_coverage);
}

void write_name_or_null(JsonWriter& json, const char* key, const std::string& name) {
    json.key(key);
    if (name.empty()) {
        json.null();
    } else {
        json.value(name);
    }
}

void write_method(JsonWriter& json, const MethodResult& result) {
    json.begin_object();
    json.key("name").value(result.method->name);
    json.key("source").value(result.method->source);
    const MethodNote* const note = find_method_note(result.method->name);
    write_name_or_null(json, "how", note != nullptr ? std::string(note->how) : "");
    write_name_or_null(json, "limits", note != nullptr ? std::string(note->limits) : "");
    json.key("drawn");
    write_classes(json, result.drawn);
    json.key("not_drawn");
    write_classes(json, result.not_drawn);
    json.key("truth_classes");
    write_classes(json, result.truth);
    write_name_or_null(json, "picture", result.picture);
    write_name_or_null(json, "difference", result.difference);
    write_row(json, result.published);
    json.key("equal_width").begin_object();
    write_row(json, result.equal_width);
    json.end_object().end_object();
}

/// A field of a CSV file, quoted if needed.
std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

std::string csv_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

void write_csv_row(std::string& csv, const MethodResult& result, const char* kind, const ComparisonRow& row) {
    csv += csv_field(result.method->name) + "," + kind + "," + csv_field(to_string(result.drawn)) + "," +
           csv_field(to_string(result.not_drawn)) + "," + csv_number(row.asked_width_px) + "," +
           csv_number(row.truth_width_px);
    for (const auto& value : row.values.values) csv += value ? "," + csv_number(*value) : ",";
    csv += "\n";
}

}  // namespace

std::string metrics_json(const Comparison& c) {
    JsonWriter json;
    json.begin_object();
    json.key("scene").begin_object();
    json.key("input").value(c.input);
    json.key("width").value(c.width).key("height").value(c.height);
    json.key("crop");
    write_rect(json, c.crop);
    json.key("focus").begin_array().value(c.focus.x).value(c.focus.y).end_array();
    json.key("triangles").value(c.triangles);
    json.key("lines");
    write_classes(json, c.classes);
    json.key("line_width_px").value(c.line_width_px);
    json.key("threads").value(c.threads);
    json.end_object();
    json.key("truth").begin_object();
    json.key("method").value(c.truth_method);
    json.key("source").value(find_method(c.truth_method)->source);
    json.key("picture").value(c.truth_picture);
    json.key("time_s").value(c.truth_time_s);
    json.end_object();
    json.key("chart").begin_object();
    json.key("line_width_px");
    if (c.chart_width_px > 0) {
        json.value(c.chart_width_px);
    } else {
        json.null();
    }
    json.end_object();
    json.key("motion").begin_object();
    json.key("frames").value(c.frames);
    json.key("step_px").begin_array().value(1.0 / 32).value(.618 / 32).end_array();
    json.key("crop");
    if (c.frames > 1) {
        write_rect(json, c.frames_crop);
    } else {
        json.null();
    }
    write_numbers(json, "truth_coverage_by_frame", c.truth_frame_coverage);
    json.end_object();
    json.key("metrics").begin_array();
    for (const MetricInfo& info : metric_table()) {
        json.begin_object();
        json.key("key").value(info.key).key("group").value(info.group).key("title").value(info.title);
        json.key("what").value(info.what).key("better").value(word_for(info.better)).key("digits").value(info.digits);
        json.end_object();
    }
    json.end_array();
    json.key("complete").value(c.complete);
    json.key("methods").begin_array();
    for (const MethodResult& result : c.methods) write_method(json, result);
    json.end_array().end_object();
    return json.text();
}

std::string metrics_csv(const Comparison& c) {
    std::string csv = "name,row,drawn,not_drawn,asked_width_px,truth_width_px";
    for (const MetricInfo& info : metric_table()) csv += "," + std::string(info.key);
    csv += "\n";
    for (const MethodResult& result : c.methods) {
        write_csv_row(csv, result, "published", result.published);
        write_csv_row(csv, result, "equal_width", result.equal_width);
    }
    return csv;
}

}  // namespace burin
