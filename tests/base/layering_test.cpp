#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

// docs/architecture.md: what each folder may include, itself aside.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"base", {}},
    {"image", {"base"}},
    {"mesh", {"base"}},
    {"abuffer", {"base"}},
    {"lines", {"abuffer", "mesh", "base"}},
    {"shading", {"lines", "abuffer", "mesh"}},
    {"scene", {"shading", "lines", "abuffer", "mesh", "image", "base"}},
    {"render", {"scene", "shading", "lines", "abuffer", "mesh", "image", "base"}},
    {"methods", {"render", "scene", "shading", "lines", "abuffer", "mesh", "image", "base"}},
    {"compare",
     {"methods", "render", "scene", "shading", "lines", "abuffer", "mesh", "image", "base"}},
    {"cli",
     {"compare", "methods", "render", "scene", "shading", "lines", "abuffer", "mesh", "image",
      "base"}},
};

// docs/methods/abuffer.md: the same within the method.
const std::map<std::string, std::set<std::string>> kPartsOfTheABuffer = {
    {"screen", {}},
    {"samples", {"screen"}},
    {"layers", {"samples", "screen"}},
    {"fine", {"layers", "samples", "screen"}},
    {"strokes", {"layers", "samples", "screen"}},
};

// A library is used in these source files and nowhere else.
const std::map<std::string, std::set<std::string>> kLibraryFiles = {
    {"OpenEXR/|Imath", {"image/exr_io.cpp", "image/exr_reader.cpp"}},
    {"OpenImageIO/", {"image/oiio_module.cpp"}},
    {"OpenMesh/", {"mesh/subdivide.cpp"}},
    {"nlohmann/", {"mesh/gltf_json.h"}},
    {"meshoptimizer", {"mesh/gltf_meshopt.cpp"}},
    {"draco/", {"mesh/draco_module.cpp"}},
    {"toml\\+\\+/", {"scene/toml_reader.h"}},
    {"CLI/", {"cli/arguments.cpp"}},
    {"embree3/", {"methods/embree_scene.cpp"}},
};

/// `prefix`: of the folders' names in includes.
void expect_order(const std::map<std::string, std::set<std::string>>& may_include, const std::string& prefix) {
    const std::regex include("^#include [\"<]" + prefix + "([a-z_]+)(/|\\.h)[^\">]*[\">]");
    for (const auto& [folder, allowed] : may_include) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(BURIN_SOURCE_FOLDER) / prefix / folder)) {
            std::ifstream file(entry.path());
            std::string line;
            std::smatch match;
            while (std::getline(file, line)) {
                if (!std::regex_search(line, match, include)) continue;
                const std::string used = match[1];
                const bool is_beside_folders = match[2] == ".h" && !prefix.empty();  // and may include all of them
                if (!may_include.contains(used) && !is_beside_folders) continue;     // a library's folder
                EXPECT_TRUE(used == folder || allowed.contains(used)) << entry.path() << ": " << line;
            }
        }
    }
}

TEST(Layering, FoldersIncludeOnlyWhatTheyMay) { expect_order(kMayInclude, ""); }

TEST(Layering, PartsOfTheABufferIncludeOnlyWhatTheyMay) { expect_order(kPartsOfTheABuffer, "methods/abuffer/"); }

TEST(Layering, EachLibraryLivesInOneFile) {
    for (const auto& [pattern, files] : kLibraryFiles) {
        const std::regex include("^#include [\"<](" + pattern + ")");
        for (const auto& [folder, allowed] : kMayInclude) {
            for (const auto& entry : fs::recursive_directory_iterator(fs::path(BURIN_SOURCE_FOLDER) / folder)) {
                const std::string name = folder + "/" + entry.path().filename().string();
                std::ifstream file(entry.path());
                std::string line;
                while (std::getline(file, line)) {
                    EXPECT_TRUE(!std::regex_search(line, include) || files.contains(name)) << name << ": " << line;
                }
            }
        }
    }
}

}  // namespace
