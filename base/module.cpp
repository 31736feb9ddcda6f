#include "base/module.h"

#include <dlfcn.h>
#include <sys/auxv.h>

#include <filesystem>
#include <string>

#include "base/error.h"

namespace burin {
namespace {

namespace fs = std::filesystem;

/// The program's own path; without /proc it is the path by which the program was started.
fs::path program_path() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) return program;
    const auto* const started_by = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
    return started_by != nullptr ? fs::canonical(started_by, error) : fs::path();
}

/// Where this code is: the program, or the shared library that it is a part of.
fs::path own_path() {
    Dl_info own{}, program{};
    const auto* const headers_of_program = reinterpret_cast<const void*>(::getauxval(AT_PHDR));
    const bool is_known = ::dladdr(reinterpret_cast<const void*>(&program_path), &own) != 0;
    const bool is_of_program = headers_of_program == nullptr || ::dladdr(headers_of_program, &program) == 0 ||
                               own.dli_fbase == program.dli_fbase;
    if (!is_known || is_of_program) return program_path();
    std::error_code error;
    return fs::canonical(own.dli_fname, error);
}

/// A module and, if it cannot be loaded, why.
struct Module {
    void* handle = nullptr;
    std::string failure;

    explicit Module(const char* name) {
        const fs::path folder = own_path().parent_path();
        std::error_code ignored;
        for (const fs::path& candidate :
             {folder / name, folder / "burin" / name, folder / BURIN_MODULES_FROM_PROGRAM / name,
              folder.parent_path() / "lib" / "burin" / name}) {
            if (handle == nullptr && fs::exists(candidate, ignored)) load(candidate.c_str());
        }
        if (handle == nullptr && failure.empty()) load(name);  // the loader's own search path
    }
    void load(const char* path) {
        handle = ::dlopen(path, RTLD_NOW | RTLD_LOCAL);
        if (handle == nullptr) failure = ::dlerror();
    }
};

}  // namespace

void* module_function(const char* module, const char* name, const char* purpose, const char* remedy) {
    const Module loaded(module);  // what is loaded already is only found again
    void* const function = loaded.handle != nullptr ? ::dlsym(loaded.handle, name) : nullptr;
    if (function == nullptr) {
        throw InputError("cannot load " + std::string(module) + ", which " + purpose + ": " +
                         (loaded.failure.empty() ? std::string("it lacks a function") : loaded.failure) +
                         "; keep it beside the burin program, or " + remedy);
    }
    return function;
}

}  // namespace burin
