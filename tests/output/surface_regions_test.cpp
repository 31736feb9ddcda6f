// Surfaces as filled paths.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "image/half.h"
#include "output/path_data.h"
#include "output/paths/surface_regions.h"
#include "output/svg.h"
#include "render/film.h"
#include "tests/support/random.h"

namespace burin {
namespace {

/// Loops of a path, closed.
std::vector<std::vector<glm::dvec2>> loops_of(const VectorDrawing& drawing, const VectorPath& path) {
    std::vector<std::vector<glm::dvec2>> loops = {{path.start}};
    for (const PathStep& step : drawing.steps_of(path)) {
        if (step.kind == PathStep::Kind::move) loops.emplace_back();
        loops.back().push_back(step.to);
    }
    return loops;
}

double area_of(const std::vector<glm::dvec2>& loop) {
    double area = 0;
    for (std::size_t i = 0; i + 1 < loop.size(); ++i)
        area += 0.5 * (loop[i].y * loop[i + 1].x - loop[i].x * loop[i + 1].y);
    return area;
}

SurfaceGrid grid_of(int columns, int rows, const std::vector<std::uint32_t>& looks) {
    SurfaceGrid grid;
    grid.area = {10, 20, 10 + columns, 20 + rows};
    grid.looks.resize(5);
    for (std::uint32_t i = 1; i < 5; ++i) grid.looks[i] = {i, glm::vec3(0.2f * static_cast<float>(i)), 1};
    grid.look_at = looks;
    return grid;
}

VectorDrawing regions_of(const SurfaceGrid& grid) {
    VectorDrawing drawing;
    drawing.width_px = grid.area.x1;
    drawing.height_px = grid.area.y1;
    drawing.crop = grid.area;
    drawing.objects = {"a", "b", "c", "d"};
    add_surface_regions(grid, drawing);
    return drawing;
}

/// Random patches: each part of an edge is one of two regions, in opposite directions, or has nothing on its other
/// side. So there are no gaps, nothing lies twice, and areas are about those of the grid.
TEST(SurfaceRegions, HaveTheSameEdgesAsTheirNeighbours) {
    test::Random random(5);
    for (int trial = 0; trial < 40; ++trial) {
        constexpr int kColumns = 40, kRows = 30;
        std::vector<std::uint32_t> looks(kColumns * kRows, 0);
        for (int patch = 0; patch < 14; ++patch) {
            const int x0 = random.integer(0, kColumns), y0 = random.integer(0, kRows), size = random.integer(1, 14);
            const auto look = static_cast<std::uint32_t>(random.integer(0, 4));
            for (int y = 0; y < kRows; ++y) {
                for (int x = 0; x < kColumns; ++x) {
                    const bool is_in = trial % 2 == 0 ? std::hypot(x - x0, y - y0) < size
                                                      : std::abs(x - x0) < size && std::abs(y - y0) < size;
                    if (is_in) looks[static_cast<std::size_t>(y * kColumns + x)] = look;
                }
            }
        }
        const SurfaceGrid grid = grid_of(kColumns, kRows, looks);
        const VectorDrawing drawing = regions_of(grid);
        std::map<std::array<double, 4>, int> parts;
        double all = 0, wanted = 0;
        for (const VectorPath& path : drawing.paths) {
            EXPECT_TRUE(path.is_closed);
            double area = 0;
            for (const auto& loop : loops_of(drawing, path)) {
                ASSERT_GE(loop.size(), 4u);
                EXPECT_EQ(loop.front(), loop.back());
                area += area_of(loop);
                for (std::size_t i = 0; i + 1 < loop.size(); ++i)
                    ++parts[{loop[i].x, loop[i].y, loop[i + 1].x, loop[i + 1].y}];
            }
            const auto cells = std::count(looks.begin(), looks.end(), path.object);
            EXPECT_NEAR(area, static_cast<double>(cells), 10 + 0.2 * static_cast<double>(cells));
            all += area;
        }
        double borders = 0;
        for (const auto& [part, count] : parts) {
            EXPECT_EQ(count, 1);
            if (!parts.contains({part[2], part[3], part[0], part[1]})) {
                const std::vector<glm::dvec2> way = {{0, 0}, {part[0], part[1]}, {part[2], part[3]}, {0, 0}};
                borders += area_of(way);
            }
        }
        for (const std::uint32_t look : looks) wanted += look > 0 ? 1 : 0;
        EXPECT_NEAR(all, borders, 1e-6);  // what lies within the border of all that is seen
        EXPECT_NEAR(all, wanted, 12 + 0.05 * wanted);
    }
}

/// Edges that are straight have few points, and lie where they are.
TEST(SurfaceRegions, StraightEdgesAreStraight) {
    constexpr int kColumns = 300, kRows = 200;
    std::vector<std::uint32_t> looks;
    const auto is_in = [](double x, double y) { return y > 20 + 0.31 * x && y < 185 - 0.27 * x && x > 30; };
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x) looks.push_back(is_in(x + 0.5, y + 0.5) ? 1 : 0);
    }
    const VectorDrawing drawing = regions_of(grid_of(kColumns, kRows, looks));
    ASSERT_EQ(drawing.paths.size(), 1u);
    EXPECT_LE(drawing.paths[0].step_count, 9u);
    const auto loops = loops_of(drawing, drawing.paths[0]);
    for (const glm::dvec2 p : loops.front()) {
        const double x = p.x - 10, y = p.y - 20;
        EXPECT_LT(std::min({std::abs(y - 20 - 0.31 * x), std::abs(y - 185 + 0.27 * x), std::abs(x - 30)}), 1.0);
    }
}

/// A hole is a part of the path that runs the other way, so nothing fills it; ids depend on object and colour alone.
TEST(SurfaceRegions, HolesAreLeftOpenInFiles) {
    std::vector<std::uint32_t> looks(20 * 20, 1);
    for (int y = 5; y < 15; ++y) {
        for (int x = 5; x < 15; ++x) looks[static_cast<std::size_t>(y * 20 + x)] = x < 10 ? 0 : 2;
    }
    const VectorDrawing drawing = regions_of(grid_of(20, 20, looks));
    ASSERT_EQ(drawing.groups.size(), 2u);
    EXPECT_TRUE(drawing.groups[0].is_surface);
    EXPECT_EQ(path_data(drawing.paths[0], drawing.steps_of(drawing.paths[0])),
              "M20 25l5 0 0 10-5 0-5 0 0-10zM10 20l0 20 20 0 0-20z");
    const std::string svg = svg_of(drawing, {});
    EXPECT_NE(svg.find("inkscape:label=\"surfaces\""), std::string::npos);
    const auto id_at = [](const std::string& text, std::size_t at) {
        return text.substr(text.find("<path id=", at), 24);
    };
    std::fill(looks.begin(), looks.end(), 2);
    const std::string other = svg_of(regions_of(grid_of(20, 20, looks)), {});
    EXPECT_NE(id_at(svg, 0), id_at(other, 0));
    EXPECT_EQ(id_at(svg, svg.find("</g>")), id_at(other, 0));
}

using Colors = std::array<std::vector<std::uint16_t>, 4>;

/// The edge between two objects, whose pixels are mixed there; what varies gets its mean.
TEST(SurfaceGrids, PixelsAtEdgesGetTheColourOfTheirObject) {
    constexpr int kColumns = 60, kRows = 40;
    SurfaceGridMaker maker({0, 0, kColumns, kRows}, 1, {0.75, 0.75});
    for (int y = 0; y < kRows; ++y) {
        std::vector<std::uint32_t> objects;
        Colors colors;
        for (int x = 0; x < kColumns; ++x) {
            const double edge = 20.3 + 0.4 * y, right = std::clamp(x + 1 - edge, 0.0, 1.0);
            objects.push_back(y < 4 ? 0 : y > 30 ? 3 : x + 0.75 > edge ? 2 : 1);
            std::array<double, 4> color = {1 - right, 0, right, 1};
            if (y < 4) color = {};
            if (y == 4) color = {0.5 * (1 - right), 0, 0.5 * right, 0.5};
            if (y > 30) color = {x / 60.0, 0.5, 0.5, 1};
            for (std::size_t k = 0; k < 4; ++k) colors[k].push_back(Film::to_half(static_cast<float>(color[k])));
        }
        maker.add_row(objects.data(), {colors[0].data(), colors[1].data(), colors[2].data(), colors[3].data()});
    }
    const SurfaceGrid grid = maker.grid();
    ASSERT_EQ(grid.looks.size(), 4u);
    EXPECT_EQ(grid.mean_objects, 1u);
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x) {
            const SurfaceGrid::Look& look = grid.looks[grid.look_at[static_cast<std::size_t>(y * kColumns + x)]];
            const bool is_right = x + 0.75 > 20.3 + 0.4 * y;
            const std::uint32_t object = y < 4 ? 0 : y > 30 ? 3 : is_right ? 2 : 1;
            ASSERT_EQ(look.object, object) << x << " " << y;
            const float red[] = {0, 1, 0, 0.49f}, blue[] = {0, 0, 1, 0.5f};
            EXPECT_NEAR(look.color.r, red[object], 0.02f);
            EXPECT_NEAR(look.color.b, blue[object], 0.01f);
        }
    }
}

}  // namespace
}  // namespace burin
