#pragma once

#include "mesh/shapes.h"
#include "tests/support/random.h"

namespace burin::test {

/// A sphere of triangles with folds all over; `flat`: squeezed along z, so that many of them are deep.
inline PolygonSoup rough_sphere(Random& random, int segments, double roughness, double flat = 1) {
    PolygonSoup soup = make_sphere(0.8, segments, segments / 2);
    for (glm::dvec3& p : soup.positions) {
        p *= 1 + random.real(-roughness, roughness) / segments;
        p.z *= flat;
    }
    return soup;
}

}  // namespace burin::test
