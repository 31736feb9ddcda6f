#include "base/mapped_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

TEST(MappedFile, CopiesWhatItMaps) {
    test::TemporaryFolder folder;
    std::string text;
    for (int i = 0; i < 3000; ++i) text += std::to_string(i);
    const MappedFile file(folder.write("text", text), true);
    EXPECT_EQ(file.bytes(), text);
    for (const std::size_t place : {std::size_t{0}, std::size_t{1}, std::size_t{4095}, text.size() - 1, text.size()}) {
        std::string copy(text.size() - place, ' ');
        file.copy(place, copy);
        EXPECT_EQ(copy, text.substr(place));
    }
    std::string too_much(2, ' ');
    EXPECT_THROW(file.copy(text.size() - 1, too_much), InputError);
}

/// Models may be in more files than a process may have open.
TEST(MappedFile, IsNotOpenUnlessItHasTo) {
    test::TemporaryFolder folder;
    const std::string path = folder.write("text", "text");
    const auto next_descriptor = [] {
        const int fd = ::dup(0);
        ::close(fd);
        return fd;
    };
    const int before = next_descriptor();
    const MappedFile file(path);
    EXPECT_EQ(next_descriptor(), before);
    {
        const MappedFile open(path, true);
        EXPECT_NE(next_descriptor(), before);
    }
    EXPECT_EQ(next_descriptor(), before);
}

/// Runs work in a process of its own. Its exit status, or 128 + the number of the signal that ended it; and what it
/// printed.
std::pair<int, std::string> in_process(const std::function<void()>& work) {
    int ends[2];
    if (::pipe(ends) != 0) return {-1, ""};
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDERR_FILENO);
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        work();
        ::_exit(0);
    }
    ::close(ends[1]);
    std::string printed;
    char buffer[1000];
    for (ssize_t count; (count = ::read(ends[0], buffer, sizeof buffer)) > 0;)
        printed.append(buffer, static_cast<std::size_t>(count));
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), printed};
}

/// Reads one byte of every page.
void look_at(const MappedFile& file) {
    const volatile char* const bytes = file.bytes().data();
    for (std::size_t i = 0; i < file.bytes().size(); i += 512) [[maybe_unused]] const char read = bytes[i];
}

TEST(MappedFile, AFileThatIsCutEndsAProgramWithItsName) {
    test::TemporaryFolder folder;
    const std::string path = folder.write("a\nb", std::string(100000, 'x')),
                      other_path = folder.write("other", std::string(100000, 'x'));
    const auto read_cut = [&](bool is_program) {
        return in_process([&] {
            if (is_program) MappedFile::end_process_where_files_are_cut();
            const MappedFile before(other_path), file(path), behind(other_path);
            { const MappedFile gone(other_path); }
            if (::truncate(path.c_str(), 100) != 0) ::_exit(99);
            look_at(before);
            look_at(file);
        });
    };
    const auto [status, message] = read_cut(true);
    EXPECT_EQ(status, 1);
    EXPECT_EQ(message,
              folder.path() +
                  "/a?b: cannot read: the file has become shorter while it was read; is another program writing it?\n");
    EXPECT_EQ(::truncate(path.c_str(), 100000), 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they handle signals themselves
    EXPECT_EQ(read_cut(false).first, 128 + SIGBUS) << "a library leaves signals alone";
#endif
}

TEST(MappedFile, WhatWasReadOfACutFileIsNotTrusted) {
    test::TemporaryFolder folder;
    const std::string path = folder.write("text", "0123456789");
    const MappedFile file(path);
    const FileLength length(path);
    file.check_is_whole();
    length.check();
    ASSERT_EQ(::truncate(path.c_str(), 9), 0);
    EXPECT_THROW(file.check_is_whole(), InputError);
    EXPECT_THROW(length.check(), InputError);
    // Another file in its place leaves the old one as it is.
    folder.write("new", "x");
    std::filesystem::rename(folder.file("new"), path);
    file.check_is_whole();
    std::filesystem::remove(path);
    file.check_is_whole();
    FileLength(folder.file("missing")).check();
}

}  // namespace
}  // namespace burin
