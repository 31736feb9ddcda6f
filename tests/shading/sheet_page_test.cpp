// docs/shading/sheets.md names keys that sheets have, with defaults that they take, and the messages of errors.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "scene/sheet_toml.h"
#include "shading/ink/stroke_values.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {
namespace {

/// A section of the page, from its heading to the next one.
std::string section(const std::string& heading) {
    std::ifstream file(std::string(BURIN_SOURCE_FOLDER) + "/docs/shading/sheets.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t begin = text.find("\n## " + heading + "\n"), end = text.find("\n## ", begin + 1);
    return begin == std::string::npos ? "" : text.substr(begin, end - begin);
}

struct Row {
    std::string first, second;
};

/// The first two columns of the rows of a section's tables, but for their heads.
std::vector<Row> rows_of(const std::string& text) {
    static const std::regex row("\n\\| (`[^|]*`[^|]*) \\| ([^|]*) \\|");
    std::vector<Row> rows;
    for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at)
        rows.push_back({(*at)[1], (*at)[2]});
    return rows;
}

std::vector<std::string> in_backticks(const std::string& text) {
    static const std::regex code("`([^`]+)`");
    std::vector<std::string> words;
    for (std::sregex_iterator at(text.begin(), text.end(), code), end; at != end; ++at) words.push_back((*at)[1]);
    return words;
}

std::string error_of(const std::string& text) {
    try {
        const CompiledSheet compiled(read_sheet_text(text, "s.toml"), {});
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

const std::string kSet = "[[set]]\nname = \"a\"\nclasses = [\"crease\"]\nstyle = \"ink\"\n", kStyle = "[style.ink]\n";

TEST(SheetPage, KeysOfStylesAreKnownAndTakeTheirDefaults) {
    std::size_t count = 0;
    for (const Row& row : rows_of(section("Styles"))) {
        for (const std::string& key : in_backticks(row.first)) {
            ++count;
            EXPECT_EQ(error_of(kSet + kStyle + key + " = [{}]").find("unknown key"), std::string::npos) << key;
        }
        if (in_backticks(row.first).size() > 1 || row.second == "none") continue;
        const std::vector<std::string> texts = in_backticks(row.second);
        const std::string value = texts.empty() ? row.second : texts.front();
        EXPECT_EQ(error_of(kSet + kStyle + in_backticks(row.first).front() + " = " + value), "") << row.first;
    }
    EXPECT_EQ(count, 23u);
}

/// Whether a text names a key, or the table that it is in: "taper" of "taper.start".
bool names(const std::string& text, std::string_view key) {
    return text.find("`" + std::string(key.substr(0, key.find('.'))) + "`") != std::string::npos;
}

std::string line_with(const std::string& page, const std::string& words) {
    std::ifstream file(std::string(BURIN_SOURCE_FOLDER) + "/docs/shading/" + page);
    for (std::string line; std::getline(file, line);) {
        if (line.find(words) != std::string::npos) return line;
    }
    return {};
}

TEST(SheetPage, SentencesOnValuesOfChainsNameAll) {
    for (const std::string& line : {line_with("sheets.md", "which are the same along a line"),
                                    line_with("variables.md", "change along a chain")}) {
        for (std::size_t k = 0; k < kChainValueCount; ++k) {
            const std::string_view key = key_of(static_cast<ChainValue>(k));
            EXPECT_TRUE(names(line, key)) << key << ": " << line;
        }
    }
}

TEST(SheetPage, KeysOfSetsAndSheetsAreKnown) {
    std::size_t count = 0;
    for (const Row& row : rows_of(section("Line sets"))) {
        for (const std::string& key : in_backticks(row.first)) {
            ++count;
            const std::string set = kSet.find("\n" + key + " = ") != std::string::npos ? "" : key + " = [{}]\n";
            EXPECT_EQ(error_of(kSet + set + kStyle).find("unknown key"), std::string::npos) << key;
        }
    }
    for (const Row& row : rows_of(section("The sheet"))) {
        const std::string key = in_backticks(row.first).front();
        if (key.starts_with('[')) continue;
        ++count;
        EXPECT_EQ(error_of(key + " = [{}]\n" + kSet + kStyle).find("unknown key"), std::string::npos) << key;
    }
    EXPECT_EQ(count, 17u);
}

TEST(SheetPage, MessagesOfStylesAreThoseOfTheProgram) {
    std::size_t count = 0;
    for (const Row& row : rows_of(section("Errors"))) {
        const std::string line = in_backticks(row.first).front(), message = in_backticks(row.second).front();
        if (!message.starts_with("[style.ink]")) continue;
        ++count;
        const std::string error = error_of(kSet + kStyle + line);
        EXPECT_TRUE(error.ends_with(": " + message)) << error << "\n" << message;
    }
    EXPECT_EQ(count, 9u);
}

}  // namespace
}  // namespace burin
