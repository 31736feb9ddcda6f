#include "compare/report.h"

#include <gtest/gtest.h>

#include "compare/metrics_files.h"
#include "methods/method_table.h"
#include "tests/support/temporary_folder.h"

namespace burin {
namespace {

Comparison small_comparison() {
    Comparison c;
    c.input = "</script><b>\"odd\", name";
    c.width = c.height = 8;
    c.crop = {0, 0, 8, 8};
    c.truth_method = methods().front().name;
    c.truth_picture = "truth.png";
    c.complete = true;
    MethodResult result;
    result.method = &methods().front();
    result.published.values[Metric::rmse] = 0.25;
    c.methods.push_back(result);
    return c;
}

// RFC 4648, section 10.
TEST(Base64, FollowsTheStandard) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(MetricTable, HasARowPerMetricWithAKeyOfItsOwn) {
    for (std::size_t i = 0; i < kMetricCount; ++i) {
        EXPECT_FALSE(metric_table()[i].key.empty());
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(metric_table()[i].key, metric_table()[k].key);
    }
}

TEST(MetricsFiles, WhatDoesNotApplyIsNullInJsonAndEmptyInCsv) {
    const Comparison c = small_comparison();
    const std::string json = metrics_json(c), csv = metrics_csv(c);
    EXPECT_NE(json.find("\"rmse\": 0.25"), std::string::npos);
    EXPECT_NE(json.find("\"psnr_db\": null"), std::string::npos);
    EXPECT_EQ(json.find("inf"), std::string::npos);
    EXPECT_NE(csv.find(",0.25,,"), std::string::npos);
    const auto columns = [](std::string_view line) { return std::count(line.begin(), line.end(), ','); };
    const std::size_t first = csv.find('\n'), second = csv.find('\n', first + 1);
    EXPECT_EQ(columns(csv.substr(0, first)), columns(csv.substr(first, second - first)));
}

TEST(Report, IsOnePageInWhichNamesOfFilesCannotBreakOut) {
    const test::TemporaryFolder folder;
    folder.write("truth.png", "no picture, but bytes");
    write_report(small_comparison(), folder.path());
    const std::string page = test::read_file(folder.file("report.html"));
    EXPECT_EQ(page.find("{{"), std::string::npos);
    EXPECT_EQ(page.find("</script><b>"), std::string::npos);
    EXPECT_NE(page.find("data:image/png;base64," + base64("no picture, but bytes")), std::string::npos);
    for (const char* outside : {"src=\"http", "href=\"http", "url(", "@import", "fetch("}) {
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    }
}

}  // namespace
}  // namespace burin
