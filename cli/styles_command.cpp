#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json_writer.h"
#include "cli/commands.h"
#include "mesh/text_scan.h"
#include "scene/parameter_text.h"
#include "scene/sheet_library.h"

namespace burin {
namespace {

/// The sheets that names find. One of the user's that is wrong is named, and left out.
std::vector<StyleSheet> read_all_sheets(bool quiet) {
    std::vector<StyleSheet> sheets;
    for (const SheetSource& source : all_sheets()) {
        try {
            sheets.push_back(read_sheet(source));
        } catch (const InputError& error) {
            if (source.file.empty()) throw;
            if (!quiet)
                std::fprintf(stderr, "burin: note: left out, because %s\n", printable(error.what(), 4000).c_str());
        }
    }
    return sheets;
}

void write_parameter(JsonWriter& json, const SheetParameter& p) {
    json.begin_object();
    json.key("name").value(p.name);
    json.key("value");
    if (p.value.kind == StyleValue::Kind::number && p.value.unit == SheetUnit::px) {
        json.value(p.value.number);
    } else {
        json.value(text_of_parameter(p));
    }
    if (p.least) json.key("min").value(*p.least);
    if (p.most) json.key("max").value(*p.most);
    json.end_object();
}

void print_json(const std::vector<StyleSheet>& sheets) {
    JsonWriter json;
    json.begin_object().key("styles").begin_array();
    for (const StyleSheet& sheet : sheets) {
        json.begin_object();
        json.key("name").value(sheet.name);
        json.key("summary").value(sheet.summary);
        json.key("parameters").begin_array();
        for (const SheetParameter& p : sheet.parameters) write_parameter(json, p);
        json.end_array().end_object();
    }
    json.end_array().end_object();
    std::fputs(json.text().c_str(), stdout);
}

void print_list(const std::vector<StyleSheet>& sheets) {
    for (const StyleSheet& sheet : sheets) {
        std::printf("%-16s %s\n", printable(sheet.name).c_str(), printable(sheet.summary, 400).c_str());
        std::string parameters;
        for (const SheetParameter& p : sheet.parameters)
            parameters += (parameters.empty() ? "" : ", ") + p.name + " = " + text_of_parameter(p);
        if (!parameters.empty()) std::printf("%-16s %s\n", "", parameters.c_str());
    }
}

}  // namespace

void run_styles(const Arguments& a) {
    if (a.style.empty()) {
        const std::vector<StyleSheet> sheets = read_all_sheets(a.quiet);
        a.json ? print_json(sheets) : print_list(sheets);
        return;
    }
    const auto source = find_sheet(a.style, {});
    if (!source) throw UsageError(no_such_sheet(a.style));
    if (a.json) {
        print_json({read_sheet(*source)});
        return;
    }
    const std::string text = text_of_sheet(*source);
    std::fwrite(text.data(), 1, text.size(), stdout);
}

}  // namespace burin
