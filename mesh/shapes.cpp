#include "mesh/shapes.h"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "base/interrupt.h"

namespace burin {
namespace {

PolygonSoup empty_soup(const char* name) {
    PolygonSoup soup;
    soup.object_names = {name};
    soup.materials = {Material{}};
    return soup;
}

void add(PolygonSoup& soup, std::initializer_list<int> corners) {
    for (const int c : corners) soup.corners.push_back(static_cast<std::uint32_t>(c));
    soup.polygon_ends.push_back(static_cast<std::uint32_t>(soup.corners.size()));
}

/// Unit circle in the XZ plane. Exact at the quarters, so that mirrored points match.
glm::dvec2 on_circle(int i, int segments) {
    const double angle = 2 * std::numbers::pi * i / segments;
    const auto clean = [](double v) { return std::abs(v) < 1e-15 ? 0.0 : v; };
    return {clean(std::cos(angle)), clean(std::sin(angle))};
}

}  // namespace

PolygonSoup make_box(glm::dvec3 size) {
    PolygonSoup soup = empty_soup("box");
    for (int i = 0; i < 8; ++i) {
        soup.positions.push_back(0.5 * size * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    }
    add(soup, {0, 4, 6, 2});  // -X
    add(soup, {1, 3, 7, 5});  // +X
    add(soup, {0, 1, 5, 4});  // -Y
    add(soup, {2, 6, 7, 3});  // +Y
    add(soup, {0, 2, 3, 1});  // -Z
    add(soup, {4, 5, 7, 6});  // +Z
    return soup;
}

PolygonSoup make_plane(double size_x, double size_z, int columns, int rows) {
    PolygonSoup soup = empty_soup("plane");
    for (int r = 0; r <= rows; ++r) {
        throw_if_interrupted();
        for (int c = 0; c <= columns; ++c) {
            soup.positions.emplace_back(size_x * (static_cast<double>(c) / columns - 0.5), 0.0,
                                        size_z * (static_cast<double>(r) / rows - 0.5));
        }
    }
    for (int r = 0; r < rows; ++r) {
        throw_if_interrupted();
        for (int c = 0; c < columns; ++c) {
            const int a = r * (columns + 1) + c;
            const int b = a + columns + 1;
            add(soup, {a, b, b + 1, a + 1});
        }
    }
    return soup;
}

PolygonSoup make_sphere(double radius, int segments, int rings) {
    PolygonSoup soup = empty_soup("sphere");
    soup.positions.emplace_back(0.0, radius, 0.0);
    for (int r = 1; r < rings; ++r) {
        throw_if_interrupted();
        const double polar = std::numbers::pi * r / rings;
        for (int s = 0; s < segments; ++s) {
            const glm::dvec2 c = on_circle(s, segments) * (radius * std::sin(polar));
            soup.positions.emplace_back(c.x, radius * std::cos(polar), c.y);
        }
    }
    soup.positions.emplace_back(0.0, -radius, 0.0);
    const int south = 1 + (rings - 1) * segments;
    const auto at = [&](int ring, int s) { return 1 + (ring - 1) * segments + s % segments; };
    for (int s = 0; s < segments; ++s) {
        throw_if_interrupted();
        add(soup, {0, at(1, s + 1), at(1, s)});
        for (int r = 1; r + 1 < rings; ++r) {
            add(soup, {at(r, s), at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)});
        }
        add(soup, {south, at(rings - 1, s), at(rings - 1, s + 1)});
    }
    return soup;
}

PolygonSoup make_cylinder(double bottom_radius, double top_radius, double height, int segments) {
    PolygonSoup soup = empty_soup(top_radius > 0 ? "cylinder" : "cone");
    for (int s = 0; s < segments; ++s) {
        const glm::dvec2 c = on_circle(s, segments) * bottom_radius;
        soup.positions.emplace_back(c.x, -0.5 * height, c.y);
    }
    if (top_radius > 0) {
        for (int s = 0; s < segments; ++s) {
            const glm::dvec2 c = on_circle(s, segments) * top_radius;
            soup.positions.emplace_back(c.x, 0.5 * height, c.y);
        }
    } else {
        soup.positions.emplace_back(0.0, 0.5 * height, 0.0);
    }
    for (int s = 0; s < segments; ++s) {
        const int next = (s + 1) % segments;
        if (top_radius > 0) {
            add(soup, {s, segments + s, segments + next, next});
        } else {
            add(soup, {s, segments, next});
        }
    }
    std::vector<std::uint32_t> cap;
    for (int s = 0; s < segments; ++s) cap.push_back(static_cast<std::uint32_t>(s));
    soup.add_polygon(cap);
    if (top_radius > 0) {
        cap.clear();
        for (int s = segments; s-- > 0;) cap.push_back(static_cast<std::uint32_t>(segments + s));
        soup.add_polygon(cap);
    }
    return soup;
}

PolygonSoup make_torus(double radius, double tube_radius, int segments, int tube_segments) {
    PolygonSoup soup = empty_soup("torus");
    for (int s = 0; s < segments; ++s) {
        throw_if_interrupted();
        const glm::dvec2 around = on_circle(s, segments);
        for (int t = 0; t < tube_segments; ++t) {
            const glm::dvec2 tube = on_circle(t, tube_segments) * tube_radius;
            soup.positions.emplace_back(around.x * (radius + tube.x), tube.y, around.y * (radius + tube.x));
        }
    }
    const auto at = [&](int s, int t) { return (s % segments) * tube_segments + t % tube_segments; };
    for (int s = 0; s < segments; ++s) {
        throw_if_interrupted();
        for (int t = 0; t < tube_segments; ++t) {
            add(soup, {at(s, t), at(s, t + 1), at(s + 1, t + 1), at(s + 1, t)});
        }
    }
    return soup;
}

}  // namespace burin
