#include "scene/sheet_toml.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/mapped_file.h"
#include "scene/lines_toml.h"
#include "scene/parse_toml.h"
#include "scene/set_toml.h"
#include "scene/sheet_tables.h"
#include "scene/sheet_values.h"
#include "scene/style_toml.h"
#include "scene/surfaces_toml.h"
#include "scene/toml_reader.h"
#include "shading/expression/error.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {
namespace {

using Rule = SheetValueRule;

/// Of parameters that have a range, in which it is.
using RangeUnits = std::map<std::string, SheetUnit, std::less<>>;

RangeUnits range_units_of(const toml::table& root) {
    RangeUnits units;
    const toml::table* const parameters = root["parameters"].as_table();
    if (parameters == nullptr) return units;
    for (const auto& [name, node] : *parameters) {
        const toml::node* const value = node.is_table() ? node.as_table()->get("value") : nullptr;
        if (value != nullptr) units.emplace(name.str(), unit_of(*value));
    }
    return units;
}

class SheetReader {
  public:
    SheetReader(TomlReader root, const std::string& name, RangeUnits range_units)
        : root_(std::move(root)), range_units_(std::move(range_units)) {
        sheet_.name = name;
    }

    StyleSheet read() {
        // A table that is not known would be missed below, where it is needed.
        root_.set_top_keys(kSheetKeys);
        for (const std::string_view key : kSheetKeys) root_.node(key);
        for (const std::string_view key : kSheetTables) root_.node(key);
        // Later versions may have keys that this one does not know.
        if (const auto version = root_.integer("style_version", 0, 1000000); version && *version != 1)
            root_.fail("style_version", "is " + std::to_string(*version) + "; this version reads 1");
        root_.finish();
        read_what_is_found();
        if (auto styles = root_.table("style")) {
            sheet_.styles = read_styles(*styles, values_);
            for (const SheetStyle& style : sheet_.styles) names_.emplace(style.name, "a style");
        }
        if (auto t = root_.table("parameters")) read_parameters(*t);
        if (auto t = root_.table("let")) read_lets(*t);
        if (auto t = root_.table("ramp")) read_ramps(*t);
        if (auto t = root_.table("groups")) read_groups(*t);
        sheet_.sets = read_sets(root_, sheet_.styles, values_);
        return std::move(sheet_);
    }

  private:
    void read_what_is_found() {
        sheet_.summary = root_.text("summary").value_or("");
        if (sheet_.summary.size() > 200 || sheet_.summary.find_first_of("\n\r") != std::string::npos)
            root_.fail("summary", "must be one line of at most 200 bytes");
        sheet_.crease_angle_deg = read_crease_angle(root_);
        if (const auto contours = root_.choice("contours", {"mesh", "smooth"})) sheet_.smooth_contours = *contours == 1;
        sheet_.filter = read_pixel_filter(root_);
        sheet_.light = root_.vector("light");
        if (auto surfaces = root_.table("surfaces")) sheet_.surfaces = read_surfaces(*surfaces);
        if (sheet_.light && glm::length(*sheet_.light) < 1e-12)
            root_.fail("light", "must be a direction, such as [-1, 1, 1]");
    }

    /// Checks a name that expressions use. `kind`: "a parameter".
    void take_name(const TomlReader& table, const std::string& name, const char* kind, std::size_t count) {
        if (const auto fault = fault_of_name(name, symbols_))
            table.fail(name, *fault + "; choose another name" + table.hint_for_top_key(name));
        const auto [other, is_new] = names_.emplace(name, kind);
        if (!is_new) table.fail(name, std::string(other->second) + " has this name, too; rename one");
        if (count > kMostSheetNames)
            table.fail(name, "there are more than " + std::to_string(kMostSheetNames) + " of them");
    }

    static void read_range(TomlReader& table, SheetParameter& parameter) {
        const std::string unit = parameter.range_unit == SheetUnit::px ? "px" : suffix_of(parameter.range_unit);
        for (const char* key : {"min", "max"}) {
            if (table.is_text(key)) table.fail(key, "must be a number: it is in the unit of value, " + unit);
        }
        parameter.least = table.number("min", {-1e30, 1e30});
        parameter.most = table.number("max", {-1e30, 1e30});
        if (parameter.least && parameter.most && *parameter.least > *parameter.most)
            table.fail("max", "must not be less than min");
    }

    void read_parameters(TomlReader& t) {
        for (const std::string& name : t.keys()) {
            take_name(t, name, "a parameter", sheet_.parameters.size() + 1);
            SheetParameter parameter;
            parameter.name = name;
            parameter.where = t.position(name);
            Rule rule{Rule::Of::number_or_color, -1e30, 1e30, false, true};
            if (t.is_table(name)) {
                TomlReader table = *t.table(name);
                if (!table.has("value")) table.fail("needs a value");
                parameter.value = values_.value(table, "value", rule);
                const auto of_text = range_units_.find(name);
                const bool is_as_written = of_text == range_units_.end() || TomlReader::is_override(table.position());
                parameter.range_unit = is_as_written ? parameter.value.unit : of_text->second;
                read_range(table, parameter);
                table.finish();
            } else {
                parameter.value = values_.value(t, name, rule);
            }
            if (parameter.value.unit == SheetUnit::world)
                parameter.value.source.fail("a parameter takes no world units; multiply it by 1world where it is used");
            if (const auto fault = fault_of_parameter(parameter)) parameter.value.source.fail(*fault);
            sheet_.parameters.push_back(std::move(parameter));
        }
    }

    void read_lets(TomlReader& t) {
        for (const std::string& name : t.keys()) {
            take_name(t, name, "a let", sheet_.lets.size() + 1);
            if (t.is_number(name)) {
                // A number is an expression, too.
                SheetLet let{name, {}};
                const StyleValue value = values_.value(t, name, {Rule::Of::number, -1e30, 1e30, false, true});
                let.text = value.source;
                let.text.text = text_of(value.number);
                sheet_.lets.push_back(std::move(let));
                continue;
            }
            const auto text = t.text(name);
            if (!text->starts_with('=') && !text->starts_with('#'))
                t.fail(name, "must be a number, a colour, or an expression, which begins with '='");
            sheet_.lets.push_back({name, values_.expression(t, name)});
        }
    }

    void read_ramps(TomlReader& t) {
        for (const std::string& name : t.keys()) {
            take_name(t, name, "a ramp", sheet_.ramps.size() + 1);
            TomlReader table = *t.table(name);
            if (table.has("over"))
                table.fail("over", "stands where the ramp is used: write \"=ramp(\\\"" + name + "\\\", depth)\"");
            SheetUnit unit = SheetUnit::px;
            const Ramp ramp = SheetValueReader::ramp(table, {Rule::Of::number_or_color, -1e30, 1e30}, unit);
            if (unit != SheetUnit::px) table.fail("stops", "the values of a shared ramp have no unit");
            table.finish();
            sheet_.ramps.push_back({name, ramp});
        }
    }

    void read_groups(TomlReader& t) {
        for (const std::string& name : t.keys()) {
            take_name(t, name, "a group", sheet_.groups.size() + 1);
            TomlReader table = *t.table(name);
            if (!table.has("objects") && !table.has("materials"))
                table.fail("needs objects = [\"...\"] or materials = [\"...\"]");
            if (auto globs = read_globs(table, "objects")) sheet_.groups.push_back({name, "object", *std::move(globs)});
            if (auto globs = read_globs(table, "materials"))
                sheet_.groups.push_back({name, "material", *std::move(globs)});
            table.finish();
        }
    }

    TomlReader root_;
    RangeUnits range_units_;
    SheetValueReader values_;
    ExpressionSymbols symbols_ = sheet_variables();
    std::map<std::string, const char*> names_;  ///< and what has them
    StyleSheet sheet_;
};

}  // namespace

StyleSheet read_sheet_text(std::string_view text, const std::string& name, const std::vector<Override>& overrides) {
    toml::table root = parse_checked_toml(text, name, "a style sheet", kMaxSheetBytes, kMaxSheetValues);
    RangeUnits range_units = range_units_of(root);
    for (const Override& o : overrides) apply_sheet_override(root, o);
    return SheetReader(TomlReader(root, "", name, kSheetPage), name, std::move(range_units)).read();
}

StyleSheet read_sheet_file(const std::string& path, const std::vector<Override>& overrides) {
    const MappedFile file(path);
    try {
        StyleSheet sheet = read_sheet_text(file.bytes(), path, overrides);
        sheet.file = path;
        sheet.name = std::filesystem::path(path).stem().string();
        return sheet;
    } catch (const InputError&) {
        file.check_is_whole();
        throw;
    }
}

}  // namespace burin
