// Where lines go that a sheet moves to one side.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mesh/shapes.h"
#include "tests/support/shaded_scene.h"

namespace burin::styled_moves_test {
namespace {

using namespace test;

/// Intersections of small triangles have hairs between two samples, which run anywhere; the line beside them does not.
TEST(StyledPlaces, OffsetOfIntersectionsHasNoTangles) {
    const auto at = [](PolygonSoup soup, glm::dvec3 place) {
        return transformed(soup, [place](glm::dvec3 p) { return p + place; });
    };
    const ShadedScene scene(
        {at(make_sphere(120, 96, 48), {150, 140, 0}), at(make_torus(100, 30, 96, 24), {180, 150, 60})},
        pixel_camera(340, 300), sheet_of(R"("intersection")", "width = 1\noffset = 6"), 340, 300);
    const LineRuns runs = scene.found().runs;
    double found = 0, drawn = 0;
    for (const LineRun& run : runs.runs) found += runs.length_px(run);
    const InkedLines lines = scene.inked();
    for (const InkStroke& stroke : lines.strokes) {
        const auto p = lines.points_of(stroke);
        for (std::size_t i = 1; i < p.size(); ++i) drawn += glm::distance(p[i - 1].place, p[i].place);
    }
    EXPECT_GT(found, 100);
    EXPECT_NEAR(drawn, found, 0.25 * found);
}

/// A polygon moved outwards or inwards is a larger or smaller one, however short its sides are: each place of it is as
/// far off the line as the sheet says, and at sharp corners at most twice that.
TEST(StyledPlaces, OffsetOfSmallPolygonsKeepsTheirCorners) {
    for (const double size : {1.5, 3.0, 12.0, 14.3, 16.0, 60.0}) {
        for (const int corners : {3, 4, 5, 12}) {
            PolygonSoup soup;
            std::vector<std::uint32_t> polygon;
            for (int i = 0; i < corners; ++i) {
                const double angle = 6.2832 * (i + 0.3) / corners;
                soup.positions.emplace_back(70.1 + size * std::cos(angle), 60.3 + size * std::sin(angle), 0);
                polygon.push_back(static_cast<std::uint32_t>(i));
            }
            soup.add_polygon(polygon);
            const ShadedScene scene({soup}, pixel_camera(140, 120),
                                    sheet_of(R"("border", "silhouette")", "width = 1\noffset = 4"), 140, 120);
            const LineRuns runs = scene.found().runs;
            const auto distance_to_line = [&](glm::dvec2 p) {
                double least = std::numeric_limits<double>::infinity();
                for (const RunPiece& of_run : runs.pieces) {
                    const LinePiece& piece = of_run.piece;
                    const glm::dvec2 way = piece.to - piece.from;
                    const double square = glm::dot(way, way),
                                 share = square > 0 ? std::clamp(glm::dot(p - piece.from, way) / square, 0.0, 1.0) : 0;
                    least = std::min(least, glm::distance(p, piece.from + share * way));
                }
                return least;
            };
            const InkedLines lines = scene.inked();
            ASSERT_FALSE(lines.strokes.empty()) << size;
            // A regular polygon becomes a larger or smaller one, without hooks at its corners.
            double drawn = 0;
            for (const InkStroke& stroke : lines.strokes) {
                const auto p = lines.points_of(stroke);
                for (std::size_t i = 1; i < p.size(); ++i) drawn += glm::distance(p[i - 1].place, p[i].place);
            }
            const double step = 3.14159265 / corners, inner = size * std::cos(step),
                         around = 2 * corners * size * std::sin(step);
            const auto error_of = [&](double inner_moved) {
                return std::abs(drawn - around * inner_moved / inner) / around;
            };
            const double bound = size > 10 ? 0.03 : 100;
            EXPECT_LT(std::min(error_of(inner + 4), error_of(inner - 4)), bound) << corners << ", " << size;
            for (const InkStroke& stroke : lines.strokes) {
                for (const InkPoint& p : lines.points_of(stroke)) {
                    const double off = distance_to_line(p.place);
                    // A small polygon moved inwards comes out at its other side.
                    EXPECT_GT(off, size > 20 ? 3.9 : -1.0) << corners << " corners, " << size;
                    EXPECT_LT(off, 8.1) << corners << " corners, " << size;
                }
            }
        }
    }
}

/// Contours of a mesh fold back by a pixel here and there, as where they pass from facet to facet. A line that is moved
/// far from such a contour has no spikes there: moved outwards by 12 pixels it is a little longer than the contour.
TEST(StyledPlaces, OffsetOfContoursThatFoldHasNoSpikes) {
    for (const char* contours : {"mesh", "smooth"}) {
        const std::string sheet = "contours = \"" + std::string(contours) + "\"\n" +
                                  sheet_of(R"("silhouette")", "width = 1\noffset = 12\nmin_length = 6");
        const ShadedScene scene(read_scene_file(BURIN_SOURCE_FOLDER "/scenes/teapot.toml", {}), sheet, 800, 500);
        const LineRuns runs = scene.found().runs;
        double found = 0, drawn = 0;
        for (const LineRun& run : runs.runs) {
            if (runs.length_px(run) >= 6) found += runs.length_px(run);
        }
        const InkedLines lines = scene.inked();
        for (const InkStroke& stroke : lines.strokes) {
            const auto p = lines.points_of(stroke);
            for (std::size_t i = 1; i < p.size(); ++i) drawn += glm::distance(p[i - 1].place, p[i].place);
        }
        EXPECT_GT(found, 1000) << contours;
        EXPECT_NEAR(drawn, found, 0.2 * found) << contours;
    }
}

/// The rim of a plate is one line, of which a part is the plate's outline and the rest an edge between two surfaces
/// that are seen. The part that is moved keeps its distance up to where it ends.
TEST(StyledPlaces, OffsetOfAPartOfALineKeepsItsDistance) {
    const ShadedScene scene(
        "[camera]\neye = [3, 2.5, 6]\nfov = 30\n[[object]]\nname = \"plate\"\n"
        "shape = \"cylinder\"\nradius = 2\nheight = 0.15\n",
        "[[set]]\nname = \"shore\"\nclasses = [\"silhouette\"]\nstyle = \"shore\"\n"
        "[[set]]\nname = \"edges\"\nclasses = [\"crease\", \"polygon\"]\nstyle = \"edge\"\n"
        "[style.shore]\nwidth = 1\noffset = 12\n[style.edge]\nwidth = 0.5\n",
        400, 300);
    const LineRuns runs = scene.found().runs;
    const InkedLines lines = scene.inked();
    int moved = 0;
    for (const InkStroke& stroke : lines.strokes) {
        if (stroke.order.set != 0) continue;
        for (const InkPoint& p : lines.points_of(stroke)) {
            double least = std::numeric_limits<double>::infinity();
            for (const RunPiece& of_run : runs.pieces) {
                const glm::dvec2 way = of_run.piece.to - of_run.piece.from, from = of_run.piece.from;
                const double share = std::clamp(glm::dot(p.place - from, way) / glm::dot(way, way), 0.0, 1.0);
                least = std::min(least, glm::distance(p.place, from + share * way));
            }
            EXPECT_NEAR(least, 12, 0.5) << p.place.x << ',' << p.place.y;
            ++moved;
        }
    }
    EXPECT_GT(moved, 50);
}

}  // namespace
}  // namespace burin::styled_moves_test
