#include "tests/support/minimal_scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/shapes.h"
#include "tests/support/drawing.h"

namespace burin::test {
namespace {

constexpr double kSize = 256;
constexpr double kEyeZ = 1000;

using DepthAt = std::function<double(double x, double y)>;

/// z = .5 lies at the world's z = 0, where single precision is finest.
glm::dvec3 world(double x, double y, double z) { return {x, kSize - y, (0.5 - z) * kSize}; }
glm::dvec3 world(glm::dvec2 p, const DepthAt& z) { return world(p.x, p.y, z(p.x, p.y)); }

DepthAt flat(double z) {
    return [z](double, double) { return z; };
}
/// dz/dy = b, and .5 in the middle.
DepthAt tilted(double b) {
    return [b](double, double y) { return 0.5 + b * (y - 0.5 * kSize); };
}

PolygonSoup polygons(const std::vector<glm::dvec2>& points, const DepthAt& z,
                     const std::vector<std::vector<std::uint32_t>>& corners) {
    std::vector<glm::dvec3> positions;
    for (const glm::dvec2& p : points) positions.push_back(world(p, z));
    return soup_of(std::move(positions), corners);
}

PolygonSoup rectangle(double x0, double y0, double x1, double y1, const DepthAt& z) {
    return polygons({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, z, {{3, 2, 1, 0}});
}

PolygonSoup grid(double x0, double y0, double cell_px, int columns, int rows, const DepthAt& z) {
    std::vector<glm::dvec2> points;
    std::vector<std::vector<std::uint32_t>> corners;
    for (int r = 0; r <= rows; ++r) {
        for (int c = 0; c <= columns; ++c) points.push_back({x0 + c * cell_px, y0 + r * cell_px});
    }
    const auto at = [columns](int c, int r) { return static_cast<std::uint32_t>(r * (columns + 1) + c); };
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            corners.push_back({at(c, r), at(c, r + 1), at(c + 1, r + 1), at(c + 1, r)});
        }
    }
    return polygons(points, z, corners);
}

void mark_all_edges(PolygonSoup& soup) {
    for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
        const auto p = soup.polygon(i);
        for (std::size_t k = 0; k < p.size(); ++k) soup.marked_edges.push_back({p[k], p[(k + 1) % p.size()]});
    }
}

/// Centred at a pixel position with the middle at z = .5.
PolygonSoup sphere(double x, double y, double radius, int segments, int rings) {
    return transformed(make_sphere(radius, segments, rings), [&](glm::dvec3 p) { return p + world(x, y, 0.5); });
}

MinimalScene made(std::vector<PolygonSoup> objects) {
    MinimalScene result;
    result.scene = scene_of(std::move(objects));
    result.scene.lines.classes = LineClassSet::all();
    result.camera = pixel_camera(static_cast<int>(kSize), static_cast<int>(kSize), kEyeZ);
    result.scene.zbuffer.depth_range = {kEyeZ - 0.5 * kSize, kEyeZ + 0.5 * kSize};
    return result;
}

ScreenSegment segment(glm::dvec2 a, glm::dvec2 b, const DepthAt& z) { return {a, b, z(a.x, a.y), z(b.x, b.y)}; }

/// A square around a middle, cut by a line of slope .37 (from its left to its right side).
struct CutSquare {
    std::vector<glm::dvec2> points;  // corners clockwise from the upper left, then the line's ends
    CutSquare(glm::dvec2 middle, double side) {
        const double h = 0.5 * side;
        for (const glm::dvec2 c : {glm::dvec2(-h, -h), glm::dvec2(h, -h), glm::dvec2(h, h), glm::dvec2(-h, h),
                                   glm::dvec2(-h, -0.37 * h), glm::dvec2(h, 0.37 * h)}) {
            points.push_back(middle + c);
        }
    }
    std::vector<std::uint32_t> above() const { return {4, 5, 1, 0}; }
    std::vector<std::uint32_t> below() const { return {3, 2, 5, 4}; }
};

double slope_side_px(double b) { return std::min(200.0, 0.8 / std::abs(b)); }

}  // namespace

MinimalScene scene_sil() {
    const std::vector<glm::dvec2> p = {{40.3, 50.7}, {200.1, 80.2}, {90.6, 210.9}};
    MinimalScene s = made({polygons(p, flat(0.5), {{0, 2, 1}})});
    for (std::size_t i = 0; i < 3; ++i) s.lines.push_back({p[i], p[(i + 1) % 3]});
    return s;
}

MinimalScene scene_slope(double b) {
    const CutSquare square({128.13, 127.71}, slope_side_px(b));
    MinimalScene s = made({polygons(square.points, tilted(b), {square.above(), square.below()})});
    s.lines = {segment(square.points[4], square.points[5], tilted(b))};
    return s;
}

MinimalScene scene_half_slope(double b, bool below) {
    const CutSquare square({128.13, 127.71}, slope_side_px(b));
    MinimalScene s = made({polygons(square.points, tilted(b), {below ? square.below() : square.above()})});
    s.lines = {segment(square.points[4], square.points[5], tilted(b))};
    return s;
}

MinimalScene scene_gap(double gap) {
    MinimalScene s = made(
        {grid(20.3, 20.7, 21.271, 10, 10, flat(0.5)), rectangle(-50, -50, kSize + 50, kSize + 50, flat(0.5 - gap))});
    for (int i = 0; i <= 10; ++i) {
        const double at = 21.271 * i;
        s.lines.push_back({{20.3, 20.7 + at}, {20.3 + 212.71, 20.7 + at}});
        s.lines.push_back({{20.3 + at, 20.7}, {20.3 + at, 20.7 + 212.71}});
    }
    return s;
}

MinimalScene scene_dilemma() {
    constexpr double b = 0.02;
    const DepthAt surface = tilted(b);
    const DepthAt cover = [=](double x, double y) { return surface(x, y) - 0.005; };
    const CutSquare seen({64.13, 127.71}, 40), hidden({192.13, 127.71}, 40);
    MinimalScene s =
        made({polygons(seen.points, surface, {seen.above(), seen.below()}),
              polygons(hidden.points, surface, {hidden.above(), hidden.below()}), rectangle(162, 97, 222, 157, cover)});
    s.lines = {segment(seen.points[4], seen.points[5], surface), segment(hidden.points[4], hidden.points[5], surface)};
    return s;
}

MinimalScene scene_sphere() {
    PolygonSoup outer = sphere(128.2, 127.9, 90, 64, 32), inner = sphere(128.2, 127.9, 89, 64, 32);
    mark_all_edges(inner);
    MinimalScene s = made({outer, inner});
    s.scene.lines.classes = LineClass::mark;
    return s;
}

MinimalScene scene_step() {
    MinimalScene s = made(
        {rectangle(100.37, 60.2, 180.6, 190.8, flat(0.3)), rectangle(-50, -50, kSize + 50, kSize + 50, flat(0.6))});
    s.lines = {{{100.37, 60.2}, {100.37, 190.8}, 0.3, 0.3}};
    return s;
}

MinimalScene scene_flat() {
    MinimalScene s =
        made({rectangle(80.4, 80.3, 170.6, 170.7, flat(0.5)), rectangle(30.4, 30.3, 220.6, 220.7, flat(0.501))});
    s.lines = {{{80.4, 80.3}, {170.6, 80.3}}, {{80.4, 170.7}, {170.6, 170.7}}};
    return s;
}

MinimalScene scene_graze() {
    // 200 pixels high on the screen, and as deep as 2 degrees make that.
    const double deep = 200 / std::tan(glm::radians(2.0));
    PolygonSoup floor = transformed(grid(28.2, 28.4, 20, 10, 10, flat(0.5)),
                                    [&](glm::dvec3 p) { return glm::dvec3(p.x, p.y, -(p.y - 128) / 200 * deep); });
    MinimalScene s = made({floor});
    s.camera = pixel_camera(static_cast<int>(kSize), static_cast<int>(kSize), deep);
    s.units_per_z = 1.25 * deep;
    s.scene.zbuffer.depth_range = {0.375 * deep, 1.625 * deep};
    return s;
}

MinimalScene scene_curv() {
    std::vector<PolygonSoup> spheres;
    for (int i = 0; i < 64; ++i) {
        spheres.push_back(sphere(20.3 + 30.7 * (i % 8), 20.6 + 30.4 * (i / 8), 6, 24, 12));
    }
    return made(std::move(spheres));
}

MinimalScene scene_thin(double shift_px) {
    const double x = 128.2 + shift_px;
    MinimalScene s = made({rectangle(x, 40.3, x + 0.3, 210.8, flat(0.5))});
    s.lines = {{{x, 40.3}, {x, 210.8}}, {{x + 0.3, 40.3}, {x + 0.3, 210.8}}};
    return s;
}

MinimalScene scene_concave() {
    const std::vector<glm::dvec2> p = {{40.3, 40.6},   {120.7, 40.6},  {120.7, 130.2},
                                       {210.4, 130.2}, {210.4, 214.9}, {40.3, 214.9}};
    MinimalScene s = made({polygons(p, flat(0.5), {{5, 4, 3, 2, 1, 0}})});
    for (std::size_t i = 0; i < p.size(); ++i) s.lines.push_back({p[i], p[(i + 1) % p.size()]});
    return s;
}

MinimalScene scene_notch() {
    MinimalScene s = made({rectangle(90.3, 120.6, 154.3, 136.6, flat(0.5))});
    s.lines = {{{90.3, 120.6}, {154.3, 120.6}}, {{90.3, 136.6}, {154.3, 136.6}}};
    return s;
}

MinimalScene scene_sliver() {
    constexpr std::uint32_t kSectors = 720;
    std::vector<glm::dvec2> points = {{128.3, 127.6}};
    std::vector<std::vector<std::uint32_t>> corners;
    for (std::uint32_t i = 0; i < kSectors; ++i) {
        const double angle = glm::radians(360.0 * i / kSectors);
        points.push_back(points[0] + 100.0 * glm::dvec2(std::cos(angle), std::sin(angle)));
        corners.push_back({0, 1 + (i + 1) % kSectors, 1 + i});
    }
    MinimalScene s = made({polygons(points, flat(0.5), corners)});
    s.scene.lines.classes = LineClass::border;
    return s;
}

MinimalScene scene_near(int behind) {
    // The eye at the origin looks along -z; what lies at z >= 0 is not before it.
    const double z1 = behind == 2 ? 1.0 : -4.0;
    const double z2 = behind == 0 ? 0.0 : 1.5;
    MinimalScene s = made({soup_of({{-1, -0.6, -5}, {1.3, -0.9, z1}, {0.4, 0.8, z2}}, {{0, 1, 2}})});
    s.scene.zbuffer.depth_range.reset();
    s.camera = perspective_camera({0, 0, 0}, {0, 0, -1}, 60);
    return s;
}

MinimalScene scene_intersect() {
    // z = .5 + (x - 128) / 512 and its mirror image meet at x = 128.
    const auto slanted = [](double sign) { return [sign](double x, double) { return 0.5 + sign * (x - 128) / 512; }; };
    const std::vector<glm::dvec2> p = {{40.3, 50.7}, {215.6, 60.2}, {120.4, 220.3}};
    const std::vector<glm::dvec2> q = {{50.2, 190.7}, {110.4, 40.6}, {210.8, 200.1}};
    MinimalScene s = made({polygons(p, slanted(1), {{0, 2, 1}}), polygons(q, slanted(-1), {{0, 2, 1}})});
    s.lines = {{{128, 70}, {128, 180}}};
    return s;
}

MinimalScene scene_tjunc() {
    const std::vector<glm::dvec2> p = {{40.3, 60.6},  {128.4, 60.6},  {128.4, 200.2}, {40.3, 200.2},
                                       {210.7, 60.6}, {210.7, 130.7}, {128.4, 130.7}, {210.7, 200.2}};
    return made({polygons(p, flat(0.5), {{3, 2, 1, 0}, {6, 5, 4, 1}, {2, 7, 5, 6}})});
}

MinimalScene scene_cut(double angle_deg) {
    // The line runs level; the occluder's edge crosses it at x = 128.
    const double tangent = std::tan(glm::radians(angle_deg));
    const auto edge_at = [&](double y) { return 128.2 + (y - 128.37) / tangent; };
    const std::vector<glm::dvec2> sheet = {{20, 40}, {236, 40}, {236, 216}, {20, 216}, {20, 128.37}, {236, 128.37}};
    const double top = 128.37 - 100 * tangent, bottom = 128.37 + 100 * tangent;
    const std::vector<glm::dvec2> cover = {{edge_at(top), top}, {500, top}, {500, bottom}, {edge_at(bottom), bottom}};
    MinimalScene s =
        made({polygons(sheet, flat(0.6), {{4, 5, 1, 0}, {3, 2, 5, 4}}), polygons(cover, flat(0.4), {{3, 2, 1, 0}})});
    s.lines = {{{20, 128.37}, {128.2, 128.37}, 0.6, 0.6}};
    return s;
}

MinimalScene scene_pair(bool same_direction, double b) {
    const std::vector<glm::dvec2> p = {{40.5, 80}, {200.5, 160}, {40.5, 20}, {200.5, 90}, {40.5, 150}, {200.5, 230}};
    const std::vector<std::uint32_t> upper = {0, 1, 3, 2}, against = {1, 0, 4, 5}, along = {0, 1, 5, 4};
    MinimalScene s = made({polygons(p, tilted(b), {upper, same_direction ? along : against})});
    s.lines = {segment(p[0], p[1], tilted(b))};
    return s;
}

MinimalScene scene_unedged(double b) {
    const CutSquare square({128.13, 127.71}, slope_side_px(b));
    PolygonSoup edged = polygons(square.points, tilted(b), {square.above()});
    mark_all_edges(edged);
    MinimalScene s = made({edged, polygons(square.points, tilted(b), {square.below()})});
    s.scene.lines.classes = LineClass::mark;
    s.lines = {segment(square.points[4], square.points[5], tilted(b))};
    return s;
}

MinimalScene scene_back(double b) {
    // Wound apart, as front and back of a closed thing. They meet on the left.
    const double x0 = 28.4, x1 = 228.4;
    const DepthAt front = tilted(b);
    const DepthAt back = [=](double x, double y) { return front(x, y) + 1e-4 * (x - x0) / (x1 - x0); };
    PolygonSoup marked = grid(x0 + 10, 28.7, 18.93, 10, 10, back);
    mark_all_edges(marked);
    MinimalScene s = made({marked, rectangle(x0 - 1, 20, x1 + 10, 240, front)});
    s.scene.lines.classes = LineClass::mark;
    return s;
}

MinimalScene scene_hilite() {
    const std::vector<glm::dvec2> p = {{50.3, 60.7}, {205.8, 118.2}, {170.2, 30.4}, {80.6, 210.9}};
    const DepthAt z = tilted(1e-3);
    MinimalScene s = made({polygons(p, z, {{0, 1, 2}, {1, 0, 3}})});
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 1}}) {
        s.lines.push_back(segment(p[static_cast<std::size_t>(a)], p[static_cast<std::size_t>(b)], z));
    }
    return s;
}

MinimalScene scene_three_layers() {
    return made({rectangle(100.3, 100.6, 160.4, 160.2, flat(0.3)), rectangle(70.3, 70.6, 190.4, 190.2, flat(0.5)),
                 rectangle(40.3, 40.6, 220.4, 220.2, flat(0.7))});
}

MinimalScene scene_star() {
    std::vector<glm::dvec2> points;
    std::vector<std::vector<std::uint32_t>> corners;
    std::vector<std::array<std::uint32_t, 2>> marks;
    std::vector<ScreenSegment> lines;
    for (std::uint32_t i = 0; i < 180; ++i) {
        const double angle = glm::radians(static_cast<double>(i));
        const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
        // Odd multiples of the golden section, for positions between pixels without a pattern.
        const glm::dvec2 odd(std::fmod(0.618034 * i, 1.0), std::fmod(0.754878 * i, 1.0));
        const glm::dvec2 middle = glm::dvec2(13 + 17 * (i % 14), 14 + 18 * (i / 14)) + odd;
        const auto first = static_cast<std::uint32_t>(points.size());
        for (const glm::dvec2 d : {-7.0 * along, 7.0 * along, 2.0 * across, -2.0 * across})
            points.push_back(middle + d);
        corners.push_back({first, first + 1, first + 2});
        corners.push_back({first + 1, first, first + 3});
        marks.push_back({first, first + 1});
        lines.push_back({middle - 7.0 * along, middle + 7.0 * along});
    }
    PolygonSoup soup = polygons(points, flat(0.5), corners);
    soup.marked_edges = marks;
    MinimalScene s = made({soup});
    s.scene.lines.classes = LineClass::mark;
    s.lines = lines;
    return s;
}

MinimalScene scene_dense() { return made({grid(28.3, 28.6, 1.5, 128, 128, flat(0.5))}); }

}  // namespace burin::test
