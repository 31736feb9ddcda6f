#include "base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

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

}  // namespace
}  // namespace burin
