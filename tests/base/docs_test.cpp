// Names in backticks in the docs are those of the code: files, folders, types and functions that exist.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "lines/line_class.h"

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = BURIN_SOURCE_FOLDER;
const std::vector<std::string> kFolders = {"base",  "image",  "mesh",    "kernels", "view",   "lines",   "shading",
                                           "scene", "render", "abuffer", "strokes", "output", "methods", "compare",
                                           "web",   "cli",    "burin",   "bench",   "python", "blender"};

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
}

std::vector<std::string> in_backticks(const std::string& text) {
    static const std::regex code("`([^`\n]+)`");
    std::vector<std::string> words;
    for (std::sregex_iterator it(text.begin(), text.end(), code), end; it != end; ++it) words.push_back((*it)[1]);
    return words;
}

/// The column of files of a folder's README, without what stands in parentheses.
std::vector<std::string> names_in_table(const std::string& readme) {
    static const std::regex row("\\|[^|]*\\|([^|]*)\\|"), parentheses("\\([^()]*\\)");
    std::vector<std::string> names;
    std::istringstream lines(readme);
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, row)) continue;
        for (const std::string& name : in_backticks(std::regex_replace(match[1].str(), parentheses, "")))
            names.push_back(name);
    }
    return names;
}

/// Whether a name in a README is that of a file, with its suffix or without. `gltf_*` is that of all that begin so.
bool is_name_of(const std::string& name, const fs::path& file) {
    const std::string with_suffix = file.filename().string(), stem = file.stem().string();
    if (name.ends_with('*')) return stem.starts_with(name.substr(0, name.size() - 1));
    const std::string last = fs::path(name).filename().string();
    return last == with_suffix || last == stem;
}

bool is_in_folder_named(const std::set<std::string>& names, const fs::path& folder, const fs::path& file) {
    const fs::path below = file.lexically_relative(folder).parent_path();
    return !below.empty() && names.contains(below.begin()->string() + "/");
}

TEST(Docs, ReadmesNameTheFilesOfTheirFolder) {
    for (const std::string& folder : kFolders) {
        const std::vector<std::string> list = names_in_table(text_of(kRoot / folder / "README.md"));
        const std::set<std::string> names(list.begin(), list.end());
        const std::vector<fs::path> files = files_below(kRoot / folder);
        EXPECT_FALSE(names.empty()) << folder;
        for (const std::string& name : names) {
            const bool is_folder = fs::is_directory(kRoot / name) || fs::is_directory(kRoot / folder / name);
            const bool is_file =
                std::any_of(files.begin(), files.end(), [&](const fs::path& file) { return is_name_of(name, file); });
            EXPECT_TRUE(is_folder || is_file) << folder << "/README.md: " << name << " is not there";
        }
        for (const fs::path& file : files) {
            if (file.filename() == "README.md" || file.filename() == "CMakeLists.txt") continue;
            const bool is_named = is_in_folder_named(names, kRoot / folder, file) ||
                                  std::any_of(names.begin(), names.end(),
                                              [&](const std::string& name) { return is_name_of(name, file); });
            EXPECT_TRUE(is_named) << folder << "/README.md does not name " << file;
        }
    }
}

TEST(Docs, ReadmesOfFoldersAreShort) {
    std::vector<std::string> folders = kFolders;
    folders.insert(folders.end(), {"tests", "fuzz", "scripts", "scenes", "styles"});
    for (const std::string& folder : folders) {
        const std::string text = text_of(kRoot / folder / "README.md");
        EXPECT_FALSE(text.empty()) << folder;
        EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 30) << folder;
    }
}

/// README.md, CONTRIBUTING.md, READMEs of folders and the pages of `docs`.
std::vector<fs::path> pages() {
    std::vector<fs::path> pages = {kRoot / "README.md", kRoot / "CONTRIBUTING.md"};
    for (const std::string& folder : kFolders) pages.push_back(kRoot / folder / "README.md");
    for (const fs::path& file : files_below(kRoot / "docs")) {
        if (file.extension() == ".md") pages.push_back(file);
    }
    return pages;
}

TEST(Docs, NamePathsThatAreThere) {
    static const std::regex path("[a-z0-9_-]+(/[a-z0-9_.-]+)+");
    int count = 0;
    for (const fs::path& page : pages()) {
        for (const std::string& name : in_backticks(text_of(page))) {
            if (!std::regex_match(name, path) || name.starts_with("build/")) continue;
            bool is_there = false;
            for (const fs::path& base : {kRoot, page.parent_path()}) {
                for (const char* suffix : {"", ".h", ".cpp", ".inc"}) is_there |= fs::exists(base / (name + suffix));
            }
            EXPECT_TRUE(is_there) << page << ": " << name;
            ++count;
        }
    }
    EXPECT_GT(count, 100);
}

/// All words of the sources and scripts, and the names of files and folders.
std::set<std::string> words_of_the_code() {
    static const std::regex word("[A-Za-z_][A-Za-z0-9_]*");
    std::vector<fs::path> files = files_below(kRoot / "scripts");
    for (const std::string& folder : kFolders) {
        for (const fs::path& file : files_below(kRoot / folder)) files.push_back(file);
    }
    for (const fs::path& file : files_below(kRoot / "tests")) files.push_back(file);
    std::set<std::string> words;
    for (const fs::path& file : files) {
        if (file.extension() == ".md") continue;
        words.insert(file.stem().string());
        words.insert(file.parent_path().filename().string());
        const std::string text = text_of(file);
        std::string name;
        for (const char c : text + ' ') {
            if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
                name += c;
            } else if (!name.empty()) {
                words.insert(name);
                name.clear();
            }
        }
    }
    return words;
}

/// Types, functions and members: `LinePiece`, `decide_line()`, `Film::kBandRows`, `is_plain`; keys of TOML and JSON,
/// too.
bool is_identifier(const std::string& name) {
    static const std::regex identifier("[A-Za-z][A-Za-z0-9_:]*(\\(\\))?");
    static const std::regex of_code(".*([a-z][A-Z]|[a-z]_[a-z]|::|\\(\\)).*");
    return std::regex_match(name, identifier) && std::regex_match(name, of_code);
}

TEST(Docs, NameTypesAndFunctionsThatAreThere) {
    static const std::regex part("[A-Za-z][A-Za-z0-9_]*");
    std::set<std::string> words = words_of_the_code();
    for (const std::string_view name : burin::kLineClassNames)
        words.insert("is_" + std::string(name));  // variables of sheets
    int count = 0;
    for (const fs::path& page : pages()) {
        for (const std::string& name : in_backticks(text_of(page))) {
            if (!is_identifier(name)) continue;
            for (std::sregex_iterator it(name.begin(), name.end(), part), end; it != end; ++it) {
                const auto word = words.lower_bound(it->str());  // or one that begins so
                EXPECT_TRUE(word != words.end() && word->starts_with(it->str())) << page << ": " << name;
                ++count;
            }
        }
    }
    EXPECT_GT(count, 300);
}

TEST(Docs, AreReadAsTheyAreWritten) {
    EXPECT_EQ(names_in_table("| a | `b` (`c`, `d`), `e/`: `f_*` |\n`g`\n| - | `h` | `i` |\n"),
              (std::vector<std::string>{"b", "e/", "f_*"}));
    EXPECT_TRUE(is_name_of("tile_kernels", "kernels/tile_kernels.inc"));
    EXPECT_TRUE(is_name_of("loops/put", "kernels/loops/put.inc"));
    EXPECT_TRUE(is_name_of("gltf_*", "mesh/gltf_pose.cpp"));
    EXPECT_FALSE(is_name_of("gltf", "mesh/gltf_pose.cpp"));
    EXPECT_TRUE(is_in_folder_named({"masks/"}, "abuffer", "abuffer/masks/mask_grid.h"));
    EXPECT_FALSE(is_in_folder_named({"masks/"}, "abuffer", "abuffer/line_finder.h"));
    for (const char* name : {"LinePiece", "decide_line()", "Film::kBandRows", "is_plain", "file()"})
        EXPECT_TRUE(is_identifier(name)) << name;
    for (const char* name : {"mark", "--lines", "a b", "ZIP", "Z_RLE", "lines.width"})
        EXPECT_FALSE(is_identifier(name)) << name;
}

}  // namespace
