#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "compare/rasterize_svg.h"
#include "tests/cli/models.h"
#include "tests/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace burin::test {
namespace {

constexpr const char* kInstall = "rsvg-convert is missing; scripts/install-dependencies installs it";

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
    ASSERT_FALSE(find_svg_rasterizer().empty()) << kInstall;
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

/// A straight stroke, one pixel wide and half opaque, from 10.5 to 1090.5.
VectorDrawing long_stroke(double y, glm::vec3 color) {
    VectorDrawing drawing;
    drawing.width_px = 1200;
    drawing.height_px = 8;
    drawing.crop = {0, 0, 1200, 8};
    drawing.paper = glm::vec3(1.0f);
    drawing.styles.resize(1);
    drawing.styles[0].color = color;
    drawing.styles[0].opacity = 0.5f;
    drawing.styles[0].caps = StrokeCaps::butt;
    PathStep step;
    step.to = {1090.5, y};
    drawing.steps = {step};
    VectorPath path;
    path.start = {10.5, y};
    path.step_count = 1;
    drawing.paths = {path};
    drawing.groups.resize(1);
    drawing.groups[0].path_count = 1;
    drawing.sets = {"lines"};
    return drawing;
}

// The picture is wider than what is drawn at once.
TEST(RasterizeSvg, GivesAreasAsCoverageAndLinearColours) {
    const std::string rasterizer = find_svg_rasterizer();
    ASSERT_FALSE(rasterizer.empty()) << kInstall;
    const glm::vec3 color{0.5f, 0.0f, 1.0f};
    const std::vector<glm::vec4> pixels = rasterize_svg(long_stroke(4.25, color), rasterizer);
    ASSERT_EQ(pixels.size(), 1200u * 8u);
    for (int y = 0; y < 8; ++y) {
        const float of_row = y == 3 ? 0.25f : (y == 4 ? 0.75f : 0.0f);
        for (int x = 0; x < 1200; ++x) {
            const float of_column = x == 10 || x == 1090 ? 0.5f : (x > 10 && x < 1090 ? 1.0f : 0.0f);
            const glm::vec4& pixel = pixels[static_cast<std::size_t>(y * 1200 + x)];
            const float alpha = 0.5f * of_row * of_column;
            ASSERT_NEAR(pixel.a, alpha, 0.005f) << x << " " << y;
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], alpha * color[c], 0.008f) << x << " " << y;
        }
    }
}

TEST(RasterizeSvg, ACropIsThatPartOfThePicture) {
    const std::string rasterizer = find_svg_rasterizer();
    ASSERT_FALSE(rasterizer.empty()) << kInstall;
    VectorDrawing drawing = long_stroke(4.25, glm::vec3(0.0f));
    const std::vector<glm::vec4> whole = rasterize_svg(drawing, rasterizer);
    drawing.crop = {1005, 2, 1100, 7};
    const std::vector<glm::vec4> part = rasterize_svg(drawing, rasterizer);
    ASSERT_EQ(part.size(), 95u * 5u);
    for (std::size_t i = 0; i < part.size(); ++i) {
        EXPECT_EQ(part[i], whole[(i / 95 + 2) * 1200 + i % 95 + 1005]) << i;
    }
}

// Such pictures of rsvg-convert have no alpha channel.
TEST(RasterizeSvg, InkCanCoverAllOfThePicture) {
    const std::string rasterizer = find_svg_rasterizer();
    ASSERT_FALSE(rasterizer.empty()) << kInstall;
    VectorDrawing drawing = long_stroke(4, glm::vec3(0.5f, 0.0f, 1.0f));
    drawing.styles[0].opacity = 1;
    drawing.styles[0].width_px = 40;
    drawing.crop = {20, 0, 30, 8};
    for (const glm::vec4& pixel : rasterize_svg(drawing, rasterizer)) {
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(pixel[c], glm::vec4(0.5f, 0.0f, 1.0f, 1.0f)[c], 0.008f);
    }
}

TEST(RasterizeSvg, NeedsAFolderForItsFiles) {
    const ScopedVariable scratch("TMPDIR", "/nowhere/at/all");
    try {
        rasterize_svg(long_stroke(4, glm::vec3(0.0f)), "/bin/true");
        FAIL() << "there is no such folder";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("set TMPDIR"), std::string::npos) << error.what();
    }
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
