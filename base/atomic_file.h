#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/byte_sink.h"

namespace burin {

/// An output file that appears under its name only when it is complete.
///
/// The bytes go to a file without a name where the file system has such (O_TMPFILE), so that
/// nothing is left of it whatever ends the process; else to a temporary file in the same folder.
/// commit() flushes it to disk and gives it its name. Without commit() (an error, an interrupt) an
/// older file of the same name stays as it was. A symbolic link stays a link: what it points to is
/// written, whether it exists or not. A file that is replaced keeps its permissions; one that is
/// read-only is not replaced.
class AtomicFile final : public ByteSink {
  public:
    /// Throws InputError when the folder is missing, it or the file is not writable, or the name cannot be used.
    explicit AtomicFile(const std::string& path);
    ~AtomicFile() override;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Writes at the current position; throws InputError when the disk is full or fails.
    void write(const void* data, std::size_t size) override;
    void seek(std::size_t position) override;
    std::size_t position() const override { return position_; }

    /// Makes the file appear under its name. Throws InputError when that fails.
    void commit();

  private:
    void open_without_name();
    void open_with_temporary_name();
    void give_name();
    [[noreturn]] void fail(const char* action) const;

    std::string path_;            // as it was given
    std::string target_;          // where links lead
    std::string temporary_path_;  // while there is one
    int fd_ = -1;
    std::size_t position_ = 0;
};

/// Fails before the work, not after it: throws what an AtomicFile of this path would throw. Removes
/// temporary files for this path that processes left behind which are dead.
void check_output_file(const std::string& path);

/// Removes temporary files for these paths that processes of this host left behind which are dead. Each folder is read
/// once.
void remove_left_behind(const std::vector<std::string>& paths);

/// Removes the temporary files of this process. May be called by signal handlers and where memory
/// has run out.
void remove_temporary_files() noexcept;

}  // namespace burin
