// A cap for memory holds: what the method takes from the heap beyond the model and the picture stays below it.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "mesh/shapes.h"
#include "methods/abuffer/abuffer.h"
#include "tests/support/counting_heap.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

constexpr int kWidth = 400, kHeight = 700;

/// Tori with triangles of about a pixel, over and behind each other.
Scene heap_of_tori(std::uint64_t seed) {
    Random random(seed);
    Scene scene = scene_of({make_torus(0.7, 0.3, 260, 130)});
    const SceneObject torus = scene.objects[0];
    for (int i = 0; i < 11; ++i) {
        SceneObject instance = torus;
        instance.to_world = glm::translate(glm::dmat4(1.0), random.in_box(1) * glm::dvec3(1.5, 3.5, 2)) *
                            glm::rotate(glm::dmat4(1.0), random.real(0, 3), random.direction());
        scene.objects.push_back(instance);
    }
    return scene;
}

/// Bytes at the peak of a render, beyond what was there before. 0: the cap was refused, and `least` is what it names.
std::size_t peak_of(const Scene& scene, int threads, std::uint64_t cap_bytes, std::uint64_t& least) {
    const Frame frame = make_frame(scene, perspective_camera({2, 1, 12}, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
    Film film(frame.crop, frame.crop, LayerSet{}, frame.criteria.classes);
    RunOptions options;
    options.threads = threads;
    options.memory_bytes = cap_bytes;
    const std::size_t before = CountingHeap::now();
    CountingHeap::forget_peak();
    try {
        render_abuffer(frame, options, film);
    } catch (const InputError& error) {
        const std::string words = error.what(), key = "at least ";
        least = std::uint64_t{std::stoul(words.substr(words.find(key) + key.size()))} << 20;
        return 0;
    }
    return CountingHeap::peak() - before;
}

TEST(PeakMemory, StaysBelowTheCap) {
    for (const HiddenStyle hidden : {HiddenStyle::none, HiddenStyle::solid, HiddenStyle::dashed}) {
        Scene scene = heap_of_tori(1);
        scene.lines.style.hidden.style = hidden;
        prepare_for_abuffer(scene, 2, true);
        for (const int threads : {1, 2}) {
            std::uint64_t least = 0;
            ASSERT_EQ(peak_of(scene, threads, 1, least), 0u);
            std::size_t at_least = 0;
            for (const std::uint64_t cap : {least + least / 2, least}) {
                at_least = peak_of(scene, threads, cap, least);
                EXPECT_GT(at_least, 0u) << "refused";
                EXPECT_LE(at_least, cap) << "hidden " << static_cast<int>(hidden) << ", threads " << threads;
            }
            // Without a cap it takes more: the test is not about nothing.
            EXPECT_GT(peak_of(scene, threads, 0, least), at_least);
        }
    }
}

}  // namespace
}  // namespace burin
