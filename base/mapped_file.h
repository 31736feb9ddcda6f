#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace burin {

/// A regular file mapped read-only into memory.
class MappedFile {
  public:
    /// Throws InputError when `path` is missing, not a regular file, empty or unreadable.
    explicit MappedFile(const std::string& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::string_view bytes() const { return {data_, size_}; }

  private:
    const char* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace burin
