#include "base/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <iterator>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::read_file;
using test::TemporaryFolder;

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
    const TemporaryFolder folder;
    {
        AtomicFile file(folder.file("a.txt"));
        file.write("hello", 5);
        EXPECT_FALSE(std::filesystem::exists(folder.file("a.txt")));
        file.commit();
    }
    EXPECT_EQ(read_file(folder.file("a.txt")), "hello");
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
    const TemporaryFolder folder;
    folder.write("a.txt", "old");
    {
        AtomicFile file(folder.file("a.txt"));
        file.write("new", 3);
    }
    EXPECT_EQ(read_file(folder.file("a.txt")), "old");
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST(AtomicFile, SeeksAndOverwrites) {
    const TemporaryFolder folder;
    AtomicFile file(folder.file("b"));
    file.write("0123456789", 10);
    file.seek(3);
    file.write("abc", 3);
    EXPECT_EQ(file.position(), 6u);
    file.commit();
    EXPECT_EQ(read_file(folder.file("b")), "012abc6789");
}

TEST(AtomicFile, RefusesPlacesThatCannotBeWritten) {
    const TemporaryFolder folder;
    EXPECT_THROW(AtomicFile("/nonexistent-folder/x.png"), InputError);
    EXPECT_THROW(AtomicFile(folder.path()), InputError);
    EXPECT_THROW(AtomicFile("/dev/null"), InputError);
}

TEST(AtomicFile, AFullDiskIsAnError) {
    const TemporaryFolder folder;
    AtomicFile file(folder.file("c"));
    // A limit on file sizes fails in the same place as a full disk does.
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string data(5000, 'x');
    EXPECT_THROW(file.write(data.data(), data.size()), InputError);
    setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, old_handler);
}

TEST(AtomicFile, ASymbolicLinkKeepsPointing) {
    const TemporaryFolder folder;
    folder.write("target.txt", "old");
    std::filesystem::create_symlink("target.txt", folder.file("link.txt"));
    AtomicFile file(folder.file("link.txt"));
    file.write("new", 3);
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.txt")));
    EXPECT_EQ(read_file(folder.file("target.txt")), "new");
}

/// An output that may be written before what it points to exists.
TEST(AtomicFile, ALinkToNothingLeadsToTheNewFile) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("shots"));
    std::filesystem::create_symlink("shots/../shots/001.txt", folder.file("inner.txt"));
    std::filesystem::create_symlink("inner.txt", folder.file("latest.txt"));
    {
        AtomicFile file(folder.file("latest.txt"));
        file.write("new", 3);
        EXPECT_FALSE(std::filesystem::exists(folder.file("shots/001.txt")));
        file.commit();
    }
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("latest.txt")));
    EXPECT_TRUE(std::filesystem::is_symlink(folder.file("inner.txt")));
    EXPECT_EQ(read_file(folder.file("shots/001.txt")), "new");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"inner.txt", "latest.txt", "shots"}));
}

TEST(AtomicFile, ALinkThatLeadsNowhereIsRefusedAndStays) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("missing/001.txt", folder.file("far.txt"));
    std::filesystem::create_symlink("round.txt", folder.file("round.txt"));
    for (const char* name : {"far.txt", "round.txt"}) {
        EXPECT_THROW(AtomicFile(folder.file(name)), InputError);
        EXPECT_TRUE(std::filesystem::is_symlink(folder.file(name)));
    }
}

TEST(AtomicFile, ANameThatIsTooLongIsRefusedAtOnce) {
    const TemporaryFolder folder;
    const std::string longest(255, 'n');
    AtomicFile(folder.file(longest)).commit();
    AtomicFile(folder.file(longest)).commit();  // replaced through a temporary name
    EXPECT_EQ(folder.names(), std::vector<std::string>{longest});
    const std::string long_suffix = "x." + std::string(253, 'y');
    AtomicFile(folder.file(long_suffix)).commit();
    AtomicFile(folder.file(long_suffix)).commit();
    try {
        AtomicFile(folder.file(longest + "n"));
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("the name is too long"), std::string::npos);
    }
}

TEST(AtomicFile, AReplacedFileKeepsItsPermissions) {
    const TemporaryFolder folder;
    const auto mode = [&] { return static_cast<unsigned>(std::filesystem::status(folder.file("a")).permissions()); };
    for (const unsigned kept : {0640u, 0600u, 0200u, 0755u}) {
        if (kept == 0200u && ::geteuid() != 0) continue;  // the test could not read it
        std::filesystem::remove(folder.file("a"));
        folder.write("a", "old");
        std::filesystem::permissions(folder.file("a"), static_cast<std::filesystem::perms>(kept));
        AtomicFile file(folder.file("a"));
        file.write("new", 3);
        file.commit();
        EXPECT_EQ(mode(), kept);
        EXPECT_EQ(read_file(folder.file("a")), "new");
    }
}

TEST(AtomicFile, AReadOnlyFileIsNotReplaced) {
    const TemporaryFolder folder;
    folder.write("a", "old");
    std::filesystem::create_symlink("a", folder.file("link"));
    for (const unsigned mode : {0444u, 0400u, 0555u}) {
        std::filesystem::permissions(folder.file("a"), static_cast<std::filesystem::perms>(mode));
        for (const std::string& path : {folder.file("a"), folder.file("link")}) {
            try {
                AtomicFile file(path);
                FAIL() << "no error";
            } catch (const InputError& error) {
                EXPECT_EQ(error.what(),
                          path + ": cannot write: the file is read-only; give another name or change its permissions");
            }
            EXPECT_THROW(check_output_file(path), InputError);
        }
        EXPECT_EQ(read_file(folder.file("a")), "old");
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a", "link"}));
}

std::string host() {
    char name[65] = "";
    ::gethostname(name, sizeof name - 1);
    return name;
}

/// The number of a process that has ended.
int dead_process() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return child;
}

TEST(AtomicFile, WhatDeadProcessesLeftIsRemovedForAllFramesAtOnce) {
    const TemporaryFolder folder;
    const std::string behind = ".burin-" + host() + "-" + std::to_string(dead_process()) + "-0.exr";
    std::vector<std::string> paths;
    for (const char* frame : {"o.0001", "o.0002", "o.0003"}) {
        folder.write("." + std::string(frame) + behind, "x");
        paths.push_back(folder.file(std::string(frame) + ".exr"));
    }
    folder.write(".o.0004" + behind, "x");
    remove_left_behind(paths);
    EXPECT_EQ(folder.names(), std::vector<std::string>{".o.0004" + behind});
}

TEST(AtomicFile, WhatDeadProcessesLeftIsRemoved) {
    const TemporaryFolder folder;
    const std::string dead = std::to_string(dead_process()), alive = std::to_string(::getppid()),
                      own = std::to_string(::getpid());
    const std::string mark = ".burin-" + host() + "-";
    const std::vector<std::string> stale = {".o" + mark + dead + "-0.exr", ".o" + mark + dead + "-17.exr",
                                            ".o" + mark + dead + "-1.png", ".o" + mark + own + "-3.exr"};
    std::vector<std::string> others = {".o" + mark + alive + "-0.exr",
                                       ".p" + mark + dead + "-0.exr",
                                       ".o.burin-x",
                                       ".o.burin-elsewhere-" + dead + "-0.exr",
                                       ".o" + mark + dead,
                                       "o" + mark + dead + "-0.exr",
                                       ".o" + mark + "-1-0.exr"};
    for (const std::string& name : stale) folder.write(name, "x");
    for (const std::string& name : others) folder.write(name, "x");
    // A process of another container has left this one.
    const std::string locked = ".o" + mark + dead + "-5.exr";
    const int fd = ::open(folder.write(locked, "x").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(fd, LOCK_EX), 0);
    others.push_back(locked);
    check_output_file(folder.file("o.exr"));
    std::sort(others.begin(), others.end());
    EXPECT_EQ(folder.names(), others);
    ::close(fd);
}

/// Where the file system has files without names, nothing is there to be left behind; elsewhere one temporary name is.
TEST(AtomicFile, HasNoNameBeforeItIsComplete) {
    const TemporaryFolder folder;
    const int fd = ::open(folder.path().c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    const bool needs_name = fd < 0 || ::access("/proc/self/fd", F_OK) != 0;
    if (fd >= 0) ::close(fd);
    AtomicFile file(folder.file("a"));
    file.write("new", 3);
    EXPECT_EQ(folder.names().size(), needs_name ? 1u : 0u);
    file.commit();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

/// From now on this process finds no files without names.
bool forbid_files_without_names() {
    constexpr unsigned kNoName = O_TMPFILE & ~O_DIRECTORY;
    sock_filter program[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_openat, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[2])),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, kNoName, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EOPNOTSUPP),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog filter{std::size(program), program};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// On file systems where every file has a name.
TEST(AtomicFile, ATemporaryNameIsRemovedWhateverHappens) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.txt");
    const auto is_temporary = [&](const std::vector<std::string>& names) {
        return names.size() == 1 && names[0] == ".a.burin-" + host() + "-" + std::to_string(::getpid()) + "-0.txt";
    };
    constexpr int kNoFilter = 77;
    // The number of the check that fails, from 1.
    const auto check = [&]() -> int {
        if (!forbid_files_without_names()) return kNoFilter;
        {
            AtomicFile file(path);
            if (!is_temporary(folder.names())) return 1;
        }
        if (!folder.names().empty()) return 2;
        {
            AtomicFile file(path);
            remove_temporary_files();
            if (!folder.names().empty()) return 3;
        }
        check_output_file(path);
        if (!folder.names().empty()) return 4;
        AtomicFile file(path);
        file.write("new", 3);
        check_output_file(path);  // leaves a file that is being written
        if (!is_temporary(folder.names())) return 5;
        file.commit();
        if (folder.names() != std::vector<std::string>{"a.txt"}) return 6;
        remove_temporary_files();
        return read_file(path) == "new" ? 0 : 7;
    };
    const pid_t child = ::fork();
    if (child == 0) ::_exit(check());
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == kNoFilter) << "this needs a Linux with seccomp filters";
    EXPECT_EQ(status, 0) << "check " << WEXITSTATUS(status);
}

}  // namespace
}  // namespace burin
