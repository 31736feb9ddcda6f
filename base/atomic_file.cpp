#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace burin {
namespace fs = std::filesystem;

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        throw InputError(path + ": is a folder; give the name of a file to write");
    }
    // A symbolic link stays a link: the file it points to is replaced.
    if (fs::is_symlink(path, ignored)) {
        const fs::path target = fs::weakly_canonical(path, ignored);
        if (!ignored) path_ = target.string();
    }
    if (fs::exists(path_, ignored) && !fs::is_regular_file(path_, ignored)) {
        throw InputError(path + ": is not a regular file; give the name of a file to write");
    }
    const fs::path folder = fs::path(path_).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored)) {
        throw InputError(path + ": cannot write: the folder " + folder.string() +
                         " does not exist; create it first");
    }
    // The extension stays last, because image libraries choose the format by it.
    const fs::path name = fs::path(path_).filename();
    const std::string stem = "." + name.stem().string().substr(0, 100) + ".burin-";
    const std::string extension = name.extension().string();
    for (int attempt = 0; attempt < 100 && fd_ < 0; ++attempt) {
        const std::string unique = std::to_string(::getpid()) + "-" + std::to_string(attempt);
        temporary_path_ = (folder / (stem + unique + extension)).string();
        fd_ = ::open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd_ < 0 && errno != EEXIST) break;
    }
    if (fd_ < 0) {
        const std::string reason = std::strerror(errno);
        throw InputError(path + ": cannot write: " + reason +
                         "; choose another place or change its permissions");
    }
}

AtomicFile::~AtomicFile() {
    if (fd_ >= 0) ::close(fd_);
    if (!committed_) ::unlink(temporary_path_.c_str());
}

void AtomicFile::fail(const char* action) const {
    const std::string reason = std::strerror(errno);
    throw InputError(path_ + ": cannot " + action + ": " + reason +
                     "; nothing was written under this name");
}

void AtomicFile::write(const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = ::pwrite(fd_, bytes, size, static_cast<off_t>(position_));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail("write");
        bytes += written;
        size -= static_cast<std::size_t>(written);
        position_ += static_cast<std::size_t>(written);
    }
}

void AtomicFile::seek(std::size_t position) { position_ = position; }

void AtomicFile::commit() {
    if (::fsync(fd_) != 0) fail("write");
    const int fd = fd_;
    fd_ = -1;
    if (::close(fd) != 0) fail("write");
    if (::rename(temporary_path_.c_str(), path_.c_str()) != 0) fail("rename the finished file");
    committed_ = true;
}

}  // namespace burin
