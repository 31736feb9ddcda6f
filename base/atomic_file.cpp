#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include "base/error.h"

namespace burin {
namespace {

namespace fs = std::filesystem;

// ---- temporary files with names ----

/// Names of temporary files, where a signal handler can reach them. What finds no room stays behind
/// if the process is ended, until the next one removes it.
struct TemporaryName {
    std::atomic<bool> is_taken{false};
    std::atomic<bool> is_set{false};
    char path[1024];
};
std::array<TemporaryName, 16> g_temporary_names;

void remember_temporary_file(const std::string& path) {
    if (path.size() >= sizeof TemporaryName::path) return;
    for (TemporaryName& name : g_temporary_names) {
        if (name.is_taken.exchange(true)) continue;
        std::memcpy(name.path, path.c_str(), path.size() + 1);
        name.is_set.store(true);
        return;
    }
}

void forget_temporary_file(const std::string& path) {
    for (TemporaryName& name : g_temporary_names) {
        if (!name.is_set.load() || path != name.path) continue;
        name.is_set.store(false);
        name.is_taken.store(false);
        return;
    }
}

constexpr std::string_view kMark = ".burin-";

/// Of this machine; several may write to one folder.
std::string host_name() {
    char name[65] = "";
    if (::gethostname(name, sizeof name - 1) != 0 || name[0] == '\0') return "host";
    std::string text(name);
    std::replace(text.begin(), text.end(), '/', '_');
    return text;
}

/// Temporary files for `target` are called this, then PROCESS-NUMBER.
std::string temporary_stem(const fs::path& target) {
    return "." + target.filename().stem().string().substr(0, 100) + std::string(kMark) + host_name() + "-";
}

fs::path temporary_path(const fs::path& target, int number) {
    std::string extension = target.filename().extension().string();
    if (extension.size() > 16) extension.clear();
    return target.parent_path() /
           (temporary_stem(target) + std::to_string(::getpid()) + "-" + std::to_string(number) + extension);
}

constexpr int kMostTemporaryNames = 100;

/// Whether the file of this name is one that temporary_path() gave to a process that is dead, for
/// the same target.
bool is_left_behind(const fs::path& folder, std::string_view name, const std::string& stem) {
    if (!name.starts_with(stem)) return false;
    name.remove_prefix(stem.size());
    long process = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
    if (error != std::errc() || process <= 0 || end == name.data() + name.size() || *end != '-') return false;
    const bool is_alive = ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH;
    if (is_alive && process != ::getpid()) return false;
    // In another container of this name the number may be alive: then the file is locked.
    const fs::path path = folder / fs::path(stem + std::string(name));
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    struct stat info {};
    const bool is_free =
        fd >= 0 && ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && ::flock(fd, LOCK_EX | LOCK_NB) == 0;
    if (fd >= 0) ::close(fd);
    return is_free;
}

/// Removes what is left behind in a folder of temporary files with these stems.
void remove_left_behind(const fs::path& folder, const std::set<std::string>& stems) {
    const std::string behind_mark = host_name() + "-";
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        const std::size_t mark = name.rfind(kMark);
        if (name[0] != '.' || mark == std::string::npos) continue;
        const auto stem = stems.find(name.substr(0, mark + kMark.size()) + behind_mark);
        if (stem != stems.end() && is_left_behind(folder, name, *stem)) ::unlink(it->path().c_str());
    }
}

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

// ---- where files go ----

/// Where a path leads that may be a symbolic link, to a file that need not exist.
std::string followed(const std::string& path) {
    constexpr int kMostLinks = 40;
    fs::path at(path);
    for (int i = 0; i < kMostLinks; ++i) {
        std::error_code error;
        const fs::path target = fs::read_symlink(at, error);
        if (error) return at.string();
        at = target.is_absolute() ? target : at.parent_path() / target;
    }
    throw InputError(path + ": cannot write: symbolic links lead in a circle; give another name");
}

/// Whether a file is not to be written: by this user, or by its permissions by anyone. These protect a file from root,
/// too, whom the system would let write it.
bool is_read_only(const std::string& path, const struct stat& info) {
    return (info.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0 ||
           ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0;
}

std::string name_of_descriptor(int fd) { return "/proc/self/fd/" + std::to_string(fd); }

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(followed(path)) {
    std::error_code ignored;
    struct stat old {};
    const bool exists = ::stat(target_.c_str(), &old) == 0;
    if (!exists && errno == ENAMETOOLONG) {
        throw InputError(path + ": cannot write: the name is too long; give a shorter one");
    }
    if (exists && S_ISDIR(old.st_mode)) {
        throw InputError(path + ": is a folder; give the name of a file to write");
    }
    if (exists && !S_ISREG(old.st_mode)) {
        throw InputError(path + ": is not a regular file; give the name of a file to write");
    }
    if (exists && is_read_only(target_, old)) {
        throw InputError(path + ": cannot write: the file is read-only; give another name or change its permissions");
    }
    const fs::path folder = fs::path(target_).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, ignored)) {
        throw InputError(path + ": cannot write: the folder " + folder.string() + " does not exist; create it first");
    }
    open_without_name();
    if (fd_ < 0) open_with_temporary_name();
    if (fd_ < 0) {
        const std::string reason = std::strerror(errno);
        throw InputError(path + ": cannot write: " + reason + "; choose another place or change its permissions");
    }
    ::flock(fd_, LOCK_EX | LOCK_NB);  // tells others that it is in use
    constexpr mode_t kPermissions = 0777;
    if (exists) ::fchmod(fd_, old.st_mode & kPermissions);
}

AtomicFile::~AtomicFile() {
    if (fd_ >= 0) ::close(fd_);
    if (temporary_path_.empty()) return;
    ::unlink(temporary_path_.c_str());
    forget_temporary_file(temporary_path_);
}

void AtomicFile::open_without_name() {
#ifdef O_TMPFILE
    const fs::path folder = fs::path(target_).parent_path();
    fd_ = ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (fd_ < 0 || ::access(name_of_descriptor(fd_).c_str(), F_OK) == 0) return;
    ::close(fd_);  // it could get no name without /proc
    fd_ = -1;
#endif
}

void AtomicFile::open_with_temporary_name() {
    for (int number = 0; number < kMostTemporaryNames && fd_ < 0; ++number) {
        const std::string path = temporary_path(target_, number).string();
        remember_temporary_file(path);
        fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd_ >= 0) {
            temporary_path_ = path;
            return;
        }
        const int error = errno;
        forget_temporary_file(path);
        errno = error;
        if (error != EEXIST) return;
    }
}

void AtomicFile::fail(const char* action) const {
    const std::string reason = std::strerror(errno);
    throw InputError(path_ + ": cannot " + action + ": " + reason + "; nothing was written under this name");
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

/// Gives the file its own name, if that is free, else a temporary one.
void AtomicFile::give_name() {
    const std::string from = name_of_descriptor(fd_);
    const auto link_to = [&](const std::string& path) {
        return ::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0;
    };
    if (link_to(target_)) return;
    for (int number = 0; number < kMostTemporaryNames && errno == EEXIST; ++number) {
        const std::string path = temporary_path(target_, number).string();
        if (!link_to(path)) continue;
        temporary_path_ = path;
        remember_temporary_file(path);
        return;
    }
    fail("name the finished file");
}

void AtomicFile::commit() {
    if (::fsync(fd_) != 0) fail("write");
    if (temporary_path_.empty()) give_name();
    const int fd = fd_;
    fd_ = -1;
    if (::close(fd) != 0) fail("write");
    if (temporary_path_.empty()) return;
    if (::rename(temporary_path_.c_str(), target_.c_str()) != 0) fail("rename the finished file");
    forget_temporary_file(temporary_path_);
    temporary_path_.clear();
}

void check_output_file(const std::string& path) {
    const std::string target = followed(path);
    const AtomicFile writable(path);
    remove_left_behind(folder_of(target), {temporary_stem(target)});
}

void remove_left_behind(const std::vector<std::string>& paths) {
    std::map<fs::path, std::set<std::string>> stems;
    for (const std::string& path : paths) {
        const fs::path target = followed(path);
        stems[folder_of(target)].insert(temporary_stem(target));
    }
    for (const auto& [folder, of_folder] : stems) remove_left_behind(folder, of_folder);
}

void remove_temporary_files() noexcept {
    for (TemporaryName& name : g_temporary_names) {
        if (name.is_set.load()) ::unlink(name.path);
    }
}

}  // namespace burin
