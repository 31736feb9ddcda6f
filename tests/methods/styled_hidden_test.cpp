// Hidden lines, drawn or not, change nothing of visible ones.

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "mesh/shapes.h"
#include "tests/support/random.h"
#include "tests/support/shaded_scene.h"

namespace burin::styled_hidden_test {
namespace {

using namespace test;

constexpr int kWidth = 180, kHeight = 140;

/// A sheet with one set of visible lines, and one of hidden ones if it has a style.
std::string sheet_of_two(const std::string& visible, const std::string& hidden) {
    const std::string classes = R"(classes = ["border", "silhouette", "crease", "intersection", "object"])";
    std::string text = "style_version = 1\n[[set]]\nname = \"seen\"\nstyle = \"seen\"\n" + classes;
    if (!hidden.empty()) text += "\n[[set]]\nname = \"behind\"\nstyle = \"behind\"\nqi = [1, 255]\n" + classes;
    text += "\n[style.seen]\n" + visible + "\n";
    if (!hidden.empty()) text += "[style.behind]\n" + hidden + "\n";
    return text;
}

/// Boxes, balls, rings and bars, turned and placed at random; they hide each other and pass through each other.
std::vector<PolygonSoup> random_objects(std::uint64_t seed) {
    Random random(seed);
    std::vector<PolygonSoup> objects;
    for (int i = random.integer(3, 8); i > 0; --i) {
        const double size = random.real(20, 70);
        const int shape = random.integer(0, 3);
        const PolygonSoup soup = shape == 0   ? make_box(glm::dvec3(size, 0.3 * size, size))
                                 : shape == 1 ? make_sphere(0.5 * size, 32, 20)
                                 : shape == 2 ? make_torus(0.5 * size, 0.15 * size, 40, 16)
                                              : make_cylinder(0.3 * size, 0.2 * size, size, 24);
        const glm::dvec3 axis = random.direction();
        const glm::dvec3 place(random.real(20, kWidth - 20), random.real(20, kHeight - 20), random.real(-40, 40));
        const double turn = random.real(0, 6);
        objects.push_back(transformed(soup, [&](glm::dvec3 p) {
            const double c = std::cos(turn), s = std::sin(turn);
            return place + p * c + glm::cross(axis, p) * s + axis * (glm::dot(axis, p) * (1 - c));
        }));
    }
    return objects;
}

using PointKey = std::tuple<double, double, float, float, float, float, float, float>;
struct SeenStroke {
    InkOrder order;
    bool is_closed = false, is_constant = false;
    std::vector<PointKey> points;
    bool operator==(const SeenStroke&) const = default;
};
std::vector<SeenStroke> seen_strokes(const InkedLines& lines) {
    std::vector<SeenStroke> seen;
    for (const InkStroke& stroke : lines.strokes) {
        if (stroke.order.is_hidden) continue;
        SeenStroke& own = seen.emplace_back(SeenStroke{stroke.order, stroke.is_closed, stroke.is_constant, {}});
        for (const InkPoint& p : lines.points_of(stroke))
            own.points.emplace_back(p.place.x, p.place.y, p.nearness, p.width_px, p.opacity, p.color.r, p.color.g,
                                    p.color.b);
    }
    return seen;
}

constexpr const char* kVisible[] = {
    "width = 1.4",
    "width = \"=1 + 0.4 * facing2\"\nopacity = 0.5",
    "width = 2\ntaper = { start = 12, end = 9 }\novershoot = 5",
    "width = 1.4\nmin_length = [4, 9]\ncaps = \"butt\"",
};
constexpr const char* kHidden[] = {
    "width = 0.5\ndash = [4, 2]\nmin_length = 6",
    "width = 0.7\nopacity = 0.5\ntaper = { start = 12 }",
    "width = 2\nside = \"inside\"",
};

class StyledHidden : public ::testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Random, StyledHidden, ::testing::Range<std::uint64_t>(0, 8));

TEST_P(StyledHidden, LinesChangeNoVisibleStroke) {
    for (const char* const visible : kVisible) {
        const ShadedScene alone(random_objects(GetParam()), pixel_camera(kWidth, kHeight), sheet_of_two(visible, ""),
                                kWidth, kHeight);
        const std::vector<SeenStroke> expected = seen_strokes(alone.inked());
        ASSERT_FALSE(expected.empty());
        const Image picture = alone.draw();
        for (const char* const hidden : kHidden) {
            SCOPED_TRACE(std::string(visible) + "\nhidden: " + hidden);
            const ShadedScene both(random_objects(GetParam()), pixel_camera(kWidth, kHeight),
                                   sheet_of_two(visible, hidden), kWidth, kHeight);
            const InkedLines lines = both.inked();
            const std::vector<SeenStroke> seen = seen_strokes(lines);
            EXPECT_LT(seen.size(), lines.strokes.size()) << "nothing is hidden";
            std::size_t different =
                seen.size() > expected.size() ? seen.size() - expected.size() : expected.size() - seen.size();
            for (std::size_t i = 0; i < std::min(seen.size(), expected.size()); ++i)
                different += seen[i] == expected[i] ? 0 : 1;
            EXPECT_EQ(different, 0u);
            const Image with_hidden = both.draw();
            std::size_t different_pixels = 0;
            for (const char* const channel : {"lines.R", "lines.G", "lines.B", "lines.A"}) {
                for (int y = 0; y < kHeight; ++y) {
                    for (int x = 0; x < kWidth; ++x)
                        different_pixels +=
                            value_at(picture, channel, x, y) != value_at(with_hidden, channel, x, y) ? 1 : 0;
                }
            }
            EXPECT_EQ(different_pixels, 0u);
        }
    }
}

}  // namespace
}  // namespace burin::styled_hidden_test
