// A line has one id, whichever of an edge's triangles its pieces were found between, and whether they are seen or not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::line_ids_test {
namespace {

using namespace test;

constexpr int kSize = 200;

/// Sheets that meet in one edge from (0, -1, 0) to (0, 1, 0), in any order and winding, subdivided or not.
PolygonSoup fan(Random& random, int sheets) {
    std::vector<glm::dvec3> positions = {{0, -1, 0}, {0, 1, 0}};
    std::vector<std::vector<std::uint32_t>> polygons;
    const double first = random.real(0, 2 * std::numbers::pi);
    for (int i = 0; i < sheets; ++i) {
        const double angle = first + 2 * std::numbers::pi * (i + random.real(0, 0.4)) / sheets;
        const auto next = static_cast<std::uint32_t>(positions.size());
        positions.push_back({std::cos(angle), -1, std::sin(angle)});
        positions.push_back({std::cos(angle), 1, std::sin(angle)});
        std::vector<std::uint32_t> sheet = {0, 1, next + 1, next};
        if (random.integer(0, 1) != 0) std::reverse(sheet.begin(), sheet.end());
        std::rotate(sheet.begin(), sheet.begin() + random.integer(0, 3), sheet.end());
        polygons.push_back(sheet);
    }
    for (std::size_t i = polygons.size(); i > 1; --i)
        std::swap(polygons[i - 1], polygons[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    return soup_of(std::move(positions), std::move(polygons));
}

TEST(LineIds, AnEdgeOfAnyNumberOfPolygonsIsOneLine) {
    std::size_t pieces = 0, behind = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        // A plate hides the lower half of the edge.
        const PolygonSoup plate = soup_of({{-2, -2, 1.5}, {2, -2, 1.5}, {2, 0, 1.5}, {-2, 0, 1.5}}, {{0, 1, 2, 3}});
        Scene scene = scene_of({fan(random, random.integer(2, 7)), plate});
        scene.lines.style.hidden.style = HiddenStyle::dashed;  // asks for whole lines
        scene.lines.classes = LineClassSet::all();
        const Camera camera =
            perspective_camera({random.real(-4, 4), random.real(-0.5, 0.5), random.real(3, 5)}, {0, 0, 0}, 40);
        const Frame frame = make_frame(scene, camera, kSize, kSize, {0, 0, kSize, kSize});
        Film film(frame.crop, frame.crop, LayerSet{}, frame.criteria.classes);
        const LineDrawing drawing = find_drawing(frame, {1}, film);

        const Projection& projection = frame.surfaces.projection;
        const auto to_screen = [&](glm::dvec3 p) {
            return projection.to_pixel(glm::dvec3(frame.camera.to_view() * glm::dvec4(p, 1)));
        };
        const glm::dvec2 a = to_screen({0, -1, 0}), b = to_screen({0, 1, 0});
        const auto is_on_edge = [&](const LinePiece& piece) {
            const glm::dvec2 along = glm::normalize(b - a);
            const auto distance = [&](glm::dvec2 p) { return std::abs(along.x * (p - a).y - along.y * (p - a).x); };
            const double share = glm::dot(0.5 * (piece.from + piece.to) - a, along) / glm::distance(a, b);
            // A sheet that is seen edge-on has its other sides on the same line of the picture, beyond this edge.
            return share > 0 && share < 1 && std::max(distance(piece.from), distance(piece.to)) < 0.02 &&
                   glm::distance(piece.from, piece.to) > 2;
        };
        std::set<LineId> ids;
        for (const auto& lists : {drawing.visible(), drawing.behind()}) {
            for (const std::span<const LinePiece> list : lists) {
                for (const LinePiece& piece : list) {
                    if (!piece.is_drawn || !is_on_edge(piece)) continue;
                    ids.insert(piece.line);
                    ++(piece.is_hidden() ? behind : pieces);
                }
            }
        }
        EXPECT_LE(ids.size(), 1u);
        for (const WholeLine& line : drawing.whole_lines()) {
            LinePiece whole;
            whole.from = line.from / 256.0;
            whole.to = line.to / 256.0;
            EXPECT_TRUE(!is_on_edge(whole) || ids.empty() || ids.contains(line.id));
        }
    }
    EXPECT_GT(pieces, 300u);
    EXPECT_GT(behind, 20u);
}

}  // namespace
}  // namespace burin::line_ids_test
