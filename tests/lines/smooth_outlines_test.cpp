// Outlines of closed bodies with smooth contours: closed, and no farther from the smooth surface's
// than the mesh's are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::smooth_outlines_test {
namespace {

using namespace test;

constexpr int kSize = 200;

/// Around the y axis: (radius, height) from the bottom up. Closed by flat ends.
PolygonSoup turned_body(const std::vector<glm::dvec2>& profile, std::uint32_t segments) {
    PolygonSoup soup;
    std::vector<std::uint32_t> bottom, top;
    const auto rings = static_cast<std::uint32_t>(profile.size());
    for (std::uint32_t r = 0; r < rings; ++r) {
        for (std::uint32_t s = 0; s < segments; ++s) {
            const double angle = 2 * std::numbers::pi * s / segments;
            soup.positions.push_back({profile[r].x * std::cos(angle), profile[r].y, profile[r].x * std::sin(angle)});
        }
    }
    for (std::uint32_t s = 0; s < segments; ++s) {
        const std::uint32_t next = (s + 1) % segments;
        bottom.push_back(s);
        top.push_back((rings - 1) * segments + s);
        for (std::uint32_t r = 0; r + 1 < rings; ++r) {
            soup.add_polygon(
                std::vector{r * segments + s, (r + 1) * segments + s, (r + 1) * segments + next, r * segments + next});
        }
    }
    soup.add_polygon(bottom);
    soup.add_polygon(top);
    return soup;
}

/// With a round profile.
PolygonSoup round_vase(std::uint32_t segments, int steps) {
    std::vector<glm::dvec2> profile;
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        profile.push_back({0.55 + 0.3 * std::sin(5.6 * t + 0.3), 2 * t - 1});
    }
    return turned_body(profile, segments);
}

PolygonSoup vase(std::uint32_t segments) {
    return turned_body({{0.3, -1}, {0.7, -0.8}, {0.9, -0.4}, {0.7, 0}, {0.35, 0.3}, {0.3, 0.5}, {0.6, 0.8}, {0.65, 1}},
                       segments);
}

Drawing drawing_of(const PolygonSoup& soup, const Camera& camera, Contours contours, double crease_angle_deg = 40) {
    Scene scene = scene_of({soup});
    scene.lines.contours = contours;
    scene.lines.classes = LineClassSet(LineClass::silhouette) | LineClass::border;
    scene.lines.crease_angle_deg = crease_angle_deg;
    return Drawing(scene, camera, kSize, kSize, {0, 0, kSize, kSize}, 2, render_abuffer);
}

Camera random_camera(Random& random, double distance) {
    return perspective_camera(distance * random.direction(), 0.05 * random.direction());
}

/// What the background reaches from the corners of the picture between the lines, from pixel to
/// pixel.
class Flood {
  public:
    explicit Flood(const Drawing& drawing) : drawing_(drawing), is_reached_(kSize * kSize, false) {
        std::vector<std::pair<int, int>> next;
        const auto reach = [&](int x, int y) {
            if (x < 0 || y < 0 || x >= kSize || y >= kSize || is_reached(x, y) || drawing.line(x, y) > 0) return;
            is_reached_[static_cast<std::size_t>(y * kSize + x)] = true;
            next.emplace_back(x, y);
        };
        for (const int x : {0, kSize - 1}) {
            for (const int y : {0, kSize - 1}) reach(x, y);
        }
        while (!next.empty()) {
            const auto [x, y] = next.back();
            next.pop_back();
            reach(x - 1, y);
            reach(x + 1, y);
            reach(x, y - 1);
            reach(x, y + 1);
        }
    }
    bool is_reached(int x, int y) const { return is_reached_[static_cast<std::size_t>(y * kSize + x)]; }
    /// The share of a surface's pixels that are reached.
    double share_of_figure() const {
        double all = 0, reached = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (drawing_.at("id.object", x, y) == 0) continue;
                ++all;
                reached += is_reached(x, y) ? 1 : 0;
            }
        }
        return all > 0 ? reached / all : 1;
    }
    /// Pixels of lines next to it.
    std::vector<glm::dvec2> shore() const {
        std::vector<glm::dvec2> found;
        for (int y = 1; y + 1 < kSize; ++y) {
            for (int x = 1; x + 1 < kSize; ++x) {
                if (!(drawing_.line(x, y) >= 0.2)) continue;  // a line between two pixels has half of either
                if (is_reached(x - 1, y) || is_reached(x + 1, y) || is_reached(x, y - 1) || is_reached(x, y + 1))
                    found.push_back({x + 0.5, y + 0.5});
            }
        }
        return found;
    }

  private:
    const Drawing& drawing_;
    std::vector<bool> is_reached_;
};

TEST(SmoothOutlines, OfClosedBodiesAreClosed) {
    struct Body {
        const char* name;
        PolygonSoup soup;
        double distance;
    };
    const std::vector<Body> bodies = {{"vase of 8", vase(8), 4},
                                      {"vase of 12", vase(12), 4},
                                      {"vase of 5", vase(5), 4},
                                      {"sphere", make_sphere(0.9, 9, 6), 4},
                                      {"finer sphere", make_sphere(0.9, 16, 8), 3.5},
                                      {"torus", make_torus(0.7, 0.3, 12, 9), 3.6},
                                      {"coarse torus", make_torus(0.6, 0.35, 7, 6), 3.6},
                                      {"cylinder", make_cylinder(0.6, 0.6, 1.4, 10), 3.6},
                                      {"cone", make_cylinder(0.8, 0, 1.4, 10), 3.6},
                                      {"cup", make_cylinder(0.4, 0.8, 1.0, 9), 3.6}};
    Random random(7);
    for (const Body& body : bodies) {
        for (const double crease_angle : {40.0, 75.0, 180.0}) {
            for (int view = 0; view < 6; ++view) {
                const Camera camera = random_camera(random, body.distance);
                const Drawing mesh = drawing_of(body.soup, camera, Contours::mesh, crease_angle);
                const Drawing smooth = drawing_of(body.soup, camera, Contours::smooth, crease_angle);
                ASSERT_EQ(Flood(mesh).share_of_figure(), 0) << body.name << " view " << view;
                EXPECT_LT(Flood(smooth).share_of_figure(), 0.05)
                    << body.name << " view " << view << " crease angle " << crease_angle;
            }
        }
    }
}

struct Distances {
    double mean = 0, largest = 0;
};

template <typename Distance>
Distances distances(const Drawing& drawing, const Distance& distance) {
    Distances result;
    const std::vector<glm::dvec2> shore = Flood(drawing).shore();
    for (const glm::dvec2& p : shore) {
        result.mean += distance(p) / static_cast<double>(shore.size());
        result.largest = std::max(result.largest, distance(p));
    }
    return result;
}

TEST(SmoothOutlines, OfASphereAreNearerToItThanTheMeshes) {
    const double radius = 0.9, eye_distance = 3.4, sine = radius / eye_distance;
    const double focal_px = 0.5 * kSize / std::tan(17.5 * std::numbers::pi / 180),
                 radius_px = focal_px * sine / std::sqrt(1 - sine * sine);
    const auto distance = [&](glm::dvec2 p) { return std::abs(glm::distance(p, glm::dvec2(0.5 * kSize)) - radius_px); };
    Random random(11);
    for (const auto& [segments, rings] : {std::pair{10, 7}, {12, 6}, {16, 8}, {24, 12}}) {
        for (int view = 0; view < 6; ++view) {
            const Camera camera = perspective_camera(eye_distance * random.direction(), glm::dvec3(0.0));
            const Distances mesh =
                distances(drawing_of(make_sphere(radius, segments, rings), camera, Contours::mesh), distance);
            const Distances smooth =
                distances(drawing_of(make_sphere(radius, segments, rings), camera, Contours::smooth), distance);
            // A pixel's centre is up to a pixel from the line.
            EXPECT_LT(smooth.mean, std::max(mesh.mean, 0.6)) << segments << " view " << view;
            EXPECT_LT(smooth.largest, std::max(mesh.largest, 1.3)) << segments << " view " << view;
        }
    }
}

TEST(SmoothOutlines, OfBodiesAreNearerToTheirFineOnesThanTheMeshes) {
    struct Body {
        const char* name;
        PolygonSoup coarse, fine;
    };
    // Pixels count by their centres: largest distances are off by up to a pixel.
    const std::vector<Body> bodies = {{"torus", make_torus(0.7, 0.3, 16, 10), make_torus(0.7, 0.3, 160, 100)},
                                      {"coarse torus", make_torus(0.7, 0.3, 12, 9), make_torus(0.7, 0.3, 120, 90)},
                                      {"cylinder", make_cylinder(0.6, 0.6, 1.4, 12), make_cylinder(0.6, 0.6, 1.4, 192)},
                                      {"vase", round_vase(12, 10), round_vase(192, 160)}};
    Random random(13);
    for (const Body& body : bodies) {
        for (int view = 0; view < 6; ++view) {
            const Camera camera = random_camera(random, 3.8);
            const std::vector<glm::dvec2> truth = Flood(drawing_of(body.fine, camera, Contours::mesh)).shore();
            const auto distance = [&](glm::dvec2 p) {
                double least = 1e300;
                for (const glm::dvec2& q : truth) least = std::min(least, glm::distance(p, q));
                return least;
            };
            const Distances mesh = distances(drawing_of(body.coarse, camera, Contours::mesh), distance);
            const Distances smooth = distances(drawing_of(body.coarse, camera, Contours::smooth), distance);
            EXPECT_LT(smooth.mean, mesh.mean) << body.name << " view " << view;
            EXPECT_LT(smooth.largest, mesh.largest + 1) << body.name << " view " << view;
        }
    }
}

}  // namespace
}  // namespace burin::smooth_outlines_test
