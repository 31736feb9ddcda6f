#include "base/mapped_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

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

}  // namespace
}  // namespace burin
