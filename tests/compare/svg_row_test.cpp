#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/rasterize_svg.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test {
namespace {

namespace fs = std::filesystem;

/// A variable of the environment with another value as long as this object exists.
class ScopedVariable {
  public:
    ScopedVariable(const char* name, const std::string& value) : name_(name) {
        if (const char* const before = std::getenv(name)) before_ = before;
        ::setenv(name, value.c_str(), 1);
    }
    ~ScopedVariable() {
        if (before_) {
            ::setenv(name_, before_->c_str(), 1);
        } else {
            ::unsetenv(name_);
        }
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

ProgramResult compare_in(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"compare", "cube.obj", "-o", "d"});
    ProgramOptions options;
    options.time_limit_s = kSanitized ? 300 : 60;
    return run_burin(folder.path(), arguments, options);
}

TEST(SvgRow, IsAsNearTheTruthAsPathsCanBe) {
    if (find_svg_rasterizer().empty()) GTEST_SKIP() << "rsvg-convert is not installed";
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    fs::create_directory(folder.file("scratch"));
    const ScopedVariable scratch("TMPDIR", folder.file("scratch"));
    const ProgramResult r = compare_in(
        folder, {"--size", "96x72", "--methods", "abuffer,svg", "--frames", "2", "--set", "lines.color=\"#d02010\""});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_TRUE(fs::is_empty(folder.file("scratch")));
    const auto metrics = nlohmann::json::parse(read_file(folder.file("d/metrics.json")));
    ASSERT_EQ(metrics["methods"].size(), 2u);
    const auto &abuffer = metrics["methods"][0], &svg = metrics["methods"][1];
    EXPECT_EQ(svg["name"], "svg");
    EXPECT_EQ(svg["drawn"], abuffer["drawn"]);
    // The other program rounds to 8 bits and mixes strokes in its own way where they meet.
    for (const auto* row : {&svg, &svg["equal_width"]}) {
        const double psnr98_db = (*row)["psnr98_db"];
        EXPECT_GT(psnr98_db, 43);
        EXPECT_LT(psnr98_db, 70);
    }
    EXPECT_GT(svg["psnr_db"].get<double>(), abuffer["psnr_db"].get<double>() - 20);
    EXPECT_EQ(svg["missed_share"], 0.0);
    EXPECT_EQ(svg["false_share"], 0.0);
    EXPECT_NEAR(svg["width_px"].get<double>(), 1, 0.01);
    EXPECT_NEAR(svg["offset_px"].get<double>(), 0, 0.01);
    EXPECT_LT(svg["flicker_sd"], 0.05);
    for (const char* key : {"time_s", "cpu_time_s", "memory_bytes_per_px"}) EXPECT_TRUE(svg[key].is_null()) << key;
    EXPECT_NE(read_file(folder.file("d/report.html")).find("\"name\": \"svg\""), std::string::npos);
    for (const char* name : {"d/svg.png", "d/svg_diff.png"}) EXPECT_GT(fs::file_size(folder.file(name)), 100u) << name;
}

// What is drawn in parts fits together, and a crop is the same part of the picture.
TEST(SvgRow, IsTheSameForALargePictureAndACropOfIt) {
    if (find_svg_rasterizer().empty()) GTEST_SKIP() << "rsvg-convert is not installed";
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const ProgramResult r =
        compare_in(folder, {"--size", "2100x60", "--crop", "900,0,1200,60", "--methods", "svg", "-w", "40"});
    ASSERT_EQ(r.status, 0) << r.err;
    const auto svg = nlohmann::json::parse(read_file(folder.file("d/metrics.json")))["methods"][0];
    const ProgramResult whole = compare_in(folder, {"--size", "2100x60", "--methods", "svg", "-w", "40"});
    ASSERT_EQ(whole.status, 0) << whole.err;
    const auto all = nlohmann::json::parse(read_file(folder.file("d/metrics.json")))["methods"][0];
    EXPECT_GT(all["psnr98_db"], 43.0);
    EXPECT_NEAR(all["psnr98_db"].get<double>(), svg["psnr98_db"].get<double>(), 1);
}

TEST(SvgRow, IsLeftOutWithoutTheProgramThatDrawsIt) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    const ScopedVariable path("PATH", folder.path());
    const ProgramResult named = compare_in(folder, {"--size", "32x24", "--methods", "patel,svg"});
    EXPECT_EQ(named.status, 2);
    EXPECT_TRUE(is_one_line(named.err)) << named.err;
    EXPECT_NE(named.err.find("rsvg-convert"), std::string::npos) << named.err;
    EXPECT_FALSE(fs::exists(folder.file("d")));
    const ProgramResult all = compare_in(folder, {"--size", "32x24", "-w", "40"});
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_TRUE(is_one_line(all.err)) << all.err;
    EXPECT_NE(all.err.find("rsvg-convert"), std::string::npos) << all.err;
    const auto metrics = nlohmann::json::parse(read_file(folder.file("d/metrics.json")));
    EXPECT_EQ(metrics["complete"], true);
    for (const auto& method : metrics["methods"]) EXPECT_NE(method["name"], "svg");
}

TEST(SvgRow, TellsWhyTheProgramThatDrawsItFailed) {
    const TemporaryFolder folder;
    folder.write("cube.obj", kCubeObj);
    ::chmod(folder.write("rsvg-convert", "#!/bin/sh\necho no such luck >&2\nexit 3\n").c_str(), 0755);
    fs::create_directory(folder.file("scratch"));
    const ScopedVariable path("PATH", folder.path()), scratch("TMPDIR", folder.file("scratch"));
    const ProgramResult r = compare_in(folder, {"--size", "32x24", "--methods", "svg", "-w", "40"});
    EXPECT_EQ(r.status, 1);
    EXPECT_TRUE(is_one_line(r.err)) << r.err;
    EXPECT_NE(r.err.find("rsvg-convert: failed with exit status 3: no such luck"), std::string::npos) << r.err;
    EXPECT_TRUE(fs::is_empty(folder.file("scratch")));
}

}  // namespace
}  // namespace burin::test
