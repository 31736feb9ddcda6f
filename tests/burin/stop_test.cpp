#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "tests/burin/shapes.h"

namespace burin::test::stop_test {
namespace {

constexpr View kLarge{.width = 8192, .height = 8192};  // takes long enough to be stopped
const Options kBeauty{.layers = "beauty"};

Scene large_scene() {
    Scene scene;
    scene.add(waves(150).mesh());
    scene.set("lines.draw=all");
    return scene;
}

TEST(Stop, CancelFromAnotherThreadEndsThePictureAndNoLaterOne) {
    Scene scene = large_scene();
    const std::string before = exr_of(scene);
    std::atomic<bool> is_done = false;
    std::thread other([&] {
        while (!is_done) scene.cancel();  // whenever it begins
    });
    EXPECT_EQ(failure_of([&] { scene.render(kLarge, kBeauty); }), BURIN_STOPPED);
    is_done = true;
    other.join();
    EXPECT_TRUE(exr_of(scene) == before);
}

TEST(Stop, CancelStopsOneSceneAlone) {
    Scene scene = large_scene(), other = large_scene();
    const std::string before = exr_of(other);
    std::atomic<bool> is_done = false;
    std::thread canceller([&] {
        while (!is_done) scene.cancel();
    });
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(exr_of(other) == before);
    is_done = true;
    canceller.join();
}

TEST(Stop, MeshesAndFilesAreStoppedToo) {
    Scene scene;
    const Arrays arrays = waves(400);
    const TemporaryFolder folder;
    folder.write("waves.obj", obj_text(arrays));
    std::atomic<bool> is_done = false;
    std::thread other([&] {
        while (!is_done) scene.cancel();
    });
    EXPECT_EQ(failure_of([&] { scene.add_mesh(arrays.mesh()); }), BURIN_STOPPED);
    EXPECT_EQ(failure_of([&] { scene.add_file(folder.file("waves.obj")); }), BURIN_STOPPED);
    is_done = true;
    other.join();
    EXPECT_EQ(scene.add_mesh(arrays.mesh()), 1);  // nothing has been added so far
    EXPECT_EQ(scene.add_file(folder.file("waves.obj")), 1);
}

TEST(Stop, ProgressGrowsAndIsToldToItsOwnThread) {
    Scene scene = large_scene();
    const std::thread::id self = std::this_thread::get_id();
    double last = 0;
    Options options = kBeauty;
    options.threads = 2;  // of which one tells
    options.progress = [&](double done) {
        EXPECT_EQ(std::this_thread::get_id(), self);
        EXPECT_GE(done, last);
        EXPECT_LE(done, 1);
        last = done;
        return false;
    };
    scene.render(kLarge, options);
    EXPECT_GT(last, 0);
}

TEST(Stop, ProgressStops) {
    Scene scene = large_scene();
    const std::string before = exr_of(scene);
    Options options = kBeauty;
    options.threads = 1;
    int calls = 0;
    options.progress = [&](double) { return ++calls == 1; };
    std::string text;
    EXPECT_EQ(failure_of([&] { scene.render(kLarge, options); }, &text), BURIN_STOPPED);
    EXPECT_EQ(text, "stopped, by burin_cancel() or the progress function");
    EXPECT_EQ(calls, 1);
    options.progress = [](double) -> bool { throw std::out_of_range("mine"); };
    EXPECT_THROW(scene.render(kLarge, options), std::out_of_range);
    EXPECT_TRUE(exr_of(scene) == before);
}

TEST(Threads, ScenesAreDrawnAtOnce) {
    const auto make = [](int kind) {
        Scene scene;
        scene.add(kind % 2 == 0 ? waves(30).mesh() : cube().mesh());
        if (kind >= 2) scene.set("lines.hidden.style=dashed");
        return scene;
    };
    std::vector<std::string> alone;
    for (int kind = 0; kind < 4; ++kind) {
        Scene scene = make(kind);
        alone.push_back(exr_of(scene));
    }
    std::vector<std::thread> threads;
    std::atomic<int> differ = 0;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 10; ++i) {
                const int kind = (t + i) % 4;
                Scene scene = make(kind);
                const bool is_same = exr_of(scene, {.width = 200, .height = 150}, {.threads = 1 + i % 3}) ==
                                     alone[static_cast<std::size_t>(kind)];
                if (!is_same) ++differ;
                if (failure_of([&] { scene.set("lines.width=" + std::to_string(-t)); }) != BURIN_BAD_ARGUMENT) ++differ;
                if (std::string(burin_error()).find("=" + std::to_string(-t)) == std::string::npos) ++differ;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(differ, 0);
}

TEST(Threads, FilesAreLoadedAtOnce) {
    const TemporaryFolder folder;
    folder.write("waves.obj", obj_text(waves(60)));
    const std::string scene_text =
        "[[object]]\nfile = \"waves.obj\"\n[[object]]\nshape = \"box\"\nsubdivide = 2\nscheme = \"catmull-clark\"\n";
    const auto make = [&] {
        Scene scene;
        scene.add_text(scene_text, folder.path());
        return exr_of(scene);
    };
    const std::string alone = make();
    std::vector<std::thread> threads;
    std::atomic<int> differ = 0;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            for (int i = 0; i < 5; ++i) differ += make() == alone ? 0 : 1;
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(differ, 0);
}

}  // namespace
}  // namespace burin::test::stop_test
