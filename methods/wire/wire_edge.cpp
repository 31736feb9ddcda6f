#include "methods/wire/wire_edge.h"

#include <utility>

#include "methods/wire/edge_distance.h"
#include "view/screen_polygon.h"

namespace burin {

glm::dvec3 homogeneous_position(const Projection& p, const glm::dvec3& view) {
    if (needs_no_clipping(p, view)) {
        const double w = p.orthographic ? 1.0 : -view.z;
        const glm::dvec2 pixel = p.to_pixel(view);
        return glm::dvec3(snap_to_subpixels(pixel.x) / kSubpixelsPerPixel,
                          snap_to_subpixels(pixel.y) / kSubpixelsPerPixel, 1.0) *
               w;
    }
    return p.homogeneous(view);
}

std::optional<WireEdge> wire_edge(const SurfaceSet& surfaces, std::uint32_t instance, HalfEdge half_edge,
                                  LineClass line_class) {
    const Projection& projection = surfaces.projection;
    const auto& corners = surfaces.instances[instance].mesh->triangles[half_edge / 3];
    std::uint32_t a = corners[half_edge % 3], b = corners[(half_edge % 3 + 1) % 3];
    if (b < a) std::swap(a, b);
    glm::dvec3 from = surfaces.view_position(instance, a), to = surfaces.view_position(instance, b);
    const double near_distance = projection.near_distance;
    const bool from_is_behind = -from.z < near_distance, to_is_behind = -to.z < near_distance;
    if (from_is_behind && to_is_behind) return std::nullopt;

    WireEdge edge;
    edge.line_class = line_class;
    edge.line = line_through(homogeneous_position(projection, from), homogeneous_position(projection, to));
    if (from_is_behind || to_is_behind) {
        const double part = (-near_distance - from.z) / (to.z - from.z);
        glm::dvec3 cut = from + (to - from) * part;
        cut.z = -near_distance;
        (from_is_behind ? from : to) = cut;
        (from_is_behind ? edge.from_part : edge.to_part) = part;
    }
    const glm::dvec3 h0 = homogeneous_position(projection, from), h1 = homogeneous_position(projection, to);
    edge.from = glm::dvec2(h0) / h0.z;
    edge.to = glm::dvec2(h1) / h1.z;
    edge.from_nearness = projection.nearness(from);
    edge.to_nearness = projection.nearness(to);
    return edge;
}

}  // namespace burin
