#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "base/error.h"
#include "base/interrupt.h"
#include "image/image_io.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Random;
using test::read_file;
using test::TemporaryFolder;

/// Noise, so that files are not much smaller than the picture. With `bits` 8 the values are those
/// that 8 bits can hold.
DisplayImage noise(int width, int height, int channels, int bits) {
    Random random(static_cast<std::uint64_t>(width * height + channels + bits));
    DisplayImage image{width, height, channels, {}};
    for (int i = 0; i < width * height * channels; ++i) {
        image.pixels.push_back(
            static_cast<std::uint16_t>(bits == 16 ? random.integer(0, 65535) : 257 * random.integer(0, 255)));
    }
    return image;
}

TEST(DisplayFile, PngAndTiffKeepEveryValue) {
    const TemporaryFolder folder;
    for (const char* name : {"a.png", "a.tif", "a.tiff", "A.PNG"}) {
        for (const int channels : {3, 4}) {
            for (const int bits : {8, 16}) {
                for (const auto& [width, height] : {std::pair{1, 1}, {31, 77}, {260, 5}}) {
                    DisplayImage image = noise(width, height, channels, bits);
                    if (channels == 4) image.pixels[3] = 0;  // its colour must not get lost
                    write_display_image(folder.file(name), image, bits);
                    const DisplayImage back = read_display_image(folder.file(name));
                    EXPECT_EQ(back.width, width);
                    EXPECT_EQ(back.height, height);
                    EXPECT_EQ(back.channels, channels);
                    EXPECT_TRUE(back.pixels == image.pixels) << name << ' ' << channels << ' ' << bits;
                    if (std::tolower(name[2]) == 'p') {  // byte 24 of a PNG is its depth
                        EXPECT_EQ(static_cast<int>(read_file(folder.file(name))[24]), bits);
                    }
                }
            }
        }
    }
}

TEST(DisplayFile, EightBitsRoundToTheNearest) {
    const TemporaryFolder folder;
    DisplayImage image{256, 257, 3, {}};
    for (int i = 0; i < 256 * 257; ++i) {
        for (int c = 0; c < 3; ++c) image.pixels.push_back(static_cast<std::uint16_t>(std::min(i, 65535)));
    }
    for (const char* name : {"a.png", "a.tif"}) {
        write_display_image(folder.file(name), image, 8);
        const DisplayImage back = read_display_image(folder.file(name));
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            ASSERT_LE(std::abs(back.pixels[i] - image.pixels[i]), 129) << name << ' ' << i;
        }
    }
}

TEST(DisplayFile, EqualPicturesGiveEqualFiles) {
    const TemporaryFolder folder;
    const DisplayImage image = noise(40, 30, 4, 8);
    for (const char* name : {"a.png", "a.tif"}) write_display_image(folder.file(name), image, 8);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a date would differ now
    for (const char* name : {"b.png", "b.tif"}) write_display_image(folder.file(name), image, 8);
    EXPECT_TRUE(read_file(folder.file("a.png")) == read_file(folder.file("b.png")));
    EXPECT_TRUE(read_file(folder.file("a.tif")) == read_file(folder.file("b.tif")));
}

TEST(DisplayFile, AFullDiskLeavesNothing) {
    const TemporaryFolder folder;
    const DisplayImage image = noise(70, 60, 3, 8);
    for (const std::string extension : {"png", "tif"}) {
        const std::string whole = folder.file("whole." + extension), target = folder.file("a." + extension);
        write_display_image(whole, image, 8);
        const std::size_t size = read_file(whole).size();
        folder.write("a." + extension, "old");

        rlimit old{};
        getrlimit(RLIMIT_FSIZE, &old);
        const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
        // Libraries write in pieces of some kilobytes; the last piece is the one they lose quietly.
        for (std::size_t limit = 0; limit < size; limit += limit + 1024 < size - 1 ? 512 : 1) {
            const rlimit small{limit, old.rlim_max};
            setrlimit(RLIMIT_FSIZE, &small);
            std::string message = "nothing was thrown";
            try {
                write_display_image(target, image, 8);
            } catch (const InputError& error) {
                message = error.what();
            }
            setrlimit(RLIMIT_FSIZE, &old);
            ASSERT_EQ(message.find(target + ": cannot write"), 0u) << limit << ": " << message;
            ASSERT_EQ(message.find('\n'), std::string::npos) << message;
            ASSERT_EQ(read_file(target), "old") << limit;
        }
        std::signal(SIGXFSZ, old_handler);
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.png", "a.tif", "whole.png", "whole.tif"}));
}

TEST(DisplayFile, AnInterruptLeavesNothing) {
    const TemporaryFolder folder;
    // In a process of its own: an interrupt cannot be taken back.
    const auto write_interrupted = [&](const std::string& name) {
        install_interrupt_handlers();
        std::raise(SIGTERM);
        try {
            write_display_image(folder.file(name), noise(9, 9, 3, 8), 8);
        } catch (const Interrupted&) {
            std::_Exit(folder.names().empty() ? 77 : 1);
        }
        std::_Exit(2);
    };
    EXPECT_EXIT(write_interrupted("a.png"), testing::ExitedWithCode(77), "");
    EXPECT_EXIT(write_interrupted("a.tif"), testing::ExitedWithCode(77), "");
}

TEST(DisplayFile, RefusesWhatItCannotWriteOrRead) {
    const TemporaryFolder folder;
    const DisplayImage image = noise(5, 5, 3, 8);
    EXPECT_THROW(write_display_image(folder.file("missing/a.png"), image, 8), InputError);
    EXPECT_THROW(write_display_image(folder.path(), image, 8), InputError);
    EXPECT_THROW(write_display_image(folder.file("a.unknown"), image, 8), InputError);
    EXPECT_TRUE(folder.names().empty());
    EXPECT_THROW(read_display_image(folder.file("missing.png")), InputError);
    EXPECT_THROW(read_display_image(folder.write("text.png", "this is no image")), InputError);
    write_display_image(folder.file("a.png"), noise(50, 50, 3, 8), 8);
    const std::string bytes = read_file(folder.file("a.png"));
    EXPECT_THROW(read_display_image(folder.write("cut.png", bytes.substr(0, bytes.size() / 2))), InputError);
}

}  // namespace
}  // namespace burin
