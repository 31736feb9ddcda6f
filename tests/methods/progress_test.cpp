#include <gtest/gtest.h>

#include <vector>

#include "base/progress.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "render/drawing_needs.h"
#include "tests/support/drawing.h"

namespace burin::test {
namespace {

constexpr int kWidth = 400, kHeight = 300;

/// What a picture of a box says of its progress, all of it.
std::vector<double> told(HiddenStyle hidden, std::uint64_t memory_bytes) {
    Scene scene = scene_of({make_box({1, 1, 1})});
    scene.lines.style.hidden.style = hidden;
    const Frame frame =
        make_frame(scene, perspective_camera({2, 3, 4}, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight}, nullptr);
    std::vector<double> parts;
    Progress progress([&](double done) { parts.push_back(done); }, std::chrono::milliseconds(0));
    Film film({0, 0, kWidth, kHeight}, {0, 0, kWidth, kHeight}, LayerSet{}, frame.criteria.classes);
    render_abuffer(frame, {.threads = 1, .progress = &progress, .memory_bytes = memory_bytes}, film);
    return parts;
}

/// Finding hidden lines is told of as well: that is a step per tile, as for visible ones.
TEST(AbufferProgress, GoesOnWhileHiddenLinesAreFound) {
    const std::size_t visible = told(HiddenStyle::none, 0).size();
    EXPECT_GT(visible, 10u);
    for (const std::uint64_t memory_bytes : {std::uint64_t{0}, std::uint64_t{1} << 30}) {
        for (const HiddenStyle hidden : {HiddenStyle::none, HiddenStyle::solid, HiddenStyle::dashed}) {
            const std::vector<double> parts = told(hidden, memory_bytes);
            if (hidden != HiddenStyle::none) {
                EXPECT_GT(parts.size(), 2 * visible - 4);
            }
            double last = 0;
            for (const double part : parts) {
                EXPECT_GT(part, last);
                last = part;
            }
            EXPECT_EQ(last, 1);
        }
    }
}

}  // namespace
}  // namespace burin::test
