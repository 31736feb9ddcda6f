// A picture in pieces is the same picture: with a cap for memory, and with tiles of any size.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "abuffer/fine/fine_edges.h"
#include "abuffer/picture_slices.h"
#include "abuffer/slice_costs.h"
#include "base/error.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::memory_test {
namespace {

using namespace test;

constexpr int kWidth = 120, kHeight = 260;
const glm::dvec3 kEye(2, 1, 12);

/// A heap of instances of one mesh over the whole picture, some partly beside it, one around the eye, and
/// loose polygons between them.
Scene heap_of_instances(std::uint64_t seed) {
    Random random(seed);
    std::vector<PolygonSoup> objects{make_torus(0.7, 0.3, 110, 55), {}};
    for (std::uint32_t i = 0; i < 12; ++i) {
        const glm::dvec3 center = random.in_box(3);
        for (int k = 0; k < 3; ++k) objects[1].positions.push_back(center + random.direction() * random.real(0.5, 6));
        objects[1].add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 1, 3 * i + 2});
    }
    Scene scene = scene_of(std::move(objects));
    const SceneObject torus = scene.objects[0];
    for (int i = 0; i < 9; ++i) {
        SceneObject instance = torus;
        instance.to_world = glm::translate(glm::dmat4(1.0), random.in_box(1) * glm::dvec3(1.5, 3.5, 2)) *
                            glm::rotate(glm::dmat4(1.0), random.real(0, 3), random.direction());
        if (i == 7) instance.to_world = glm::translate(glm::dmat4(1.0), kEye);
        scene.objects.push_back(instance);
    }
    scene.lines.classes = LineClassSet::all();
    scene.abuffer.samples = 2;
    scene.abuffer.fine_lines = true;
    return scene;
}

/// Instances about as large as a sample, and smaller: some lie between the samples where pieces meet.
Scene dust(std::uint64_t seed) {
    Random random(seed);
    Scene scene = scene_of({make_torus(0.04, 0.015, 7, 5)});
    const SceneObject grain = scene.objects[0];
    for (int i = 0; i < 1500; ++i) {
        SceneObject instance = grain;
        const double size = random.real(0.05, 1);
        instance.to_world = glm::translate(glm::dmat4(1.0), random.in_box(1) * glm::dvec3(1.5, 3.5, 1)) *
                            glm::rotate(glm::dmat4(1.0), random.real(0, 3), random.direction()) *
                            glm::scale(glm::dmat4(1.0), glm::dvec3(size));
        scene.objects.push_back(instance);
    }
    scene.lines.classes = LineClassSet::all();
    return scene;
}

Frame frame_of(const Scene& scene, PixelRect crop) {
    return make_frame(scene, perspective_camera(kEye, {0, 0, 0}), kWidth, kHeight, crop);
}

Image draw(const Scene& scene, RunOptions options = {}, PixelRect crop = {0, 0, kWidth, kHeight}) {
    const Frame frame = frame_of(scene, crop);
    Film film({0, 0, kWidth, kHeight}, crop, LayerSet{true, true, true, true, true, true, true, true},
              frame.criteria.classes);
    render_abuffer(frame, options, film);
    return film.image();
}

constexpr int kTileSamples = 32;  // small tiles, to have many rows of them

/// What a refusal names.
template <typename Run>
std::uint64_t named_memory(const Run& run) {
    try {
        run();
    } catch (const InputError& error) {
        const std::string words = error.what(), before = "at least ";
        const std::size_t at = words.find(before);
        EXPECT_NE(at, std::string::npos) << words;
        return std::uint64_t{std::stoul(words.substr(at + before.size()))} << 20;
    }
    ADD_FAILURE() << "one byte is enough";
    return 0;
}

std::uint64_t least_memory(const Scene& scene, int threads, PixelRect crop = {0, 0, kWidth, kHeight}) {
    RunOptions options;
    options.threads = threads;
    options.memory_bytes = 1;
    options.tile_samples = kTileSamples;
    return named_memory([&] { draw(scene, options, crop); });
}

/// How many slices a picture has for visible surfaces, and for all surfaces where hidden ones count.
std::array<std::size_t, 2> count_pieces(const Scene& scene, std::uint64_t cap_bytes, int threads) {
    const Frame frame = frame_of(scene, {0, 0, kWidth, kHeight});
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), threads, false);
    const PixelTiles tiles({-8, -8, kWidth + 8, kHeight + 8}, kTileSamples / 2);
    const SlicePlan plan = plan_slices(frame, screen, tiles, cap_bytes, threads);
    int row = 0;
    for (const PictureSlice& piece : plan.visible) {  // one after the other, none left out
        EXPECT_EQ(piece.rows.begin, row);
        EXPECT_LT(piece.rows.begin, piece.rows.end);
        row = piece.rows.end;
    }
    EXPECT_EQ(row, tiles.rows().end);
    return {plan.visible.size(), plan.layers.size()};
}

TEST(Memory, ACapChangesNothing) {
    for (const HiddenStyle style : {HiddenStyle::none, HiddenStyle::solid, HiddenStyle::dashed}) {
        Scene scene = heap_of_instances(1);
        scene.lines.style.hidden.style = style;
        scene.lines.style.width_px = style == HiddenStyle::solid ? 9 : 1;
        const Image whole = draw(scene);
        for (const int threads : {1, 3}) {
            const std::uint64_t least = least_memory(scene, threads);
            for (const std::uint64_t more : {0u, 1u, 100u}) {
                if (more > 0 && threads > 1) continue;
                RunOptions options;
                options.threads = threads;
                options.tile_samples = kTileSamples;
                options.memory_bytes = least + (more << 20);
                EXPECT_TRUE(same_bits(whole, draw(scene, options)))
                    << "style " << static_cast<int>(style) << ", threads " << threads << ", " << more << " MB more";
            }
        }
    }
}

TEST(Memory, NothingIsLostBetweenTheSamplesOfPieces) {
    for (const int samples : {2, 4}) {
        Scene scene = dust(5);
        scene.abuffer.samples = samples;
        scene.abuffer.fine_lines = true;
        const Image whole = draw(scene);
        RunOptions options;
        options.threads = 1;
        options.tile_samples = kTileSamples;
        options.memory_bytes = least_memory(scene, 1);
        EXPECT_TRUE(same_bits(whole, draw(scene, options))) << samples << " samples";
    }
}

TEST(Memory, ACapChangesNothingBehindTransparentSurfacesAndInACrop) {
    Scene scene = heap_of_instances(2);
    for (Material& m : scene.materials) m.opacity = 0.5f;
    const PixelRect crop{13, 37, 101, 239};
    const Image whole = draw(scene, {}, crop);
    RunOptions options;
    options.threads = 2;
    options.tile_samples = kTileSamples;
    options.memory_bytes = least_memory(scene, 2, crop);
    EXPECT_TRUE(same_bits(whole, draw(scene, options, crop)));
}

/// With hidden lines every thread holds a tile with all its triangles, in any layer.
TEST(Memory, TheFullestTileCountsForEveryThread) {
    constexpr int kMore = 64;  // the least cap is rounded to megabytes
    const auto mb_per_thread = [](int segments, HiddenStyle style) {
        Scene scene = scene_of({make_torus(0.7, 0.3, segments, segments / 2)});
        scene.lines.style.hidden.style = style;
        return static_cast<double>((least_memory(scene, 1 + kMore) - least_memory(scene, 1)) >> 20) / kMore;
    };
    const double plain = mb_per_thread(200, HiddenStyle::none);
    const double some = mb_per_thread(200, HiddenStyle::solid) - plain;
    EXPECT_GT(some, 0.1);
    EXPECT_GT(mb_per_thread(400, HiddenStyle::solid) - plain, 3 * some) << "four times as many triangles in a tile";
}

/// Lists are counted as found and as sorted. Borders, which have one side only, do not count half.
TEST(Memory, ListsOfEdgesAreCountedFromAbove) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random(seed);
        PolygonSoup loose;
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const glm::dvec3 center = random.in_box(1) * glm::dvec3(1.5, 3.5, 1);
            for (int k = 0; k < 3; ++k) loose.positions.push_back(center + random.direction() * random.real(0.01, 0.3));
            loose.add_polygon(std::vector<std::uint32_t>{3 * i, 3 * i + 1, 3 * i + 2});
        }
        const Scene scene = seed % 2 == 0 ? scene_of({loose}) : heap_of_instances(seed);
        const Frame frame = frame_of(scene, {0, 0, kWidth, kHeight});
        constexpr int kSamples = 2;
        const PixelTiles tiles({0, 0, 120, 264}, kTileSamples / kSamples);
        ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), 1);
        const auto rows = [&](bool has_fine) {
            SliceCosts costs(tiles, nullptr, kSamples, has_fine, 1);
            costs.add(screen);
            return costs.visible().bins;
        };
        const std::vector<std::uint64_t> plain = rows(false), all = rows(true);
        const PossibleLines possible(screen, 1);
        const FineEdges edges(screen, &possible, {}, tiles, kSamples, 1);
        std::uint64_t count = 0;
        for (std::size_t row = 0; row < all.size(); ++row) {
            std::uint64_t in_row = 0;
            for (int column = 0; column < tiles.columns(); ++column) {
                in_row +=
                    edges.in(row * static_cast<std::size_t>(tiles.columns()) + static_cast<std::size_t>(column)).size();
            }
            using List = TileLists<TileEdge>;
            EXPECT_GE(all[row] - plain[row], in_row * (2 * sizeof(List::Record) + sizeof(TileEdge)))
                << "seed " << seed << " row " << row;
            count += in_row;
        }
        EXPECT_GT(count, 1000u);
    }
}

TEST(Memory, LinesThatOthersDependOnAreKeptToTheEnd) {
    Scene scene = heap_of_instances(4);
    const std::uint64_t plain = least_memory(scene, 1);
    for (const bool is_dashed : {true, false}) {
        scene.lines.style.dash_px.reset();
        if (is_dashed) scene.lines.style.dash_px = {7.0, 4.0};
        scene.lines.contours = is_dashed ? Contours::mesh : Contours::smooth;
        RunOptions options;
        options.threads = 1;
        options.tile_samples = kTileSamples;
        options.memory_bytes = least_memory(scene, 1);
        EXPECT_GT(options.memory_bytes, plain);
        EXPECT_GE(count_pieces(scene, options.memory_bytes, 1)[0], 2u);
        EXPECT_TRUE(same_bits(draw(scene), draw(scene, options))) << (is_dashed ? "dashed" : "smooth");
    }
}

TEST(Memory, TheLeastCapTakesMorePiecesThanALargeOne) {
    Scene scene = heap_of_instances(1);
    const auto least = [&] { return named_memory([&] { count_pieces(scene, 1, 1); }); };
    EXPECT_GE(count_pieces(scene, least(), 1)[0], 2u);
    scene.lines.style.hidden.style = HiddenStyle::solid;
    EXPECT_GE(count_pieces(scene, least(), 1)[1], 2u);
    const auto [one, other] = count_pieces(scene, std::uint64_t{1} << 40, 1);
    EXPECT_EQ(one, 1u);
    EXPECT_EQ(other, 1u);
}

TEST(Memory, LessThanTheLeastIsRefusedWithIt) {
    const Scene scene = heap_of_instances(1);
    const std::uint64_t least = least_memory(scene, 2);
    RunOptions options;
    options.threads = 2;
    options.tile_samples = kTileSamples;
    options.memory_bytes = least - (1 << 20);
    EXPECT_THROW(draw(scene, options), InputError);
    options.memory_bytes = least;
    EXPECT_NO_THROW(draw(scene, options));
}

TEST(Memory, ASceneWithNothingInThePictureNeedsLittle) {
    Scene scene = heap_of_instances(1);
    for (SceneObject& o : scene.objects) o.to_world = glm::translate(glm::dmat4(1.0), glm::dvec3(1000, 0, 0));
    RunOptions options;
    options.threads = 1;
    options.memory_bytes = 16 << 20;
    EXPECT_TRUE(same_bits(draw(scene), draw(scene, options)));
}

TEST(Tiles, WholeTilesMayLieBesideThePicture) {
    Scene scene = heap_of_instances(1);
    scene.lines.style.width_px = 300;
    const PixelRect crop{50, 120, 70, 140};
    const Image whole = draw(scene), part = draw(scene, {}, crop);
    const Channel &a = *whole.find("lines.A"), &b = *part.find("lines.A");
    for (int y = 0; y < crop.height(); ++y) {
        for (int x = 0; x < crop.width(); ++x) ASSERT_EQ(part.value(b, x, y), whole.value(a, x + crop.x0, y + crop.y0));
    }
}

TEST(Tiles, TheirSizeChangesNothing) {
    Scene scene = heap_of_instances(3);
    for (const int samples : {2, 4, 8}) {
        scene.abuffer.samples = samples;
        const Image best = draw(scene);
        for (int tile = 8 * samples; tile <= 128; tile *= 2) {
            RunOptions options;
            options.tile_samples = tile;
            EXPECT_TRUE(same_bits(best, draw(scene, options))) << samples << " samples, tiles of " << tile;
        }
    }
}

}  // namespace
}  // namespace burin::memory_test
