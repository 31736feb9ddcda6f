#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

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

/// What there is to draw of a scene, with all that is done after visible lines are found.
Scene scene_drawn_with(const std::string& look) {
    Scene scene = large_scene();
    if (look == "hidden") scene.set("lines.hidden.style=dashed");
    if (look == "sheet") scene.set_style("technical");
    return scene;
}

TEST(Stop, CancelEndsThePictureWhenMuchOfItIsDrawn) {
    const struct {
        std::string look;
        double share;  // after which it is stopped
    } cases[] = {{"plain", 0.1}, {"plain", 0.5}, {"hidden", 0.2}, {"sheet", 0.1}};
    for (const auto& [look, share] : cases) {
        SCOPED_TRACE(look + " " + std::to_string(share));
        Scene scene = scene_drawn_with(look);
        const std::string before = exr_of(scene);
        std::atomic<bool> is_late = false, is_done = false;
        std::thread other([&] {
            while (!is_late && !is_done) std::this_thread::yield();
            while (!is_done) scene.cancel();
        });
        Options options = kBeauty;
        options.threads = 1;  // it takes long enough to be told of
        int calls_when_late = 0;
        options.progress = [&, least = share](double done) {
            if (is_late) ++calls_when_late;
            if (done >= least) is_late = true;
            return false;
        };
        EXPECT_EQ(failure_of([&] { scene.render(kLarge, options); }), BURIN_STOPPED);
        is_done = true;
        other.join();
        EXPECT_TRUE(is_late);
        EXPECT_LE(calls_when_late, 1);  // no more than what was about to be told
        EXPECT_TRUE(exr_of(scene) == before);
    }
}

// The memory of the stopped picture is given back by a thread that a fork does not copy.
TEST(Stop, AForkGoesOnAfterAStoppedPicture) {
    Scene scene = large_scene();
    const std::string before = exr_of(scene);
    Options options;
    options.threads = 1;
    options.progress = [](double done) { return done > 0.3; };
    EXPECT_EQ(failure_of([&] { scene.render(kLarge, options); }), BURIN_STOPPED);
    const pid_t child = fork();
    if (child == 0) {
        alarm(120);  // ends it, should it wait for ever
        _exit(exr_of(scene) == before ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
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
