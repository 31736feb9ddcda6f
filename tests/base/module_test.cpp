#include "base/module.h"

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace burin {
namespace {

TEST(Module, OneThatIsNotThereIsNamedWithWhatItIsFor) {
    try {
        module_function("burin_none.so", "draw", "draws nothing", "draw something");
        FAIL();
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find("cannot load burin_none.so, which draws nothing: "), 0u) << text;
        EXPECT_NE(text.find("; keep it beside the burin program, or draw something"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace burin
