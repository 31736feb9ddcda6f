#include <gtest/gtest.h>

#include <cmath>

#include "compare/chart_metrics.h"
#include "compare/render_lines.h"
#include "methods/method_table.h"

namespace burin {
namespace {

const LineClassSet kCreasesAndSilhouettes = LineClassSet(LineClass::crease) | LineClass::silhouette;

/// Adds a stroke to a picture, exactly, from end to end.
void add_stroke(Plane& plane, const Segment& s, double width_px, double overhang_px = 0) {
    const glm::dvec2 along = s.along(), across = s.across();
    const glm::dvec2 low = glm::min(s.a, s.b) - width_px - 2.0 - overhang_px;
    const glm::dvec2 high = glm::max(s.a, s.b) + width_px + 2.0 + overhang_px;
    const auto inside = [](double v, int size) { return std::clamp(static_cast<int>(v), 0, size - 1); };
    for (int y = inside(low.y, plane.height); y <= inside(high.y, plane.height); ++y) {
        for (int x = inside(low.x, plane.width); x <= inside(high.x, plane.width); ++x) {
            const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) - s.a;
            const double t = glm::dot(p, along);
            if (t < -overhang_px || t > s.length() + overhang_px) continue;
            float& value = plane.at(x, y);
            value = std::max(value, static_cast<float>(band_coverage(glm::dot(p, across), across, width_px)));
        }
    }
}

Plane ideal_drawing(const TestChart& chart, double width_px) {
    Plane plane(chart.width, chart.height);
    for (const Segment& s : chart.star) add_stroke(plane, s, width_px);
    for (const Segment& s : chart.slopes) add_stroke(plane, s, width_px);
    for (const Segment& s : chart.silhouettes) add_stroke(plane, s, width_px, 2);
    return plane;
}

TEST(TestChart, HasOneLinePerDegreeInsideThePicture) {
    const TestChart chart = make_test_chart(1);
    ASSERT_EQ(chart.star.size(), 180u);
    for (std::size_t i = 0; i < 180; ++i) {
        const glm::dvec2 along = chart.star[i].along();
        const double degrees = std::atan2(-along.y, along.x) * 180 / 3.14159265358979323846;  // y points down
        EXPECT_NEAR(std::remainder(degrees - static_cast<double>(i), 180), 0, 1e-6);
        for (const glm::dvec2 end : {chart.star[i].a, chart.star[i].b}) {
            EXPECT_TRUE(end.x > 0 && end.y > 0 && end.x < chart.width && end.y < chart.height);
        }
    }
    EXPECT_EQ(chart.hidden.size(), 32u);
}

TEST(ChartMetrics, AnExactDrawingIsPerfect) {
    for (const double width : {1.0, 2.5}) {
        const TestChart chart = make_test_chart(width);
        ComparisonRow row;
        measure_chart(chart, ideal_drawing(chart, width), kCreasesAndSilhouettes, width, row);
        EXPECT_NEAR(*row.values[Metric::width_px], width, 0.002);
        EXPECT_NEAR(*row.values[Metric::width_bias], 0, 0.002);
        EXPECT_LT(*row.values[Metric::width_ripple], 0.01);
        EXPECT_LT(*row.values[Metric::offset_px], 0.002);
        EXPECT_LT(*row.values[Metric::angle_rmse], 1e-6);
        EXPECT_EQ(*row.values[Metric::stippled_share], 0);
        EXPECT_EQ(*row.values[Metric::leak_share], 0);
        EXPECT_NEAR(*row.values[Metric::silhouette_ratio], 1, 0.01);
    }
}

TEST(ChartMetrics, MeasuresLeaksStipplesAndHalfSilhouettes) {
    const TestChart chart = make_test_chart(1);
    Plane drawing(chart.width, chart.height);
    for (const Segment& s : chart.star) add_stroke(drawing, s, 1);
    for (std::size_t i = 0; i < chart.slopes.size(); i += 2) add_stroke(drawing, chart.slopes[i], 1);
    for (const Segment& s : chart.silhouettes) add_stroke(drawing, s, 0.5, 2);
    for (std::size_t i = 0; i < 8; ++i) add_stroke(drawing, chart.hidden[i].segment, 1);  // the two smallest gaps
    ComparisonRow row;
    measure_chart(chart, drawing, kCreasesAndSilhouettes, 1, row);
    EXPECT_NEAR(*row.values[Metric::stippled_share], 0.5, 1e-9);
    EXPECT_NEAR(*row.values[Metric::leak_share], 0.25, 0.01);
    EXPECT_NEAR(*row.values[Metric::silhouette_ratio], 0.5, 0.01);
    ASSERT_EQ(row.curves->leak_share.size(), 8u);
    EXPECT_NEAR(row.curves->leak_share[1], 1, 0.03);
    EXPECT_EQ(row.curves->leak_share[2], 0);
}

// A pixel is black where a line one pixel wide crosses its middle's row or column: unbroken stairs.
TEST(ChartMetrics, UnbrokenAliasedLinesAreNotStippled) {
    const TestChart chart = make_test_chart(1);
    Plane drawing(chart.width, chart.height);
    for (const std::vector<Segment>* lines : {&chart.star, &chart.slopes}) {
        for (const Segment& s : *lines) {
            const glm::dvec2 d = s.b - s.a;
            const int steps = static_cast<int>(std::max(std::abs(d.x), std::abs(d.y)) * 16);
            const bool is_flat = std::abs(d.x) > std::abs(d.y);
            for (int i = 0; i <= steps; ++i) {
                const glm::dvec2 p = s.a + d * (static_cast<double>(i) / steps);
                const double t = is_flat ? p.x : p.y;
                if (std::abs(t - std::floor(t) - 0.5) > 0.05) continue;  // the pixel's middle
                drawing.at(static_cast<int>(p.x), static_cast<int>(p.y)) = 1;
            }
        }
    }
    ComparisonRow row;
    measure_chart(chart, drawing, kCreasesAndSilhouettes, 1, row);
    EXPECT_EQ(*row.values[Metric::stippled_share], 0);
}

TEST(ChartMetrics, AMethodWithoutInteriorLinesIsNotMeasured) {
    const TestChart chart = make_test_chart(1);
    ComparisonRow row;
    measure_chart(chart, Plane(chart.width, chart.height), LineClass::silhouette, 1, row);
    EXPECT_FALSE(row.values[Metric::width_px]);
    EXPECT_FALSE(row.values[Metric::leak_share]);
    EXPECT_EQ(chart_classes(LineClass::polygon), LineClassSet(LineClass::polygon));
}

// The chart's geometry is where the chart says it is: a method of the program finds every line
// there.
TEST(ChartMetrics, AMethodDrawsTheLinesWhereTheyAre) {
    TestChart chart = make_test_chart(1);
    chart.scene.lines.classes = kCreasesAndSilhouettes;
    chart.scene.patel.mask_bits = 256;
    const ComparedView view{chart.camera, chart.width, chart.height, {0, 0, chart.width, chart.height}};
    ComparisonRow row;
    measure_chart(chart, render_lines(*find_method("patel"), chart.scene, view, {2, nullptr}).coverage,
                  LineClassSet::all(), 1, row);
    EXPECT_LT(*row.values[Metric::offset_px], 0.01);
    for (const double width : row.curves->width_px) EXPECT_GT(width, 0.6);
    EXPECT_EQ(*row.values[Metric::stippled_share], 0);
    EXPECT_EQ(*row.values[Metric::leak_share], 0);
    EXPECT_NEAR(*row.values[Metric::silhouette_ratio], 1, 0.05);
}

// What the methods' own descriptions say: docs/methods/slope-offset.md, id-buffer.md and offset.md.
TEST(ChartMetrics, HiddenLinesLeakThroughSteepCovers) {
    TestChart chart = make_test_chart(1);
    chart.scene.lines.classes = kCreasesAndSilhouettes;
    const ComparedView view{chart.camera, chart.width, chart.height, {0, 0, chart.width, chart.height}};
    for (const char* name : {"offset", "slope-offset", "id-buffer"}) {
        ComparisonRow row;
        measure_chart(chart, render_lines(*find_method(name), chart.scene, view, {2, nullptr}).coverage,
                      LineClassSet::all(), 1, row);
        EXPECT_GT(row.curves->leak_share.front(), 0.1) << name;
        EXPECT_LT(row.curves->leak_share.back(), 0.5 * row.curves->leak_share.front()) << name;
    }
}

}  // namespace
}  // namespace burin
