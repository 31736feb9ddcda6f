#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "mesh/polygon_soup.h"

// Built-in shapes are made as polygon soups, like models from files.

namespace burin {

/// The built-in shapes, all around the origin with +Y up, all made of the fewest polygons that
/// describe them: flat caps and sides are one polygon each. Sizes are in world units.
/// `segments` go around the Y axis, 3 or more.

/// Six quadrilaterals.
PolygonSoup make_box(glm::dvec3 size);
/// A rectangle in the XZ plane, cut into columns x rows quadrilaterals.
PolygonSoup make_plane(double size_x, double size_z, int columns, int rows);
/// `rings` bands from pole to pole, 2 or more.
PolygonSoup make_sphere(double radius, int segments, int rings);
/// Along Y, with two caps. A top radius of 0 gives a cone, with an apex instead of the upper cap.
PolygonSoup make_cylinder(double bottom_radius, double top_radius, double height, int segments);
/// Around Y: `radius` is that of the circle in the middle of the tube.
PolygonSoup make_torus(double radius, double tube_radius, int segments, int tube_segments);

/// The Utah teapot: Martin Newell's 32 Bézier patches (1975), each cut into
/// tessellation x tessellation quadrilaterals. It stands on the XZ plane, 3.15 units high, with its
/// spout towards +X.
PolygonSoup make_teapot(int tessellation);

/// A shape that is not made yet, and how large it will be.
struct Shape {
    std::string name;
    std::uint64_t polygons = 0;
    std::uint64_t corners = 0;  ///< of all polygons
    std::string settings;       ///< that make it so large, for messages: "segments 64, rings 32"
    std::function<PolygonSoup()> make;
};

}  // namespace burin
