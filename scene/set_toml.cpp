#include "scene/set_toml.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/interrupt.h"
#include "shading/expression/error.h"
#include "shading/expression/glob.h"
#include "shading/expression/unknown_word.h"
#include "shading/sheet/variables.h"

namespace burin {
namespace {

LineClassSet read_set_classes(TomlReader& t) {
    if (t.node("classes") == nullptr) t.fail("needs classes = [\"silhouette\", ...]: only these are looked for");
    const std::vector<std::string> names = *t.texts("classes");
    if (names.empty()) t.fail("classes", "must name at least one line class");
    const auto later = classes_of_later_versions();
    std::vector<std::string> known(kLineClassNames.begin(), kLineClassNames.end());
    LineClassSet classes;
    for (const std::string& name : names) {
        if (const auto line_class = line_class_named(name)) {
            classes |= *line_class;
        } else if (std::find(later.begin(), later.end(), name) != later.end()) {
            t.fail("classes", "the class " + in_quotes(name) + " is not in this version");
        } else {
            t.fail("classes", "unknown line class " + in_quotes(name) + suggestion_of(name, known) + "; known are " +
                                  to_string(LineClassSet::all()));
        }
    }
    return classes;
}

std::array<int, 2> read_qi(TomlReader& t) {
    if (t.node("qi") == nullptr) return {0, 0};
    if (!t.node("qi")->is_array()) {
        const int only = *t.integer("qi", 0, 255);
        return {only, only};
    }
    const std::vector<double> range = *t.numbers("qi", 2);
    std::array<int, 2> qi{};
    for (std::size_t k = 0; k < 2; ++k) {
        if (!(range[k] >= 0 && range[k] <= 255) || range[k] != static_cast<double>(static_cast<int>(range[k])))
            t.fail("qi", "must be a whole number from 0 to 255, or two, from and to");
        qi[k] = static_cast<int>(range[k]);
    }
    if (qi[0] > qi[1]) t.fail("qi", "must have the smaller number first");
    return qi;
}

/// The name of a layer of the set's own; empty: none.
std::string read_layer(TomlReader& t, const std::string& set_name) {
    if (t.node("layer") == nullptr) return {};
    std::string name = set_name;
    if (t.is_text("layer")) {
        name = *t.text("layer");
    } else if (!t.node("layer")->is_boolean()) {
        t.fail("layer", "must be true, or a name in quotes");
    } else if (!*t.boolean("layer")) {
        return {};
    }
    if (!is_sheet_word(name))
        t.fail("layer", "the name of a layer has letters, digits, _ and - only, not " + in_quotes(name));
    if (name == "hidden") t.fail("layer", "lines_hidden is a layer of its own already; choose another name");
    return name;
}

class SetReader {
  public:
    SetReader(const std::vector<SheetStyle>& styles, SheetValueReader& values) : styles_(styles), values_(values) {
        for (const SheetStyle& style : styles) style_names_.push_back(style.name);
    }

    LineSet read(TomlReader& t) {
        LineSet set;
        set.where = t.position();
        const auto name = t.text("name");
        if (!name || name->empty()) t.fail("needs a name");
        if (!names_.insert(*name).second) t.fail("name", "two sets have this name; rename one");
        set.name = *name;
        set.classes = read_set_classes(t);
        set.qi = read_qi(t);
        if (t.node("select") != nullptr) set.select = values_.expression(t, "select");
        set.objects = read_globs(t, "objects").value_or(std::vector<std::string>{});
        set.materials = read_globs(t, "materials").value_or(std::vector<std::string>{});
        set.style = read_style(t);
        if (t.node("test") != nullptr) set.test = SheetValueReader::word(t, "test");
        set.also = t.boolean("also").value_or(false);
        set.is_enabled = t.boolean("enabled").value_or(true);
        set.layer = read_layer(t, set.name);
        if (!set.layer.empty() && !layers_.insert(set.layer).second)
            t.fail("layer", "two sets have this layer; rename one");
        if (t.has("priority")) t.fail("priority", "is a key of styles; sets are asked in the order of the sheet");
        t.finish();
        return set;
    }

  private:
    std::size_t read_style(TomlReader& t) {
        const auto style = t.text("style");
        if (!style) t.fail("needs a style = \"NAME\", one of the tables [style.NAME]");
        const auto place = std::find(style_names_.begin(), style_names_.end(), *style);
        if (place == style_names_.end())
            t.fail("style", "there is no style " + in_quotes(*style) + suggestion_of(*style, style_names_));
        return static_cast<std::size_t>(place - style_names_.begin());
    }

    const std::vector<SheetStyle>& styles_;
    SheetValueReader& values_;
    std::vector<std::string> style_names_;
    std::set<std::string> names_, layers_;
};

}  // namespace

std::vector<LineSet> read_sets(TomlReader& root, const std::vector<SheetStyle>& styles, SheetValueReader& values) {
    std::vector<TomlReader> tables = root.tables("set");
    if (tables.empty()) root.fail("the sheet has no [[set]]; add one with name, classes and style");
    if (tables.size() > kMostSheetSets)
        root.fail("set", "the sheet has more than " + std::to_string(kMostSheetSets) + " sets");
    SetReader reader(styles, values);
    std::vector<LineSet> sets;
    for (TomlReader& table : tables) sets.push_back(reader.read(table));
    return sets;
}

std::optional<std::vector<std::string>> read_globs(TomlReader& table, std::string_view key) {
    auto globs = table.texts(key);
    if (!globs) return globs;
    if (globs->empty()) table.fail(key, "must have at least one pattern, such as \"wheel*\"");
    if (globs->size() > kMostPlainNames) table.fail(key, "has more than " + std::to_string(kMostPlainNames) + " names");
    if (globs->size() > kMostGlobs && !are_plain_names(*globs))
        table.fail(key, "has more than " + std::to_string(kMostGlobs) +
                            " entries, which is possible for names alone, without '*', '?' and '!'");
    for (const std::string& glob : *globs) {
        if (glob.empty() || glob == "!") table.fail(key, "has an empty pattern");
        if (glob.size() > 1000) table.fail(key, "has a pattern of more than 1000 bytes");
    }
    return globs;
}

}  // namespace burin
