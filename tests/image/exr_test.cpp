#include "image/exr_io.h"
#include "image/exr_reader.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <regex>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "image/half.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

using test::Random;
using test::read_file;
using test::TemporaryFolder;

/// Channels of all three types, filled with noise.
Image noise_image(PixelRect display, PixelRect data, std::uint64_t seed) {
    Random random(seed);
    Image image(display, data);
    for (const char* name : {"R", "G", "B", "A", "lines.A"}) {
        for (std::uint16_t& v : image.add(name, PixelType::float16).as<std::uint16_t>()) {
            v = half_from_float(static_cast<float>(random.real(0, 1)));
        }
    }
    for (const char* name : {"Z", "N.X"}) {
        for (float& v : image.add(name, PixelType::float32).as<float>()) {
            v = static_cast<float>(random.real(-1e6, 1e6));
        }
    }
    for (const char* name : {"id.object", "id.polygon"}) {
        for (std::uint32_t& v : image.add(name, PixelType::uint32).as<std::uint32_t>()) v = random.bits();
    }
    return image;
}

void expect_equal(const Image& a, const Image& b) {
    EXPECT_EQ(a.display(), b.display());
    EXPECT_EQ(a.data(), b.data());
    ASSERT_EQ(a.channels().size(), b.channels().size());
    for (const Channel& channel : a.channels()) {
        const Channel* const other = b.find(channel.name);
        ASSERT_NE(other, nullptr) << channel.name;
        EXPECT_EQ(channel.type, other->type) << channel.name;
        EXPECT_TRUE(channel.bytes == other->bytes) << channel.name;
    }
}

TEST(Exr, AllTypesAndWindowsSurvive) {
    const TemporaryFolder folder;
    const PixelRect windows[][2] = {
        {{0, 0, 37, 23}, {0, 0, 37, 23}},    // the usual case
        {{0, 0, 64, 48}, {5, 7, 33, 41}},    // a crop
        {{0, 0, 64, 48}, {63, 47, 64, 48}},  // one pixel in the corner
        {{-8, -6, 20, 30}, {-8, 2, 20, 9}},  // windows may start anywhere
        {{0, 0, 3, 700}, {0, 0, 3, 700}},    // more rows than are written at once
    };
    std::uint64_t seed = 0;
    for (const auto& [display, data] : windows) {
        const Image image = noise_image(display, data, ++seed);
        write_exr(folder.file("a.exr"), image, {});
        expect_equal(image, read_exr(folder.file("a.exr")));
    }
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST(Exr, SpecialNumbersSurvive) {
    const TemporaryFolder folder;
    Image image({0, 0, 6, 1}, {0, 0, 6, 1});
    image.add("Z", PixelType::float32);
    image.add("id.polygon", PixelType::uint32);
    const float depths[] = {INFINITY, -INFINITY, 0.0f, -0.0f, 1e-45f, 3.4e38f};
    // A float holds none of the larger ones exactly.
    const std::uint32_t ids[] = {0, 1, 16777217, 2147483649u, 4294967294u, 4294967295u};
    std::memcpy(image.find("Z")->bytes.data(), depths, sizeof depths);
    std::memcpy(image.find("id.polygon")->bytes.data(), ids, sizeof ids);
    write_exr(folder.file("a.exr"), image, {});
    const Image back = read_exr(folder.file("a.exr"));
    expect_equal(image, back);
    EXPECT_EQ(back.value(*back.find("id.polygon"), 3, 0), 2147483649.0);
}

TEST(Exr, EqualImagesGiveEqualFiles) {
    const TemporaryFolder folder;
    const Image image = noise_image({0, 0, 200, 300}, {10, 0, 190, 300}, 5);
    write_exr(folder.file("1.exr"), image, {1, {{"software", "burin"}}});
    const std::string first = read_file(folder.file("1.exr"));
    for (const int threads : {1, 2, 3, 8, 1000}) {
        write_exr(folder.file("2.exr"), image, {threads, {{"software", "burin"}}});
        EXPECT_TRUE(read_file(folder.file("2.exr")) == first) << threads << " threads";
    }
}

TEST(Exr, TheHeaderHasTextsAndNoDate) {
    const TemporaryFolder folder;
    write_exr(folder.file("a.exr"), noise_image({0, 0, 8, 8}, {0, 0, 8, 8}, 1), {1, {{"software", "burin 1"}}});
    const std::string header = read_file(folder.file("a.exr")).substr(0, 1000);
    EXPECT_NE(header.find("software"), std::string::npos);
    EXPECT_NE(header.find("burin 1"), std::string::npos);
    EXPECT_EQ(header.find("capDate"), std::string::npos);
    EXPECT_FALSE(std::regex_search(header, std::regex("(19|20)[0-9][0-9][:/-]")));
}

TEST(Exr, AFullDiskLeavesNothing) {
    const TemporaryFolder folder;
    const Image image = noise_image({0, 0, 100, 100}, {0, 0, 100, 100}, 1);
    write_exr(folder.file("whole.exr"), image, {});
    const std::size_t size = read_file(folder.file("whole.exr")).size();
    folder.write("a.exr", "old");

    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const std::size_t limit : {std::size_t{0}, std::size_t{100}, size / 2, size - 1}) {
        const rlimit small{limit, old.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
        EXPECT_THROW(write_exr(folder.file("a.exr"), image, {}), InputError) << limit;
        EXPECT_THROW(write_exr(folder.file("a.exr"), image, {4, {}}), InputError) << limit;
    }
    setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_EQ(read_file(folder.file("a.exr")), "old");
    EXPECT_EQ(folder.names().size(), 2u);
}

TEST(Exr, RowsMayComeInAnyOrder) {
    const TemporaryFolder folder;
    Random random(3);
    const PixelRect data{3, -5, 40, 130};
    const Image image = noise_image({0, -5, 64, 140}, data, 5);
    write_exr(folder.file("whole.exr"), image, {});
    std::vector<int> rows;
    for (int y = data.y0; y < data.y1; y += ExrWriter::kChunkRows) rows.push_back(y);
    for (const int threads : {1, 3}) {
        for (std::size_t i = rows.size(); i > 1; --i)
            std::swap(rows[i - 1], rows[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
        ExrWriter writer(folder.file("rows.exr"), image.display(), data, image.formats(), {});
        parallel_for(rows.size(), threads, [&](std::size_t i, int) {
            // A part of the image that has these rows, and sometimes more.
            PixelRect part_rows = data;
            part_rows.y0 = std::max(data.y0, rows[i] - (i % 2 == 0 ? 0 : ExrWriter::kChunkRows));
            part_rows.y1 = std::min(data.y1, rows[i] + ExrWriter::kChunkRows);
            Image part(image.display(), part_rows);
            for (const Channel& c : image.channels()) {
                Channel& copy = part.add(c.name, c.type);
                const std::size_t row_bytes = copy.bytes.size() / static_cast<std::size_t>(part.height());
                std::copy_n(c.bytes.begin() + static_cast<std::ptrdiff_t>(
                                                  row_bytes * static_cast<std::size_t>(part_rows.y0 - data.y0)),
                            copy.bytes.size(), copy.bytes.begin());
            }
            writer.write_chunk(strip_of(part), rows[i]);
        });
        EXPECT_FALSE(std::filesystem::exists(folder.file("rows.exr"))) << "nothing under the name before the end";
        writer.finish();
        EXPECT_TRUE(read_file(folder.file("rows.exr")) == read_file(folder.file("whole.exr"))) << threads;
        std::filesystem::remove(folder.file("rows.exr"));
    }
}

TEST(Exr, MissingBlocksAreBackground) {
    const TemporaryFolder folder;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const int width = random.integer(1, 90), height = random.integer(1, 40), block_width = random.integer(1, 40);
        const PixelRect data{-7, 3, width - 7, height + 3};
        Image image = noise_image({-7, 0, 100, 100}, data, seed);
        // Blocks of their own for what is there, and the background in the image for the others.
        ImageStrip strip{data, block_width, {}, {}};
        for (const Channel& c : image.channels()) {
            auto& bytes = strip.background.emplace_back();
            const bool is_plain = random.integer(0, 1) == 0;
            for (std::byte& b : bytes) b = is_plain ? std::byte{0} : static_cast<std::byte>(random.bits());
            static_cast<void>(c);
        }
        std::vector<std::unique_ptr<Image>> blocks;
        for (int x0 = 0; x0 < width; x0 += block_width) {
            const int x1 = std::min(x0 + block_width, width);
            const bool is_there = random.integer(0, 2) == 0;
            auto block = std::make_unique<Image>(data, PixelRect{data.x0 + x0, data.y0, data.x0 + x1, data.y1});
            for (std::size_t c = 0; c < image.channels().size(); ++c) {
                const std::size_t size = size_of(image.channels()[c].type);
                Channel& all = *image.find(image.channels()[c].name);
                Channel& own = block->add(all.name, all.type);
                for (int y = 0; y < height; ++y) {
                    for (int x = x0; x < x1; ++x) {
                        std::byte* const pixel = all.bytes.data() + static_cast<std::size_t>(y * width + x) * size;
                        if (is_there) {
                            std::copy_n(pixel, size,
                                        own.bytes.data() + static_cast<std::size_t>(y * (x1 - x0) + x - x0) * size);
                        } else {
                            std::copy_n(strip.background[c].data(), size, pixel);
                        }
                    }
                }
            }
            strip.blocks.push_back(is_there ? block.get() : nullptr);
            blocks.push_back(std::move(block));
        }
        write_exr(folder.file("whole.exr"), image, {});
        ExrWriter writer(folder.file("blocks.exr"), image.display(), data, image.formats(), {});
        for (int y = data.y0; y < data.y1; y += ExrWriter::kChunkRows) writer.write_chunk(strip, y);
        writer.finish();
        EXPECT_TRUE(read_file(folder.file("blocks.exr")) == read_file(folder.file("whole.exr")));
    }
}

TEST(Exr, AFileWithRowsMissingIsNone) {
    const TemporaryFolder folder;
    const Image image = noise_image({0, 0, 20, 40}, {0, 0, 20, 40}, 5);
    {
        ExrWriter writer(folder.file("a.exr"), image.display(), image.data(), image.formats(), {});
        writer.write_chunk(strip_of(image), 0);
        writer.write_chunk(strip_of(image), 32);
        EXPECT_THROW(writer.finish(), InputError);
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(Exr, AnInterruptLeavesNothing) {
    const TemporaryFolder folder;
    const Image image = noise_image({0, 0, 4, 4}, {0, 0, 4, 4}, 1);
    // In a process of its own: an interrupt cannot be taken back.
    const auto write_interrupted = [&] {
        install_interrupt_handlers();
        std::raise(SIGINT);
        try {
            write_exr(folder.file("a.exr"), image, {});
        } catch (const Interrupted&) {
            std::_Exit(folder.names().empty() ? 77 : 1);
        }
        std::_Exit(2);
    };
    EXPECT_EXIT(write_interrupted(), testing::ExitedWithCode(77), "");
}

TEST(Exr, RefusesWhatItCannotWriteOrRead) {
    const TemporaryFolder folder;
    const Image image = noise_image({0, 0, 4, 4}, {0, 0, 4, 4}, 1);
    EXPECT_THROW(write_exr(folder.file("missing/a.exr"), image, {}), InputError);
    EXPECT_THROW(write_exr(folder.path(), image, {}), InputError);
    EXPECT_THROW(write_exr(folder.file("empty.exr"), Image({0, 0, 4, 4}, {0, 0, 4, 4}), {}), InputError);
    EXPECT_TRUE(folder.names().empty());

    EXPECT_THROW(read_exr(folder.file("missing.exr")), InputError);
    EXPECT_THROW(read_exr(folder.write("text.exr", "this is no image")), InputError);
    write_exr(folder.file("a.exr"), image, {});
    const std::string bytes = read_file(folder.file("a.exr"));
    EXPECT_THROW(read_exr(folder.write("cut.exr", bytes.substr(0, bytes.size() / 2))), InputError);
}

TEST(Image, ValuesOfEveryTypeAreNumbers) {
    Image image({0, 0, 2, 2}, {0, 0, 2, 2});
    image.add("h", PixelType::float16).as<std::uint16_t>()[3] = half_from_float(0.25f);
    image.add("f", PixelType::float32).as<float>()[1] = -7.5f;
    image.add("u", PixelType::uint32).as<std::uint32_t>()[2] = 4000000000u;
    EXPECT_EQ(image.value(*image.find("h"), 1, 1), 0.25);
    EXPECT_EQ(image.value(*image.find("f"), 1, 0), -7.5);
    EXPECT_EQ(image.value(*image.find("u"), 0, 1), 4e9);
    EXPECT_EQ(image.value(*image.find("u"), 1, 1), 0);
    EXPECT_EQ(image.find("x"), nullptr);
    EXPECT_EQ(std::as_const(image).find("x"), nullptr);
}

}  // namespace
}  // namespace burin
