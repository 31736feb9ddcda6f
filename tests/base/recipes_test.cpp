// The recipes of CONTRIBUTING.md ("**A method**: ...") name files that are there.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Paths of the project's files in backticks, in the section "Recipes".
std::vector<std::string> paths_in_recipes(std::istream& text) {
    static const std::regex code("`([^`]+)`"),
        path("[A-Za-z0-9_.*-]+(/[A-Za-z0-9_.*-]+)+|[A-Za-z0-9_]+\\.(md|cpp|h|py)");
    std::vector<std::string> paths;
    bool is_recipe = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("## ")) is_recipe = line == "## Recipes";
        if (!is_recipe) continue;
        for (std::sregex_iterator it(line.begin(), line.end(), code), end; it != end; ++it) {
            if (const std::string word = (*it)[1]; std::regex_match(word, path)) paths.push_back(word);
        }
    }
    return paths;
}

/// NAME in a path stands for the name of one that is there already.
bool exists(const fs::path& root, const std::string& path) {
    const std::size_t placeholder = path.find("NAME");
    if (placeholder == std::string::npos) return fs::exists(root / path);
    const fs::path folder = (root / path.substr(0, placeholder + 1)).parent_path();
    const std::string pattern = fs::path(path).filename().string();
    const std::size_t at = pattern.find("NAME");
    if (at == std::string::npos || !fs::is_directory(folder)) return false;
    const std::string before = pattern.substr(0, at), after = pattern.substr(at + 4);
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.size() > before.size() + after.size() && name.starts_with(before) && name.ends_with(after))
            return true;
    }
    return false;
}

TEST(Recipes, NameFilesThatAreThere) {
    std::ifstream file(fs::path(BURIN_SOURCE_FOLDER) / "CONTRIBUTING.md");
    const std::vector<std::string> paths = paths_in_recipes(file);
    EXPECT_GE(paths.size(), 100u);
    for (const std::string& path : paths) EXPECT_TRUE(exists(BURIN_SOURCE_FOLDER, path)) << "CONTRIBUTING.md: " << path;
}

TEST(Recipes, AreLookedAtInBackticksAndWithPlaceholders) {
    std::istringstream text(
        "Other `base/none.h`.\n\n## Recipes\n\n**A thing**: `base/error.h`, `Some::name`, `a b/c`, `README.md`;\n\nand "
        "`methods/NAME.cpp`.\n"
        "\n## More\n\n`base/none.h`\n");
    EXPECT_EQ(paths_in_recipes(text), (std::vector<std::string>{"base/error.h", "README.md", "methods/NAME.cpp"}));
    const fs::path root = BURIN_SOURCE_FOLDER;
    for (const char* there : {"base/error.h", "README.md", "methods/NAME.cpp", "docs/methods/NAME.md", "fuzz/seeds"})
        EXPECT_TRUE(exists(root, there)) << there;
    for (const char* missing :
         {"base/none.h", "NONE.md", "methods/NAME.none", "none/NAME.cpp", "docs/methods/NAME.cpp"})
        EXPECT_FALSE(exists(root, missing)) << missing;
}

}  // namespace
