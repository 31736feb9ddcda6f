// Drawings of features that samples miss, and the truth.

#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "mesh/build_meshes.h"
#include "mesh/shapes.h"
#include "methods/abuffer.h"
#include "methods/reference/reference.h"
#include "tests/support/drawing.h"
#include "tests/support/joined_soups.h"
#include "tests/support/random.h"

namespace burin::test {

inline Drawing draw_fine(const Scene& scene, const Camera& camera, int size, RenderFunction render = render_abuffer) {
    return Drawing(scene, camera, size, size, {0, 0, size, size}, 2, render);
}

inline Drawing truth(Scene scene, const Camera& camera, int size, int samples = 16) {
    scene.reference.samples = samples;
    return draw_fine(scene, camera, size, render_reference);
}

inline double largest_error(const Drawing& a, const Drawing& b) {
    double largest = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) largest = std::max(largest, std::abs(a.line(x, y) - b.line(x, y)));
    }
    return largest;
}

/// Lines where none is within a pixel.
inline int count_false(const Drawing& drawn, const Drawing& truth) {
    int count = 0;
    for (int y = 0; y < drawn.height(); ++y) {
        for (int x = 0; x < drawn.width(); ++x) {
            double near = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, drawn.height() - 1); ++v) {
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, drawn.width() - 1); ++u) {
                    near = std::max(near, truth.line(u, v));
                }
            }
            if (drawn.line(x, y) > 0.25 && near == 0) ++count;
        }
    }
    return count;
}

/// In a picture of kFineSize pixels whose units are pixels: turned around the middle, and moved a little.
inline constexpr int kFineSize = 44;
inline PolygonSoup placed(PolygonSoup soup, double angle_deg, double depth = 0) {
    const double a = glm::radians(angle_deg);
    return transformed(std::move(soup), [=](glm::dvec3 p) {
        return glm::dvec3(22.13 + std::cos(a) * p.x - std::sin(a) * p.y, 21.86 + std::sin(a) * p.x + std::cos(a) * p.y,
                          p.z + depth);
    });
}

inline PolygonSoup wall() { return placed(make_box({100, 100, 1}), 0, -30); }

/// A prism along x whose cross section is a closed polygon (y, z), counterclockwise from +x.
inline PolygonSoup prism(const std::vector<glm::dvec2>& section, double half_length) {
    std::vector<glm::dvec3> rings;
    for (const double x : {-half_length, half_length}) {
        for (const glm::dvec2& p : section) rings.push_back({x, p.x, p.y});
    }
    return between_rings(std::move(rings));
}

inline const double kAngles_deg[] = {0, 3, 17, 45, 62, 90};

}  // namespace burin::test
