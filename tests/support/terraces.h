#pragma once

#include "mesh/shapes.h"
#include "scene/camera.h"
#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace burin::test {

/// Terraces, and a camera in front of them: their walls are edge-on to within snapping, or exactly.
struct Terraces {
    PolygonSoup soup;
    Camera camera;

    Terraces(Random& random, double deepest) {
        constexpr std::size_t kSteps = 40;
        soup = make_plane(2.5, 2.5, kSteps, kSteps);
        const double deep = random.real(0, deepest) * random.real(0, 1),
                     apart = random.integer(0, 2) * random.real(0, 2e-3);
        for (std::size_t i = 0; i < soup.positions.size(); ++i) {
            glm::dvec3& p = soup.positions[i];
            p = {p.x, -p.z, deep * random.integer(0, 2)};
            if (i % (kSteps + 1) % 2 == 1) p.x = soup.positions[i - 1].x + random.real(-apart, apart);
        }
        camera = perspective_camera({random.real(-1, 1) * apart, random.real(-1, 1) * apart, 9}, {0, 0, 0}, 18);
        camera.orthographic = random.integer(0, 2) != 0;
        camera.height = 2.5;
    }
};

}  // namespace burin::test
