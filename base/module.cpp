#include "base/module.h"

#include <dlfcn.h>
#include <sys/auxv.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <string>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"

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
};

Module load(const std::string& path) {
    Module module{::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL), {}};
    if (module.handle == nullptr) module.failure = ::dlerror();
    return module;
}

Module find_and_load(const std::string& name) {
    const fs::path folder = own_path().parent_path();
    std::error_code ignored;
    Module module;
    for (const fs::path& candidate :
         {folder / name, folder / "burin" / name, folder / BURIN_MODULES_FROM_PROGRAM / name,
          folder.parent_path() / "lib" / "burin" / name}) {
        if (module.handle == nullptr && fs::exists(candidate, ignored)) module = load(candidate.string());
    }
    if (module.handle == nullptr && module.failure.empty()) module = load(name);  // the loader's own search path
    return module;
}

/// Loads a module. What it needs may be hundreds of libraries, which take a quarter of a second and cannot be
/// interrupted: a thread loads them, which is left to itself where this one is asked to stop.
Module load_unless_interrupted(const std::string& name) {
    constexpr auto kPatience = std::chrono::milliseconds(10);
    throw_if_interrupted();
    std::packaged_task<Module()> task([name] { return find_and_load(name); });
    std::future<Module> loaded = task.get_future();
    std::thread(std::move(task)).detach();
    while (loaded.wait_for(kPatience) != std::future_status::ready) throw_if_interrupted();
    return loaded.get();
}

}  // namespace

void* module_function(const char* module, const char* name, const char* purpose, const char* remedy) {
    const Module loaded = load_unless_interrupted(module);  // what is loaded already is only found again
    void* const function = loaded.handle != nullptr ? ::dlsym(loaded.handle, name) : nullptr;
    if (function == nullptr) {
        throw InputError("cannot load " + std::string(module) + ", which " + purpose + ": " +
                         (loaded.failure.empty() ? std::string("it lacks a function") : loaded.failure) +
                         "; keep it beside the burin program, or " + remedy);
    }
    return function;
}

}  // namespace burin
