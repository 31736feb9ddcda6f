#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

// Readers see a file as bytes in memory, and learn of it if another program cuts the file meanwhile.

namespace burin {

/// Knows how long a file was.
class FileLength {
  public:
    explicit FileLength(const std::string& path);

    /// Throws InputError if the file has become shorter since: what was read of it in the meantime may be zeros.
    void check() const;

  private:
    std::string path_;
    dev_t device_ = 0;
    ino_t inode_ = 0;
    off_t size_ = 0;
};

/// A regular file mapped read-only into memory.
class MappedFile {
  public:
    /// Throws InputError when `path` is missing, not a regular file, empty or unreadable. `stays_open`: for copy(). A
    /// process may have far fewer files open than mapped.
    explicit MappedFile(const std::string& path, bool stays_open = false);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    const std::string& path() const { return path_; }
    std::string_view bytes() const { return {data_, size_}; }

    /// Copies what stands in bytes() from `place` on, of a file that stays open. The first look at each page of bytes()
    /// is a page fault, which takes longer than copying the page on some machines. Throws InputError when it cannot be
    /// read (any more); who looks at bytes() of a file that has become shorter gets zeros up to the end of its last
    /// page, and SIGBUS behind that.
    void copy(std::size_t place, std::span<char> to) const;

    /// Throws InputError if the file has become shorter since, as FileLength does.
    void check_is_whole() const { length_.check(); }

    /// From now on the process ends with exit status 1 and a message that names the file, instead of a signal, when it
    /// looks at bytes() that a file no longer has. For programs: a library leaves signals alone.
    static void end_process_where_files_are_cut();

  private:
    static void on_bus_error(int signal_number, void* info);

    std::string path_;
    int fd_ = -1;
    const char* data_ = nullptr;
    std::size_t size_ = 0;
    FileLength length_;
    // A list of all files that are mapped, for the signal handler.
    MappedFile* next_ = nullptr;
    MappedFile* previous_ = nullptr;
};

}  // namespace burin
