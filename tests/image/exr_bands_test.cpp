#include "image/exr_bands.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/exr_container.h"
#include "image/exr_io.h"
#include "image/image.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin::exr_bands_test {
namespace {

using test::Random;
using test::read_file;
using test::TemporaryFolder;

/// Channels whose values follow from the place of the pixel in the picture, so that bands are cuts of the whole.
Image picture(PixelRect display, PixelRect data, std::uint32_t seed) {
    Image image(display, data);
    for (const char* name : {"R", "A", "id.object"}) {
        const bool is_id = std::string_view(name) == "id.object";
        Channel& channel = image.add(name, is_id ? PixelType::uint32 : PixelType::float32);
        std::size_t i = 0;
        for (int y = data.y0; y < data.y1; ++y) {
            for (int x = data.x0; x < data.x1; ++x, ++i) {
                const std::uint32_t v = (static_cast<std::uint32_t>(x * 7919 + y * 104729) ^ seed) * 2654435761u;
                if (is_id) {
                    channel.as<std::uint32_t>()[i] = v >> 28;
                } else {
                    channel.as<float>()[i] = static_cast<float>(v >> 20) / 4096;
                }
            }
        }
    }
    return image;
}

std::string write_band(const TemporaryFolder& folder, const std::string& name, PixelRect data,
                       const ExrOptions& options = {}, std::uint32_t seed = 1, PixelRect display = {0, 0, 40, 200}) {
    write_exr(folder.file(name), picture(display, data, seed), options);
    return folder.file(name);
}

std::string error_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ExrBands, JoinedBandsAreTheBytesOfTheWhole) {
    const TemporaryFolder folder;
    for (const std::uint64_t trial : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}) {
        SCOPED_TRACE(trial);
        Random random(trial);
        // The picture may begin above and left of the display window, as with overscan.
        const int x0 = random.integer(-4, 4), y0 = random.integer(-4, 4);
        const PixelRect whole{x0, y0, x0 + 1 + random.integer(0, 39), y0 + 1 + random.integer(0, 189)};
        const ExrOptions options{1, {{"burin/fingerprint", "0123456789abcdef"}}};
        const std::string expected = read_file(write_band(folder, "whole.exr", whole, options));
        std::vector<std::string> bands;
        for (int y = whole.y0; y < whole.y1;) {
            const int end = std::min(whole.y1, y + 16 * (1 + random.integer(0, 3)));
            bands.push_back(write_band(folder, "band" + std::to_string(bands.size()) + ".exr",
                                       {whole.x0, y, whole.x1, end}, options));
            y = end;
        }
        for (std::size_t i = bands.size(); i > 1; --i) std::swap(bands[i - 1], bands[random.bits() % i]);
        join_exr_bands(bands, folder.file("joined.exr"));
        EXPECT_TRUE(read_file(folder.file("joined.exr")) == expected) << bands.size() << " bands";
    }
}

TEST(ExrBands, WhatDoesNotFitIsRefusedWithItsName) {
    const TemporaryFolder folder;
    const std::string top = write_band(folder, "top.exr", {0, 0, 40, 32});
    const auto joined = [&](const std::string& other) {
        return error_of([&] { join_exr_bands({top, other}, folder.file("joined.exr")); });
    };
    const std::string gap = write_band(folder, "gap.exr", {0, 48, 40, 64});
    EXPECT_EQ(joined(gap),
              gap + ": begins at row 48, but " + top + " ends before row 32; the rows between are missing");
    const std::string twice = write_band(folder, "twice.exr", {0, 16, 40, 64});
    EXPECT_EQ(joined(twice), twice + ": begins at row 16, which " + top + " has, too");
    EXPECT_EQ(joined(top), top + ": begins at row 0, which " + top + " has, too");
    const std::string narrow = write_band(folder, "narrow.exr", {0, 32, 39, 64});
    EXPECT_EQ(joined(narrow), narrow + ": has other columns than " + top);
    const std::string other = write_band(folder, "other.exr", {0, 32, 40, 64}, {}, 1, {0, 0, 40, 201});
    EXPECT_TRUE(joined(other).starts_with(other + ": its attribute 'displayWindow' differs from that of " + top));
    const std::string named = write_band(folder, "named.exr", {0, 32, 40, 64}, {1, {{"comment", "x"}}});
    EXPECT_TRUE(joined(named).starts_with(named + ": its attribute 'comment' differs")) << joined(named);
    const std::string uneven = write_band(folder, "uneven.exr", {0, 0, 40, 31});
    const std::string below = write_band(folder, "below.exr", {0, 31, 40, 64});
    EXPECT_EQ(error_of([&] {
                  join_exr_bands({below, uneven}, folder.file("joined.exr"));
              }),
              below + ": begins at row 31, not at a multiple of 16");
    EXPECT_EQ(joined(folder.file("none.exr")).find(folder.file("none.exr") + ": "), 0u);
    EXPECT_EQ(folder.names().size(), 8u) << "nothing is written where bands do not fit";
}

TEST(ExrBands, HalfAFileIsRefused) {
    const TemporaryFolder folder;
    const std::string path = write_band(folder, "whole.exr", {0, 0, 40, 100});
    const std::string bytes = read_file(path);
    for (std::size_t length = 1; length < bytes.size(); length += 1 + length / 7) {
        folder.write("cut.exr", bytes.substr(0, length));
        const std::string error =
            error_of([&] { join_exr_bands({folder.file("cut.exr")}, folder.file("joined.exr")); });
        EXPECT_TRUE(error.starts_with(folder.file("cut.exr") + ": ")) << length << ": " << error;
    }
    // A writer that was killed leaves zeros in the table, which stands behind the header.
    const ExrContainer whole = parse_exr_container("whole", bytes);
    const std::size_t first_chunk = static_cast<std::size_t>(whole.parts[0].chunks[0].data() - bytes.data());
    std::string unfinished = bytes;
    std::memset(unfinished.data() + first_chunk - 8, 0, 8);
    EXPECT_EQ(error_of([&] { parse_exr_container("x.exr", unfinished); }),
              "x.exr: it is half written: rows from 96 on are missing");
}

/// Changed bytes give an error or a container whose chunks lie within the file.
TEST(ExrContainer, MutatedFilesAreReadOrRefused) {
    const TemporaryFolder folder;
    const std::string bytes = read_file(write_band(folder, "whole.exr", {0, 0, 9, 40}));
    int read = 0, refused = 0;
    for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::string mutated = bytes;
        for (int n = random.integer(1, 3); n > 0; --n) {
            // Headers and tables are what is read: most changes are there.
            const std::size_t reach =
                random.integer(0, 3) == 0 ? mutated.size() : std::min<std::size_t>(400, mutated.size());
            mutated[random.bits() % reach] = static_cast<char>(random.bits());
        }
        if (random.integer(0, 7) == 0) mutated.resize(random.bits() % mutated.size());
        try {
            const ExrContainer file = parse_exr_container("x.exr", mutated);
            for (const ContainedPart& part : file.parts) {
                for (const std::string_view chunk : part.chunks) {
                    ASSERT_GE(chunk.data(), mutated.data());
                    ASSERT_LE(chunk.data() + chunk.size(), mutated.data() + mutated.size());
                }
            }
            ++read;
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(read, 1000);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace burin::exr_bands_test
