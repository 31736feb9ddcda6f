#include "methods/projected_polygon.h"

#include <algorithm>
#include <limits>

namespace burin {
namespace {

ProjectedCorner project(const Projection& p, const DepthRange& depth, const glm::dvec3& view) {
    return {p.to_pixel(view), depth.z(-view.z), -view.z};
}

/// Where the line from `inner`, in front of the near plane, to `outer`, behind it, meets it. It is always computed from
/// the inner end, so that all polygons that share the edge get the same.
glm::dvec3 cut_at_near(double near_distance, const glm::dvec3& inner, const glm::dvec3& outer) {
    const double part = (-inner.z - near_distance) / (outer.z - inner.z);
    glm::dvec3 cut = inner + (outer - inner) * part;
    cut.z = -near_distance;
    return cut;
}

}  // namespace

DepthRange DepthRange::between(double near_distance, double far_distance, bool orthographic) {
    DepthRange range;
    range.orthographic = orthographic;
    if (orthographic) {
        range.b = 1 / (far_distance - near_distance);
        range.a = -near_distance * range.b;
    } else {
        range.a = far_distance / (far_distance - near_distance);
        range.b = -near_distance * range.a;
    }
    return range;
}

DepthRange DepthRange::fitted(const Frame& frame) {
    const Projection& projection = frame.surfaces.projection;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::uint32_t i = 0; i < frame.surfaces.instances.size(); ++i) {
        const auto count = frame.surfaces.instances[i].mesh->positions.size();
        for (std::uint32_t v = 0; v < count; ++v) {
            const double distance = -frame.surfaces.view_position(i, v).z;
            low = std::min(low, distance);
            high = std::max(high, distance);
        }
    }
    low = std::max(low, projection.near_distance);
    if (!(high > low)) {  // all in one plane, or nothing to be seen
        const double at = low < std::numeric_limits<double>::infinity() ? low : 1;
        const double pixel = std::max(projection.pixel_size(std::max(at, 0.0)), 1e-6 * at);
        return between(std::max(at - pixel, 0.5 * at), at + pixel, projection.orthographic);
    }
    // The nearest and the farthest vertex themselves stay within the range.
    const double margin = 0x1p-10 * (high - low);
    const double near_distance = projection.orthographic ? low - margin : std::max(low - margin, 0.999 * low);
    return between(near_distance, high + margin, projection.orthographic);
}

void project_polygon(const Frame& frame, const FeatureEdges& features, const DepthRange& depth, std::uint32_t instance,
                     std::uint32_t polygon, ProjectedPolygon& result) {
    result.instance = instance;
    result.polygon = polygon;
    result.edges.clear();
    result.triangles.clear();
    const SurfaceSet& surfaces = frame.surfaces;
    const Projection& projection = surfaces.projection;
    const Mesh& mesh = *surfaces.instances[instance].mesh;
    const PolygonOutlines& outlines = features.outlines(instance);
    const double near_distance = projection.near_distance;
    const auto is_inside = [&](const glm::dvec3& p) { return -p.z >= near_distance; };

    for (const std::uint32_t t : outlines.triangles(polygon)) {
        const SurfaceId surface{instance, t};
        glm::dvec3 c[3];
        surfaces.view_corners(surface, c);
        std::array<ProjectedCorner, 4> kept;
        std::size_t count = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& a = c[k];
            const glm::dvec3& b = c[(k + 1) % 3];
            if (is_inside(a)) kept[count++] = project(projection, depth, a);
            if (is_inside(a) == is_inside(b)) continue;
            const glm::dvec3 cut = is_inside(a) ? cut_at_near(near_distance, a, b) : cut_at_near(near_distance, b, a);
            kept[count++] = project(projection, depth, cut);
        }
        for (std::size_t i = 2; i < count; ++i) {
            result.triangles.push_back({{kept[0], kept[i - 1], kept[i]}, surface});
        }
    }

    for (const HalfEdge h : outlines.outline(polygon)) {
        const auto& corners = mesh.triangles[h / 3];
        std::uint32_t v = corners[h % 3], w = corners[(h % 3 + 1) % 3];
        ProjectedEdge edge;
        edge.runs_with_outline = v < w;
        if (w < v) std::swap(v, w);
        glm::dvec3 from = surfaces.view_position(instance, v);
        glm::dvec3 to = surfaces.view_position(instance, w);
        if (!is_inside(from) && !is_inside(to)) continue;
        if (!is_inside(from)) from = cut_at_near(near_distance, to, from);
        if (!is_inside(to)) to = cut_at_near(near_distance, from, to);
        edge.from = project(projection, depth, from);
        edge.to = project(projection, depth, to);
        edge.half_edge = h;
        edge.classes = features.classes({instance, h / 3}, h % 3);
        result.edges.push_back(edge);
    }
}

}  // namespace burin
