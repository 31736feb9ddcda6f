// A cap for memory holds: what the method takes from the heap beyond the model and the picture stays below it.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "image/exr_io.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/counting_heap.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin::peak_memory_test {
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
    const PreparedScene prepared = prepare_for_abuffer(scene, threads, true);
    const Frame frame = make_frame(scene, perspective_camera({2, 1, 12}, {0, 0, 0}), kWidth, kHeight,
                                   {0, 0, kWidth, kHeight}, &prepared);
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

/// Nothing of a file's rows stays once they are in the file.
TEST(PeakMemory, WrittenRowsTakeNone) {
    const TemporaryFolder folder;
    Random random(1);
    Image image({0, 0, 400, 1600}, {0, 0, 400, 1600});
    for (std::uint32_t& v : image.add("id.polygon", PixelType::uint32).as<std::uint32_t>()) v = random.bits();
    const std::size_t before = CountingHeap::now();
    ExrWriter writer(folder.file("a.exr"), image.display(), image.data(), image.formats(), {});
    for (int y = 0; y < image.height(); y += ExrWriter::kChunkRows) writer.write_chunk(strip_of(image), y);
    EXPECT_LT(CountingHeap::now() - before, image.channels().front().bytes.size() / 4);
    writer.finish();
}

/// Bands are open while they are drawn, and no longer.
TEST(PeakMemory, APictureInBandsIsNeverThereAsAWhole) {
    constexpr int kWide = 600, kTall = 3000;
    const PixelRect crop{0, 0, kWide, kTall};
    const auto peak_of = [&](const Scene& scene, int threads) {
        const Frame frame = make_frame(scene, perspective_camera({0, 0, 20}, {0, 0, 0}), kWide, kTall, crop);
        const std::size_t before = CountingHeap::now();
        CountingHeap::forget_peak();
        Film film = Film::in_bands(crop, crop, LayerSet{}, frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        options.finished_band = [&](std::size_t band) { film.close(band); };
        render_abuffer(frame, options, film);
        return CountingHeap::peak() - before;
    };
    const std::size_t before = CountingHeap::now();
    const Film whole(crop, crop, LayerSet{}, kDefaultLineClasses);
    const std::size_t most = (CountingHeap::now() - before) / 3;
    const PolygonSoup torus = make_torus(0.7, 0.3, 60, 30);
    for (const int threads : {1, 3}) EXPECT_LT(peak_of(scene_of({torus}), threads), most) << threads;
    // A tile at the top that takes longer than all others together, which do not run ahead of it.
    const auto at_the_top = [](glm::dvec3 p) { return 0.02 * p + glm::dvec3(0, 5.9, 0); };
    const Scene scene = scene_of({torus, transformed(make_torus(0.7, 0.3, 500, 400), at_the_top)});
    EXPECT_LT(peak_of(scene, 3), peak_of(scene, 1) + most);
}

}  // namespace
}  // namespace burin::peak_memory_test
