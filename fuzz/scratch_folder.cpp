#include "fuzz/scratch_folder.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace burin::fuzz {
namespace {

[[noreturn]] void fail(const std::string& path) {
    std::perror(path.c_str());
    std::abort();
}

}  // namespace

ScratchFolder::ScratchFolder() {
    const char* const base = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
    path_ = std::string(base) + "/burin-fuzz-XXXXXX";
    if (::mkdtemp(path_.data()) == nullptr) fail(path_);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string ScratchFolder::write(std::string_view name, std::span<const std::uint8_t> bytes) const {
    const std::string path = path_ + "/" + std::string(name);
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) fail(path);
    const std::size_t written = bytes.empty() ? 0 : std::fwrite(bytes.data(), 1, bytes.size(), file);
    if (std::fclose(file) != 0 || written != bytes.size()) fail(path);
    return path;
}

std::string ScratchFolder::write(std::string_view name, std::string_view text) const {
    return write(name, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace burin::fuzz
