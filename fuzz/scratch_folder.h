#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace burin::fuzz {

/// A folder in memory that a fuzz target writes its inputs to, because readers take paths. It goes
/// with the process.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::string& path() const { return path_; }

    /// Writes a file of the folder, and returns its path.
    std::string write(std::string_view name, std::span<const std::uint8_t> bytes) const;
    std::string write(std::string_view name, std::string_view text) const;

  private:
    std::string path_;
};

}  // namespace burin::fuzz
