// What a sheet says of widths, ends, dashes and places is what strokes have, and what the picture shows.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/shapes.h"
#include "tests/methods/level_crease.h"
#include "tests/support/shaded_scene.h"

namespace burin::styled_values_test {
namespace {

using namespace test;

/// The ink of a column of pixels.
double ink_at(const Image& image, int x, int y0 = 0, int y1 = 100) {
    double sum = 0;
    for (int y = y0; y < y1; ++y) sum += value_at(image, "lines.A", x, y);
    return sum;
}
/// The width at a place of a level line, between the points that are there.
double width_at(const InkedLines& lines, double x) {
    double width = -1;
    for (const InkStroke& stroke : lines.strokes) {
        const auto points = lines.points_of(stroke);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const InkPoint &a = points[i], &b = points[i + 1];
            const double low = std::min(a.place.x, b.place.x), high = std::max(a.place.x, b.place.x);
            if (x < low || x > high || low == high) continue;
            width = glm::mix(static_cast<double>(a.width_px), static_cast<double>(b.width_px),
                             (x - a.place.x) / (b.place.x - a.place.x));
        }
    }
    return width;
}
/// An edge from depth 4 to 60, about level on the screen.
struct DeepEdge {
    static Scene scene();
    static ShadedScene with(const std::string& width) {
        const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, 40);
        const double height = 160, focal = height / 2 / std::tan(20 * std::numbers::pi / 180);
        const auto at = [&](double x, double y, double depth) {
            return glm::dvec3((x - 150) * depth / focal, (80 - y) * depth / focal, -depth);
        };
        // Two faces that turn away from the eye at the edge.
        return {
            {soup_of({at(20, 80, 4), at(280, 80, 60), at(280, 95, 75), at(20, 95, 5), at(280, 65, 75), at(20, 65, 5)},
                     {{0, 1, 2, 3}, {1, 0, 5, 4}})},
            camera,
            sheet_of(R"("crease")", "width = \"" + width + "\"", ""),
            300,
            160};
    }
    static double depth_at(double x) { return 1 / glm::mix(1.0 / 4, 1.0 / 60, (x - 20) / 260); }
};

TEST(StyledValues, WidthsFollowDepth) {
    const ShadedScene scene = DeepEdge::with("=0.05*depth + 0.5");
    const InkedLines lines = scene.inked();
    const Image image = scene.draw();
    for (int x = 30; x < 270; x += 10) {
        const double wanted = 0.05 * DeepEdge::depth_at(x + 0.5) + 0.5, off = std::max(0.02 * wanted, 1.0 / 64);
        EXPECT_NEAR(width_at(lines, x + 0.5), wanted, off) << x;
        EXPECT_NEAR(ink_at(image, x, 0, 160), wanted, off) << x;
    }
}

TEST(StyledValues, WidthsInWorldUnitsAreProjected) {
    const ShadedScene scene = DeepEdge::with("0.2world");
    const InkedLines lines = scene.inked();
    const Image image = scene.draw();
    const double focal = 80 / std::tan(20 * std::numbers::pi / 180);
    for (int x = 30; x < 270; x += 10) {
        const double wanted = 0.2 * focal / DeepEdge::depth_at(x + 0.5);
        EXPECT_NEAR(width_at(lines, x + 0.5), wanted, std::max(0.02 * wanted, 1.0 / 64)) << x;
        EXPECT_NEAR(ink_at(image, x, 0, 160), wanted, std::max(0.02 * wanted, 1.0 / 64)) << x;
    }
}

/// Depth changes as perspective has it, and few samples are needed for what is about straight.
TEST(StyledValues, SamplesAreAddedOnlyWhereNeeded) {
    // A depth ramp that is exactly linear on the screen: nearness is.
    const InkedLines linear = DeepEdge::with("=4 / depth + 1").inked();
    std::size_t points = 0;
    for (const InkStroke& s : linear.strokes) points += s.point_count;
    EXPECT_LE(points, 260u / 8 * 2 + 12);
    const InkedLines constant = DeepEdge::with("=1.5").inked();
    points = 0;
    for (const InkStroke& s : constant.strokes) points += s.point_count;
    EXPECT_LE(points, 260u / 8 + 12);
}

/// The error of what is drawn between samples, for profiles of all kinds.
TEST(StyledValues, SamplesKeepTheBoundOfWidth) {
    struct Profile {
        const char* text;
        double (*value)(double x);
    };
    const auto smooth = [](double a, double b, double v) {
        const double q = std::clamp((v - a) / (b - a), 0.0, 1.0);
        return q * q * (3 - 2 * q);
    };
    static const auto step = smooth;
    const Profile profiles[] = {
        {"=1 + x / 50", [](double x) { return 1 + x / 50; }},
        {"=3", [](double) { return 3.0; }},
        {"=2 + sind(x * 20)", [](double x) { return 2 + std::sin(x * 20 * std::numbers::pi / 180); }},
        {"=2 + sind(x * 45)", [](double x) { return 2 + std::sin(x * 45 * std::numbers::pi / 180); }},
        {"=5 * smoothstep(60, 90, x)", [](double x) { return 5 * step(60, 90, x); }},
        {"=sqrt(x)", [](double x) { return std::sqrt(x); }},
        {"=200 / (x - 10)", [](double x) { return 200 / (x - 10); }},
        {"=8 * exp(0 - (x - 100) * (x - 100) / 81)",
         [](double x) { return 8 * std::exp(-(x - 100) * (x - 100) / 81); }},
        {"=abs(x - 101.3) / 12", [](double x) { return std::abs(x - 101.3) / 12; }},
        {"=x / 200 * 2 + (x / 100) ^ 3", [](double x) { return x / 100 + x * x * x * 1e-6; }},
    };
    for (const Profile& profile : profiles) {
        const InkedLines lines = level(20, 220, 50.5, std::string("width = \"") + profile.text + "\"").inked();
        double most = 0;
        for (double x = 21; x < 219; x += 0.0617) {
            const double wanted = profile.value(x), tol = std::clamp(0.01 * wanted, 1.0 / 64, 1.0 / 8);
            most = std::max(most, std::abs(width_at(lines, x) - wanted) / tol);
        }
        EXPECT_LE(most, 1.5) << profile.text;
    }
}

TEST(StyledValues, ABallsPolygonsThinOutTowardsItsRim) {
    const double radius = 300;
    const ShadedScene scene(
        {transformed(make_sphere(radius, 96, 48), [](glm::dvec3 p) { return p + glm::dvec3(310, 310, 0); })},
        pixel_camera(620, 620), sheet_of(R"("polygon")", "width = \"=3*facing\""), 620, 620);
    const InkedLines lines = scene.inked();
    std::size_t count = 0, near_rim = 0;
    for (const InkStroke& stroke : lines.strokes) {
        const auto points = lines.points_of(stroke);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            for (const double share : {0.0, 0.3, 0.5, 0.8}) {
                const glm::dvec2 place = glm::mix(points[i].place, points[i + 1].place, share);
                const double width = glm::mix(static_cast<double>(points[i].width_px),
                                              static_cast<double>(points[i + 1].width_px), share);
                const double d = glm::distance(place, glm::dvec2(310, 310)) / radius;
                if (d > 0.95) continue;  // a pixel nearer to the rim changes the width by more than is allowed
                const double wanted = 3 * std::sqrt(1 - d * d);
                EXPECT_NEAR(width, wanted, std::max(0.02 * wanted, 1.0 / 64)) << d;
                ++count;
                near_rim += d > 0.9;
            }
        }
    }
    EXPECT_GT(count, 20000u);
    EXPECT_GT(near_rim, 1000u);
}

const PolygonSoup kPlate = rectangle(100, 20, 140, 80, 30);  // before the middle of a line from 20 to 220

TEST(StyledValues, TapersAreAtFreeEndsOnly) {
    for (const std::string set : {"", "qi = [0, 255]"}) {
        const ShadedScene scene =
            level(20, 220, 50.5, "width = 4\ntaper = { start = 24, end = 24, shape = \"linear\" }", set, {kPlate});
        const InkedLines lines = scene.inked();
        EXPECT_NEAR(width_at(lines, 99), 4, 1e-3) << set;
        EXPECT_NEAR(width_at(lines, 141), 4, 1e-3);
        EXPECT_NEAR(width_at(lines, 80), 4, 1e-3);
        for (const double s : {2.0, 6.0, 12.0, 20.0}) {
            EXPECT_NEAR(width_at(lines, 20 + s), 4 * s / 24, 0.06);
            EXPECT_NEAR(width_at(lines, 220 - s), 4 * s / 24, 0.06);
        }
        if (!set.empty()) {
            EXPECT_NEAR(width_at(lines, 101), 4, 1e-3);
        }
    }
}
TEST(StyledValues, TapersShrinkInProportionOnShortLines) {
    const InkedLines lines =
        level(100, 118, 50.5, "width = 4\ntaper = { start = 12, end = 24, shape = \"linear\" }").inked();
    // 18 px are shared as 6 and 12; which end comes first, the mesh says.
    const bool begins_left = width_at(lines, 106) > width_at(lines, 112);
    const auto at = [&](double s) { return width_at(lines, begins_left ? 100 + s : 118 - s); };
    EXPECT_NEAR(at(6), 4, 0.05);
    EXPECT_NEAR(at(3), 2, 0.05);
    EXPECT_NEAR(at(12), 2, 0.05);
    EXPECT_NEAR(at(15), 1, 0.05);
}
TEST(StyledValues, TapersHaveTheirShapes) {
    for (const std::string shape : {"linear", "round", "sharp"}) {
        const InkedLines lines =
            level(20, 220, 50.5, "width = 8\ntaper = { start = 40, end = 40, shape = \"" + shape + "\" }").inked();
        for (double s = 1; s < 45; s += 1.7) {
            const double q = std::min(s / 40, 1.0);
            const double wanted = 8 * (shape == "linear" ? q : shape == "round" ? std::sqrt(q * (2 - q)) : q * q);
            EXPECT_NEAR(width_at(lines, 20 + s), wanted, 1.5 * std::clamp(0.01 * wanted, 1.0 / 64, 0.125))
                << shape << s;
        }
    }
}

struct Extent {
    double from = 1e9, to = -1e9;
};
std::vector<Extent> strokes_of(const InkedLines& lines, bool is_hidden = false) {
    std::vector<Extent> all;
    for (const InkStroke& s : lines.strokes) {
        if (s.order.is_hidden != is_hidden) continue;
        Extent e;
        for (const InkPoint& p : lines.points_of(s)) {
            e.from = std::min(e.from, p.place.x);
            e.to = std::max(e.to, p.place.x);
        }
        all.push_back(e);
    }
    std::sort(all.begin(), all.end(), [](const Extent& a, const Extent& b) { return a.from < b.from; });
    return all;
}

TEST(StyledDashes, HaveTheLengthsAndPhaseOfTheirPattern) {
    for (const double phase : {0.0, 3.0, -2.5, 17.0}) {
        const InkedLines lines =
            level(20, 220, 50.5, "width = 2\ndash = [8, 5]\ndash_phase = " + std::to_string(phase)).inked();
        const auto dashes = strokes_of(lines);
        EXPECT_NEAR(static_cast<double>(dashes.size()), 200.0 / 13, 1.1);
        for (const Extent& e : dashes) {
            if (e.from < 21 || e.to > 219) continue;
            // Round ends are a part of the dash.
            EXPECT_NEAR(e.to - e.from, 8 - 2, 1e-3);
            EXPECT_NEAR(std::remainder(e.from - 1 - 20 + phase, 13.0), 0, 1e-3);
        }
    }
}
TEST(StyledDashes, MayHaveEightLengthsAndDots) {
    const InkedLines lines =
        level(20, 220, 50.5, "width = 1\ndash = [9, 2, 5, 2, 3, 2, 0.5, 4]\ncaps = \"round\"").inked();
    const auto dashes = strokes_of(lines);
    ASSERT_GT(dashes.size(), 24u);
    const double wanted[] = {8, 4, 2, 0};
    for (std::size_t i = 1; i + 1 < dashes.size(); ++i)
        EXPECT_NEAR(dashes[i].to - dashes[i].from, wanted[i % 4], 1e-3) << i;
}
TEST(StyledDashes, TooShortToBeSeenAreALighterLine) {
    const ShadedScene scene = level(20, 220, 50.5, "width = 2\ndash = [0.1, 0.3]\ncaps = \"butt\"");
    EXPECT_EQ(scene.inked().strokes.size(), 1u);
    EXPECT_NEAR(ink_at(scene.draw(), 100), 2 * 0.25, 0.01);
}
TEST(StyledDashes, AreTheSameOnSeenAndHiddenPartsOfALine) {
    const auto whole = strokes_of(level(20, 220, 50.5, "width = 1\ndash = [7, 4]\ncaps = \"butt\"").inked());
    const InkedLines lines =
        level(20, 220, 50.5, "width = 1\ndash = [7, 4]\ncaps = \"butt\"", "qi = [0, 255]", {kPlate}).inked();
    for (const bool is_hidden : {false, true}) {
        const auto parts = strokes_of(lines, is_hidden);
        EXPECT_GT(parts.size(), 3u);
        for (const Extent& part : parts) {
            const bool is_within = std::any_of(whole.begin(), whole.end(), [&](const Extent& e) {
                return part.from > e.from - 0.01 && part.to < e.to + 0.01;
            });
            EXPECT_TRUE(is_within) << part.from << " " << part.to;
        }
    }
}
TEST(StyledDashes, OfALoopHaveNoSeam) {
    // A disc's border is a loop.
    std::vector<glm::dvec3> corners;
    std::vector<std::uint32_t> polygon;
    for (std::uint32_t i = 0; i < 64; ++i) {
        const double a = i * 2 * std::numbers::pi / 64;
        corners.push_back({60 + 40 * std::cos(a), 50 + 40 * std::sin(a), 0});
        polygon.push_back(i);
    }
    const ShadedScene scene({soup_of(corners, {polygon})}, pixel_camera(120, 100),
                            sheet_of(R"("border")", "width = 1\ndash = [9, 6]\ncaps = \"butt\""), 120, 100);
    const InkedLines lines = scene.inked();
    std::vector<double> lengths;
    double shortest = 1e9;
    for (const InkStroke& s : lines.strokes) {
        double length = 0;
        const auto p = lines.points_of(s);
        for (std::size_t i = 1; i < p.size(); ++i) length += glm::distance(p[i - 1].place, p[i].place);
        lengths.push_back(length);
        shortest = std::min(shortest, length);
    }
    // 251 px: 17 periods of 14.8 px; the dash at the beginning may be in two parts.
    EXPECT_GE(lengths.size(), 17u);
    EXPECT_LE(lengths.size(), 18u);
    double sum = 0;
    for (const double l : lengths) sum += l;
    EXPECT_NEAR(sum, 64 * 80 * std::sin(std::numbers::pi / 64) * 9 / 15, 0.5);
    EXPECT_GT(*std::max_element(lengths.begin(), lengths.end()), 8.5);
    EXPECT_LT(*std::max_element(lengths.begin(), lengths.end()), 9.3);
}

TEST(StyledPlaces, OffsetsMoveLinesAway) {
    // A crease is moved to the right of its chain; a border away from its surface.
    for (const double offset : {3.0, -3.0}) {
        const ShadedScene scene({rectangle(60.5, 20.5, 180.5, 70.5, 0)}, pixel_camera(240, 100),
                                sheet_of(R"("border")", "width = 1\noffset = " + std::to_string(offset)), 240, 100);
        for (const InkPoint& p : scene.inked().points) {
            const double across = std::max(p.place.x - 180.5, 60.5 - p.place.x),
                         down = std::max(p.place.y - 79.5, 29.5 - p.place.y);
            if (std::min(across, down) > -4) continue;  // at a corner
            EXPECT_NEAR(std::max(across, down), offset, 0.01);
        }
    }
}
TEST(StyledPlaces, OvershootIsAtFreeEndsAndCornersOnly) {
    for (const double overshoot : {6.0, -6.0}) {
        const auto parts = strokes_of(
            level(20, 220, 50.5, "width = 1\novershoot = " + std::to_string(overshoot), "", {kPlate}).inked());
        ASSERT_EQ(parts.size(), 2u);
        EXPECT_NEAR(parts[0].from, 20 - overshoot, 0.01);
        EXPECT_NEAR(parts[0].to, 100, 0.3);
        EXPECT_NEAR(parts[1].from, 140, 0.3);
        EXPECT_NEAR(parts[1].to, 220 + overshoot, 0.01);
    }
}
TEST(StyledPlaces, CopiesAreStrokesOfTheirOwn) {
    const InkedLines lines = level(20, 220, 50.5, "width = \"=1 + copy\"\ncopies = 5").inked();
    ASSERT_EQ(lines.strokes.size(), 5u);
    std::vector<float> widths;
    std::vector<std::uint64_t> chains;
    for (const InkStroke& s : lines.strokes) {
        widths.push_back(lines.points_of(s)[0].width_px);
        chains.push_back(s.chain);
    }
    std::sort(widths.begin(), widths.end());
    EXPECT_EQ(widths, (std::vector<float>{1, 2, 3, 4, 5}));
    std::sort(chains.begin(), chains.end());
    EXPECT_EQ(std::unique(chains.begin(), chains.end()), chains.end());
}
/// Where another object begins behind a line, its pieces do, too, to a sample: sets that ask for it change there.
TEST(StyledPlaces, PiecesEndWhereWhatIsBehindThemDoes) {
    for (int step = 0; step < 16; ++step) {
        const double end = 90.3 + 0.5 * step;
        const ShadedScene scene({rectangle(20, 20, 180, 50, 0), rectangle(10, 10, end, 90, -40)},
                                pixel_camera(200, 100),
                                sheet_of(R"("border")", "width = 2", "select = \"object2 == 0\"\n"), 200, 100);
        const FoundLines lines = scene.found();
        int before = 0, behind = 0;
        for (std::size_t i = 0; i < lines.sides.size(); ++i) {
            const LinePiece& piece = lines.runs.pieces[i].piece;
            if (lines.sides[i].front_object != 1 || piece.from.y != piece.to.y) continue;
            const double low = std::min(piece.from.x, piece.to.x), high = std::max(piece.from.x, piece.to.x);
            const bool is_before = lines.sides[i].other_object != 0;
            (is_before ? before : behind) += 1;
            EXPECT_TRUE(is_before ? high <= end + 0.5 : low >= end - 0.5) << end << ": " << low << " to " << high;
        }
        EXPECT_GT(before, 0);
        EXPECT_GT(behind, 0);
    }
}

TEST(StyledPlaces, ShortRunsFadeIn) {
    const auto opacity = [](double length) {
        const InkedLines lines = level(100, 100 + length, 50.5, "width = 2\nmin_length = [10, 30]").inked();
        return lines.points.empty() ? 0.0 : static_cast<double>(lines.points[0].opacity);
    };
    EXPECT_EQ(opacity(9), 0);
    EXPECT_NEAR(opacity(20), 0.5, 0.01);
    EXPECT_NEAR(opacity(25), 0.75, 0.01);
    EXPECT_EQ(opacity(31), 1);
}
TEST(StyledPlaces, SmoothingIsTheMeanAlongTheLine) {
    const InkedLines lines = level(20, 220, 50.5, "width = \"=x < 120 ? 2 : 6\"\nsmooth = 10").inked();
    for (double x = 90; x < 150; x += 3.1)
        EXPECT_NEAR(width_at(lines, x), 2 + 4 * std::clamp((x - 110) / 20, 0.0, 1.0), 0.1) << x;
}

TEST(StyledPlaces, WobbleHoldsItsEndsAndStaysWithinItsAmplitude) {
    const InkedLines lines = level(20, 220, 50.5, "width = 1\nwobble = { amplitude = 3, wavelength = 30 }").inked();
    double most = 0, sum = 0;
    for (const InkPoint& p : lines.points) {
        most = std::max(most, std::abs(p.place.y - 50.5));
        sum += p.place.y - 50.5;
        if (p.place.x < 20.01 || p.place.x > 219.99) {
            EXPECT_NEAR(p.place.y, 50.5, 1e-6);
        }
    }
    EXPECT_GT(most, 0.7);
    EXPECT_LE(most, 4.5);
}
TEST(StyledPlaces, WobbleOnTheObjectStaysAsTheCameraComesNearer) {
    const auto wobble = [](double height, double x_share) {
        const ShadedScene scene("[camera]\neye = [0, 0, 9]\nheight = " + std::to_string(height) + R"(
[[object]]
shape = "box"
size = [4, 4, 1]
rotate = [0, 0, 0]
)",
                                sheet_of(R"("silhouette")", "width = 1\nwobble = { amplitude = 4, wavelength = 25 }"),
                                400, 400);
        // How far the upper edge has moved at a place of the object.
        const InkedLines lines = scene.inked();
        const double px = 400 / height, x = 200 + (x_share - 0.5) * 4 * px, y = 200 - 2 * px;
        for (const InkStroke& s : lines.strokes) {
            const auto p = lines.points_of(s);
            for (std::size_t i = 0; i + 1 < p.size(); ++i) {
                const auto [low, high] = std::minmax(p[i].place.x, p[i + 1].place.x);
                if (x < low || x > high || low == high || std::abs(p[i].place.y - y) > 10) continue;
                return glm::mix(p[i].place.y, p[i + 1].place.y,
                                (x - p[i].place.x) / (p[i + 1].place.x - p[i].place.x)) -
                       y;
            }
        }
        ADD_FAILURE() << "no line there";
        return 0.0;
    };
    double most = 0;
    for (double share = 0.2; share < 0.81; share += 0.05) {
        double before = wobble(6, share);
        for (double height = 6; height > 5.4; height /= 1.01) {
            const double after = wobble(height / 1.01, share);
            EXPECT_LE(std::abs(after - before), 0.04 * 4) << share << " " << height;
            most = std::max(most, std::abs(after));
            before = after;
        }
    }
    EXPECT_GT(most, 1);
}

/// Along a loop, noise has no seam.
TEST(StyledPlaces, WobbleOfALoopIsClosed) {
    const ShadedScene scene(
        {transformed(make_sphere(40, 64, 32), [](glm::dvec3 p) { return p + glm::dvec3(60, 50, 0); })},
        pixel_camera(120, 100),
        sheet_of(R"("silhouette")", "width = 1\nwobble = { amplitude = 3, wavelength = 30, anchor = \"chain\" }"), 120,
        100);
    const InkedLines lines = scene.inked();
    ASSERT_EQ(lines.strokes.size(), 1u);
    const auto p = lines.points_of(lines.strokes[0]);
    EXPECT_LT(glm::distance(p.front().place, p.back().place), 0.1);
    EXPECT_GT(p.size(), 40u);
}

TEST(StyledSets, HiddenInkIsInItsOwnLayerAndSetsInTheirs) {
    const std::string sheet = R"(style_version = 1
[[set]]
name = "seen"
classes = ["crease"]
style = "ink"
layer = "one"
[[set]]
name = "behind"
classes = ["crease"]
qi = [1, 255]
style = "grey"
layer = "two"
[style.ink]
width = 3
[style.grey]
width = 2
color = "#808080"
)";
    const ShadedScene scene({folded({20, 49.5, 0}, {220, 49.5, 0}), kPlate}, pixel_camera(240, 100), sheet, 240, 100);
    const Image image = scene.draw();
    const auto column = [&](const std::string& channel, int x) {
        double sum = 0;
        for (int y = 0; y < 100; ++y) sum += value_at(image, channel, x, y);
        return sum;
    };
    EXPECT_NEAR(column("lines.A", 60), 3, 0.02);
    EXPECT_NEAR(column("lines_one.A", 60), 3, 0.02);
    EXPECT_EQ(column("lines_two.A", 60), 0);
    EXPECT_EQ(column("lines_hidden.A", 60), 0);
    EXPECT_EQ(column("lines.A", 120), 0);
    EXPECT_EQ(column("lines_one.A", 120), 0);
    EXPECT_NEAR(column("lines_two.A", 120), 2, 0.02);
    EXPECT_NEAR(column("lines_hidden.A", 120), 2, 0.02);
}

TEST(StyledSets, AlsoDrawsALineTwiceAndPrioritiesOrderIt) {
    for (const bool is_thin_above : {true, false}) {
        const std::string sheet = std::string(R"(style_version = 1
[[set]]
name = "wide"
classes = ["crease"]
style = "wide"
also = true
[[set]]
name = "thin"
classes = ["crease"]
style = "thin"
[style.wide]
width = 7
color = "#ff0000"
[style.thin]
width = 3
color = "#0000ff"
priority = )") + (is_thin_above ? "1" : "-1") +
                                  "\n";
        const ShadedScene scene({folded({20, 49.5, 0}, {220, 49.5, 0})}, pixel_camera(240, 100), sheet, 240, 100);
        const Image image = scene.draw();
        EXPECT_NEAR(value_at(image, "lines.B", 120, 50), is_thin_above ? 1 : 0, 0.01);
        EXPECT_NEAR(value_at(image, "lines.R", 120, 50), is_thin_above ? 0 : 1, 0.01);
        EXPECT_NEAR(value_at(image, "lines.R", 120, 53), 1, 0.01);
        EXPECT_NEAR(ink_at(image, 120), 7, 0.02);
    }
}

}  // namespace
}  // namespace burin::styled_values_test
