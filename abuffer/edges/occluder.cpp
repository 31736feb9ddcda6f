#include "abuffer/edges/occluder.h"

#include <algorithm>
#include <cmath>

#include "mesh/vectors.h"

namespace burin {
namespace {

/// Whether points on an edge belong to the triangle, by the top-left rule; its corners run clockwise as seen.
bool owns_edge(double along_x, double along_y) { return (along_y < 0) | ((along_y == 0) & (along_x > 0)); }

/// Sets what follows from the corners: winding, the top-left rule (see ScanConverter), slack. False for
/// triangles without area.
bool set_corners(Occluder& triangle, const glm::dvec2 (&corners)[3]) {
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    // Chosen without a branch, which would be unpredictable.
    const std::size_t second = area < 0 ? 2 : 1;
    const glm::dvec2 p[3] = {corners[0], corners[second], corners[3 - second]};
    triangle.vertices = {triangle.vertices[0], triangle.vertices[second], triangle.vertices[3 - second]};
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 along = p[(k + 1) % 3] - p[k];
        triangle.x[k] = p[k].x;
        triangle.y[k] = p[k].y;
        triangle.owns_edge[k] = owns_edge(along.x, along.y);
    }
    triangle.slack = std::abs(triangle.per_x) + std::abs(triangle.per_y);
    return area != 0;
}

/// The half-edge of the triangle itself after a corner.
HalfEdge half_edge_at(const ScreenSurfaces& screen, const Occluder& t, std::size_t k) {
    const std::uint32_t from = t.vertices[k], to = t.vertices[k == 2 ? 0 : k + 1];
    const SurfaceId s = screen.surface_of(t.number);
    const auto& corners = screen.surfaces().mesh_of(s).triangles[s.triangle];
    const auto is_it = [&](unsigned edge) {
        const std::uint32_t a = corners[edge], b = corners[(edge + 1) % 3];
        return (a == from && b == to) || (a == to && b == from);
    };
    unsigned edge = 0;
    while (!is_it(edge)) ++edge;
    return 3 * s.triangle + edge;
}

/// Whether the surface goes on beyond the edge after a corner, so that it hides what lies along the edge. The triangle
/// must lie on the screen.
bool goes_on_beyond(const ScreenSurfaces& screen, const Occluder& t, std::size_t k) {
    const std::uint32_t from = t.vertices[k], to = t.vertices[k == 2 ? 0 : k + 1];
    const ScreenVertex* const v = screen.vertices(t.instance);
    const Mesh& mesh = *screen.surfaces().instances[t.instance].mesh;
    const HalfEdge own = half_edge_at(screen, t, k);
    if (mesh.next_on_edge[own] == own) {
        const glm::dvec3 middle = 0.5 * (mesh.local_position(from) + mesh.local_position(to));
        return mesh.borders.seam_partner(own, middle).has_value();
    }
    for (HalfEdge h = mesh.next_on_edge[own]; h != own; h = mesh.next_on_edge[h]) {
        const ScreenVertex& apex = v[mesh.triangles[h / 3][(h + 2) % 3]];
        if (apex.x == ScreenVertex::kOffScreen || doubled_area(v[from], v[to], apex) < 0) return true;
    }
    return false;
}

}  // namespace

bool clip_where_positive(double at_0, double at_1, double& begin, double& end) {
    if (at_0 >= 0 && at_1 >= 0) return begin < end;
    if (at_0 < 0 && at_1 < 0) return false;
    const double t = at_0 / (at_0 - at_1);
    if (at_0 < 0) {
        begin = std::max(begin, t);
    } else {
        end = std::min(end, t);
    }
    return begin < end;
}

bool clip_to_rect(glm::dvec2 line_from, glm::dvec2 line_to, glm::dvec2 low, glm::dvec2 high, double& begin,
                  double& end) {
    return clip_where_positive(line_from.x - low.x, line_to.x - low.x, begin, end) &&
           clip_where_positive(high.x - line_from.x, high.x - line_to.x, begin, end) &&
           clip_where_positive(line_from.y - low.y, line_to.y - low.y, begin, end) &&
           clip_where_positive(high.y - line_from.y, high.y - line_to.y, begin, end);
}

void set_up_occluder(const ScreenSurfaces& screen, SurfaceId s, std::uint32_t number, Occluder& triangle) {
    const ScreenMesh& mesh = screen.mesh(s.instance);
    const std::uint32_t* const corner = mesh.corners + 3 * static_cast<std::size_t>(s.triangle);
    const ScreenVertex &a = mesh.vertices[corner[0]], &first = mesh.vertices[corner[1]],
                       &second = mesh.vertices[corner[2]];
    const auto area = static_cast<double>(doubled_area(a, first, second));
    // Which way it is wound would be an unpredictable branch, so there is none. The plane is the same to the bit: both
    // factors change their signs.
    const std::size_t turned = area < 0 ? 1 : 0;
    const ScreenVertex &b = mesh.vertices[corner[1 + turned]], &c = mesh.vertices[corner[2 - turned]];
    triangle.number = number;
    triangle.instance = s.instance;
    triangle.vertices = {corner[0], corner[1 + turned], corner[2 - turned]};
    const double per_area = 1.0 / std::abs(area);
    const double qa = static_cast<double>(a.nearness), qb = static_cast<double>(b.nearness) - qa,
                 qc = static_cast<double>(c.nearness) - qa;
    triangle.nearness = qa;
    triangle.per_x = (qb * (c.y - a.y) - qc * (b.y - a.y)) * per_area;
    triangle.per_y = (qc * (b.x - a.x) - qb * (c.x - a.x)) * per_area;
    triangle.slack = std::abs(triangle.per_x) + std::abs(triangle.per_y);
    const auto set_corner = [&](std::size_t k, const ScreenVertex& from, const ScreenVertex& to) {
        triangle.x[k] = from.x;
        triangle.y[k] = from.y;
        triangle.owns_edge[k] = owns_edge(to.x - from.x, to.y - from.y);
    };
    set_corner(0, a, b);
    set_corner(1, b, c);
    set_corner(2, c, a);
}

Occluder occluder_of(const ScreenSurfaces& screen, SurfaceId s, std::uint32_t number) {
    Occluder triangle;
    set_up_occluder(screen, s, number, triangle);
    return triangle;
}

std::vector<Occluder> clipped_occluders(const ScreenSurfaces& screen, SurfaceId s, std::uint32_t number) {
    std::vector<Occluder> parts;
    const SurfaceSet& surfaces = screen.surfaces();
    const ScreenPolygon polygon = surfaces.screen_polygon(s);
    const DepthPlane plane = surfaces.plane(s);
    const auto corner = [&](int i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        return glm::dvec2(p.x, p.y);
    };
    Occluder triangle;
    triangle.number = number;
    triangle.instance = s.instance;
    triangle.per_x = plane.per_x / kSubpixelsPerPixel;
    triangle.per_y = plane.per_y / kSubpixelsPerPixel;
    triangle.nearness = plane.extended_to(to_pixels(corner(0))) - surfaces.farthest_nearness;
    for (int i = 2; i < polygon.count; ++i) {
        triangle.vertices = surfaces.mesh_of(s).triangles[s.triangle];
        const glm::dvec2 p[3] = {corner(0), corner(i - 1), corner(i)};
        if (set_corners(triangle, p)) parts.push_back(triangle);
    }
    return parts;
}

std::optional<HalfEdge> partner_over(const ScreenSurfaces& screen, const Occluder& t, std::size_t k) {
    const Mesh& mesh = *screen.surfaces().instances[t.instance].mesh;
    const HalfEdge own = half_edge_at(screen, t, k), partner = mesh.next_on_edge[own];
    if (partner == own || mesh.next_on_edge[partner] != own) return std::nullopt;
    return partner;
}

bool lies_on(const WholeLine& line, const Occluder& triangle) {
    if (is_owner(line, triangle.number)) return true;
    if (!line.has_more_owners) return false;
    int common = 0;
    for (const std::uint64_t node : line.nodes) {
        for (const std::uint32_t v : triangle.vertices) {
            common += node == (WholeLine::node_of_vertex(triangle.instance, v));
        }
    }
    return common == 2;
}

bool is_grazed_at_end(const ScreenSurfaces& screen, const WholeLine& line, const Occluder& t) {
    if (screen.facing(t.number) == off_screen) return false;  // a part of it
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = k == 2 ? 0 : k + 1;
        const glm::dvec2 corner(t.x[k], t.y[k]), along = glm::dvec2(t.x[next], t.y[next]) - corner;
        const double depth = std::max(cross(along, line.from - corner), cross(along, line.to - corner));
        if (depth < glm::length(along) && !goes_on_beyond(screen, t, k)) return true;
    }
    return false;
}

double level_slack(const SurfaceSet& surfaces, double nearness, double level_px) {
    const Projection& p = surfaces.projection;
    if (p.orthographic) return level_px / p.focal_px + surfaces.coordinate_error;
    // A step in distance d is a step of d / distance^2 in nearness.
    const double absolute = nearness + surfaces.farthest_nearness;
    return absolute * (level_px / p.focal_px + surfaces.coordinate_error * absolute);
}

double snapping_slack(const WholeLine& line) {
    return std::abs(line.nearness_to - line.nearness_from) / glm::distance(line.from, line.to);
}

double line_slack(const SurfaceSet& surfaces, const WholeLine& line, double begin, double end, double level_px) {
    return level_slack(surfaces, std::max(line.nearness_at(begin), line.nearness_at(end)), level_px) +
           snapping_slack(line);
}

bool clip_where_hidden(const WholeLine& line, double slack, const Occluder& t, double& begin, double& end,
                       bool with_edges) {
    if (!clip_where_positive(t.nearness_at(line.from) - line.nearness_from - slack,
                             t.nearness_at(line.to) - line.nearness_to - slack, begin, end)) {
        return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = k == 2 ? 0 : k + 1;
        const double dx = t.x[next] - t.x[k], dy = t.y[next] - t.y[k];
        const double at_0 = dx * (line.from.y - t.y[k]) - dy * (line.from.x - t.x[k]);
        const double at_1 = dx * (line.to.y - t.y[k]) - dy * (line.to.x - t.x[k]);
        if (at_0 == 0 && at_1 == 0 && !t.owns_edge[k] && !with_edges) return false;
        if (!clip_where_positive(at_0, at_1, begin, end)) return false;
    }
    return true;
}

}  // namespace burin
