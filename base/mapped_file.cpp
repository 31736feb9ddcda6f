#include "base/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>

#include "base/atomic_file.h"
#include "base/error.h"

namespace burin {
namespace {

constexpr const char* kCut =
    ": cannot read: the file has become shorter while it was read; is another program writing it?";

// A signal handler can reach nothing but globals. A lock that spins may be taken in it: who holds it reads no mapped
// file.
std::atomic_flag g_lock = ATOMIC_FLAG_INIT;
MappedFile* g_first = nullptr;

class SpinLock {
  public:
    SpinLock() {
        while (g_lock.test_and_set(std::memory_order_acquire)) {
        }
    }
    ~SpinLock() { g_lock.clear(std::memory_order_release); }
    SpinLock(const SpinLock&) = delete;
    SpinLock& operator=(const SpinLock&) = delete;
};

/// Writes to standard error what main() would print of an InputError.
void write_message(const char* path) {
    char message[4400];
    std::size_t size = 0;
    const auto add = [&](const char* text, std::size_t most) {
        for (; *text != '\0' && most > 0; ++text, --most) {
            message[size++] = static_cast<unsigned char>(*text) < 0x20 || *text == 0x7F ? '?' : *text;
        }
    };
    add(path, 4000);
    add(kCut, 300);
    message[size++] = '\n';
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message, size);
}

}  // namespace

FileLength::FileLength(const std::string& path) : path_(path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0) return;
    device_ = info.st_dev;
    inode_ = info.st_ino;
    size_ = info.st_size;
}

void FileLength::check() const {
    const FileLength now(path_);
    // Another file of this name may stand in its place by now. Who has opened the old one still has it.
    if (now.device_ == device_ && now.inode_ == inode_ && now.size_ < size_) throw InputError(path_ + kCut);
}

MappedFile::MappedFile(const std::string& path, bool stays_open) : path_(path), length_(path) {
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
    const SpinLock lock;
    next_ = g_first;
    if (next_ != nullptr) next_->previous_ = this;
    g_first = this;
}

MappedFile::~MappedFile() {
    {
        const SpinLock lock;
        (previous_ != nullptr ? previous_->next_ : g_first) = next_;
        if (next_ != nullptr) next_->previous_ = previous_;
    }
    ::munmap(const_cast<char*>(data_), size_);
    if (fd_ >= 0) ::close(fd_);
}

void MappedFile::copy(std::size_t place, std::span<char> to) const {
    while (!to.empty()) {
        const ssize_t count = ::pread(fd_, to.data(), to.size(), static_cast<off_t>(place));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            if (count == 0) throw InputError(path_ + kCut);
            throw InputError(path_ + ": cannot read: " + std::strerror(errno));
        }
        place += static_cast<std::size_t>(count);
        to = to.subspan(static_cast<std::size_t>(count));
    }
}

void MappedFile::on_bus_error(int signal_number, void* info) {
    const char* const place = static_cast<const char*>(static_cast<const siginfo_t*>(info)->si_addr);
    {
        const SpinLock lock;
        for (const MappedFile* file = g_first; file != nullptr; file = file->next_) {
            constexpr std::size_t kPage = 4096;  // at least; the last one is mapped as a whole
            const std::size_t mapped = (file->size_ + kPage - 1) / kPage * kPage;
            if (std::less<>()(place, file->data_) || std::less_equal<>()(file->data_ + mapped, place)) continue;
            write_message(file->path_.c_str());
            remove_temporary_files();
            ::_exit(1);
        }
    }
    // The signal has another cause, which ends the process once this returns.
    std::signal(signal_number, SIG_DFL);
    ::raise(signal_number);
}

void MappedFile::end_process_where_files_are_cut() {
    struct sigaction action {};
    action.sa_sigaction = [](int signal_number, siginfo_t* info, void*) { on_bus_error(signal_number, info); };
    action.sa_flags = SA_SIGINFO;
    sigemptyset(&action.sa_mask);
    sigaction(SIGBUS, &action, nullptr);
}

}  // namespace burin
