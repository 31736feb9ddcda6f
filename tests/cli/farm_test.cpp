#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::farm_test {
namespace {

using test::ProgramResult;
using test::read_file;
using test::run_burin;
using test::TemporaryFolder;

constexpr const char* kShot =
    "[turntable]\nframes = 12\n[[object]]\nname = \"box\"\nshape = \"box\"\n[[object]]\nname = \"ball\"\n"
    "shape = \"sphere\"\ntranslate = [0.6, 0.2, 0.4]\n";

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(Assemble, BandsOfAllKindsOfFilesAreTheBytesOfTheWhole) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    const std::vector<std::vector<std::string>> looks = {{},
                                                         {"--hidden", "dashed"},
                                                         {"--layers", "beauty,lines,Z,crypto,line", "--parts"},
                                                         {"--compression", "zips"},
                                                         {"--style", "technical"},
                                                         {"--lens", "0.05", "--blur-samples", "3"}};
    for (const std::vector<std::string>& look : looks) {
        SCOPED_TRACE(look.empty() ? "plain" : look.back());
        const auto render = [&](const std::string& name, const std::vector<std::string>& crop) {
            const ProgramResult result = run_burin(
                folder.path(), joined(joined({"render", "shot.toml", "-r", "90x70", "-q", "-o", name}, look), crop));
            ASSERT_EQ(result.status, 0) << result.err;
        };
        render("whole.exr", {});
        render("top.exr", {"--crop", "0,0,90,32"});
        render("middle.exr", {"--crop", "0,32,90,48"});
        render("bottom.exr", {"--crop", "0,48,90,70"});
        const ProgramResult result =
            run_burin(folder.path(), {"assemble", "-o", "joined.exr", "bottom.exr", "top.exr", "middle.exr"});
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_TRUE(result.err.starts_with("burin: note: the bands have no fingerprint")) << result.err;
        EXPECT_TRUE(read_file(folder.file("joined.exr")) == read_file(folder.file("whole.exr")));
    }
}

TEST(Assemble, WhatIsMissingAboveAndBelowIsNoted) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    ASSERT_EQ(run_burin(folder.path(), {"render", "shot.toml", "-r", "32x48", "-q", "--skip-existing", "--crop",
                                        "0,16,32,32", "-o", "a.exr"})
                  .status,
              0);
    const ProgramResult result = run_burin(folder.path(), {"assemble", "-o", "b.exr", "a.exr"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "burin: note: b.exr has rows 16 to 31; the picture has 0 to 47\n");
}

TEST(Assemble, WrongUseIsRefused) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    ASSERT_EQ(run_burin(folder.path(), {"render", "shot.toml", "-r", "32x32", "-q", "-o", "a.exr"}).status, 0);
    EXPECT_EQ(run_burin(folder.path(), {"assemble", "-o", "a.exr", "a.exr"}).status, 2) << "an input is kept";
    EXPECT_EQ(run_burin(folder.path(), {"assemble", "-o", "b.png", "a.exr"}).status, 2);
    EXPECT_EQ(run_burin(folder.path(), {"assemble", "-o", "b.exr"}).status, 2);
    const ProgramResult twice = run_burin(folder.path(), {"assemble", "-o", "b.exr", "a.exr", "a.exr"});
    EXPECT_EQ(twice.status, 1);
    EXPECT_EQ(twice.err, "a.exr: begins at row 0, which a.exr has, too\n");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "shot.toml"}));
}

/// Where each part of the forecast is most of it.
TEST(DryRun, ForecastsWhatRenderingTakes) {
    const TemporaryFolder folder;
    std::string crowd = "[[camera]]\neye = [0, 40, 60]\ntarget = [0, 0, 0]\n";
    for (int i = 0; i < 20'000; ++i) {
        crowd += "[[object]]\nshape = \"box\"\nscale = 0.2\ntranslate = [" + std::to_string(i % 150 - 75) + ", 0, " +
                 std::to_string(i / 150 - 65) + "]\n";
    }
    folder.write("crowd.toml", crowd);
    folder.write("box.toml", "[[camera]]\neye = [3, 2, 5]\ntarget = [0, 0, 0]\n[[object]]\nshape = \"box\"\n");
    std::string copies = "[[object]]\nshape = \"sphere\"\nsegments = 256\nrings = 128\ninstance = [\n";
    for (int i = 0; i < 60; ++i) copies += "{ translate = [" + std::to_string(2 * i) + ", 0, 0] },\n";
    folder.write("copies.toml", copies + "]\n");
    const std::string still_life = BURIN_SOURCE_FOLDER "/scenes/still_life.toml";
    const std::vector<std::vector<std::string>> jobs = {
        {"crowd.toml", "-o", "x.png", "-r", "320x240"},
        {"copies.toml", "-o", "x.png", "-r", "800x600"},
        {"box.toml", "-o", "x.tif", "-r", "320x240"},
        {"box.toml", "-o", "x.exr", "--layers", "beauty,lines,crypto", "--hidden", "dashed"},
        {still_life, "-o", "x.exr", "--layers", "beauty,lines,crypto"},
        {still_life, "--turntable", "3", "-o", "x.#.png"},
        {still_life, "--turntable", "3", "-o", "x.#.exr", "--deep", "d.#.exr"},
        {still_life, "-o", "x.png", "--style", "technical", "--save-lines", "x.lines", "--save-surface"},
        {still_life, "--deep", "d.exr"},
        {still_life, "--deep", "d.exr", "-o", "x.png"},
        {still_life, "--deep", "d.exr", "--lens", "0.05", "--blur-samples", "2"},
        {still_life, "-o", "x.exr", "--lens", "0.05", "--blur-samples", "2", "--layers", "beauty,lines,crypto"}};
    for (const std::vector<std::string>& job : jobs) {
        std::string words;
        for (const std::string& word : job) words += word + " ";
        /// The last line of what it prints.
        const auto told = [&](std::vector<std::string> more) {
            more.insert(more.begin(), "render");
            more.insert(more.end(), job.begin(), job.end());
            more.insert(more.end(), {"-j", "2", "-q"});
            const ProgramResult result = run_burin(folder.path(), more);
            EXPECT_EQ(result.status, 0) << result.err;
            const std::size_t summary = result.out.rfind("{\"summary\"");
            return nlohmann::json::parse(summary == std::string::npos ? result.out : result.out.substr(summary));
        };
        const double forecast = told({"--dry-run", "--json"})["memory_bytes"]["total"];
        const double peak = told({"--stats", "-"})["peak_rss_bytes"];
        // Sanitizers take memory of their own.
        EXPECT_GT(forecast / peak, test::kSanitized ? 0 : 0.9) << words << peak;
        EXPECT_LT(forecast / peak, 1.4) << words << peak;
    }
}

TEST(DryRun, TellsWhatAJobIs) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    const std::vector<std::string> job = {
        "render",  "shot.toml",   "-r", "64x48",     "-q",     "-o",   "o.#.exr",        "--deep",
        "d.#.exr", "--turntable", "4",  "--dry-run", "--lens", "0.05", "--blur-samples", "3"};
    const std::string text = run_burin(folder.path(), job).out;
    for (const char* const line : {"frames 4\n", "files 8\n", "sub-frames 3\n", "pieces 1\n", ", blur ", "; least ",
                                   "\nframe 136 kB before compression\n", "\ndeep "})
        EXPECT_NE(text.find(line), std::string::npos) << line << text;
    std::vector<std::string> as_json = job;
    as_json.push_back("--json");
    const nlohmann::json facts = nlohmann::json::parse(run_burin(folder.path(), as_json).out);
    EXPECT_EQ(facts["files"], 8);
    EXPECT_EQ(facts["sub_frames"], 3);
    EXPECT_EQ(facts["pieces"], 1);
    EXPECT_EQ(facts["uncompressed_bytes_per_frame"], 64 * 48 * 44);
    EXPECT_GT(facts["deep_bytes_per_frame"], 64 * 48 * 4);
    const nlohmann::json& memory = facts["memory_bytes"];
    EXPECT_GT(memory["least"], 0);
    EXPECT_GT(memory["blur"], 0);
    EXPECT_EQ(memory["total"].get<std::uint64_t>(),
              memory["program"].get<std::uint64_t>() + memory["model"].get<std::uint64_t>() +
                  memory["film"].get<std::uint64_t>() + memory["blur"].get<std::uint64_t>() +
                  memory["method"].get<std::uint64_t>());
}

// What the job that collects a farm's frames asks, where an input is gone: the frame is missing, as any other.
TEST(DryRun, FramesWithoutTheirInputAreMissing) {
    const TemporaryFolder folder;
    folder.write("shot.toml", "[camera]\neye = [0, 0, 4]\n[[object]]\nfile = \"walk.##.obj\"\n");
    for (int i = 1; i <= 4; ++i)
        folder.write("walk.0" + std::to_string(i) + ".obj",
                     "v 0 0 0\nv 1 0 0\nv 0 " + std::to_string(i) + " 0\nf 1 2 3\n");
    const std::vector<std::string> render = {"render", "shot.toml", "-r", "64x48", "-q",
                                             "-o",     "o.##.png",  "-f", "1-4",   "--skip-existing"};
    ASSERT_EQ(run_burin(folder.path(), render).status, 0);
    std::filesystem::remove(folder.file("walk.03.obj"));
    std::filesystem::remove(folder.file("o.04.png"));
    const ProgramResult text = run_burin(folder.path(), joined(render, {"--dry-run"}));
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("frames 4 (2 there)\nmissing 3,4\n"), std::string::npos) << text.out;
}

TEST(DryRun, TellsFramesAndMemoryAndDrawsNothing) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    const std::vector<std::string> render = {"render", "shot.toml", "-r", "64x48", "-q",
                                             "-o",     "o.##.exr",  "-f", "1-12",  "--skip-existing"};
    ASSERT_EQ(run_burin(folder.path(), joined(render, {"-f", "3-4"})).status, 2) << "frames are given once";
    ASSERT_EQ(run_burin(folder.path(), {"render", "shot.toml", "-r", "64x48", "-q", "-o", "o.##.exr", "-f", "2,5-6",
                                        "--skip-existing"})
                  .status,
              0);
    const ProgramResult text = run_burin(folder.path(), joined(render, {"--dry-run"}));
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_NE(text.out.find("frames 12 (3 there)\nmissing 1,3,4,7-12\n"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("\nmemory "), std::string::npos) << text.out;
    const ProgramResult json = run_burin(folder.path(), joined(render, {"--dry-run", "--json"}));
    const auto told = nlohmann::json::parse(json.out);
    EXPECT_EQ(told["frames"], 12);
    EXPECT_EQ(told["there"], 3);
    EXPECT_EQ(told["missing"], "1,3,4,7-12");
    const auto& memory = told["memory_bytes"];
    EXPECT_EQ(memory["total"], memory["program"].get<std::uint64_t>() + memory["model"].get<std::uint64_t>() +
                                   memory["film"].get<std::uint64_t>() + memory["method"].get<std::uint64_t>());
    EXPECT_EQ(folder.names().size(), 4u) << "nothing was drawn";
}

TEST(Submit, GivesChunksOfWhatIsMissing) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    ASSERT_EQ(
        run_burin(folder.path(), {"render", "shot.toml", "-r", "64x48", "-q", "-o", "o.##.exr", "-f", "2,5-6"}).status,
        0);
    const ProgramResult result =
        run_burin(folder.path(), {"submit", "shot.toml", "-r", "64x48", "-o", "o.##.exr", "-f", "1-12", "--chunk", "4",
                                  "--retries", "2", "--dry-run", "--", "--partition=night shift"});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* part :
         {"#SBATCH --array=0-2\n", "0) frames=1,3,4,7 ;;\n", "1) frames=8-11 ;;\n", "2) frames=12 ;;\n", " -lt 2 ]",
          "# sbatch --parsable '--partition=night shift'\n", "--dependency=afterany:JOB", "--size=64x48"})
        EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
    EXPECT_EQ(count_of(result.out, "#!/bin/sh"), 2u);
    // A shell reads them.
    folder.write("scripts.sh", result.out);
    EXPECT_EQ(std::system(("sh -n '" + folder.file("scripts.sh") + "'").c_str()), 0);
}

TEST(Submit, BandsAreTasksOfTheirOwn) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    const ProgramResult result = run_burin(folder.path(), {"submit", "shot.toml", "-r", "64x70", "-o", "it's #.exr",
                                                           "-f", "1-3", "--bands", "2", "--dry-run"});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* part : {"#SBATCH --array=0-1\n", "set -- --crop 0,0,64,32 -o 'it'\\''s #.band1.exr' ;;",
                             "set -- --crop 0,32,64,70 -o 'it'\\''s #.band2.exr' ;;",
                             "join 'it'\\''s 0002.exr' 'it'\\''s 0002.band1.exr' 'it'\\''s 0002.band2.exr'\n"})
        EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
    folder.write("scripts.sh", result.out);
    EXPECT_EQ(std::system(("sh -n '" + folder.file("scripts.sh") + "'").c_str()), 0);
    const ProgramResult deep =
        run_burin(folder.path(), {"submit", "shot.toml", "-r", "64x70", "-o", "a.##.exr", "--deep", "d.##.exr", "-f",
                                  "1-3", "--bands", "2", "--dry-run"});
    for (const char* part :
         {"set -- --crop 0,0,64,32 -o 'a.##.band1.exr' --deep 'd.##.band1.exr' ;;",
          "join a.02.exr a.02.band1.exr a.02.band2.exr\n", "join d.02.exr d.02.band1.exr d.02.band2.exr\n",
          "-f 1-3 -o 'a.##.exr' --deep 'd.##.exr' -q"})
        EXPECT_NE(deep.out.find(part), std::string::npos) << part << "\n" << deep.out;
    const auto error_of = [&](const std::vector<std::string>& more) {
        return run_burin(folder.path(), joined({"submit", "shot.toml", "-r", "64x70", "--dry-run"}, more)).err;
    };
    EXPECT_EQ(error_of({"-o", "o.##.png", "-f", "1-3", "--bands", "2"}), "burin: --bands: EXR only\n");
    EXPECT_EQ(error_of({"-o", "o.##.exr", "-f", "1-3", "--bands", "9"}),
              "burin: --bands: a picture of 70 rows has 5 bands at most\n");
    EXPECT_EQ(error_of({"-o", "o.##.exr", "-f", "1-3", "--bands", "2", "--crop", "0,0,9,9"}),
              "burin: --bands: cannot stand beside --crop; remove one\n");
}

TEST(Submit, FoldersOfJobsThatAreNotTakenAreNotLeft) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    std::filesystem::create_directory(folder.file("bin"));
    const std::string sbatch = folder.write("bin/sbatch", "#!/bin/sh\necho 'no partition' >&2\nexit 1\n");
    ASSERT_EQ(::chmod(sbatch.c_str(), 0755), 0);
    const std::string old_path = std::getenv("PATH");
    ::setenv("PATH", (folder.file("bin") + ":" + old_path).c_str(), 1);
    const std::vector<std::string> submit = {"submit", "shot.toml", "-r", "64x48", "-o", "o.##.exr", "-f", "1-3"};
    const std::vector<std::string> before = folder.names();
    EXPECT_EQ(run_burin(folder.path(), submit).status, 1);
    EXPECT_EQ(folder.names(), before);
    const ProgramResult nowhere =
        run_burin(folder.path(), {"submit", "shot.toml", "-r", "64x48", "-o", "shots/o.##.exr", "-f", "1-3"});
    EXPECT_NE(nowhere.err.find("shots does not exist; create it first"), std::string::npos) << nowhere.err;
    EXPECT_EQ(folder.names(), before) << "a name that is mistyped makes no folder";
    // One that was there stays, and so does that of a job that was taken.
    std::filesystem::create_directory(folder.file("burin-logs"));
    EXPECT_EQ(run_burin(folder.path(), submit).status, 1);
    EXPECT_TRUE(std::filesystem::remove(folder.file("burin-logs")));
    folder.write("bin/sbatch", "#!/bin/sh\necho 17\n");
    EXPECT_EQ(run_burin(folder.path(), submit).status, 0);
    EXPECT_TRUE(std::filesystem::is_directory(folder.file("burin-logs")));
    ::setenv("PATH", old_path.c_str(), 1);
}

TEST(Submit, WithoutSlurmSaysSo) {
    const TemporaryFolder folder;
    folder.write("shot.toml", kShot);
    ::setenv("PATH", "/nowhere", 1);
    const ProgramResult result =
        run_burin(folder.path(), {"submit", "shot.toml", "-r", "64x48", "-o", "o.##.exr", "-f", "1-3"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "sbatch not found; --dry-run prints the scripts\n");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"shot.toml"});
}

}  // namespace
}  // namespace burin::farm_test
