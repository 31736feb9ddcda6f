#include "cli/completion.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "cli/page.h"
#include "lines/line_class.h"
#include "mesh/model.h"
#include "methods/method_table.h"
#include "output/output_format.h"
#include "scene/method_settings.h"
#include "scene/sheet_library.h"
#include "scene/standard_views.h"

namespace burin {
namespace {

using Words = std::vector<std::string>;

/// What the value of an option may be.
struct Values {
    Words words;
    bool is_list = false;    ///< of words, separated by commas
    std::string files = {};  ///< the line for files
    Words alone = {};        ///< words that stand beside no other in a list
};

template <class Range>
Words words_of(const Range& range) {
    return Words(std::begin(range), std::end(range));
}

template <class Range, class Name>
Words names_in(const Range& range, const Name& name) {
    Words names;
    for (const auto& item : range) {
        if (!std::string(name(item)).empty()) names.emplace_back(name(item));
    }
    return names;
}

Words and_also(Words words, std::initializer_list<const char*> more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// ".obj .ply" as the line ":files obj ply".
std::string files_with(std::string_view suffixes) {
    std::string line = ":files ";
    std::copy_if(suffixes.begin(), suffixes.end(), std::back_inserter(line), [](char c) { return c != '.'; });
    return line;
}

Words paper_names() {
    Words papers;
    for (const char* size : {"A5", "A4", "A3", "A2", "A1", "A0", "letter", "legal"}) {
        papers.emplace_back(size);
        papers.push_back(std::string(size) + "-landscape");
    }
    return papers;
}

Words method_names() {
    return names_in(methods(), [](const Method& m) { return m.name; });
}

Words style_names() {
    return names_in(all_sheets(), [](const SheetSource& s) { return s.name; });
}

Words page_names() {
    return names_in(kPages, [](const Page& p) { return p.name; });
}

/// The inputs of commands.
std::optional<Values> values_of_input(std::string_view command) {
    if (command == "styles") return Values{style_names()};
    if (command == "restyle") return Values{{}, false, ":files lines"};
    if (command == "assemble") return Values{{}, false, ":files exr"};
    return Values{{}, false, files_with(std::string(".toml ") + kModelExtensions)};
}

/// Nothing: a number, or something else that cannot be listed.
std::optional<Values> values_of_option(std::string_view command, std::string_view option) {
    struct Row {
        std::string_view option;
        Values values;
    };
    const Row rows[] = {
        {"--method", {method_names()}},
        {"--methods", {and_also(method_names(), {"svg"}), true}},
        {"--style", {style_names(), false, ":files toml"}},
        {"--page", {page_names()}},
        {"--lines", {words_of(kLineClassNames), true, {}, {"all", "none"}}},
        {"--hidden", {{"none", "solid", "dashed"}}},
        {"--paper", {paper_names()}},
        {"--unit", {{"mm", "cm", "m", "in", "ft"}}},
        {"--views", {words_of(kStandardViewNames), true}},
        {"--projection", {{"first", "third"}}},
        {"--mask", {{"16", "64", "256"}}},
        {"--samples", {{"2", "4", "8"}}},
        {"--operator", {words_of(kGBufferOperatorNames), true}},
        {"--supersample", {{"1", "2", "4", "8"}}},
        {"--bits", {{"8", "16"}}},
        {"--background", {{"transparent"}}},
        {"--dashes", {{"pattern", "real"}}},
        {"--group", {{"class", "object", "qi"}}},
        {"--ids", {{"all", "none"}}},
        {"--find", {{"sheet", "all"}}},
        {"--layers",
         {and_also(
              {"beauty", "lines", "Z", "N", "ids", "coverage", "surface", "lines_hidden", "line", "motion", "crypto"},
              {"CryptoObject", "CryptoMaterial", "CryptoLine", "CryptoLineObject", "CryptoLineSet"}),
          true}},
        {"--channel-names", {{"plain", "blender"}}},
        {"--compression", {{"zip", "zips", "rle", "none"}}},
        {"--blur-samples", {{"auto"}}},
        {"--progress", {{"alf"}}},
        {"--deep", {{}, false, ":files exr"}},
        {"--save-lines", {{}, false, ":files lines"}},
        {"--stats", {{}, false, ":files json"}},
    };
    if (option == "--method" && command == "explain") return Values{{"abuffer", "patel"}};
    if (option == "--output") {
        if (command == "compare") return Values{{}, false, ":folders"};
        return Values{{}, false, command == "assemble" ? ":files exr" : files_with(suffixes_of_formats())};
    }
    const auto* const row =
        std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) { return r.option == option; });
    if (row == std::end(rows)) return std::nullopt;
    return row->values;
}

const CompletedOption* find_option(const CompletedCommand& command, std::string_view name) {
    for (const CompletedOption& option : command.options) {
        if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) return &option;
    }
    return nullptr;
}

bool is_positional(const CompletedOption& option) { return option.names.front().front() != '-'; }

/// Descriptions are short: up to the first semicolon or the first parenthesis.
void add_line(std::string& lines, std::string_view word, std::string_view help) {
    help = help.substr(0, std::min(help.find("; "), help.find(" (")));
    lines.append(word);
    if (!help.empty()) lines.append("\t").append(help);
    lines.append("\n");
}

/// `before` stands in front of the value within the same word: "--lines=".
void add_values(std::string& lines, const Values& values, std::string_view before, std::string_view typed) {
    const std::size_t comma = values.is_list ? typed.rfind(',') : std::string_view::npos;
    const std::string_view done = comma == std::string_view::npos ? "" : typed.substr(0, comma + 1);
    const std::string_view begun = typed.substr(done.size());
    const std::string_view first = done.substr(0, done.find(','));
    if (std::find(values.alone.begin(), values.alone.end(), first) != values.alone.end()) return;
    for (const std::string& word : values.words) {
        if (word == begun && word.ends_with('=')) continue;  // a value is typed
        const bool is_there = ("," + std::string(done)).find("," + word + ",") != std::string::npos;
        if (word.starts_with(begun) && !is_there) add_line(lines, std::string(before).append(done).append(word), "");
    }
    for (const std::string& word : values.alone) {
        if (word.starts_with(typed)) add_line(lines, std::string(before).append(word), "");
    }
    if (!values.files.empty()) lines.append(values.files).append("\n");
}

void add_options(std::string& lines, const CompletedCommand& command, std::string_view typed) {
    for (const CompletedOption& option : command.options) {
        const std::string& name = option.names.back();  // the long one, where there is one
        if (!is_positional(option) && name.starts_with(typed)) add_line(lines, name, option.help);
    }
}

/// The long name of an option whose value stands behind `word`; nothing if none does.
std::optional<std::string> option_with_value(const CompletedCommand& command, const std::string& word) {
    if (!word.starts_with('-') || word.find('=') != std::string::npos) return std::nullopt;
    const CompletedOption* const option = find_option(command, word);
    if (option == nullptr || !option->takes_value) return std::nullopt;
    return option->names.back();
}

/// What the option `name` was given among `words`; nothing if it was not.
std::optional<std::string> value_given(const CompletedCommand& command, std::span<const std::string> words,
                                       std::string_view name) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i].starts_with(std::string(name) + "=")) return words[i].substr(name.size() + 1);
        if (i + 1 < words.size() && option_with_value(command, words[i]) == name) return words[i + 1];
    }
    return std::nullopt;
}

/// Of --set: the parameters of the style sheet that --style names.
Values settings_of(const CompletedCommand& command, std::span<const std::string> before) {
    Values values;
    const auto style = value_given(command, before, "--style");
    if (!style) return values;
    try {
        const auto source = find_sheet(*style, {});
        if (!source) return values;
        for (const SheetParameter& parameter : read_sheet(*source).parameters)
            values.words.push_back("style." + parameter.name + "=");
    } catch (const std::exception&) {  // it is wrong, or not there: the program will say so
        values.words.clear();
    }
    return values;
}

std::optional<Values> values_for(const CompletedCommand& command, std::string_view option,
                                 std::span<const std::string> before) {
    if (option == "--set") return settings_of(command, before);
    return values_of_option(command.name, option);
}

}  // namespace

std::string completions(std::span<const CompletedCommand> commands, std::span<const std::string> words) {
    std::string lines;
    if (words.empty() || commands.empty()) return lines;
    const std::string& typed = words.back();
    const std::span<const std::string> before = words.first(words.size() - 1);

    const CompletedCommand* command = &commands.front();
    for (const std::string& word : before) {
        const auto found = std::find_if(commands.begin() + 1, commands.end(),
                                        [&](const CompletedCommand& c) { return c.name == word; });
        if (found != commands.end()) {
            command = &*found;
            break;
        }
    }
    if (command->name.empty() && !before.empty() && !before.front().starts_with('-')) return lines;  // is refused
    if (!before.empty() && std::find(before.begin(), before.end(), "--") == before.end()) {
        if (const auto option = option_with_value(*command, before.back())) {
            if (const auto values = values_for(*command, *option, before)) add_values(lines, *values, "", typed);
            return lines;
        }
    }
    if (typed.starts_with('-')) {
        const std::size_t equals = typed.find('=');
        if (equals == std::string::npos) {
            add_options(lines, *command, typed);
        } else if (const CompletedOption* const option = find_option(*command, typed.substr(0, equals))) {
            const auto values = values_for(*command, option->names.back(), before);
            if (values) add_values(lines, *values, typed.substr(0, equals + 1), typed.substr(equals + 1));
        }
    } else if (command->name.empty()) {
        for (const CompletedCommand& c : commands.subspan(1)) {
            if (c.name.starts_with(typed)) add_line(lines, c.name, c.help);
        }
    } else if (std::any_of(command->options.begin(), command->options.end(), is_positional)) {
        if (const auto values = values_of_input(command->name)) add_values(lines, *values, "", typed);
    }
    return lines;
}

}  // namespace burin
