#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace burin {

/// A regular file mapped read-only into memory.
class MappedFile {
  public:
    /// Throws InputError when `path` is missing, not a regular file, empty or unreadable. `stays_open`: for copy(). A process may
    /// have far fewer files open than mapped.
    explicit MappedFile(const std::string& path, bool stays_open = false);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::string_view bytes() const { return {data_, size_}; }

    /// Copies what stands in bytes() from `place` on, of a file that stays open. The first look at each page of bytes() is a page
    /// fault, which takes longer than copying the page on some machines. Throws InputError when it cannot be read (any more); who
    /// looks at bytes() of a file that has become shorter is stopped by the system.
    void copy(std::size_t place, std::span<char> to) const;

  private:
    std::string path_;
    int fd_ = -1;
    const char* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace burin
