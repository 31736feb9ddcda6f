#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test {
namespace {

namespace fs = std::filesystem;

ProgramResult run_compare(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    ProgramOptions options;
    options.time_limit_s = kSanitized ? 300 : 60;
    return run_burin(folder.path(), arguments, options);
}

/// One bar for the whole comparison: it never falls, and ends at 100.
void expect_rising_progress(const std::string& out) {
    std::istringstream lines(out);
    std::string line;
    int last = -1;
    while (std::getline(lines, line)) {
        int percent = 0;
        ASSERT_EQ(std::sscanf(line.c_str(), "ALF_PROGRESS %d%%", &percent), 1) << line;
        EXPECT_GT(percent, last);
        last = percent;
    }
    EXPECT_EQ(last, 100);
}

TEST(Compare, WritesPicturesMetricsAndAReport) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const ProgramResult r = run_compare(folder, {"cube.obj", "-o", "a/b", "--size", "64x48", "--methods", "patel",
                                                 "--lines", "silhouette,crease", "--frames", "2", "--progress", "alf"});
    ASSERT_EQ(r.status, 0) << r.err;
    expect_rising_progress(r.out);
    for (const char* name : {"truth.png", "patel.png", "patel_diff.png", "metrics.csv", "report.html"}) {
        EXPECT_GT(fs::file_size(folder.file("a/b/") + name), 100u) << name;
    }
    const auto metrics = nlohmann::json::parse(read_file(folder.file("a/b/metrics.json")));
    EXPECT_EQ(metrics["complete"], true);
    EXPECT_EQ(metrics["scene"]["lines"], (nlohmann::json{"silhouette", "crease"}));
    ASSERT_EQ(metrics["methods"].size(), 1u);
    const auto& patel = metrics["methods"][0];
    EXPECT_EQ(patel["name"], "patel");
    EXPECT_EQ(patel["drawn"], (nlohmann::json{"silhouette", "crease"}));
    EXPECT_GT(patel["rmse"], 0.0);
    EXPECT_LT(patel["rmse"], 0.2);
    EXPECT_EQ(patel["missed_share"], 0.0);
    EXPECT_EQ(patel["false_share"], 0.0);
    EXPECT_NEAR(patel["width_px"].get<double>(), 0.9, 0.03);
    EXPECT_GT(patel["time_s"], 0.0);
    EXPECT_TRUE(patel["ms_ssim"].is_null());  // too small a picture
    EXPECT_TRUE(patel["flicker_sd"].is_number());
    EXPECT_EQ(patel["asked_width_px"], 1.0);
    EXPECT_NEAR(patel["equal_width"]["truth_width_px"].get<double>(), 0.9, 1e-9);
}

nlohmann::json measured(const TemporaryFolder& folder) {
    return nlohmann::json::parse(read_file(folder.file("d/metrics.json")))["methods"][0];
}

// Where samples decide, few of them decide a little differently: also on the chart.
TEST(Compare, TheChartIsDrawnWithTheMethodsSettings) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    double ratios[2];
    for (int i = 0; i < 2; ++i) {
        const ProgramResult r = run_compare(folder, {"cube.obj", "-o", "d", "--size", "32x24", "--methods", "abuffer",
                                                     "--set", i == 0 ? "abuffer.samples=2" : "abuffer.samples=8"});
        ASSERT_EQ(r.status, 0) << r.err;
        ratios[i] = measured(folder)["silhouette_ratio"];
    }
    EXPECT_NE(ratios[0], ratios[1]);
}

TEST(Compare, DrawsBothSidesOfVisibleLinesWhateverTheSceneAsksFor) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    double rmse[2];
    for (int i = 0; i < 2; ++i) {
        std::vector<std::string> arguments = {"cube.obj", "-o", "d", "--size", "32x24", "--methods", "abuffer"};
        if (i == 0) {
            arguments.insert(arguments.end(), {"--crease-angle", "90"});
        } else {
            arguments.insert(arguments.end(),
                             {"--set", "lines.side=inside", "--set", "lines.hidden.style=solid", "--set",
                              "lines.dash=[3, 2]", "--set", "lines.contours=smooth", "--crease-angle", "60,120"});
        }
        const ProgramResult r = run_compare(folder, arguments);
        ASSERT_EQ(r.status, 0) << r.err;
        for (const char* name : {"lines.side", "lines.hidden", "lines.dash", "lines.contours", "creases that fade"}) {
            EXPECT_EQ(r.err.find(name) != std::string::npos, i == 1) << r.err;
        }
        rmse[i] = measured(folder)["rmse"];
    }
    EXPECT_EQ(rmse[0], rmse[1]);
}

// An open sheet that cuts through a wall: its border and the cut are ink that is right.
TEST(Compare, LinesUnderAnotherClassesNameAreNoErrors) {
    const TemporaryFolder folder;
    folder.write("sheets.obj",
                 "o wall\nv -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3 4\n"
                 "o sheet\nv -1 -1 -1\nv 1 -1 1\nv 1 1 1\nv -1 1 -1\nf 5 6 7 8\n");
    const ProgramResult r = run_compare(folder, {"sheets.obj", "-o", "d", "--size", "96x96", "--methods", "gbuffer",
                                                 "--lines", "silhouette,crease,object"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_LT(measured(folder)["false_share"], 0.01);
    EXPECT_EQ(measured(folder)["truth_classes"],
              (nlohmann::json{"border", "silhouette", "intersection", "object", "crease"}));
}

// Only the chart tells how wide a method draws; it has no lines as wide as these.
TEST(Compare, WithoutAChartThereIsNoRowAtEqualWidth) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const ProgramResult r =
        run_compare(folder, {"cube.obj", "-o", "d", "--size", "64x48", "-w", "40", "--methods", "patel"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_TRUE(measured(folder)["rmse"].is_number());
    for (const char* key : {"rmse", "ssim", "width_px", "time_s"})
        EXPECT_TRUE(measured(folder)["equal_width"][key].is_null()) << key;
}

TEST(Compare, RemovesWhatAnEarlierComparisonLeft) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    fs::create_directory(folder.file("d"));
    for (const char* name : {"d/metrics.json", "d/simple.png", "d/simple_diff.png", "d/mine.png"})
        folder.write(name, "old");
    const ProgramResult r =
        run_compare(folder, {"cube.obj", "-o", "d", "--size", "32x24", "-w", "40", "--methods", "patel"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_FALSE(fs::exists(folder.file("d/simple.png")));
    EXPECT_FALSE(fs::exists(folder.file("d/simple_diff.png")));
    EXPECT_TRUE(fs::exists(folder.file("d/mine.png")));
}

TEST(Compare, AnEmptyTruthGivesNoMetrics) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const ProgramResult r = run_compare(
        folder, {"cube.obj", "-o", "d", "--size", "32x24", "--methods", "patel", "--lines", "intersection"});
    ASSERT_EQ(r.status, 0) << r.err;
    for (const char* key : {"rmse", "ssim", "flip_mean", "missed_share", "false_share"}) {
        EXPECT_TRUE(measured(folder)[key].is_null()) << key;
    }
}

TEST(Compare, RefusesWhatCannotBe) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    folder.write("file", "");
    const struct {
        std::vector<std::string> arguments;
        int status;
        const char* words;
    } cases[] = {
        {{"cube.obj"}, 2, "--output"},
        {{"cube.obj", "-o", "d", "--methods", "magic"}, 2, "unknown method 'magic'"},
        {{"cube.obj", "-o", "d", "--frames", "1"}, 2, "--frames"},
        {{"cube.obj", "-o", "d", "-m", "patel"}, 2, "-m"},
        {{"missing.obj", "-o", "d"}, 1, "missing.obj"},
        {{"cube.obj", "-o", "file"}, 1, "file"},
        {{"cube.obj", "-o", "file/d"}, 1, "file/d"},
    };
    for (const auto& c : cases) {
        const ProgramResult r = run_compare(folder, c.arguments);
        EXPECT_EQ(r.status, c.status) << c.words;
        EXPECT_TRUE(is_one_line(r.err)) << r.err;
        EXPECT_NE(r.err.find(c.words), std::string::npos) << r.err;
    }
    EXPECT_FALSE(fs::exists(folder.file("d")));
}

TEST(Compare, AnInterruptLeavesNothingHalfWritten) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    Program program(folder.path(), {"compare", "cube.obj", "-o", "d", "--size", "3000x3000", "--methods", "patel"});
    while (!fs::exists(folder.file("d"))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.send(SIGINT);
    const ProgramResult r = program.wait();
    EXPECT_EQ(r.status, 130);
    EXPECT_EQ(r.err, "burin: interrupted; no method was finished\n");
    for (const auto& entry : fs::directory_iterator(folder.file("d"))) {
        EXPECT_EQ(entry.path().filename(), "truth.png");  // whole, if at all
    }
}

}  // namespace
}  // namespace burin::test
