#include "compare/report.h"

#include <cstdint>

#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/json_writer.h"
#include "base/mapped_file.h"
#include "compare/metrics_files.h"
#include "compare/report_page.h"

namespace burin {
namespace {

void write_text(const std::string& path, const std::string& text) {
    AtomicFile file(path);
    file.write(text.data(), text.size());
    throw_if_interrupted();
    file.commit();
}

/// JSON may stand in a page's script when nothing in it looks like a tag.
std::string within_script(const std::string& json) {
    std::string result;
    for (const char c : json) {
        if (c == '<') {
            result += "\\u003c";
        } else {
            result += c;
        }
    }
    return result;
}

void add_picture(JsonWriter& json, const std::string& folder, const std::string& name) {
    if (name.empty()) return;
    const MappedFile file(folder + "/" + name);
    json.key(name).value("data:image/png;base64," + base64(file.bytes()));
}

std::string pictures_json(const Comparison& comparison, const std::string& folder) {
    JsonWriter json;
    json.begin_object();
    add_picture(json, folder, comparison.truth_picture);
    for (const MethodResult& result : comparison.methods) {
        add_picture(json, folder, result.picture);
        add_picture(json, folder, result.difference);
    }
    json.end_object();
    return json.text();
}

/// The text up to a mark; `rest` becomes what follows it.
std::string_view before(std::string_view mark, std::string_view& rest) {
    const std::size_t at = rest.find(mark);
    const std::string_view part = rest.substr(0, at);
    rest.remove_prefix(at + mark.size());
    return part;
}

}  // namespace

std::string base64(std::string_view bytes) {
    static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

void write_metrics(const Comparison& comparison, const std::string& folder) {
    write_text(folder + "/metrics.json", metrics_json(comparison));
    write_text(folder + "/metrics.csv", metrics_csv(comparison));
}

void write_report(const Comparison& comparison, const std::string& folder) {
    std::string_view rest = report_text();
    std::string page;
    page += before("{{style}}", rest);
    page += report_style();
    page += before("{{data}}", rest);
    page += within_script(metrics_json(comparison));
    page += before("{{pictures}}", rest);
    page += pictures_json(comparison, folder);
    page += before("{{script}}", rest);
    page += report_script();
    page += rest;
    write_text(folder + "/report.html", page);
}

}  // namespace burin
