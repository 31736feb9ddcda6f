#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "shading/expression/function_table.h"

namespace burin {
namespace {

std::string page() {
    std::ifstream file(std::string(BURIN_SOURCE_FOLDER) + "/docs/shading/expressions.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ExpressionPage, HasARowForEachFunctionAndNoOther) {
    const std::string text = page();
    for (const ExpressionFunction& function : expression_functions())
        EXPECT_NE(text.find("| `" + signature(function) + "` |"), std::string::npos) << signature(function);
    // Rows of two columns; those of the table of errors have three.
    const std::regex row("\n\\| `([a-z_0-9]+)\\([^|]*\\|[^|]*\\|(?=\n)");
    std::size_t rows = 0;
    for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found, ++rows)
        EXPECT_NE(find_function((*found)[1].str()), nullptr) << (*found)[1];
    EXPECT_EQ(rows, expression_functions().size());
}

}  // namespace
}  // namespace burin
