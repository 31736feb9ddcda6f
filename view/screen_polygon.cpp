#include "view/screen_polygon.h"

namespace burin {
namespace {

struct ViewPolygon {
    int count = 0;
    std::array<glm::dvec3, ScreenPolygon::kMaxCorners> corners;
    void add(const glm::dvec3& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
};

/// Sutherland–Hodgman: keeps the part of the polygon where inside(p) >= 0. Cut points are always
/// computed from the inner to the outer end of an edge, so both neighbours of an edge get the same.
template <typename Inside>
ViewPolygon clip(const ViewPolygon& polygon, const Inside& inside) {
    ViewPolygon result;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec3& a = polygon.corners[static_cast<std::size_t>(i)];
        const glm::dvec3& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
        const double da = inside(a);
        const double db = inside(b);
        if (da >= 0) result.add(a);
        if (da >= 0 && db < 0) result.add(a + (b - a) * (da / (da - db)));
        if (da < 0 && db >= 0) result.add(b + (a - b) * (db / (db - da)));
    }
    return result;
}

ViewPolygon clipped(const Projection& p, ViewPolygon polygon) {
    const auto reach = [&p](const glm::dvec3& v) { return kGuardBandPx * (p.orthographic ? 1.0 : -v.z); };
    const glm::dvec2 f = p.focal_xy_px();
    polygon = clip(polygon, [&](const glm::dvec3& v) { return -v.z - p.near_distance; });
    polygon = clip(polygon, [&](const glm::dvec3& v) { return reach(v) - f.x * v.x; });
    polygon = clip(polygon, [&](const glm::dvec3& v) { return reach(v) + f.x * v.x; });
    polygon = clip(polygon, [&](const glm::dvec3& v) { return reach(v) - f.y * v.y; });
    return clip(polygon, [&](const glm::dvec3& v) { return reach(v) + f.y * v.y; });
}

}  // namespace

bool needs_no_clipping(const Projection& p, const glm::dvec3& corner) {
    if (-corner.z < p.near_distance) return false;
    const double reach = kGuardBandPx * (p.orthographic ? 1.0 : -corner.z);
    return std::abs(corner.x * p.x_scale) * p.focal_px <= reach && std::abs(corner.y) * p.focal_px <= reach;
}

ScreenPolygon project_triangle(const Projection& projection, const glm::dvec3 (&corners)[3]) {
    ViewPolygon polygon;
    bool safe = true;
    for (const glm::dvec3& corner : corners) {
        polygon.add(corner);
        safe = safe && needs_no_clipping(projection, corner);
    }
    if (!safe) polygon = clipped(projection, polygon);

    ScreenPolygon result;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec2 pixel = projection.to_pixel(polygon.corners[static_cast<std::size_t>(i)]);
        const SubpixelPoint corner{static_cast<std::int32_t>(snap_to_subpixels(pixel.x)),
                                   static_cast<std::int32_t>(snap_to_subpixels(pixel.y))};
        result.corners[static_cast<std::size_t>(result.count++)] = corner;
    }
    return result;
}

}  // namespace burin
