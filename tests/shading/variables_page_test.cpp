// docs/shading/variables.md has the table of variables as the code has it. With BURIN_WRITE_DOCS set, this program
// writes that table anew: BURIN_WRITE_DOCS=1 build/release/bin/sheet_test --gtest_filter='VariablesPage.*'

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "shading/sheet/variables.h"

namespace burin {
namespace {

const std::string kPage = std::string(BURIN_SOURCE_FOLDER) + "/docs/shading/variables.md";
const std::string kBegin = "<!-- from variable_table(): begin -->\n", kEnd = "<!-- from variable_table(): end -->\n";

std::string value_of(const VariableRow& row) {
    static constexpr const char* kTypes[] = {"number", "colour", "vector"};
    std::string text = kTypes[static_cast<std::size_t>(row.type)];
    for (const std::string_view part : {row.unit, row.range}) {
        if (!part.empty()) text += ", " + std::string(part);
    }
    return text;
}

std::string table() {
    static constexpr const char* kRates[] = {"frame", "chain", "piece", "place"};
    std::string text = "| name | value | changes with | tier | meaning |\n|---|---|---|---|---|\n";
    for (const VariableRow& row : variable_table()) {
        text += "| `" + std::string(row.name) + "` | " + value_of(row) + " | " +
                kRates[static_cast<std::size_t>(row.rate)] + " | " + std::to_string(static_cast<int>(row.tier)) +
                " | " + std::string(row.meaning) + " |\n";
    }
    return text;
}

std::string page() {
    std::ifstream file(kPage);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(VariablesPage, HasTheTableOfTheCode) {
    std::string text = page();
    std::size_t begin = text.find(kBegin);
    const std::size_t end = text.find(kEnd);
    ASSERT_TRUE(begin != std::string::npos && end != std::string::npos && begin < end) << kPage;
    begin += kBegin.size();
    if (std::getenv("BURIN_WRITE_DOCS") != nullptr) {
        text.replace(begin, end - begin, table());
        std::ofstream(kPage) << text;
        return;
    }
    EXPECT_EQ(text.substr(begin, end - begin), table())
        << "to write the table anew: BURIN_WRITE_DOCS=1 build/release/bin/sheet_test --gtest_filter='VariablesPage.*'";
}

/// What a later version has is not in the table, and the page says that it is not there yet.
TEST(VariablesPage, NamesWhatLaterVersionsKnow) {
    const std::string text = page();
    for (const std::string_view name : names_of_later_versions())
        EXPECT_NE(text.find("`" + std::string(name) + "`"), std::string::npos) << name;
}

}  // namespace
}  // namespace burin
