// What the options of render do to the picture and its file.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "image/exr_io.h"
#include "image/exr_reader.h"
#include "image/image_io.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::render_test {
namespace {

using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

class Render : public testing::Test {
  protected:
    Render() {
        folder_.write("cube.obj", kCubeObj);
        folder_.write("scene.toml", R"(
[[object]]
file = "cube.obj"
[[object]]
shape = "sphere"
radius = 1.3
segments = 16
rings = 8
translate = [0.5, 0.5, 0.5]
[[camera]]
name = "front"
eye = [0, 0, 9]
[[camera]]
name = "side"
eye = [9, 1, 2]
target = [0, 0, 0]
fov = 30
)");
    }

    /// Renders INPUT at 96x64 with more options; returns the file's bytes.
    std::string bytes(Arguments options, const std::string& output = "out.exr", const char* input = "cube.obj") const {
        Arguments arguments = {"render", input, "-r", "96x64", "-o", output};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramResult result = run_burin(folder_.path(), arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.out, "");
        return read_file(folder_.file(output));
    }
    Image exr(const Arguments& options, const char* input = "cube.obj") const {
        bytes(options, "out.exr", input);
        return read_exr(folder_.file("out.exr"));
    }
    DisplayImage picture(const Arguments& options, const std::string& output) const {
        bytes(options, output);
        return read_display_image(folder_.file(output));
    }

    TemporaryFolder folder_;
};

double sum(const Image& image, const std::string& channel) {
    double total = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) total += image.value(*image.find(channel), x, y);
    }
    return total;
}

/// Channel name -> type, in the order of the file.
std::map<std::string, PixelType> types(const Image& image) {
    std::map<std::string, PixelType> result;
    for (const Channel& c : image.channels()) result[c.name] = c.type;
    return result;
}

constexpr PixelType kHalf = PixelType::float16, kFloat = PixelType::float32, kUint = PixelType::uint32;

TEST_F(Render, AnExrHasTheDocumentedLayers) {
    const std::map<std::string, PixelType> usual = {
        {"R", kHalf},       {"G", kHalf},       {"B", kHalf},         {"A", kHalf},           {"lines.R", kHalf},
        {"lines.G", kHalf}, {"lines.B", kHalf}, {"lines.A", kHalf},   {"Z", kFloat},          {"N.X", kFloat},
        {"N.Y", kFloat},    {"N.Z", kFloat},    {"id.object", kUint}, {"id.material", kUint}, {"id.polygon", kUint}};
    EXPECT_EQ(types(exr({})), usual);
    EXPECT_EQ(types(exr({"--layers", "beauty,lines,Z,N,ids"})), usual);
}

TEST_F(Render, LayersByName) {
    using Types = std::map<std::string, PixelType>;
    EXPECT_EQ(types(exr({"--layers", "Z"})), (Types{{"Z", kFloat}}));
    EXPECT_EQ(types(exr({"--layers", "ids,beauty"})), (Types{{"R", kHalf},
                                                             {"G", kHalf},
                                                             {"B", kHalf},
                                                             {"A", kHalf},
                                                             {"id.object", kUint},
                                                             {"id.material", kUint},
                                                             {"id.polygon", kUint}}));
    EXPECT_EQ(types(exr({"--layers", "surface"})),
              (Types{{"surface.R", kHalf}, {"surface.G", kHalf}, {"surface.B", kHalf}, {"surface.A", kHalf}}));
    EXPECT_EQ(types(exr({"--layers", "coverage"})), (Types{{"coverage.silhouette", kHalf},
                                                           {"coverage.border", kHalf},
                                                           {"coverage.crease", kHalf},
                                                           {"coverage.intersection", kHalf},
                                                           {"coverage.object", kHalf}}));
    EXPECT_EQ(types(exr({"--layers", "coverage", "--lines", "mark,polygon,material"})),
              (Types{{"coverage.mark", kHalf}, {"coverage.polygon", kHalf}, {"coverage.material", kHalf}}));
}

TEST_F(Render, LayersDoNotChangeEachOther) {
    const Image all = exr({"--layers", "beauty,lines,Z,N,ids,coverage,surface"}, "scene.toml");
    for (const char* layer : {"beauty", "lines", "Z", "N", "ids", "coverage", "surface"}) {
        const Image one = exr({"--layers", layer}, "scene.toml");
        for (const Channel& c : one.channels()) EXPECT_TRUE(c.bytes == all.find(c.name)->bytes) << c.name;
    }
}

TEST_F(Render, BackgroundAndModelInEveryChannel) {
    const Image image = exr({"--eye", "0,0,5", "--target", "0,0,0"});
    const auto at = [&](const char* name, int x, int y) { return image.value(*image.find(name), x, y); };
    for (const char* name : {"R", "A", "lines.A", "N.Z", "id.object", "id.material", "id.polygon"}) {
        EXPECT_EQ(at(name, 1, 1), 0) << name;
    }
    EXPECT_EQ(at("Z", 1, 1), INFINITY);
    EXPECT_EQ(at("A", 48, 32), 1);
    EXPECT_EQ(at("id.object", 48, 32), 1);
    EXPECT_EQ(at("id.polygon", 48, 32), 2);  // the second face of the file is the one in front
    EXPECT_NEAR(at("Z", 48, 32), 4, 1e-5);   // along the view axis
    EXPECT_NEAR(at("Z", 60, 40), 4, 1e-5);
    EXPECT_EQ(at("N.Z", 48, 32), 1);
}

TEST_F(Render, AnExrIsTheSameWhateverThePaper) {
    const std::string usual = bytes({});
    EXPECT_TRUE(bytes({"--background", "#ff0000"}) == usual);
    EXPECT_TRUE(bytes({"--background", "transparent"}) == usual);
    EXPECT_TRUE(bytes({"--bits", "16"}) == usual);
}

TEST_F(Render, PaperOfPngAndTiff) {
    for (const std::string name : {"out.png", "out.tif"}) {
        const DisplayImage white = picture({}, name);
        EXPECT_EQ(white.width, 96);
        EXPECT_EQ(white.height, 64);
        EXPECT_EQ(white.channels, 3);
        EXPECT_EQ(white.pixels[0], 65535);
        EXPECT_NE(*std::min_element(white.pixels.begin(), white.pixels.end()),
                  65535);  // there are lines
        const DisplayImage red = picture({"--background", "#ff0080"}, name);
        EXPECT_EQ(red.pixels[0], 65535);
        EXPECT_EQ(red.pixels[1], 0);
        EXPECT_EQ(red.pixels[2], 0x80 * 257);
        const DisplayImage clear = picture({"--background", "transparent"}, name);
        EXPECT_EQ(clear.channels, 4);
        EXPECT_EQ(clear.pixels[3], 0);
        EXPECT_EQ(clear.pixels[(32 * 96 + 48) * 4 + 3], 65535);
    }
}

TEST_F(Render, BitsOfPngAndTiff) {
    const std::string eight = bytes({}, "out.png"), sixteen = bytes({"--bits", "16"}, "out.png");
    EXPECT_EQ(static_cast<int>(eight[24]), 8);
    EXPECT_EQ(static_cast<int>(sixteen[24]), 16);
    EXPECT_TRUE(bytes({"--bits", "8"}, "out.png") == eight);
    const DisplayImage fine = picture({"--bits", "16"}, "out.tif"), coarse = picture({}, "out.tif");
    for (std::size_t i = 0; i < fine.pixels.size(); ++i) {
        ASSERT_LE(std::abs(fine.pixels[i] - coarse.pixels[i]), 129) << i;
    }
}

TEST_F(Render, LayersOfAPngAreNoted) {
    const Arguments arguments = {"render", "cube.obj", "-r", "9x9", "-o", "out.png", "--layers", "Z"};
    const ProgramResult result = run_burin(folder_.path(), arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.err.find("note"), std::string::npos);
    Arguments quiet = arguments;
    quiet.emplace_back("-q");
    EXPECT_EQ(run_burin(folder_.path(), quiet).err, "");
}

TEST_F(Render, ACropIsAPieceOfTheWholePicture) {
    const Image whole = exr({}, "scene.toml");
    const Image crop = exr({"--crop", "20,10,77,50"}, "scene.toml");
    EXPECT_EQ(crop.display(), (PixelRect{0, 0, 96, 64}));
    EXPECT_EQ(crop.data(), (PixelRect{20, 10, 77, 50}));
    for (const Channel& channel : crop.channels()) {
        const Channel& other = *whole.find(channel.name);
        for (int y = 0; y < crop.height(); ++y) {
            for (int x = 0; x < crop.width(); ++x) {
                ASSERT_EQ(crop.value(channel, x, y), whole.value(other, x + 20, y + 10))
                    << channel.name << x << ',' << y;
            }
        }
    }
}

TEST_F(Render, ACapForMemoryChangesNothing) {
    const Image free = exr({}, "scene.toml");
    for (const char* size : {"500m", "0.5G", "2000000000", "1T"}) {
        const Image capped = exr({"--memory", size}, "scene.toml");
        for (const Channel& channel : free.channels()) {
            EXPECT_EQ(channel.bytes, capped.find(channel.name)->bytes) << channel.name << " " << size;
        }
    }
}

TEST_F(Render, TooLittleMemoryIsRefusedWithTheLeast) {
    const ProgramResult result =
        run_burin(folder_.path(), {"render", "scene.toml", "-o", "little.exr", "-j", "1", "--memory", "1M"});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    const std::string words = "scene.toml: --memory: this picture takes at least ";
    ASSERT_EQ(result.err.find(words), 0u) << result.err;
    const std::string least = result.err.substr(words.size(), result.err.find(';') - words.size());
    EXPECT_EQ(
        run_burin(folder_.path(), {"render", "scene.toml", "-o", "little.exr", "-j", "1", "--memory", least}).status, 0)
        << least;
}

TEST_F(Render, TooLittleMemoryForABlurredPictureIsRefusedWithWhatIsEnough) {
    const auto render = [&](const std::string& cap) {
        return run_burin(folder_.path(), {"render", "scene.toml", "-o", "blurred.exr", "-j", "1", "--lens", "0.01",
                                          "--blur-samples", "2", "--memory", cap});
    };
    const ProgramResult result = render("1M");
    const std::string words = " takes at least ", least = result.err.substr(result.err.find(words) + words.size());
    EXPECT_EQ(render(least.substr(0, least.find(';'))).status, 0) << result.err;
}

TEST_F(Render, LinesOfASheetCountAgainstTheCapForMemory) {
    folder_.write("fine.toml",
                  "[camera]\neye = [0, 0, 3]\nfov = 20\n[[object]]\nshape = \"sphere\"\nsegments = 400\nrings = 200\n");
    const auto render = [&](const std::string& cap, const std::string& style) {
        return run_burin(folder_.path(), {"render", "fine.toml", "-o", "fine.exr", "-j", "1", "-r", "640x480",
                                          "--memory", cap, "--style", style});
    };
    // Only the outline, then all edges of the mesh.
    EXPECT_EQ(render("30M", "comic").status, 0);
    std::filesystem::remove(folder_.path() + "/fine.exr");
    const ProgramResult result = render("30M", "wireframe");
    EXPECT_EQ(result.status, 1);
    const std::string words = "fine.toml: --memory: this picture takes at least ";
    ASSERT_EQ(result.err.find(words), 0u) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() + "/fine.exr"));
    const std::string least = result.err.substr(words.size(), result.err.find(';') - words.size());
    EXPECT_EQ(render(least, "wireframe").status, 0) << least;
}

TEST_F(Render, ACropOfAPngLiesOnPaper) {
    const DisplayImage whole = picture({}, "whole.png"), crop = picture({"--crop", "30,20,60,50"}, "crop.png");
    ASSERT_EQ(crop.width, 96);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            const auto i = static_cast<std::size_t>((y * 96 + x) * 3);
            const bool inside = x >= 30 && x < 60 && y >= 20 && y < 50;
            ASSERT_EQ(crop.pixels[i], inside ? whole.pixels[i] : 65535) << x << ',' << y;
        }
    }
}

TEST_F(Render, Lines) {
    const double usual = sum(exr({}), "lines.A");
    EXPECT_GT(usual, 100);
    EXPECT_EQ(sum(exr({"--lines", "none"}), "lines.A"), 0);
    const double silhouette = sum(exr({"--lines", "silhouette"}), "lines.A");
    EXPECT_GT(silhouette, 50);
    EXPECT_LT(silhouette, usual);
    EXPECT_EQ(sum(exr({"--lines", "mark"}), "lines.A"), 0);
    EXPECT_GT(sum(exr({"--lines", "all"}), "lines.A"), 0.99 * usual);
    // Every side of a cube is one polygon: no line where its two triangles meet.
    EXPECT_TRUE(bytes({"--lines", "silhouette,crease"}) == bytes({"--lines", "crease,silhouette"}));
}

TEST_F(Render, WidthsAnglesAndMasks) {
    const double one = sum(exr({}), "lines.A"), three = sum(exr({"-w", "3"}), "lines.A");
    EXPECT_GT(three, 2 * one);
    EXPECT_TRUE(bytes({"-w", "3"}) == bytes({"--line-width", "3"}));
    EXPECT_TRUE(bytes({"-w3"}) == bytes({"--line-width=3"}));
    // The sides of a cube meet at 90 degrees.
    const Arguments crease = {"--lines", "crease"};
    EXPECT_GT(sum(exr({"--lines", "crease", "--crease-angle", "89"}), "lines.A"), 10);
    EXPECT_EQ(sum(exr({"--lines", "crease", "--crease-angle", "91"}), "lines.A"), 0);
    const double full = sum(exr({"--lines", "crease"}), "lines.A");
    EXPECT_NEAR(sum(exr({"--lines", "crease", "--crease-angle", "80,100"}), "lines.A"), 0.5 * full, 0.01 * full);
    EXPECT_FALSE(bytes({"-m", "patel", "--mask", "16"}) == bytes({"-m", "patel", "--mask", "256"}));
    EXPECT_TRUE(bytes({"-m", "patel", "--mask", "64"}) == bytes({"-m", "patel"}));
    EXPECT_FALSE(bytes({"--samples", "4"}) == bytes({}));
    EXPECT_TRUE(bytes({"--samples", "2", "--set", "abuffer.fine_lines=true"}) == bytes({"-m", "abuffer"}));
    EXPECT_FALSE(bytes({"-m", "gbuffer"}) == bytes({"-m", "gbuffer", "--operator", "sobel,roberts"}));
    EXPECT_FALSE(bytes({"-m", "gbuffer"}) == bytes({"-m", "gbuffer", "--supersample", "4"}));
    EXPECT_TRUE(
        bytes({"-m", "gbuffer", "--operator", "first,second,profile,sobel,roberts,id", "--supersample", "2"}) ==
        bytes({"-m", "gbuffer", "--set", "gbuffer.operators=['id','first','second','profile','sobel','roberts']",
               "--set", "gbuffer.supersample=2"}));
    EXPECT_TRUE(bytes({"-m", "patel", "--mask", "16"}) == bytes({"--method=patel", "--mask=16"}));
}

TEST_F(Render, OverridesAreTheOptionsByAnotherName) {
    EXPECT_TRUE(bytes({"--set", "lines.width=3"}) == bytes({"-w", "3"}));
    EXPECT_TRUE(bytes({"--set", "lines.draw=['crease']"}) == bytes({"--lines", "crease"}));
    EXPECT_TRUE(bytes({"--set", "patel.mask=16"}) == bytes({"--mask", "16"}));
    EXPECT_TRUE(bytes({"--set", "camera.eye=[1,2,9]"}) == bytes({"--eye", "1,2,9"}));
    EXPECT_TRUE(bytes({"--set", "lines.width=2", "--set", "lines.crease_angle=91"}) ==
                bytes({"-w", "2", "--crease-angle", "91"}));
    EXPECT_TRUE(bytes({"--set", "lines.width=5", "-w", "2"}) == bytes({"-w", "2"}));  // options are stronger
    EXPECT_TRUE(bytes({"--set", "surfaces.shading=none"}) == bytes({"--set", "surfaces.shading='none'"}));
    EXPECT_TRUE(bytes({"--set", "picture.background=#ff0000"}, "a.png") == bytes({"--background", "#f00"}, "b.png"));
}

TEST_F(Render, CamerasByNameAndByHand) {
    const auto scene = [&](const Arguments& options) { return bytes(options, "out.exr", "scene.toml"); };
    EXPECT_TRUE(scene({}) == scene({"--camera", "front"}));  // the first one is the default
    EXPECT_FALSE(scene({}) == scene({"--camera", "side"}));
    EXPECT_TRUE(scene({"--camera", "side"}) ==
                scene({"--eye", "9,1,2", "--target", "0,0,0", "--fov", "30", "--up", "0,1,0"}));
    EXPECT_TRUE(bytes({"--fov", "35"}) == bytes({}));
    EXPECT_TRUE(bytes({"--up", "0,3,0"}) == bytes({"--up", "0,1,0"}));
    EXPECT_FALSE(bytes({"--up", "0,0,1"}) == bytes({}));
    EXPECT_FALSE(bytes({"--ortho", "5"}) == bytes({}));
}

TEST_F(Render, VectorsMayStartWithAMinus) {
    const std::string usual = bytes({"--eye=-1,2,3", "--target=-0.5,0,-.25"});
    EXPECT_TRUE(bytes({"--eye", "-1,2,3", "--target", "-.5,0,-0.25"}) == usual);
    EXPECT_TRUE(bytes({"--target", "-.5,0,-0.25", "--eye=-1.0,2e0,3"}) == usual);
    const std::string minus = bytes({"--eye", "-.5,0,3"});
    EXPECT_TRUE(bytes({"--eye=-.5,0,3"}) == minus);
    EXPECT_TRUE(bytes({"--up", "-0,1,-0"}) == bytes({}));
}

TEST_F(Render, ArgumentOrderDoesNotMatter) {
    const std::vector<Arguments> groups = {{"cube.obj"},    {"-o", "out.exr"},   {"--size", "40x30"},
                                           {"-w", "2"},     {"--eye", "-1,2,5"}, {"-q"},
                                           {"--lines=all"}, {"render"}};
    std::vector<int> order = {7, 0, 1, 2, 3, 4, 5, 6};
    std::string first;
    for (int turn = 0; turn < 8; ++turn) {
        Arguments arguments;
        for (const int i : order)
            arguments.insert(arguments.end(), groups[static_cast<std::size_t>(i)].begin(),
                             groups[static_cast<std::size_t>(i)].end());
        const ProgramResult result = run_burin(folder_.path(), arguments);
        // A file cannot be told from a mistyped command at the very first place.
        if (arguments[0] == "cube.obj") {
            EXPECT_EQ(result.status, 2);
        } else {
            ASSERT_EQ(result.status, 0) << result.err;
            const std::string now = read_file(folder_.file("out.exr"));
            if (first.empty()) first = now;
            EXPECT_TRUE(now == first) << turn;
        }
        std::rotate(order.begin(), order.begin() + 1, order.end());
        std::swap(order[2], order[5]);
    }
}

TEST_F(Render, ThreadsDoNotChangeTheFile) {
    const auto scene = [&](const char* threads, const char* output) {
        return bytes({"-j", threads}, output, "scene.toml");
    };
    for (const char* output : {"out.exr", "out.png"}) {
        const std::string one = scene("1", output);
        EXPECT_TRUE(scene("2", output) == one);
        EXPECT_TRUE(scene("5", output) == one);
        EXPECT_TRUE(scene("0", output) == one);
        EXPECT_TRUE(bytes({}, output, "scene.toml") == one);
    }
}

/// Cracks are closed for the camera, once a scene has been read: that is part of no two stages.
TEST_F(Render, StagesAreNoMoreThanAll) {
    std::string pieces;
    for (int i = 0; i < 90 * 90; ++i) {
        const int x = i % 90, y = i / 90;
        for (const auto& [dx, dy] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
            pieces += "v " + std::to_string(x + dx) + " " + std::to_string(y + dy) + " 0\n";
        pieces += "f -4 -3 -2 -1\n";
    }
    folder_.write("pieces.obj", pieces);
    const ProgramResult drawn =
        run_burin(folder_.path(), {"render", "pieces.obj", "-r", "40x30", "-o", "a.png", "--stats", "-", "-q"});
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    double parts = 0;
    const Json stages = Json::parse(drawn.out).at("stages");
    for (const auto& [stage, seconds] : stages.items()) {
        if (stage != "total") parts += seconds.get<double>();
    }
    EXPECT_LE(parts, stages.at("total").get<double>() * 1.01) << stages;
}

TEST_F(Render, Stats) {
    const ProgramResult printed = run_burin(
        folder_.path(), {"render", "cube.obj", "-m", "patel", "-r", "40x30", "-o", "a.exr", "--stats", "-", "-j", "2"});
    EXPECT_EQ(printed.status, 0);
    EXPECT_EQ(printed.err, "");
    ASSERT_EQ(run_burin(folder_.path(), {"render", "cube.obj", "-m", "patel", "-r", "40x30", "-o", "b.exr", "--stats",
                                         "s.json", "-j", "2"})
                  .status,
              0);
    for (const std::string& text : {printed.out, read_file(folder_.file("s.json"))}) {
        const Json stats = Json::parse(text);
        for (const char* stage : {"load", "prepare", "raster", "resolve", "lines", "shade", "write", "total"}) {
            EXPECT_GE(stats.at("stages").at(stage).get<double>(), 0) << stage;
            EXPECT_LT(stats.at("stages").at(stage).get<double>(), 60) << stage;
        }
        double parts = 0;
        for (const auto& [stage, seconds] : stats.at("stages").items()) {
            if (stage != "total") parts += seconds.get<double>();
        }
        EXPECT_LE(parts, stats.at("stages").at("total").get<double>() * 1.01);
        EXPECT_EQ(stats.at("triangles"), 12);
        EXPECT_GT(stats.at("fragments").get<std::uint64_t>(), 100u);
        EXPECT_EQ(stats.at("threads"), 2);
        EXPECT_EQ(stats.at("width"), 40);
        EXPECT_EQ(stats.at("height"), 30);
        EXPECT_GT(stats.at("peak_rss_bytes").get<std::uint64_t>(), 1000000u);
    }
}

TEST_F(Render, RepeatingChangesNothingButTheTimes) {
    const std::string once = bytes({}), thrice = bytes({"--repeat", "3", "--stats", "s.json"});
    EXPECT_TRUE(once == thrice);
    const Json stats = Json::parse(read_file(folder_.file("s.json")));
    EXPECT_GT(stats.at("stages").at("total").get<double>(), 0);
    EXPECT_EQ(stats.at("triangles"), 12);
}

TEST_F(Render, ScenesHaveASizeOfTheirOwn) {
    folder_.write("small.toml", "[picture]\nsize=[31,17]\n[[object]]\nshape='box'\n");
    ASSERT_EQ(run_burin(folder_.path(), {"render", "small.toml", "-o", "a.exr"}).status, 0);
    EXPECT_EQ(read_exr(folder_.file("a.exr")).display(), (PixelRect{0, 0, 31, 17}));
    ASSERT_EQ(run_burin(folder_.path(), {"render", "small.toml", "-o", "a.exr", "-r", "5x7"}).status, 0);
    EXPECT_EQ(read_exr(folder_.file("a.exr")).display(), (PixelRect{0, 0, 5, 7}));
    ASSERT_EQ(run_burin(folder_.path(), {"render", "small.toml", "-o", "a.exr", "-r", "1x1"}).status, 0);
    ASSERT_EQ(run_burin(folder_.path(), {"render", "small.toml", "-o", "a.exr", "-r", "1x3000"}).status, 0);
}

TEST_F(Render, TheDefaultSizeAndName) {
    folder_.write("part #1.obj", kCubeObj);
    ASSERT_EQ(run_burin(folder_.path(), {"render", "part #1.obj"}).status, 0);
    const DisplayImage image = read_display_image(folder_.file("part #1.png"));
    EXPECT_EQ(image.width, 1920);
    EXPECT_EQ(image.height, 1080);
    // In the folder it runs in, not beside the input.
    folder_.write("models/box.toml", "[picture]\nsize=[8,8]\n[[object]]\nshape='box'\n");
    ASSERT_EQ(run_burin(folder_.path(), {"render", "models/box.toml"}).status, 0);
    EXPECT_EQ(read_display_image(folder_.file("box.png")).width, 8);
}

TEST_F(Render, WhatIsSaidOnTheWay) {
    EXPECT_EQ(run_burin(folder_.path(), {"render", "cube.obj", "-r", "40x30", "-o", "a.exr"}).err, "");
    const ProgramResult verbose = run_burin(folder_.path(), {"render", "cube.obj", "-r", "40x30", "-o", "a.exr", "-v"});
    EXPECT_EQ(verbose.status, 0);
    EXPECT_EQ(verbose.out, "");
    EXPECT_EQ(verbose.err.find("a.exr: 40x30, 12 triangles"), 0u) << verbose.err;
    EXPECT_EQ(run_burin(folder_.path(), {"render", "cube.obj", "-r", "40x30", "-o", "a.exr", "--mask", "16"}).err,
              "burin: note: --mask is for method patel and changes nothing here\n");
    const std::string unused =
        run_burin(folder_.path(),
                  {"render", "cube.obj", "-r", "40x30", "-o", "a.exr", "-m", "simple", "--set", "lines.dash=[3, 2]",
                   "--set", "lines.contours=smooth", "--set", "lines.filter=gaussian", "--crease-angle", "30,50"})
            .err;
    for (const char* part : {"lines.dash is for method abuffer", "lines.contours is for", "lines.filter is for",
                             "fades no creases; it draws them from 40 degrees on"}) {
        EXPECT_NE(unused.find(part), std::string::npos) << unused;
    }
    EXPECT_EQ(run_burin(folder_.path(),
                        {"render", "cube.obj", "-r", "40x30", "-o", "a.exr", "--eye", "9,9,9", "--target", "18,18,18"})
                  .err,
              "burin: note: no sample of the picture sees a surface; does the camera look at the scene?\n");
    EXPECT_EQ(run_burin(folder_.path(), {"render", "cube.obj", "-r", "40x30", "-o", "a.exr", "--bits", "16"}).err,
              "burin: note: --bits and --background are for PNG and TIFF; an EXR is half precision without paper\n");
    const std::string hidden =
        run_burin(folder_.path(), {"render", "cube.obj", "-r", "40x30", "-o", "a.exr", "-m", "patel", "--operator",
                                   "id", "--set", "lines.hidden.style=solid"})
            .err;
    for (const char* part : {"--operator is for method gbuffer", "lines.hidden is for method abuffer"}) {
        EXPECT_NE(hidden.find(part), std::string::npos) << hidden;
    }
    // Methods whose widths go in steps, which a user should know.
    EXPECT_NE(
        run_burin(folder_.path(), {"render", "cube.obj", "-m", "gbuffer", "-r", "40x30", "-o", "a.exr", "-w", "2.5"})
            .err.find("about 2 px wide"),
        std::string::npos);
    EXPECT_NE(
        run_burin(folder_.path(), {"render", "cube.obj", "-m", "patel", "-r", "40x30", "-o", "a.exr", "-w", "1.37"})
            .err.find("note"),
        std::string::npos);
    EXPECT_EQ(run_burin(folder_.path(), {"render", "cube.obj", "-r", "40x30", "-o", "a.exr", "-w", "1.37", "-q"}).err,
              "");
}

}  // namespace
}  // namespace burin::test::render_test
