// A film in bands, which are handed on while the picture is drawn, is the same picture.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "base/error.h"
#include "base/stream_store.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin {
namespace {

using namespace test;

constexpr int kWidth = 70, kHeight = 330;
const LayerSet kAllLayers{true, true, true, true, true, true, true, true};

/// A torus and loose polygons over a tall picture, with some style.
Scene styled_scene(Random& random) {
    PolygonSoup loose;
    for (std::uint32_t i = 0; i < 25; ++i) {
        const glm::dvec3 center = random.in_box(1) * glm::dvec3(1, 4, 1);
        for (int k = 0; k < 3; ++k) loose.positions.push_back(center + random.direction() * random.real(0.1, 1.5));
        loose.add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 1, 3 * i + 2});
    }
    Scene scene = scene_of({make_torus(0.9, 0.4, 40, 25), loose});
    scene.lines.classes = LineClassSet::all();
    LineStyle& style = scene.lines.style;
    style.width_px = std::exp(random.real(std::log(0.3), std::log(40)));
    const auto one_in = [&](int count) { return random.integer(1, count) == 1; };
    if (one_in(3)) style.filter = PixelFilter::mitchell;
    if (one_in(3)) style.side = StrokeSide::outside;
    if (one_in(4)) style.hidden.style = one_in(2) ? HiddenStyle::solid : HiddenStyle::dashed;
    if (one_in(4)) style.dash_px = {5, 3};
    if (one_in(4)) scene.lines.contours = Contours::smooth;
    if (one_in(3)) scene.materials.front().opacity = 0.5f;
    if (one_in(3)) scene.abuffer.samples = 4;
    return scene;
}

/// A band with the pixels of the blocks that are missing.
Image filled(const ImageStrip& strip, const std::vector<ChannelFormat>& channels) {
    Image image(strip.data, strip.data);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const std::size_t size = size_of(channels[c].type);
        auto to = image.add(channels[c].name, channels[c].type).bytes.begin();
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const Image* const block = strip.blocks[static_cast<std::size_t>(x / strip.block_width)];
                const std::byte* pixel = strip.background[c].data();
                if (block != nullptr) {
                    const int at = y * block->width() + x % strip.block_width;
                    pixel = block->channels()[c].bytes.data() + static_cast<std::size_t>(at) * size;
                }
                to = std::copy_n(pixel, size, to);
            }
        }
    }
    return image;
}

/// The bands that a render hands on, each of which it hands on once.
std::map<int, Image> bands_of(const Frame& frame, const RunOptions& given, const LayerSet& layers) {
    Film film = Film::in_bands({0, 0, kWidth, kHeight}, frame.crop, layers, frame.criteria.classes);
    std::map<int, Image> bands;
    std::mutex mutex;
    RunOptions options = given;
    options.finished_band = [&](std::size_t number) {
        Image band = filled(film.band(number), film.channels());
        const int y0 = band.data().y0;
        const std::lock_guard lock(mutex);
        EXPECT_TRUE(bands.emplace(y0, std::move(band)).second) << "twice: band " << number;
        film.close(number);
    };
    render_abuffer(frame, options, film);
    return bands;
}

TEST(FilmBands, AreRowsOfTheWholeFilm) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Scene scene = styled_scene(random);
        const PreparedScene prepared = prepare_for_abuffer(scene, 1);
        PixelRect crop{0, 0, kWidth, kHeight};
        if (seed % 3 == 0)
            crop = {random.integer(0, 20), random.integer(0, 150), random.integer(40, kWidth),
                    random.integer(151, kHeight)};
        const Frame frame =
            make_frame(scene, perspective_camera({2, 1, 14}, {0, 0, 0}), kWidth, kHeight, crop, &prepared);
        RunOptions options;
        options.threads = random.integer(1, 4);
        options.tile_samples = 32 << random.integer(0, 2);
        if (seed % 4 == 0) options.memory_bytes = std::uint64_t{80} << 20;
        LayerSet layers = kAllLayers;
        if (seed % 5 == 1) layers.depth = layers.ids = false;
        if (seed % 5 == 2) layers.normal = layers.surface = false;
        Film film({0, 0, kWidth, kHeight}, crop, layers, frame.criteria.classes);
        render_abuffer(frame, options, film);
        const Image& whole = film.image();
        int y = crop.y0;
        for (const auto& [y0, band] : bands_of(frame, options, layers)) {
            ASSERT_EQ(y0, y);
            ASSERT_EQ(band.data(), (PixelRect{crop.x0, y, crop.x1, std::min(y + Film::kBandRows, crop.y1)}));
            for (const Channel& channel : band.channels()) {
                const Channel& same = *whole.find(channel.name);
                const std::size_t row_bytes = size_of(channel.type) * static_cast<std::size_t>(crop.width());
                const auto* const first = same.bytes.data() + static_cast<std::size_t>(y - crop.y0) * row_bytes;
                ASSERT_TRUE(std::equal(channel.bytes.begin(), channel.bytes.end(), first))
                    << channel.name << ", band at " << y;
            }
            y = band.data().y1;
        }
        EXPECT_EQ(y, crop.y1);
    }
}

/// A film that has a picture already becomes the next one all the same, whatever was where.
TEST(Film, TakesOnePictureAfterTheOther) {
    constexpr int kPictureHeight = 90;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const PixelRect display{0, 0, kWidth, kPictureHeight};
        const PixelRect crop = seed % 3 == 0 ? PixelRect{random.integer(0, 20), random.integer(0, 30),
                                                         random.integer(40, kWidth), kPictureHeight - 1}
                                             : display;
        LayerSet layers = kAllLayers;
        if (seed % 4 == 1) layers.depth = layers.lines = layers.lines_hidden = false;
        Film film(display, crop, layers, LineClassSet::all());
        for (int picture = 0; picture < 4; ++picture) {
            Scene scene = styled_scene(random);
            const PreparedScene prepared = prepare_for_abuffer(scene, 1);
            // Near, far away, and beside the picture.
            const Camera camera =
                perspective_camera({random.real(-3, 3), random.real(-3, 3), random.real(3, 25)}, random.in_box(2));
            const Frame frame = make_frame(scene, camera, kWidth, kPictureHeight, crop, &prepared);
            RunOptions options;
            options.threads = random.integer(1, 3);
            Film fresh(display, crop, layers, LineClassSet::all());
            render_abuffer(frame, options, fresh);
            render_abuffer(frame, options, film);
            ASSERT_TRUE(same_bits(film.image(), fresh.image())) << "picture " << picture;
        }
    }
}

/// Whatever draws into a pixel, alone in its row, the next picture begins there as background.
TEST(Film, ForgetsWhatWasDrawnIntoIt) {
    const PixelRect all{0, 0, 150, 9};
    const auto blank = [&](Film& film) {
        for (int y = all.y0; y < all.y1; ++y) film.put_background(all.x0, all.x1, y);
        finish_stream_stores();
    };
    const auto film_of = [&] { return Film(all, all, kAllLayers, LineClassSet::all()); };
    Film fresh = film_of();
    blank(fresh);
    const glm::vec4 ink(0.25f, 0.5f, 0.75f, 1.0f);
    LinePixel lines;
    lines.color = ink;
    lines.coverage.fill(0.5f);
    PixelResult pixel;
    pixel.beauty = pixel.lines = ink;
    pixel.distance = 3;
    pixel.object_id = 7;
    const std::vector<std::function<void(Film&)>> writers{
        [&](Film& film) { film.draw_over(70, 4, lines); },
        [&](Film& film) { film.add_lines(70, 4, lines); },
        [&](Film& film) { film.draw_hidden(70, 4, HiddenInk(ink, ink)); },
        [&](Film& film) { film.replace_surface(70, 4, ink); },
        [&](Film& film) { film.put(70, 4, pixel); },
        [&](Film& film) {
            film.expect_all_of({70, 4, 71, 5});
            film.put_color(70, 71, 4, {1, 2, 3, 4});
        }};
    for (std::size_t i = 0; i < writers.size(); ++i) {
        for (const bool ends : {false, true}) {
            Film film = film_of();
            blank(film);
            film.end_picture();  // what comes is all that it knows of
            blank(film);
            writers[i](film);
            EXPECT_FALSE(same_bits(film.image(), fresh.image())) << "writer " << i;
            if (ends) film.end_picture();
            blank(film);
            EXPECT_TRUE(same_bits(film.image(), fresh.image())) << "writer " << i;
        }
    }
}

/// Only what something is drawn into takes memory, also where it is drawn by a line alone.
TEST(FilmBands, BackgroundIsNotThere) {
    Scene scene = scene_of({make_torus(0.9, 0.4, 40, 25)});
    const PreparedScene prepared = prepare_for_abuffer(scene, 1);
    constexpr int kSide = 640;
    const PixelRect crop{3, 5, kSide, kSide};
    const Frame frame = make_frame(scene, perspective_camera({2, 1, 14}, {0, 0, 0}), kSide, kSide, crop, &prepared);
    Film film = Film::in_bands({0, 0, kSide, kSide}, crop, kAllLayers, frame.criteria.classes);
    Film whole({0, 0, kSide, kSide}, crop, kAllLayers, frame.criteria.classes);
    RunOptions options;
    options.threads = 2;
    render_abuffer(frame, options, whole);
    std::mutex mutex;
    std::size_t needless = 0, there = 0;
    options.finished_band = [&](std::size_t number) {
        const ImageStrip strip = film.band(number);
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < strip.blocks.size(); ++i) {
            if (strip.blocks[i] == nullptr) continue;
            ++there;
            const Channel& alpha = *strip.blocks[i]->find("A");
            needless += std::ranges::all_of(alpha.bytes, [](std::byte b) { return b == std::byte{0}; }) ? 1u : 0u;
        }
        const Image band = filled(strip, film.channels());
        for (const Channel& channel : band.channels()) {
            const std::size_t before = static_cast<std::size_t>(strip.data.y0 - crop.y0) *
                                       static_cast<std::size_t>(crop.width()) * size_of(channel.type);
            EXPECT_TRUE(std::equal(channel.bytes.begin(), channel.bytes.end(),
                                   whole.image().find(channel.name)->bytes.data() + before))
                << channel.name;
        }
        film.close(number);
    };
    render_abuffer(frame, options, film);
    EXPECT_GT(there, 0u);
    EXPECT_EQ(needless, 0u);
}

TEST(FilmBands, WhatStopsTheirWriterStopsTheRender) {
    Random random(1);
    const Scene scene = styled_scene(random);
    const Frame frame =
        make_frame(scene, perspective_camera({2, 1, 14}, {0, 0, 0}), kWidth, kHeight, {0, 0, kWidth, kHeight});
    for (const int threads : {1, 3}) {
        Film film = Film::in_bands({0, 0, kWidth, kHeight}, frame.crop, kAllLayers, frame.criteria.classes);
        RunOptions options;
        options.threads = threads;
        options.finished_band = [](std::size_t number) {
            if (number == 2) throw InputError("the disk is full");
        };
        EXPECT_THROW(render_abuffer(frame, options, film), InputError);
    }
}

}  // namespace
}  // namespace burin
