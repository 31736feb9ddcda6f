#pragma once

#include <algorithm>
#include <cmath>

#include "image/image.h"
#include "methods/projected_polygon.h"

// Triangles are filled as graphics hardware fills them, pixel by pixel with their depths.

namespace burin {

/// z over the plane of a triangle on the screen.
struct ZPlane {
    double at_corner = 0, per_x = 0, per_y = 0;
    glm::dvec2 corner{0.0};
    double low = 0, high = 0;  ///< of the triangle's corners

    explicit ZPlane(const ProjectedTriangle& triangle) {
        const auto& [a, b, c] = triangle.corners;
        corner = a.pixel;
        at_corner = a.z;
        low = std::min({a.z, b.z, c.z});
        high = std::max({a.z, b.z, c.z});
        const glm::dvec2 u = b.pixel - a.pixel, v = c.pixel - a.pixel;
        const double area = u.x * v.y - u.y * v.x;
        if (area == 0) return;
        per_x = ((b.z - a.z) * v.y - (c.z - a.z) * u.y) / area;
        per_y = ((c.z - a.z) * u.x - (b.z - a.z) * v.x) / area;
    }
    /// The corners bound it, so that rounding in the plane of a sliver does no harm.
    double at(glm::dvec2 pixel) const {
        const double z = at_corner + per_x * (pixel.x - corner.x) + per_y * (pixel.y - corner.y);
        return std::clamp(z, low, high);
    }
    /// max(|dz/dx|, |dz/dy|), OpenGL's m, per pixel.
    double slope() const { return std::max(std::abs(per_x), std::abs(per_y)); }
};

/// The first row or column whose centre lies at `position` or after it, held within [low, high].
inline int first_centre_from(double position, int low, int high) {
    return static_cast<int>(std::clamp(std::ceil(position - 0.5), double(low), double(high)));
}

/// Calls visit(x, y, z) for the pixels of `rect` whose centres lie in the triangle, with z of its
/// plane at the centre. A centre on an edge belongs to the triangle below or to the right of it, so
/// triangles that share an edge have each pixel along it once: where an edge crosses a row is
/// computed from its upper to its lower end, whichever triangle asks.
template <typename Visit>
void for_each_fragment(const ProjectedTriangle& triangle, PixelRect rect, const Visit& visit) {
    struct Edge {
        glm::dvec2 upper, lower;
        int first_row, end_row;
        double x_at(double y) const { return upper.x + (y - upper.y) * ((lower.x - upper.x) / (lower.y - upper.y)); }
    };
    Edge edges[3];
    int first_row = rect.y1, end_row = rect.y0;
    for (std::size_t k = 0; k < 3; ++k) {
        Edge& e = edges[k];
        e.upper = triangle.corners[k].pixel;
        e.lower = triangle.corners[(k + 1) % 3].pixel;
        if (e.lower.y < e.upper.y) std::swap(e.upper, e.lower);
        e.first_row = first_centre_from(e.upper.y, rect.y0, rect.y1);
        e.end_row = first_centre_from(e.lower.y, rect.y0, rect.y1);
        first_row = std::min(first_row, e.first_row);
        end_row = std::max(end_row, e.end_row);
    }
    const ZPlane plane(triangle);
    for (int y = first_row; y < end_row; ++y) {
        int begin = rect.x1, end = rect.x0;
        for (const Edge& e : edges) {
            if (y < e.first_row || y >= e.end_row) continue;
            const int crossing = first_centre_from(e.x_at(y + 0.5), rect.x0, rect.x1);
            begin = std::min(begin, crossing);
            end = std::max(end, crossing);
        }
        for (int x = begin; x < end; ++x) visit(x, y, plane.at({x + 0.5, y + 0.5}));
    }
}

}  // namespace burin
