// BURIN_KERNELS chooses the vector instructions that kernels use; no picture depends on it.

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::kernels_test {
namespace {

constexpr const char* kScene = R"(
[[object]]
file = "cube.obj"
[[object]]
shape = "teapot"
tessellation = 6
translate = [0.3, 0.4, 0.5]
[lines.hidden]
style = "dashed"
)";

class Kernels : public testing::Test {
  protected:
    Kernels() {
        folder_.write("cube.obj", kCubeObj);
        folder_.write("scene.toml", kScene);
    }
    ~Kernels() override { ::unsetenv("BURIN_KERNELS"); }

    ProgramResult render(const char* kernels, const std::string& output) const {
        if (kernels == nullptr) {
            ::unsetenv("BURIN_KERNELS");
        } else {
            ::setenv("BURIN_KERNELS", kernels, 1);
        }
        return run_burin(folder_.path(), {"render", "scene.toml", "-r", "120x90", "-o", output});
    }

    TemporaryFolder folder_;
};

TEST_F(Kernels, PicturesAreTheSameWithEachInstructionSet) {
    ASSERT_EQ(render(nullptr, "best.exr").status, 0);
    const std::string best = read_file(folder_.file("best.exr"));
    for (const char* const kernels : {"baseline", "avx2", "avx512"}) {
        const ProgramResult result = render(kernels, "one.exr");
        if (result.status == 2) {  // this processor lacks it, which must be said
            EXPECT_NE(std::string(kernels), "baseline");
            EXPECT_NE(result.err.find("this processor has no such instructions"), std::string::npos) << result.err;
            continue;
        }
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_TRUE(read_file(folder_.file("one.exr")) == best) << kernels;
    }
}

TEST_F(Kernels, UnknownSetsAreRefused) {
    const ProgramResult result = render("sse9", "out.exr");
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("BURIN_KERNELS=sse9"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("baseline, avx2 or avx512"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace burin::test::kernels_test
