// EXR files from the command line: layers, options, attributes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "image/exr_reader.h"
#include "tests/cli/pieces.h"
#include "tests/cli/program.h"
#include "tests/support/exr_header.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::exr_options_test {
namespace {

std::string scene_file(const std::string& name) { return std::string(BURIN_SOURCE_FOLDER) + "/scenes/" + name; }

void write_file(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// Renders a small picture; returns what is said on standard error.
ProgramResult render(const TemporaryFolder& folder, const std::string& scene, const std::string& output,
                     const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", scene, "-o", output, "-q", "-r", "96x64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_burin(folder.path(), arguments);
}

TEST(ExrFiles, BytesDependOnNoThreads) {
    const TemporaryFolder folder;
    const std::string layers = "beauty,lines,Z,ids,coverage,lines_hidden,line,motion,crypto";
    for (const std::vector<std::string>& look :
         std::vector<std::vector<std::string>>{{},
                                               {"--parts"},
                                               {"--hidden", "solid"},
                                               {"--hidden", "dashed", "--parts"},
                                               {"--style", "technical"},
                                               {"--compression", "zips", "--parts"},
                                               {"--compression", "rle"},
                                               {"--compression", "none"}}) {
        std::string first;
        for (const std::vector<std::string>& run :
             std::vector<std::vector<std::string>>{{"-j", "1"}, {"-j", "2"}, {"-j", "7"}}) {
            std::vector<std::string> more = {"--layers", layers};
            more.insert(more.end(), look.begin(), look.end());
            more.insert(more.end(), run.begin(), run.end());
            ASSERT_EQ(render(folder, scene_file("still_life.toml"), "a.exr", more).err, "");
            const std::string bytes = read_file(folder.file("a.exr"));
            if (first.empty()) first = bytes;
            ASSERT_TRUE(bytes == first) << (look.empty() ? "" : look.front()) << " " << run.front() << run.back();
        }
    }
}

TEST(ExrFiles, BytesDependOnNoPieces) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& look :
         std::vector<std::vector<std::string>>{{"-r", "480x320"},
                                               {"-r", "480x320", "--parts"},
                                               {"-r", "480x320", "--hidden", "solid"},
                                               {"-r", "640x480", "--hidden", "dashed", "--parts"},
                                               {"-r", "480x320", "--style", "technical"}}) {
        std::vector<std::string> picture = {scene_file("still_life.toml"),
                                            "-q",
                                            "-o",
                                            "a.exr",
                                            "--layers",
                                            "beauty,lines,Z,ids,coverage,lines_hidden,line,motion,crypto"};
        picture.insert(picture.end(), look.begin(), look.end());
        const std::vector<std::string> options = in_pieces(folder.path(), picture);
        ASSERT_FALSE(options.empty()) << look.back();
        picture.insert(picture.begin(), "render");
        ASSERT_EQ(run_burin(folder.path(), picture).err, "");
        const std::string whole = read_file(folder.file("a.exr"));
        picture.insert(picture.end(), options.begin(), options.end());
        ASSERT_EQ(run_burin(folder.path(), picture).err, "");
        EXPECT_TRUE(read_file(folder.file("a.exr")) == whole) << look.back();
    }
}

TEST(ExrFiles, OtherLayersChangeNoPixel) {
    const TemporaryFolder folder;
    for (const char* const hidden : {"none", "solid"}) {
        ASSERT_EQ(render(folder, scene_file("still_life.toml"), "a.exr", {"--hidden", hidden}).err, "");
        ASSERT_EQ(render(folder, scene_file("still_life.toml"), "b.exr",
                         {"--hidden", hidden, "--layers", "beauty,lines,Z,N,ids,lines_hidden,crypto,line,motion"})
                      .err,
                  "");
        const Image a = read_exr(folder.file("a.exr")), b = read_exr(folder.file("b.exr"));
        for (const Channel& channel : a.channels())
            EXPECT_TRUE(std::equal(channel.bytes.begin(), channel.bytes.end(), b.find(channel.name)->bytes.begin()))
                << channel.name;
    }
}

TEST(ExrFiles, HeadersTellOfFrameAndCamera) {
    const TemporaryFolder folder;
    ASSERT_EQ(render(folder, scene_file("cube.toml"), "a.exr", {"--fov", "30"}).err, "");
    const ExrHeader still(read_file(folder.file("a.exr")));
    EXPECT_FALSE(still.has("imageCounter"));
    EXPECT_EQ(still.numbers<std::int32_t>("framesPerSecond"), (std::vector<std::int32_t>{24, 1}));
    EXPECT_NEAR(still.numbers<float>("screenWindowWidth").front(), 2 * std::tan(M_PI / 12) * 96 / 64, 1e-6);
    EXPECT_EQ(still.numbers<float>("worldToNDC").size(), 16u);
    EXPECT_EQ(still.numbers<float>("worldToCamera").size(), 16u);
    EXPECT_NE(still.text("burin/camera").find("fov = 30"), std::string::npos);
    for (const std::string& name : still.order) {
        for (const char* const never : {"capDate", "owner", "host", "comments", "DateTime"}) EXPECT_NE(name, never);
    }
    ASSERT_EQ(render(folder, scene_file("cube.toml"), "b.##.exr",
                     {"--frames", "12", "--set", "frames.fps=23.976", "--ortho", "4"})
                  .err,
              "");
    const ExrHeader frame(read_file(folder.file("b.12.exr")));
    EXPECT_EQ(frame.numbers<std::int32_t>("imageCounter"), (std::vector<std::int32_t>{12}));
    EXPECT_EQ(frame.numbers<std::int32_t>("framesPerSecond"), (std::vector<std::int32_t>{24000, 1001}));
    EXPECT_NEAR(frame.numbers<float>("screenWindowWidth").front(), 4.0 * 96 / 64, 1e-5);
}

TEST(ExrFiles, CornersLieWhereMatricesLead) {
    const TemporaryFolder folder;
    write_file(folder.file("box.toml"),
               "[[object]]\nname = \"box\"\nshape = \"box\"\nsize = [2, 1.4, 1]\n[lines]\ndraw = [\"silhouette\", "
               "\"crease\"]\n[[camera]]\neye = [3, 2.2, 4]\ntarget = [0.2, 0.1, 0]\n");
    for (const std::vector<std::string>& view : std::vector<std::vector<std::string>>{
             {}, {"--crop", "20,10,90,50"}, {"--ortho", "3"}, {"--ortho", "3", "--overscan", "8"}}) {
        std::vector<std::string> more = {"--layers", "lines,coverage", "--set", "lines.width=1"};
        more.insert(more.end(), view.begin(), view.end());
        ASSERT_EQ(render(folder, "box.toml", "a.exr", more).err, "");
        const auto m = ExrHeader(read_file(folder.file("a.exr"))).numbers<float>("worldToNDC");
        const Image image = read_exr(folder.file("a.exr"));
        int seen = 0;
        // All corners but the one behind the body have lines.
        for (int corner = 0; corner < 8; ++corner) {
            const double p[4] = {(corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 0.7 : -0.7,
                                 (corner & 4) != 0 ? 0.5 : -0.5, 1};
            if (corner == 0) continue;
            double q[4] = {};
            for (int c = 0; c < 4; ++c) {
                for (int r = 0; r < 4; ++r) q[c] += p[r] * static_cast<double>(m[static_cast<std::size_t>(4 * r + c)]);
            }
            const int x = static_cast<int>(std::floor(q[0] / q[3] * 96)) - image.data().x0,
                      y = static_cast<int>(std::floor(q[1] / q[3] * 64)) - image.data().y0;
            if (x < 1 || y < 1 || x >= image.width() - 1 || y >= image.height() - 1) continue;
            double most = 0;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx)
                    most = std::max(most, image.value(*image.find("lines.A"), x + dx, y + dy));
            }
            EXPECT_GT(most, 0.3) << corner << " at " << x << "," << y;
            ++seen;
        }
        EXPECT_GE(seen, 4);
    }
}

TEST(ExrFiles, OverscanAddsPixelsAndChangesNone) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& look :
         std::vector<std::vector<std::string>>{{},
                                               {"--hidden", "solid"},
                                               {"--hidden", "dashed"},
                                               {"--set", "lines.filter=gaussian"},
                                               {"--style", "technical"}}) {
        std::vector<std::string> more = {"--layers", "beauty,lines,Z,ids,crypto"};
        more.insert(more.end(), look.begin(), look.end());
        // The model reaches beyond the picture.
        more.insert(more.end(), {"--fov", "12"});
        ASSERT_EQ(render(folder, scene_file("still_life.toml"), "a.exr", more).err, "");
        more.insert(more.end(), {"--overscan", "13"});
        ASSERT_EQ(render(folder, scene_file("still_life.toml"), "b.exr", more).err, "");
        const Image a = read_exr(folder.file("a.exr")), b = read_exr(folder.file("b.exr"));
        EXPECT_EQ(b.display(), (PixelRect{0, 0, 96, 64}));
        ASSERT_EQ(b.data(), (PixelRect{-13, -13, 109, 77}));
        const bool is_dashed = look.size() > 1 && (look[1] == "dashed" || look[0] == "--style");  // by whole lines
        double beside = 0;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 96; ++x) {
                for (const char* const name : {"A", "lines.A", "Z", "id.object", "CryptoObject00.G"}) {
                    const double before = a.value(*a.find(name), x, y), after = b.value(*b.find(name), x + 13, y + 13);
                    if (is_dashed) continue;
                    ASSERT_EQ(before, after) << name << " " << x << "," << y;
                }
            }
        }
        for (int x = 0; x < b.width(); ++x) beside += b.value(*b.find("A"), x, 3) + b.value(*b.find("A"), x, 73);
        EXPECT_GT(beside, 20);
    }
}

TEST(ExrFiles, MotionLeadsToTheNextFrame) {
    const TemporaryFolder folder;
    write_file(
        folder.file("move.toml"),
        "[frames]\nrange = \"1-5\"\n[[object]]\nname = \"box\"\nshape = \"box\"\ninterpolation = \"linear\"\n"
        "[[object.key]]\nframe = 1\ntranslate = [0, 0, 0]\n[[object.key]]\nframe = 5\ntranslate = [0.4, 0.2, 0]\n"
        "[[camera]]\nprojection = \"orthographic\"\nheight = 4\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n");
    ASSERT_EQ(render(folder, "move.toml", "m.#.exr", {"--frames", "1-5", "--layers", "motion,ids,crypto"}).err, "");
    for (int number = 1; number <= 5; ++number) {
        const Image image = read_exr(folder.file("m.000" + std::to_string(number) + ".exr"));
        int seen = 0;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 96; ++x) {
                const bool is_box = image.value(*image.find("id.object"), x, y) == 1;
                // 16 pixels are a unit; the last key holds.
                const double moved = is_box && number < 5 ? 16 : 0;
                ASSERT_NEAR(image.value(*image.find("forward.u"), x, y), 0.1 * moved, 1e-4) << number;
                ASSERT_NEAR(image.value(*image.find("forward.v"), x, y), 0.05 * moved, 1e-4) << "v points up";
                seen += is_box;
            }
        }
        EXPECT_GT(seen, 200);
    }
}

TEST(ExrFiles, MotionIsThatOfATurntableToo) {
    const TemporaryFolder folder;
    write_file(folder.file("turn.toml"),
               "[turntable]\nframes = 72\n[[object]]\nshape = \"box\"\nscale = 0.2\ntranslate = [0, 0, 1]\n"
               "[[camera]]\nprojection = \"orthographic\"\nheight = 4\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n");
    ASSERT_EQ(render(folder, "turn.toml", "m.exr", {"--frame", "1", "--layers", "motion,ids"}).err, "");
    const Image image = read_exr(folder.file("m.exr"));
    const double angle = 2 * M_PI / 72, z = 1 + 0.2 / 2;
    int seen = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            const bool is_box = image.value(*image.find("id.object"), x, y) == 1;
            const double place = (x + 0.5 - 48) / 16;
            const double moved = is_box ? 16 * (place * (std::cos(angle) - 1) - z * std::sin(angle)) : 0;
            ASSERT_NEAR(image.value(*image.find("forward.u"), x, y), moved, 2e-3) << x << "," << y;
            ASSERT_NEAR(image.value(*image.find("forward.v"), x, y), 0, 1e-4);
            seen += is_box;
        }
    }
    EXPECT_GE(seen, 4);
}

TEST(ExrFiles, StatsCountNamesWithoutRoom) {
    const TemporaryFolder folder;
    ASSERT_EQ(
        render(folder, scene_file("still_life.toml"), "a.exr",
               {"--layers", "CryptoLine", "--set", "crypto.ranks=2", "--lines", "all", "-w", "6", "--stats", "a.json"})
            .err,
        "");
    const std::string stats = read_file(folder.file("a.json"));
    const std::size_t at = stats.find("\"crypto_dropped\": ");
    ASSERT_NE(at, std::string::npos);
    EXPECT_GT(std::stoi(stats.substr(at + 18)), 0);
    const Image image = read_exr(folder.file("a.exr"));
    EXPECT_NE(image.find("CryptoLine00.A"), nullptr);
    EXPECT_EQ(image.find("CryptoLine01.R"), nullptr);
}

TEST(ExrFiles, AnEmptyPictureHasTheSameChannels) {
    const TemporaryFolder folder;
    const std::vector<std::string> layers = {"--layers", "beauty,lines,coverage,line,motion,crypto", "--parts"};
    ASSERT_EQ(render(folder, scene_file("still_life.toml"), "a.exr", layers).err, "");
    std::vector<std::string> away = layers;
    away.insert(away.end(), {"--eye", "0,0,90", "--target", "0,0,200"});
    ASSERT_EQ(render(folder, scene_file("still_life.toml"), "b.exr", away).err, "");
    const ExrHeader a(read_file(folder.file("a.exr"))), b(read_file(folder.file("b.exr")));
    ASSERT_EQ(a.parts.size(), b.parts.size());
    EXPECT_EQ(a.order, b.order);
    for (std::size_t p = 0; p < a.parts.size(); ++p) EXPECT_EQ(a.text("channels", p), b.text("channels", p));
}

TEST(ExrOptions, AreRefusedWhereTheyHaveNoMeaning) {
    const TemporaryFolder folder;
    const auto error = [&](const std::vector<std::string>& more, const std::string& output = "a.exr",
                           const std::string& scene = "cube.toml") {
        const ProgramResult result = render(folder, scene_file(scene), output, more);
        EXPECT_EQ(result.status, 2) << result.err;
        EXPECT_TRUE(is_one_line(result.err));
        return result.err;
    };
    EXPECT_EQ(error({"--parts"}, "a.png"), "burin: --parts: EXR only\n");
    EXPECT_EQ(error({"--channel-names", "blender"}, "a.svg"), "burin: --channel-names: EXR only\n");
    EXPECT_EQ(error({"--compression", "rle"}, "a.tif"), "burin: --compression: EXR only\n");
    EXPECT_EQ(error({"--overscan", "5"}, "a.png"), "burin: --overscan: EXR only\n");
    EXPECT_NE(error({"--compression", "dwaa"}).find("must be zip, zips, rle or none"), std::string::npos);
    EXPECT_NE(error({"--channel-names", "nuke"}).find("must be plain or blender"), std::string::npos);
    EXPECT_NE(error({"--overscan", "-1"}).find("--overscan"), std::string::npos);
    EXPECT_NE(error({"--overscan", "5", "--crop", "0,0,9,9"}).find("beside --crop"), std::string::npos);
    EXPECT_NE(error({"--layers", "CryptoLineSet"}).find("--style"), std::string::npos);
    EXPECT_NE(error({"--layers", "Cryptoline"}).find("unknown layer 'Cryptoline'"), std::string::npos);
    EXPECT_NE(error({"--layers", "crypto", "-m", "patel"}).find("use method abuffer"), std::string::npos);
    EXPECT_NE(error({"--layers", "crypto", "--views", "front,top"}).find("--views"), std::string::npos);
    EXPECT_NE(render(folder, scene_file("cube.toml"), "a.exr", {"--set", "crypto.ranks=5"}).err.find("even"),
              std::string::npos);
}

TEST(ExrOptions, InfoWarnsOfNamesThatAreHardToFind) {
    const TemporaryFolder folder;
    write_file(folder.file("names.toml"),
               "[[object]]\nname = \"left, right\"\nshape = \"box\"\n[[object]]\nname = \"<1234>\"\nshape = \"box\"\n");
    const std::string out = run_burin(folder.path(), {"info", "names.toml"}).out;
    EXPECT_NE(out.find("object left, right: Blender cannot find"), std::string::npos) << out;
    EXPECT_NE(out.find("object <1234>: Blender cannot find"), std::string::npos) << out;
    EXPECT_EQ(run_burin(folder.path(), {"info", scene_file("still_life.toml")}).out.find("Blender"), std::string::npos);
}

}  // namespace
}  // namespace burin::test::exr_options_test
