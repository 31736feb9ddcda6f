// Not built with sanitizers: they reserve terabytes of addresses, so that no limit fits, and their `new` ends the
// program where memory is short. tests/burin/out_of_memory_test.cpp lets memory run out there, too.

#include <gtest/gtest.h>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::memory_limit_test {
namespace {

/// With whatever there is, it is enough, or memory is what the message is about.
TEST(MemoryLimit, TooLittleMemoryIsToldAsSuch) {
    const TemporaryFolder folder;
    for (const auto& [name, content] : tetrahedra()) folder.write(name, content);
    int refused = 0;
    for (std::size_t megabytes = 80; megabytes <= 280; megabytes += 20) {
        ProgramOptions options;
        options.memory_limit = megabytes << 20;
        for (const char* method : {"reference", "abuffer"}) {
            const ProgramResult result =
                run_burin(folder.path(),
                          {"render", "tetra.gltf", "-r", "16x12", "-m", method, "-j", "1", "-o", "out.exr"}, options);
            if (result.status == 0) continue;
            ++refused;
            EXPECT_EQ(result.status, 1) << result.err;
            EXPECT_TRUE(is_one_line(result.err)) << result.err;
            EXPECT_NE(result.err.find("memory"), std::string::npos) << result.err;
        }
    }
    EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace burin::test::memory_limit_test
