// Wherever memory runs out, the call says so, and what it failed to do has changed nothing.

#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "tests/burin/shapes.h"
#include "tests/support/failing_heap.h"

namespace burin::test::out_of_memory_test {
namespace {

// Scene files and settings are left out: toml++ ends the process where its parser gets no memory.

/// Runs a call that needs memory with more and more of it until it is done.
void expect_told_everywhere(const std::string& name, const std::function<int()>& call) {
    SCOPED_TRACE(name);
    int refused = 0;
    for (std::size_t good = 0;; good += 1 + good / 16) {
        int result = BURIN_FAILED;
        bool has_failed = false;
        {
            const FailingHeap heap(good);
            result = call();
            has_failed = heap.has_failed();
        }
        if (!has_failed) {
            EXPECT_EQ(result, BURIN_DONE) << burin_error();
            break;
        }
        if (result == BURIN_DONE) continue;  // it could do without
        ++refused;
        EXPECT_EQ(result, BURIN_NO_MEMORY) << good << ": " << burin_error();
        EXPECT_NE(std::strstr(burin_error(), "memory"), nullptr) << burin_error();
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(refused, 0);
}

TEST(OutOfMemory, IsToldAndChangesNothing) {
    const TemporaryFolder folder;
    const Arrays arrays = waves(6);
    const std::string model = folder.write("waves.obj", obj_text(arrays));
    Scene scene;
    scene.add_file(model);
    scene.set("lines.hidden.style=dashed");
    const View view{.width = 64, .height = 48};
    const std::string before = exr_of(scene, view);

    burin_view c_view = {};
    c_view.size = sizeof c_view;
    c_view.width = 64;
    c_view.height = 48;
    burin_options options = {};
    options.size = sizeof options;
    options.threads = 1;
    const auto kind_of = [](bool is_done) { return is_done ? int{BURIN_DONE} : burin_error_kind(); };
    expect_told_everywhere("load", [&] {
        burin_scene* const other = burin_scene_new();
        const int result = other == nullptr ? burin_error_kind() : burin_load(other, model.c_str());
        burin_scene_free(other);
        return result < 0 ? result : int{BURIN_DONE};
    });
    expect_told_everywhere("render", [&] {
        burin_picture* const picture = burin_render(scene.get(), &c_view, &options);
        burin_picture_free(picture);
        return kind_of(picture != nullptr);
    });
    EXPECT_TRUE(exr_of(scene, view) == before);
    expect_told_everywhere("find", [&] {
        burin_drawing* const drawing = burin_find_lines(scene.get(), &c_view, &options);
        const bool has_column = drawing != nullptr && burin_column(drawing, "x0", nullptr, nullptr) != nullptr;
        burin_drawing_free(drawing);
        return kind_of(has_column);
    });
    EXPECT_TRUE(exr_of(scene, view) == before);
    burin_picture* const picture = burin_render(scene.get(), &c_view, &options);
    for (const char* format : {"exr", "png"}) {
        expect_told_everywhere(format, [&] {
            uint8_t* bytes = nullptr;
            uint64_t count = 0;
            const int result = burin_encode(picture, format, nullptr, &bytes, &count);
            burin_bytes_free(bytes);
            return result;
        });
        const std::string path = folder.file(std::string("a.") + format);
        expect_told_everywhere(path, [&] { return burin_write(picture, format, nullptr, path.c_str()); });
    }
    burin_picture_free(picture);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "a.png", "waves.obj"}));
}

}  // namespace
}  // namespace burin::test::out_of_memory_test
