#include "base/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace burin {

MappedFile::MappedFile(const std::string& path, bool stays_open) : path_(path) {
    // O_NONBLOCK: a named pipe must give an error below instead of waiting for a writer.
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) {
        const std::string reason = std::strerror(errno);
        throw InputError(path + ": cannot open: " + reason + "; check the path and its permissions");
    }
    struct stat info {};
    if (::fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        ::close(fd);
        throw InputError(path + ": not a regular file; give the path of a file");
    }
    size_ = static_cast<std::size_t>(info.st_size);
    if (size_ == 0) {
        ::close(fd);
        throw InputError(path + ": the file is empty; was it written completely?");
    }
    void* address = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd, 0);
    if (address == MAP_FAILED) {
        const int error = errno;
        ::close(fd);
        throw InputError(path + ": cannot read: " + std::strerror(error));
    }
    ::madvise(address, size_, MADV_SEQUENTIAL);
    data_ = static_cast<const char*>(address);
    if (stays_open) {
        fd_ = fd;
    } else {
        ::close(fd);
    }
}

MappedFile::~MappedFile() {
    ::munmap(const_cast<char*>(data_), size_);
    if (fd_ >= 0) ::close(fd_);
}

void MappedFile::copy(std::size_t place, std::span<char> to) const {
    while (!to.empty()) {
        const ssize_t count = ::pread(fd_, to.data(), to.size(), static_cast<off_t>(place));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            throw InputError(path_ + ": cannot read: " + (count < 0 ? std::strerror(errno) : "the file has become shorter"));
        }
        place += static_cast<std::size_t>(count);
        to = to.subspan(static_cast<std::size_t>(count));
    }
}

}  // namespace burin
