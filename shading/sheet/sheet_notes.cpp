#include "shading/sheet/sheet_notes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "shading/expression/error.h"
#include "shading/expression/glob.h"
#include "shading/expression/unknown_word.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {
namespace {

constexpr const char* kListed = " (burin info lists them)";

const std::vector<std::string>& names_of(const std::string& kind, const SheetContext& context) {
    return kind == "material" ? context.materials : context.objects;
}

/// The name that a pattern is nearly, where there are not so many that looking takes long.
std::string suggested_name(const std::string& pattern, const std::vector<std::string>& names) {
    constexpr std::size_t kMostNames = 20000;
    return names.size() > kMostNames ? "" : suggestion_of(pattern, names);
}

/// Of sheets that come along with the program, groups may be empty: they are offers.
void add_notes_on_empty_groups(const StyleSheet& sheet, const SheetContext& context, std::vector<std::string>& notes) {
    if (sheet.file.empty()) return;
    for (const ExpressionGroup& group : sheet.groups) {
        const std::vector<std::string>& names = names_of(group.kind, context);
        const GlobList globs(group.patterns);
        if (std::any_of(names.begin(), names.end(), [&](const std::string& name) { return globs.takes(name); }))
            continue;
        notes.push_back("group " + group.name + ": no " + group.kind + " of the scene is in it" + kListed);
    }
}

std::string note_on_patterns(const std::string& kind, const std::vector<std::string>& patterns, const StyleSheet& sheet,
                             const SheetContext& context) {
    const std::string note = "no " + kind + " fits its " + kind + "s";
    for (const ExpressionGroup& group : sheet.groups) {
        if (group.kind == kind && is_word_of(patterns, group.name))
            return note + "; " + in_quotes(group.name) + " is a group, which is written select = \"" + kind + " in " +
                   group.name + "\"";
    }
    std::string suggestion;
    for (std::size_t i = 0; i < std::min<std::size_t>(patterns.size(), 8) && suggestion.empty(); ++i)
        suggestion = suggested_name(patterns[i], names_of(kind, context));
    const char* const parts = kind == "object" ? "; parts of a file are called NAME/PART" : "";
    return note + suggestion + parts + kListed;
}

std::string note_on_color(const std::array<float, 3>& color) {
    std::string values;
    bool is_of_bytes = true;
    for (const float part : color) {
        values += (values.empty() ? "" : ", ") + text_of(static_cast<double>(part));
        is_of_bytes = is_of_bytes && part >= 0 && part <= 255 && part == std::floor(part);
    }
    std::string note = "a colour has " + values + ", beyond 1: components are from 0 to 1";
    // 2, 1, 1 is rather light.
    if (is_of_bytes && *std::max_element(color.begin(), color.end()) >= 16) {
        char hex[8];
        std::snprintf(hex, sizeof hex, "#%02x%02x%02x", static_cast<unsigned>(color[0]),
                      static_cast<unsigned>(color[1]), static_cast<unsigned>(color[2]));
        note += "; for 0 to 255 write " + std::string(hex);
    }
    return note;
}

}  // namespace

void add_notes_on(const std::string& whose, const ExpressionRemarks& remarks, const SheetContext& context,
                  std::vector<std::string>& notes) {
    for (const ExpressionRemarks::Name& name : remarks.names)
        notes.push_back(whose + ": no " + name.kind + " fits " + in_quotes(name.pattern) +
                        suggested_name(name.pattern, names_of(name.kind, context)) + kListed);
    for (const auto& color : remarks.colors) notes.push_back(whose + ": " + note_on_color(color));
}

std::vector<std::string> notes_on_sheet(const StyleSheet& sheet, std::span<const CompiledSet> sets,
                                        std::span<const CompiledStyle> styles, const SheetContext& context) {
    std::vector<std::string> notes;
    add_notes_on_empty_groups(sheet, context, notes);
    const auto has_none = [](const std::vector<bool>& taken) {
        return std::find(taken.begin(), taken.end(), true) == taken.end();
    };
    std::vector<bool> draws(styles.size());
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const CompiledSet& set = sets[i];
        if (!set.is_enabled) continue;
        draws[set.style] = true;
        if (set.has_object_globs && has_none(set.objects)) {
            notes.push_back("set " + set.name + ": " +
                            note_on_patterns("object", sheet.sets[i].objects, sheet, context));
        } else if (set.has_material_globs && has_none(set.materials)) {
            notes.push_back("set " + set.name + ": " +
                            note_on_patterns("material", sheet.sets[i].materials, sheet, context));
        }
        add_notes_on("set " + set.name, set.remarks, context, notes);
    }
    for (std::size_t i = 0; i < styles.size(); ++i) {
        if (draws[i]) add_notes_on("style " + styles[i].name, styles[i].remarks, context, notes);
    }
    return notes;
}

}  // namespace burin
