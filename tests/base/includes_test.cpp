#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kSourceFolder = BURIN_SOURCE_FOLDER;
const std::vector<std::string> kProductFolders = {"base",    "image",   "mesh",   "kernels", "view",    "lines",
                                                  "shading", "scene",   "render", "abuffer", "strokes", "output",
                                                  "methods", "compare", "web",    "cli",     "burin"};

// Which header brings which names of the standard library: those that are used often and that other headers do not
// always bring.
const std::map<std::string, std::string> kNames = {
    {"algorithm",
     "all_of any_of none_of clamp copy count_if equal_range fill find find_if lower_bound upper_bound max min "
     "max_element min_element nth_element partition remove_if reverse rotate sort stable_sort transform unique"},
    {"array", "array"},
    {"atomic", "atomic"},
    {"bit", "bit_cast countr_zero popcount"},
    {"charconv", "from_chars to_chars"},
    {"chrono", "chrono"},
    {"cmath",
     "abs atan2 ceil cos exp exp2 floor fma hypot isfinite isnan llround log2 lround pow round sin sqrt tan trunc"},
    {"condition_variable", "condition_variable"},
    {"cstdint", "int32_t int64_t uint16_t uint32_t uint64_t uint8_t"},
    {"cstring", "memchr memcmp memcpy memset strerror strlen"},
    {"deque", "deque"},
    {"exception", "current_exception exception_ptr rethrow_exception"},
    {"filesystem", "filesystem"},
    {"fstream", "ifstream ofstream"},
    {"functional", "function"},
    {"limits", "numeric_limits"},
    {"map", "map multimap"},
    {"memory", "make_shared make_unique shared_ptr unique_ptr weak_ptr"},
    {"mutex", "lock_guard mutex scoped_lock unique_lock"},
    {"numeric", "accumulate iota"},
    {"optional", "nullopt optional"},
    {"set", "set"},
    {"span", "span"},
    {"sstream", "istringstream ostringstream"},
    {"stdexcept", "logic_error runtime_error"},
    {"string", "string to_string"},
    {"string_view", "string_view"},
    {"thread", "thread"},
    {"tuple", "tie tuple"},
    {"unordered_map", "unordered_map"},
    {"variant", "get_if holds_alternative variant visit"},
    {"vector", "vector"},
};

std::string contents_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What a file includes, and what the project's headers that it includes do.
const std::set<std::string>& all_included(const std::string& path) {
    static std::map<std::string, std::set<std::string>> known;
    const auto [place, is_new] = known.try_emplace(path);
    if (!is_new) return place->second;
    static const std::regex kInclude("#include +(?:<([^>]+)>|\"([^\"]+)\")");
    const std::string text = contents_of(kSourceFolder / path);
    for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) {
        const std::string name = (*it)[1].matched ? (*it)[1].str() : (*it)[2].str();
        place->second.insert(name);
        if (!fs::is_regular_file(kSourceFolder / name)) continue;
        const std::set<std::string>& more = all_included(name);
        place->second.insert(more.begin(), more.end());
    }
    return place->second;
}

/// The presets of tests compile several files of a folder as one, where a file finds what the one before it includes.
/// The preset release, which users build, does not.
TEST(Includes, EachFileBringsWhatItUses) {
    std::map<std::string, std::string> header_of;
    for (const auto& [header, names] : kNames) {
        std::istringstream words(names);
        for (std::string name; words >> name;) header_of[name] = header;
    }
    const std::regex no_code("//[^\n]*|\"(?:\\\\.|[^\"\\\\\n])*\""), standard_name("\\bstd::(\\w+)");
    std::size_t files = 0;
    for (const std::string& folder : kProductFolders) {
        for (const auto& entry : fs::recursive_directory_iterator(kSourceFolder / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".cpp" && extension != ".h" && extension != ".hpp") continue;
            ++files;
            const std::string path = fs::relative(entry.path(), kSourceFolder).string();
            const std::string code = std::regex_replace(contents_of(entry.path()), no_code, "");
            std::set<std::string> missing;
            for (std::sregex_iterator it(code.begin(), code.end(), standard_name), end; it != end; ++it) {
                const auto found = header_of.find((*it)[1]);
                if (found != header_of.end() && !all_included(path).contains(found->second))
                    missing.insert("<" + found->second + "> for std::" + found->first);
            }
            for (const std::string& what : missing) ADD_FAILURE() << path << ": include " << what;
        }
    }
    EXPECT_GT(files, 400u);
}

}  // namespace
