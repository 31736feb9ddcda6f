// Lists that are written by hand, where no code reads the one of the code, have all that this one has.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/murmur_hash.h"
#include "burin/burin.h"
#include "lines/line_class.h"
#include "methods/feature_edges.h"
#include "output/output_format.h"

namespace burin::written_lists_test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = BURIN_SOURCE_FOLDER;

std::string text_of(const fs::path& path) {
    std::ifstream file(kRoot / path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What stands in a file behind `begin` and before the next `end`; nothing if it has no `begin`.
std::string part_of(const fs::path& path, const std::string& begin, const std::string& end) {
    const std::string text = text_of(path);
    const std::size_t from = text.find(begin);
    if (from == std::string::npos) return {};
    return text.substr(from + begin.size(), text.find(end, from + begin.size()) - from - begin.size());
}

std::vector<std::string> words_in(const std::string& text) {
    std::vector<std::string> words(1);
    for (const char c : text) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    return words;
}

/// The classes that a text names, in its order, each once.
std::vector<std::string> classes_in(const std::string& text) {
    std::vector<std::string> classes;
    for (const std::string& word : words_in(text)) {
        if (line_class_named(word) && std::find(classes.begin(), classes.end(), word) == classes.end())
            classes.push_back(word);
    }
    return classes;
}

std::vector<std::string> names_of(LineClassSet classes) {
    std::vector<std::string> names;
    for (int c = 0; c < kLineClassCount; ++c) {
        if (classes.has(static_cast<LineClass>(c))) names.emplace_back(name_of(static_cast<LineClass>(c)));
    }
    return names;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return names;
}

struct WrittenList {
    const char *file, *begin, *end;
};

TEST(WrittenLists, OfBitsHaveAllLineClassesInTheirOrder) {
    for (const WrittenList& list :
         {WrittenList{"docs/conventions.md", "| class | a line where |", "\n- "},
          WrittenList{"docs/shading/lines-files.md", "the lowest first:", "|"},
          WrittenList{"python/notebooks/lines_as_arrays.ipynb", "names = [", "]"},
          WrittenList{"blender/burin_blender/panel_look.py", "LINE_CLASSES = (", ")"},
          WrittenList{"burin/burin.h", "of those that the scene draws (\"lines.draw\"), as bits:", ";"}}) {
        std::vector<std::string> found;
        // Of a table only the first column, of text all words.
        std::istringstream rows(part_of(list.file, list.begin, list.end));
        for (std::string row; std::getline(rows, row);)
            for (const std::string& name : classes_in(row.starts_with("| `") ? row.substr(0, row.find('|', 1)) : row))
                found.push_back(name);
        EXPECT_EQ(found, names_of(LineClassSet::all())) << list.file;
    }
}

TEST(WrittenLists, HaveAllLineClasses) {
    for (const WrittenList& list : {WrittenList{"docs/shading/variables.md", "## Sides", "\nA mark"},
                                    WrittenList{"blender/burin_blender/properties.py", "LINE_TYPES = (", "\n)"},
                                    WrittenList{"tests/cli/deep_reader_test.py", "CLASSES = [", "]"}}) {
        std::string text = part_of(list.file, list.begin, list.end);
        static const std::regex upper("\"([A-Z]+)\", *\"[^\"]*\", *\"[^\"]*\"");  // a value, its label and a tooltip
        text = std::regex_replace(text, upper, "$1");
        EXPECT_EQ(sorted(classes_in(text)), sorted(names_of(LineClassSet::all()))) << list.file;
    }
}

TEST(WrittenLists, OfMethodsThatDrawEdgesHaveTheirClasses) {
    for (const WrittenList& list :
         {WrittenList{"docs/methods/simple.md", "**Which edges**", "\n"},
          WrittenList{"docs/methods/single-pass.md", "A line is drawn along a mesh edge of a [class]", "\n"}}) {
        static const std::regex code("`([^`]*)`");
        const std::string text = part_of(list.file, list.begin, list.end);
        std::string names;
        for (std::sregex_iterator at(text.begin(), text.end(), code), end; at != end; ++at)
            names += (*at)[1].str() + " ";
        EXPECT_EQ(sorted(classes_in(names)), sorted(names_of(kEdgeClasses))) << list.file;
    }
}

TEST(WrittenLists, OfNumbersInDeepFilesHaveAllLineClasses) {
    const std::string table = part_of("docs/pipeline/deep.md", "| class | `lineid` |", "\n\n");
    for (const std::string_view name : kLineClassNames)
        EXPECT_NE(table.find("`" + std::string(name) + "` | " + std::to_string(murmur_hash(name)) + " |"),
                  std::string::npos)
            << name << " " << murmur_hash(name);
}

/// The add-on offers all line classes, so it needs a library that has them.
TEST(WrittenLists, TheAddOnNeedsALibraryThatHasTheLineClasses) {
    constexpr int kAbiThatHasThem = 1;
    static_assert(kLineClassCount == 8, "the number above is the BURIN_ABI of the new class");
    const int needed = std::stoi("0" + part_of("blender/burin_blender/library.py", "NEEDED_ABI = ", " "));
    EXPECT_GE(needed, kAbiThatHasThem);
    EXPECT_LE(needed, BURIN_ABI);
}

std::set<std::string> vector_formats() {
    std::set<std::string> formats;
    for (const NamedFormat& f : kNamedFormats) {
        if (is_vector(f.format)) formats.insert(std::string(f.name));
    }
    return formats;
}

/// The vector formats that a line leaves out though it names three: what says something of one or two is no list.
std::set<std::string> left_out_in(const std::string& line, std::set<std::string> formats) {
    std::size_t named = 0;
    for (const std::string& word : words_in(line)) named += formats.erase(word);
    return named >= 3 ? formats : std::set<std::string>();
}

TEST(WrittenLists, HaveAllVectorFormats) {
    static const std::set<std::string> kSuffixes = {".md", ".h", ".hpp", ".cpp", ".py", ".js", ".html", ".toml", ""};
    const std::set<std::string> formats = vector_formats();
    std::size_t lists = 0;
    for (const char* const place : {"README.md", "docs", "debian/control", "burin", "blender", "cli", "output",
                                    "python", "scene", "tests", "web"}) {
        std::vector<fs::path> files;
        if (fs::is_directory(kRoot / place)) {
            for (const auto& entry : fs::recursive_directory_iterator(kRoot / place)) {
                // Decisions say what was true when they were made.
                if (entry.is_regular_file() && kSuffixes.contains(entry.path().extension().string()) &&
                    entry.path().parent_path().filename() != "decisions")
                    files.push_back(entry.path());
            }
        } else {
            files.push_back(kRoot / place);
        }
        for (const fs::path& file : files) {
            std::istringstream text(text_of(file));
            int number = 0;
            for (std::string line; std::getline(text, line);) {
                ++number;
                for (const std::string& format : left_out_in(line, formats))
                    ADD_FAILURE() << file.string() << ":" << number << " leaves out " << format << ": " << line;
                std::set<std::string> rest = formats;
                for (const std::string& word : words_in(line)) rest.erase(word);
                lists += rest.empty() ? 1 : 0;
            }
        }
    }
    EXPECT_GT(lists, 10u);
}

TEST(WrittenLists, AreReadAsTheyAreWritten) {
    EXPECT_EQ(classes_in("| `mark` | a Border |\nsilhouettes, mark"), (std::vector<std::string>{"mark", "border"}));
    EXPECT_EQ(part_of("lines/line_class.h", "#pragma ", "\n"), "once");
    EXPECT_EQ(part_of("lines/line_class.h", "#pragma none", "\n"), "");
    EXPECT_EQ(left_out_in("a.one, TWO and (three)", {"one", "two", "three", "four"}), std::set<std::string>{"four"});
    EXPECT_TRUE(left_out_in("ONE and TWO", {"one", "two", "three", "four"}).empty());
}

}  // namespace
}  // namespace burin::written_lists_test
