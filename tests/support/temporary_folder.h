#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace burin::test {

/// A folder that exists as long as this object.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::string& path() const { return path_; }
    /// Path of a file in it.
    std::string file(const std::string& name) const { return path_ + "/" + name; }
    /// Writes a file in it and returns its path.
    std::string write(const std::string& name, std::string_view content) const;
    /// Names of all files in it, sorted.
    std::vector<std::string> names() const;

  private:
    std::string path_;
};

std::string read_file(const std::string& path);

}  // namespace burin::test
