#pragma once

#include <cstddef>
#include <string>

namespace burin {

/// An output file that appears under its name only when it is complete.
///
/// The bytes go to a temporary file in the same folder; commit() flushes it to disk and renames it.
/// Without commit() (an error, an interrupt) the temporary file is removed and an older file of
/// the same name stays as it was.
class AtomicFile {
  public:
    /// Throws InputError when the folder is missing or not writable.
    explicit AtomicFile(const std::string& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Where the bytes go until commit(), for libraries that open files themselves.
    const std::string& temporary_path() const { return temporary_path_; }

    /// Writes at the current position; throws InputError when the disk is full or fails.
    void write(const void* data, std::size_t size);
    void seek(std::size_t position);
    std::size_t position() const { return position_; }

    /// Makes the file appear under its name. Throws InputError when that fails.
    void commit();

  private:
    [[noreturn]] void fail(const char* action) const;

    std::string path_;
    std::string temporary_path_;
    int fd_ = -1;
    std::size_t position_ = 0;
    bool committed_ = false;
};

}  // namespace burin
