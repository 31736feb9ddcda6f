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
    {"kernels", {"base"}},
    {"view", {"base", "image", "mesh", "kernels"}},
    {"lines", {"base", "image", "mesh", "kernels", "view"}},
    {"shading", {"base", "image", "mesh", "kernels", "view", "lines"}},
    {"scene", {"base", "image", "mesh", "kernels", "view", "lines", "shading"}},
    {"render", {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene"}},
    {"strokes", {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render"}},
    {"abuffer", {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render"}},
    {"output", {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render"}},
    {"methods",
     {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render", "strokes", "abuffer",
      "output"}},
    {"compare",
     {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render", "strokes", "abuffer", "output",
      "methods"}},
    {"web",
     {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render", "strokes", "abuffer", "output",
      "methods"}},
    {"cli",
     {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render", "strokes", "abuffer", "output",
      "methods", "compare", "web"}},
    {"burin",
     {"base", "image", "mesh", "kernels", "view", "lines", "shading", "scene", "render", "strokes", "abuffer", "output",
      "methods"}},
};

// docs/methods/abuffer.md: the same within the folder.
const std::map<std::string, std::set<std::string>> kPartsOfTheABuffer = {
    {"masks", {"coverage_mask"}},
    {"screen", {}},
    {"samples", {"screen"}},
    {"edges", {"samples", "screen"}},
    {"hiding", {"edges", "samples", "screen"}},
    {"fine", {"hiding", "edges", "samples", "screen"}},
};

// A library is used in these source files and nowhere else.
const std::map<std::string, std::set<std::string>> kLibraryFiles = {
    {"OpenEXR/|Imath", {"image/exr_chunk_file.cpp", "image/exr_reader.cpp"}},
    {"OpenImageIO/", {"image/oiio_module.cpp"}},
    {"OpenMesh/", {"mesh/subdivide.cpp"}},
    {"nlohmann/", {"mesh/gltf_json.h"}},
    {"meshoptimizer", {"mesh/gltf_meshopt.cpp"}},
    {"draco/", {"mesh/draco_module.cpp"}},
    {"toml\\+\\+/", {"scene/toml_reader.h"}},
    {"CLI/", {"cli/arguments.cpp"}},
    {"boost/", {"web/view_server.cpp"}},
    {"embree3/", {"methods/reference/embree_scene.cpp"}},
    {"pybind11/", {"python/core.cpp"}},
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

TEST(Layering, PartsOfTheABufferIncludeOnlyWhatTheyMay) { expect_order(kPartsOfTheABuffer, "abuffer/"); }

TEST(Layering, EachLibraryLivesInOneFile) {
    for (const auto& [pattern, files] : kLibraryFiles) {
        const std::regex include("^#include [\"<](" + pattern + ")");
        for (const auto& [folder, allowed] : kMayInclude) {
            for (const auto& entry : fs::recursive_directory_iterator(fs::path(BURIN_SOURCE_FOLDER) / folder)) {
                const std::string name = fs::relative(entry.path(), BURIN_SOURCE_FOLDER).string();
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
