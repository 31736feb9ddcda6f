// Deep EXR from the command line, and several files of one picture.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "image/exr_reader.h"
#include "image/half.h"
#include "tests/cli/pieces.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test::deep_test {
namespace {

std::string scene_file(const std::string& name) { return std::string(BURIN_SOURCE_FOLDER) + "/scenes/" + name; }

ProgramResult render(const TemporaryFolder& folder, const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", scene, "-q"};
    if (std::find(more.begin(), more.end(), "-r") == more.end()) arguments.insert(arguments.end(), {"-r", "96x70"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_burin(folder.path(), arguments);
}

void write_file(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// A box that moves behind a pane of glass.
std::string moving_scene() {
    return "[frames]\nrange = \"1-4\"\n[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 0]\nfov = 30\n"
           "[[material]]\nname = \"glass\"\ncolor = \"#4060ff\"\nopacity = 0.4\n"
           "[[object]]\nname = \"pane\"\nshape = \"box\"\nsize = [1.5, 1.5, 0.1]\ntranslate = [0.4, 0, 1]\n"
           "material = \"glass\"\n"
           "[[object]]\nname = \"box\"\nshape = \"box\"\n[[object.key]]\nframe = 1\ntranslate = [-1, 0, 0]\n"
           "[[object.key]]\nframe = 4\ntranslate = [1, 0, 0]\n";
}

double worst_difference(const Image& deep, const Image& flat) {
    double worst = 0;
    for (const char* const name : {"R", "G", "B", "A"}) {
        const auto a = deep.find(name)->as<float>();
        const auto b = flat.find(name)->as<std::uint16_t>();
        for (std::size_t i = 0; i < a.size(); ++i)
            worst = std::max(worst, std::abs(static_cast<double>(a[i]) - static_cast<double>(float_from_half(b[i]))));
    }
    return worst;
}

TEST(Deep, FlattensToTheBeautyByOpenExrsReader) {
    const TemporaryFolder folder;
    write_file(folder.file("glass.toml"), moving_scene());
    for (const std::vector<std::string>& look :
         std::vector<std::vector<std::string>>{{scene_file("still_life.toml")},
                                               {scene_file("still_life.toml"), "--set", "surfaces.shading=\"lambert\""},
                                               {scene_file("still_life.toml"), "--style", "pencil"},
                                               {scene_file("still_life.toml"), "--style", "comic"},
                                               {scene_file("still_life.toml"), "-w", "6", "--set", "deep.float=true"},
                                               {scene_file("still_life.toml"), "-r", "640x480", "--style", "blueprint"},
                                               {scene_file("flange.toml"), "-r", "320x200", "--style", "pencil"},
                                               {scene_file("flange.toml"), "-r", "640x480", "--style", "blueprint"},
                                               {scene_file("shaded.toml")},
                                               {scene_file("cage.toml"), "-w", "0.5"},
                                               {scene_file("crossing.toml"), "--samples", "8"},
                                               {scene_file("flange.toml"), "--set", "lines.filter=\"gaussian\""},
                                               {folder.file("glass.toml"), "--frame", "3"},
                                               {folder.file("glass.toml"), "--frame", "2", "--style", "technical"}}) {
        std::vector<std::string> more(look.begin() + 1, look.end());
        more.insert(more.end(), {"--hidden", "none", "-o", "flat.exr", "--deep", "deep.exr"});
        ASSERT_EQ(render(folder, look.front(), more).err, "");
        const Image flat = read_exr(folder.file("flat.exr")), deep = read_flattened_exr(folder.file("deep.exr"));
        // Shares of filtered lines are no exact halves: they are rounded once more.
        const bool is_filtered = look.back().find("filter") != std::string::npos;
        EXPECT_LE(worst_difference(deep, flat), is_filtered ? 1.0 / 1024 : 1.0 / 2048)
            << look.front() << " " << look.back();
    }
}

/// Has a deep file drawn as a whole and in pieces.
void expect_same_in_pieces(const TemporaryFolder& folder, const std::string& scene,
                           const std::vector<std::string>& look, const std::vector<std::string>& more) {
    std::vector<std::string> picture = {scene, "-q", "--deep", "deep.exr"};
    picture.insert(picture.end(), more.begin(), more.end());
    picture.insert(picture.end(), look.begin(), look.end());
    const std::vector<std::string> options = in_pieces(folder.path(), picture);
    ASSERT_FALSE(options.empty()) << picture.back();
    picture.insert(picture.begin(), "render");
    ASSERT_EQ(run_burin(folder.path(), picture).err, "");
    const std::string whole = read_file(folder.file("deep.exr"));
    picture.insert(picture.end(), options.begin(), options.end());
    ASSERT_EQ(run_burin(folder.path(), picture).err, "");
    EXPECT_TRUE(read_file(folder.file("deep.exr")) == whole) << picture.back();
}

TEST(Deep, BlurredItFlattensToTheBlurredBeauty) {
    const TemporaryFolder folder;
    write_file(folder.file("glass.toml"), moving_scene());
    for (const std::vector<std::string>& blur :
         std::vector<std::vector<std::string>>{{"--shutter", "-0.5,0.5", "--blur-samples", "9"},
                                               {"--lens", "0.3", "--focus", "8", "--blur-samples", "16"}}) {
        std::vector<std::string> more = blur;
        more.insert(more.end(), {"--frame", "2", "-o", "flat.exr", "--deep", "deep.exr"});
        ASSERT_EQ(render(folder, folder.file("glass.toml"), more).err, "");
        const Image flat = read_exr(folder.file("flat.exr")), deep = read_flattened_exr(folder.file("deep.exr"));
        EXPECT_LE(worst_difference(deep, flat), 1.0 / 1024) << blur.front();
        const std::string bytes = read_file(folder.file("deep.exr"));
        more.insert(more.end(), {"-j", "1"});
        ASSERT_EQ(render(folder, folder.file("glass.toml"), more).err, "");
        EXPECT_TRUE(read_file(folder.file("deep.exr")) == bytes) << blur.front();
        expect_same_in_pieces(folder, folder.file("glass.toml"), blur, {"-r", "640x480", "--frame", "2"});
    }
}

TEST(Deep, BytesDependOnNeitherThreadsNorPiecesNorWhatStandsBeside) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& look : std::vector<std::vector<std::string>>{
             {}, {"--hidden", "solid"}, {"--hidden", "dashed"}, {"--style", "technical"}, {"--compression", "none"}}) {
        std::string first;
        for (const std::vector<std::string>& run : std::vector<std::vector<std::string>>{
                 {"-j", "1"}, {"-j", "2"}, {"-j", "7"}, {"-o", "flat.exr"}, {"-o", "flat.png"}}) {
            std::vector<std::string> more = {"--deep", "deep.exr"};
            more.insert(more.end(), look.begin(), look.end());
            more.insert(more.end(), run.begin(), run.end());
            ASSERT_EQ(render(folder, scene_file("still_life.toml"), more).err, "");
            const std::string bytes = read_file(folder.file("deep.exr"));
            if (first.empty()) first = bytes;
            ASSERT_TRUE(bytes == first) << (look.empty() ? "" : look.back()) << " " << run.front() << run.back();
        }
    }
    for (const std::vector<std::string>& look : std::vector<std::vector<std::string>>{
             {"-r", "480x320"}, {"-r", "480x320", "--hidden", "solid"}, {"-r", "480x320", "--style", "technical"}})
        expect_same_in_pieces(folder, scene_file("still_life.toml"), look, {});
    EXPECT_FALSE(std::filesystem::exists(folder.file("still_life.png"))) << "without -o it stands alone";
}

TEST(Deep, FlatFilesBesideItAreAsAlone) {
    const TemporaryFolder folder;
    const std::vector<std::string> layers = {"--layers", "beauty,lines,Z,crypto,line"};
    for (const char* const name : {"a.exr", "a.png"}) {
        std::vector<std::string> more = {"-o", name};
        if (std::string(name) == "a.exr") more.insert(more.end(), layers.begin(), layers.end());
        ASSERT_EQ(render(folder, scene_file("still_life.toml"), more).err, "");
        const std::string alone = read_file(folder.file(name));
        more.insert(more.end(), {"--deep", "deep.exr"});
        ASSERT_EQ(render(folder, scene_file("still_life.toml"), more).err, "");
        EXPECT_TRUE(read_file(folder.file(name)) == alone) << name;
    }
}

TEST(Deep, BandsAreJoinedToTheWhole) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& look :
         std::vector<std::vector<std::string>>{{}, {"--hidden", "solid"}, {"--style", "technical"}}) {
        const auto draw = [&](const std::string& name, const std::string& crop) {
            std::vector<std::string> more = {"--deep", name, "--crop", crop, "--skip-existing"};
            more.insert(more.end(), look.begin(), look.end());
            ASSERT_EQ(render(folder, scene_file("still_life.toml"), more).err, "");
        };
        draw("whole.exr", "0,0,96,70");
        draw("a.exr", "0,0,96,16");
        draw("b.exr", "0,16,96,48");
        draw("c.exr", "0,48,96,70");
        const ProgramResult joined =
            run_burin(folder.path(), {"assemble", "-q", "-o", "joined.exr", "b.exr", "c.exr", "a.exr"});
        ASSERT_EQ(joined.err, "");
        EXPECT_TRUE(read_file(folder.file("joined.exr")) == read_file(folder.file("whole.exr")));
        for (const char* const name : {"whole.exr", "a.exr", "b.exr", "c.exr"})
            std::filesystem::remove(folder.file(name));
    }
}

TEST(Deep, FramesAreSkippedIfBothFilesAreThere) {
    const TemporaryFolder folder;
    write_file(folder.file("a.toml"), moving_scene());
    const std::vector<std::string> job = {"--skip-existing", "-o",      "flat.##.exr", "--deep",
                                          "deep.##.exr",     "--stats", "stats.jsonl"};
    ASSERT_EQ(render(folder, "a.toml", job).err, "");
    const std::string deep = read_file(folder.file("deep.03.exr"));
    EXPECT_NE(deep, read_file(folder.file("deep.02.exr")));
    std::filesystem::remove(folder.file("deep.03.exr"));
    std::filesystem::copy_file(folder.file("flat.02.exr"), folder.file("deep.02.exr"),
                               std::filesystem::copy_options::overwrite_existing);  // it is none
    ASSERT_EQ(render(folder, "a.toml", job).err, "");
    const std::string stats = read_file(folder.file("stats.jsonl"));
    EXPECT_NE(stats.find("\"done\": 2"), std::string::npos) << stats;
    EXPECT_NE(stats.find("\"skipped\": 2"), std::string::npos) << stats;
    EXPECT_TRUE(read_file(folder.file("deep.03.exr")) == deep);
    std::size_t at = 0;
    for (const char* const row : {"\"frame\": 1", "\"frame\": 2", "\"frame\": 3", "\"frame\": 4"}) {
        EXPECT_GE(stats.find(row), at) << "rows have the order of frames";
        at = stats.find(row);
    }
}

TEST(Deep, WhatItCannotStandBesideIsRefused) {
    const TemporaryFolder folder;
    write_file(folder.file("a.toml"), moving_scene());
    const auto error_of = [&](std::vector<std::string> more) {
        const ProgramResult result = render(folder, "a.toml", more);
        EXPECT_EQ(result.status, 2) << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        return result.err;
    };
    EXPECT_EQ(error_of({"--deep", "d.exr", "-m", "patel"}), "burin: --deep: needs method abuffer\n");
    EXPECT_NE(error_of({"--deep", "d.png"}).find("--deep: a deep file is an EXR"), std::string::npos);
    EXPECT_NE(error_of({"--deep", "d.exr", "-o", "./d.exr"}).find("would overwrite"), std::string::npos);
    EXPECT_NE(error_of({"--deep", "d.exr", "--layers", "Z"}).find("--layers"), std::string::npos);
    EXPECT_NE(error_of({"--deep", "d.exr", "--parts"}).find("--parts"), std::string::npos);
    EXPECT_NE(error_of({"--deep", "d.exr", "--views", "front,top"}).find("--views"), std::string::npos);
    EXPECT_NE(error_of({"--deep", "d.exr", "-f", "1-3"}).find("--deep: several frames need a pattern"),
              std::string::npos);
    EXPECT_NE(error_of({"--deep", "d.##.exr", "-o", "d.exr", "-f", "1-3"}).find("-o: several frames need a pattern"),
              std::string::npos);
    EXPECT_EQ(render(folder, "a.toml", {"--deep", "d.exr", "--set", "deep.hidden=\"front\""}).status, 2);
    EXPECT_EQ(render(folder, "a.toml", {"--deep", "d.exr", "--set", "deep.float=1"}).status, 2);
    EXPECT_FALSE(std::filesystem::exists(folder.file("d.exr")));
}

TEST(SeveralOutputs, EachHasTheBytesThatItHasAlone) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& look : std::vector<std::vector<std::string>>{
             {}, {"--hidden", "solid"}, {"--style", "technical"}, {"--layers", "Z,lines"}}) {
        std::vector<std::string> all = look;
        const std::vector<std::string> names = {"a.exr", "b.png", "c.svg", "d.pdf", "e.exr"};
        for (const std::string& name : names) all.insert(all.end(), {"-o", name});
        ASSERT_EQ(render(folder, scene_file("cube.toml"), all).err, "");
        std::vector<std::string> together;
        for (const std::string& name : names) together.push_back(read_file(folder.file(name)));
        for (std::size_t i = 0; i < names.size(); ++i) {
            std::vector<std::string> one = look;
            one.insert(one.end(), {"-o", names[i]});
            ASSERT_EQ(render(folder, scene_file("cube.toml"), one).err, "");
            EXPECT_TRUE(read_file(folder.file(names[i])) == together[i]) << names[i] << " " << look.size();
        }
    }
}

TEST(SeveralOutputs, FramesAreThereIfAllFilesAre) {
    const TemporaryFolder folder;
    write_file(folder.file("a.toml"), moving_scene());
    const std::vector<std::string> job = {"--skip-existing", "-o",      "a.##.exr", "-o", "b.##.png", "-o",
                                          "c.##.svg",        "--stats", "-"};
    EXPECT_NE(render(folder, "a.toml", job).out.find("\"done\": 4"), std::string::npos);
    EXPECT_NE(render(folder, "a.toml", job).out.find("\"skipped\": 4"), std::string::npos);
    std::filesystem::remove(folder.file("b.02.png"));
    EXPECT_NE(render(folder, "a.toml", job).out.find("\"skipped\": 3"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder.file("b.02.png")));
    const ProgramResult twice = render(folder, "a.toml", {"-o", "x.##.exr", "-o", "x.##.exr"});
    EXPECT_EQ(twice.status, 2);
    EXPECT_NE(twice.err.find("would overwrite"), std::string::npos) << twice.err;
}

TEST(SkipExisting, NeedsNoPlaceToWriteIfAllIsThere) {
    const TemporaryFolder folder;
    write_file(folder.file("a.toml"), moving_scene());
    std::filesystem::create_directory(folder.file("out"));
    ProgramOptions options;
    options.obeys_permissions = true;
    const std::vector<std::vector<std::string>> jobs = {{"-o", "out/still.exr", "--frame", "1"},
                                                        {"-o", "out/f.##.exr", "-f", "1-2"}};
    ::chmod(folder.path().c_str(), 0777);
    ::chmod(folder.file("out").c_str(), 0777);
    for (const bool is_second : {false, true}) {
        for (const auto& job : jobs) {
            std::vector<std::string> arguments = {"render", "a.toml", "-q", "-r", "96x70", "--skip-existing"};
            arguments.insert(arguments.end(), job.begin(), job.end());
            EXPECT_EQ(run_burin(folder.path(), arguments, options).err, "") << is_second;
            arguments.insert(arguments.end(), {"-w", "3"});  // it is to be made again
            if (is_second) {
                EXPECT_EQ(run_burin(folder.path(), arguments, options).status, 1);
            }
        }
        ::chmod(folder.file("out").c_str(), 0555);
    }
    ::chmod(folder.file("out").c_str(), 0777);
}

TEST(Statistics, OverwriteNoFileOfAFrame) {
    const TemporaryFolder folder;
    write_file(folder.file("a.toml"), moving_scene());
    for (const std::vector<std::string>& job :
         std::vector<std::vector<std::string>>{{"-o", "a.##.exr", "--stats", "./a.03.exr"},
                                               {"-o", "a.exr", "--frame", "1", "--stats", "a.exr"},
                                               {"--deep", "a.##.exr", "--stats", "a.01.exr"}}) {
        const ProgramResult result = render(folder, "a.toml", job);
        EXPECT_EQ(result.status, 2);
        EXPECT_NE(result.err.find("would overwrite"), std::string::npos) << result.err;
    }
}

TEST(Frames, MorePointsThanTwoAreNoRange) {
    const TemporaryFolder folder;
    write_file(folder.file("a.toml"), moving_scene());
    for (const char* const list : {"1...3", "1....3", "1..3..5", "1..", "..3", "1:.3"}) {
        const ProgramResult result = render(folder, "a.toml", {"-o", "a.##.exr", "-f", list});
        EXPECT_EQ(result.status, 2) << list;
        EXPECT_NE(result.err.find("--frames"), std::string::npos) << result.err;
    }
    EXPECT_EQ(render(folder, "a.toml", {"-o", "a.##.exr", "-f", "1..2"}).err, "");
}

TEST(Lens, TooLargeOnesAreNamed) {
    const TemporaryFolder folder;
    write_file(folder.file("a.toml"), moving_scene());
    for (const char* const radius : {"1e30", "1e6"}) {
        const ProgramResult result =
            render(folder, "a.toml", {"-o", "a.exr", "--frame", "1", "--lens", radius, "--blur-samples", "8"});
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.err.find("the lens moves the picture"), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find("shift"), std::string::npos) << result.err;
    }
}

}  // namespace
}  // namespace burin::test::deep_test
