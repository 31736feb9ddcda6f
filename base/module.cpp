#include "base/module.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace burin {
namespace {

namespace fs = std::filesystem;

/// Where a module can be: beside the program, or where it was installed.
std::vector<fs::path> candidates(const char* module) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    std::vector<fs::path> paths;
    if (!error) {
        paths.push_back(program.parent_path() / module);
        paths.push_back(program.parent_path().parent_path() / "lib" / "burin" / module);
    }
    paths.emplace_back(module);  // the loader's own search path
    return paths;
}

}  // namespace

void* module_function(const char* module, const char* name, const char* purpose,
                      const char* remedy) {
    void* handle = nullptr;
    for (const fs::path& path : candidates(module)) {
        if (handle == nullptr) handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    }
    void* const function = handle != nullptr ? dlsym(handle, name) : nullptr;
    if (function == nullptr) {
        const char* const reason = dlerror();
        throw InputError("cannot load " + std::string(module) + ", which " + purpose + ": " +
                         (reason != nullptr ? reason : "not found") +
                         "; keep it beside the burin program, or " + remedy);
    }
    return function;
}

}  // namespace burin
