#include "methods/wire/wire_triangle.h"

namespace burin {
namespace {

/// Edge k of edge_distance.h is half-edge (k + 1) % 3 of its triangle.
constexpr HalfEdge half_edge_opposite(int corner) { return static_cast<HalfEdge>((corner + 1) % 3); }

/// Whether the line comes within `reach` of the rectangle, as far as its corners can tell.
bool comes_near(const glm::dvec3& line, PixelRect r, double reach) {
    const glm::dvec2 middle(0.5 * (r.x0 + r.x1), 0.5 * (r.y0 + r.y1));
    const double radius = 0.5 * std::hypot(r.width(), r.height());
    return std::abs(signed_distance(line, middle)) <= radius + reach;
}

}  // namespace

void WireTriangle::load(SurfaceId surface, PixelRect rect, double reach_px) {
    surface_ = surface;
    channels_.clear();
    glm::dvec3 corners[3];
    frame_.surfaces.view_corners(surface, corners);
    const Projection& projection = frame_.surfaces.projection;
    polygon_ = project_triangle(projection, corners);
    if (polygon_.count == 0) return;
    plane_ = snapped_depth_plane(projection, corners);
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 h = homogeneous_position(projection, corners[k]);
        p_[k] = glm::dvec2(h) / h.z;
        w_[k] = h.z;
        behind_[k] = -corners[k].z < projection.near_distance;
    }
    if (rules_.exclude == WireExclude::polygon) {
        load_polygon_edges(rect, reach_px);
    } else {
        load_own_edges();
    }
}

void WireTriangle::add(const WireEdge& edge, int own_edge, bool is_dotted) {
    Channel c;
    c.edge = edge;
    c.own_edge = own_edge;
    c.is_dotted = is_dotted;
    if (own_edge >= 0) {
        c.at_corners = EdgeChannel(0.0);
        c.at_corners[own_edge] = altitudes(p_)[own_edge];
    } else {
        for (int k = 0; k < 3; ++k) c.at_corners[k] = signed_distance(edge.line, p_[k]);
    }
    channels_.push_back(c);
}

LineClass WireTriangle::stray_class() const {
    if (frame_.criteria.classes.has(LineClass::polygon)) return LineClass::polygon;
    int last = kLineClassCount - 1;
    while (last > 0 && !frame_.criteria.classes.has(static_cast<LineClass>(last))) --last;
    return static_cast<LineClass>(last);
}

void WireTriangle::load_own_edges() {
    const Mesh& mesh = frame_.surfaces.mesh_of(surface_);
    for (int k = 0; k < 3; ++k) {
        const HalfEdge j = half_edge_opposite(k), h = 3 * surface_.triangle + j;
        const auto line_class = features_.drawn(surface_, j);
        const bool is_dotted =
            !line_class && rules_.dotted_diagonals && PolygonOutlines::across_diagonal(mesh, h) != kNoHalfEdge;
        const bool is_moved_away = !line_class && !is_dotted && rules_.exclude == WireExclude::q && is_whole();
        if (!line_class && !is_dotted && !is_moved_away) continue;
        const auto edge = wire_edge(frame_.surfaces, surface_.instance, h, line_class.value_or(stray_class()));
        if (!edge || !is_line(edge->line)) continue;
        add(*edge, k, is_dotted);
        if (is_moved_away) {
            EdgeChannel& channel = channels_.back().at_corners;
            channel = channel_moved_away(k, channel[k], rules_.q_px);
        }
    }
}

void WireTriangle::load_polygon_edges(PixelRect rect, double reach_px) {
    const SurfaceSet& surfaces = frame_.surfaces;
    const Mesh& mesh = surfaces.mesh_of(surface_);
    const SurfaceId polygon{surface_.instance, mesh.polygon_of(surface_.triangle)};
    if (polygon != edges_of_) {
        edges_of_ = polygon;
        polygon_edges_.clear();
        for (const HalfEdge h : features_.outlines(polygon.instance).outline(polygon.triangle)) {
            const auto line_class = features_.drawn({polygon.instance, h / 3}, h % 3);
            if (!line_class) continue;
            const auto edge = wire_edge(surfaces, polygon.instance, h, *line_class);
            if (edge && is_line(edge->line) && comes_near(edge->line, rect, reach_px)) polygon_edges_.push_back(*edge);
        }
    }
    for (const WireEdge& edge : polygon_edges_) add(edge, -1, false);
}

}  // namespace burin
