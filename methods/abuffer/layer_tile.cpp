#include "methods/abuffer/layer_tile.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace burin {
namespace {

/// Cells are made so small that about so many triangles touch one.
constexpr double kTrianglesPerCell = 6;
/// Shorter parts of lines belong to the part before. Pixels.
constexpr double kShortestPiecePx = 1.0 / 32;
/// A surface is in front of a line if it is nearer by this part of a pixel's width.
constexpr double kLevelPx = 1.0 / 16;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// The part of [begin, end] in which a value that runs from `at_0` at 0 to `at_1` at 1 is positive.
/// False if there is none.
bool clip(double at_0, double at_1, double& begin, double& end) {
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

/// Names the place where an edge of one triangle passes through another one.
std::uint64_t node_of(const LayerTriangle& edge_owner, std::size_t edge, const LayerTriangle& other) {
    const auto mix = [](std::uint64_t h, std::uint64_t value) {  // splitmix64
        h += value + 0x9E3779B97F4A7C15u;
        h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9u;
        h = (h ^ h >> 27) * 0x94D049BB133111EBu;
        return h ^ h >> 31;
    };
    const auto [a, b] = std::minmax(edge_owner.vertices[edge], edge_owner.vertices[(edge + 1) % 3]);
    const std::uint64_t h = mix(mix(edge_owner.instance, std::uint64_t{a} << 32 | b), other.number);
    return h | std::uint64_t{1} << 63;
}

/// The part of a line within a rectangle.
bool clip_to(const LayerLine& line, glm::dvec2 low, glm::dvec2 high, double& begin, double& end) {
    return clip(line.from.x - low.x, line.to.x - low.x, begin, end) &&
           clip(high.x - line.from.x, high.x - line.to.x, begin, end) &&
           clip(line.from.y - low.y, line.to.y - low.y, begin, end) &&
           clip(high.y - line.from.y, high.y - line.to.y, begin, end);
}

}  // namespace

bool has_transparent_surfaces(const Scene& scene) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const SceneObject& object) {
        return std::any_of(object.materials.begin(), object.materials.end(),
                           [&](std::uint32_t m) { return scene.materials[m].opacity < 1; });
    });
}

LayerTile::LayerTile(const Frame& frame, const ScreenSurfaces& screen, const LayerBins& bins, const PixelTiles& grid)
    : frame_(frame),
      screen_(screen),
      bins_(bins),
      grid_(grid),
      has_transparent_(has_transparent_surfaces(*frame.scene)) {}

void LayerTile::fill(std::size_t tile) {
    rect_ = grid_.tile(tile);
    triangles_.clear();
    SurfaceId s;
    std::uint32_t first = 0, end = 0;
    for (const std::uint32_t value : bins_.triangles(tile)) {
        const std::uint32_t number = value & ~LayerBins::kClipped;
        if (number >= end) {
            s = screen_.surface_of(number);
            first = number - s.triangle;
            end = first + static_cast<std::uint32_t>(frame_.surfaces.mesh_of(s).triangles.size());
        }
        s.triangle = number - first;
        add_triangle(value, s);
    }
    sort_into_cells();
}

void LayerTile::add_triangle(std::uint32_t value, SurfaceId s) {
    LayerTriangle triangle;
    triangle.number = value & ~LayerBins::kClipped;
    triangle.instance = s.instance;
    triangle.vertices = frame_.surfaces.mesh_of(s).triangles[s.triangle];
    triangle.transmission = has_transparent_ ? 1 - static_cast<double>(frame_.material_of(s).opacity) : 0;
    if ((value & LayerBins::kClipped) != 0) {
        const ScreenPolygon polygon = frame_.surfaces.screen_polygon(s);
        const DepthPlane plane = frame_.surfaces.plane(s);
        std::array<glm::dvec2, ScreenPolygon::kMaxCorners> corners;
        for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
            corners[i] = glm::dvec2(polygon.corners[i].x, polygon.corners[i].y);
        }
        triangle.per_x = plane.per_x / kSubpixelsPerPixel;
        triangle.per_y = plane.per_y / kSubpixelsPerPixel;
        const double zero = frame_.surfaces.farthest_nearness;
        triangle.nearness = plane.extended_to(corners[0] / 256.0) - zero;
        triangle.low = plane.lowest - zero;
        triangle.high = plane.highest - zero;
        add_polygon(triangle, {corners.data(), static_cast<std::size_t>(polygon.count)});
        return;
    }
    const ScreenVertex* const v = screen_.vertices(s.instance);
    const ScreenVertex &a = v[triangle.vertices[0]], &b = v[triangle.vertices[1]], &c = v[triangle.vertices[2]];
    const double per_area = 1.0 / static_cast<double>(doubled_area(a, b, c));
    const double qa = static_cast<double>(a.nearness), qb = static_cast<double>(b.nearness) - qa,
                 qc = static_cast<double>(c.nearness) - qa;
    triangle.nearness = qa;
    triangle.per_x = (qb * (c.y - a.y) - qc * (b.y - a.y)) * per_area;
    triangle.per_y = (qc * (b.x - a.x) - qb * (c.x - a.x)) * per_area;
    triangle.low = qa + std::min({0.0, qb, qc});
    triangle.high = qa + std::max({0.0, qb, qc});
    const glm::dvec2 corners[3] = {{a.x, a.y}, {b.x, b.y}, {c.x, c.y}};
    add_polygon(triangle, corners);
}

void LayerTile::add_polygon(LayerTriangle triangle, std::span<const glm::dvec2> corners) {
    const std::array<std::uint32_t, 3> vertices = triangle.vertices;
    triangle.slack = std::abs(triangle.per_x) + std::abs(triangle.per_y);
    for (std::size_t i = 2; i < corners.size(); ++i) {
        std::array<glm::dvec2, 3> p{corners[0], corners[i - 1], corners[i]};
        const double area = cross(p[1] - p[0], p[2] - p[0]);
        if (area == 0) continue;
        const bool is_turned = area < 0;
        if (is_turned) std::swap(p[1], p[2]);
        triangle.vertices = vertices;
        if (is_turned) std::swap(triangle.vertices[1], triangle.vertices[2]);
        triangle.box_low = glm::min(p[0], glm::min(p[1], p[2]));
        triangle.box_high = glm::max(p[0], glm::max(p[1], p[2]));
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 along = p[(k + 1) % 3] - p[k];
            triangle.x[k] = p[k].x;
            triangle.y[k] = p[k].y;
            triangle.owns_edge[k] = along.y < 0 || (along.y == 0 && along.x > 0);
        }
        triangles_.push_back(triangle);
    }
}

int LayerTile::column_at(double x) const {
    return static_cast<int>(std::clamp(std::floor((x / 256 - rect_.x0) / cell_px_), 0.0, columns_ - 1.0));
}
int LayerTile::row_at(double y) const {
    return static_cast<int>(std::clamp(std::floor((y / 256 - rect_.y0) / cell_px_), 0.0, rows_ - 1.0));
}

void LayerTile::sort_into_cells() {
    const double area = static_cast<double>(rect_.width()) * rect_.height();
    const double wanted = std::sqrt(area * kTrianglesPerCell / std::max(1.0, static_cast<double>(triangles_.size())));
    cell_px_ = 1;
    while (cell_px_ < 32 && 2 * cell_px_ <= wanted) cell_px_ *= 2;
    columns_ = (rect_.width() + cell_px_ - 1) / cell_px_;
    rows_ = (rect_.height() + cell_px_ - 1) / cell_px_;
    cell_end_.assign(static_cast<std::size_t>(columns_ * rows_) + 2, 0);
    const auto for_cells = [&](const LayerTriangle& t, const auto& visit) {
        const int first_column = column_at(t.box_low.x), last_column = column_at(t.box_high.x);
        const int last_row = row_at(t.box_high.y);
        for (int row = row_at(t.box_low.y); row <= last_row; ++row) {
            for (int column = first_column; column <= last_column; ++column) {
                visit(static_cast<std::size_t>(row * columns_ + column));
            }
        }
    };
    // Counts are kept one place further, so that filling moves each list's end to its place.
    for (const LayerTriangle& t : triangles_) for_cells(t, [&](std::size_t c) { ++cell_end_[c + 2]; });
    for (std::size_t i = 2; i < cell_end_.size(); ++i) cell_end_[i] += cell_end_[i - 1];
    cell_triangles_.resize(cell_end_.back());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        for_cells(triangles_[i], [&](std::size_t c) { cell_triangles_[cell_end_[c + 1]++] = i; });
    }
    fragment_count_ += cell_triangles_.size();
}

double LayerTile::level_slack(double nearness) const {
    const Projection& p = frame_.surfaces.projection;
    if (p.orthographic) return kLevelPx / p.focal_px + frame_.surfaces.coordinate_error;
    // A step in distance d is a step of d / distance^2 in nearness.
    const double absolute = nearness + frame_.surfaces.farthest_nearness;
    return absolute * (kLevelPx / p.focal_px + frame_.surfaces.coordinate_error * absolute);
}

bool LayerTile::is_owner(const LayerLine& line, const LayerTriangle& triangle) const {
    if (triangle.number == line.owners[0] || triangle.number == line.owners[1]) return true;
    if (!line.has_more_owners) return false;
    int common = 0;
    for (const std::uint64_t node : line.nodes) {
        for (const std::uint32_t v : triangle.vertices) {
            common += node == (std::uint64_t{triangle.instance} << 32 | v);
        }
    }
    return common == 2;
}

/// Notes where in [begin, end] a triangle is in front of a line.
void LayerTile::hide(const LayerLine& line, const LayerTriangle& t, double begin, double end) {
    const double nearest = std::min(line.nearness_from, line.nearness_to);
    if (t.high <= nearest || is_owner(line, t)) return;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = k == 2 ? 0 : k + 1;
        const double dx = t.x[next] - t.x[k], dy = t.y[next] - t.y[k];
        const double at_0 = dx * (line.from.y - t.y[k]) - dy * (line.from.x - t.x[k]);
        const double at_1 = dx * (line.to.y - t.y[k]) - dy * (line.to.x - t.x[k]);
        if (at_0 == 0 && at_1 == 0 && !t.owns_edge[k]) return;
        if (!clip(at_0, at_1, begin, end)) return;
    }
    const double slack = line_slack_ + t.slack;
    if (!clip(t.nearness_at(line.from) - line.nearness_from - slack,
              t.nearness_at(line.to) - line.nearness_to - slack, begin, end)) {
        return;
    }
    intervals_.push_back({begin, end, t.transmission});
}

void LayerTile::find_pieces(const LayerLine& line, std::uint32_t line_number, std::vector<LayerPiece>& pieces) {
    const glm::dvec2 corner = glm::dvec2(rect_.x0, rect_.y0) * 256.0;
    double begin = 0, end = 1;
    if (!clip_to(line, corner, glm::dvec2(rect_.x1, rect_.y1) * 256.0, begin, end)) return;
    intervals_.clear();
    const double length = glm::distance(line.from, line.to);
    line_slack_ = level_slack(std::max(line.nearness_from, line.nearness_to)) +
                  std::abs(line.nearness_to - line.nearness_from) / length;
    const glm::dvec2 a = glm::mix(line.from, line.to, begin), b = glm::mix(line.from, line.to, end);
    const int first_row = row_at(std::min(a.y, b.y)), last_row = row_at(std::max(a.y, b.y));
    const int first_column = column_at(std::min(a.x, b.x));
    const int last_column = column_at(std::max(a.x, b.x));
    const double size = cell_px_ * 256.0;
    for (int row = first_row; row <= last_row; ++row) {
        for (int column = first_column; column <= last_column; ++column) {
            double from = begin, to = end;
            const glm::dvec2 low = corner + glm::dvec2(column, row) * size;
            if (!clip_to(line, low, low + size, from, to)) continue;
            for (const std::uint32_t i : cell(column, row)) hide(line, triangles_[i], from, to);
        }
    }
    if (!intervals_.empty()) sweep(line, line_number, begin, end, pieces);
}

/// Counts the layers in front from one end of the line to the other.
void LayerTile::sweep(const LayerLine& line, std::uint32_t number, double begin, double end,
                      std::vector<LayerPiece>& pieces) {
    events_.clear();
    for (const Interval& i : intervals_) {
        const int opaque = i.transmission == 0 ? 1 : 0;
        events_.push_back({i.begin, opaque});
        events_.push_back({i.end, -opaque});
    }
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    const double shortest = std::min(kShortestPiecePx / line.length_px(), 0.5 * (end - begin));
    int opaque = 0;
    double start = begin;
    const std::size_t first_piece = pieces.size();
    const auto emit = [&](double to) {
        double transmission = 1;
        if (has_transparent_) {
            const double middle = 0.5 * (start + to);
            for (const Interval& i : intervals_) {
                if (i.transmission > 0 && i.begin < middle && middle < i.end) transmission *= i.transmission;
            }
        }
        LayerPiece piece;
        piece.line = number;
        piece.begin = start;
        piece.end = to;
        piece.invisibility = static_cast<std::uint8_t>(std::min(opaque, 255));
        piece.transmission = static_cast<std::uint8_t>(std::lround(255 * transmission));
        const double from = start;
        start = to;
        if (piece.invisibility == 0 && piece.transmission == 255) return;
        LayerPiece* const last = pieces.size() > first_piece ? &pieces.back() : nullptr;
        if (last != nullptr && last->end == from && last->invisibility == piece.invisibility &&
            last->transmission == piece.transmission) {
            last->end = to;
        } else {
            pieces.push_back(piece);
        }
    };
    for (const Event& e : events_) {
        if (end - e.at < shortest) break;  // what is left is too short to differ
        if (e.at - start >= shortest) emit(e.at);
        opaque += e.opaque;
    }
    emit(end);
}

void LayerTile::find_intersections(std::vector<LayerLine>& lines) {
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            const auto list = cell(column, row);
            for (std::size_t i = 0; i < list.size(); ++i) {
                const LayerTriangle& a = triangles_[list[i]];
                for (std::size_t j = i + 1; j < list.size(); ++j) {
                    const LayerTriangle& b = triangles_[list[j]];
                    if (a.low >= b.high || b.low >= a.high) continue;
                    // Of all cells that both touch, the first one is responsible.
                    if (column_at(std::max(a.box_low.x, b.box_low.x)) != column ||
                        row_at(std::max(a.box_low.y, b.box_low.y)) != row) {
                        continue;
                    }
                    intersect(a, b, lines);
                }
            }
        }
    }
}

void LayerTile::intersect(const LayerTriangle& a, const LayerTriangle& b, std::vector<LayerLine>& lines) const {
    if (a.number == b.number) return;
    if (a.instance == b.instance) {
        for (const std::uint32_t v : a.vertices) {
            if (v == b.vertices[0] || v == b.vertices[1] || v == b.vertices[2]) return;
        }
    }
    // How much nearer a is than b, where corners of either are.
    double low = 0, high = 0;
    const auto reaches_through = [&](const LayerTriangle& plane, const LayerTriangle& corners) {
        low = high = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 p(corners.x[k], corners.y[k]);
            const double gap = plane.nearness_at(p) - corners.nearness_at(p);
            low = std::min(low, gap);
            high = std::max(high, gap);
        }
        const double slack = plane.slack + corners.slack + level_slack(std::min(plane.high, corners.high));
        return low < -slack && high > slack;
    };
    if (!reaches_through(a, b) || !reaches_through(b, a)) return;
    if (frame_.surfaces.polygon_id(screen_.surface_of(a.number)) ==
        frame_.surfaces.polygon_id(screen_.surface_of(b.number))) {
        return;
    }

    // Both planes meet where gap(p) = offset + slope.p = 0; from there, the part within both triangles.
    const glm::dvec2 slope(a.per_x - b.per_x, a.per_y - b.per_y);
    const glm::dvec2 origin(a.x[0], a.y[0]);
    const double square = glm::dot(slope, slope);
    if (!(square > 0)) return;
    const glm::dvec2 foot = origin - slope * ((a.nearness_at(origin) - b.nearness_at(origin)) / square);
    const glm::dvec2 along = glm::dvec2(-slope.y, slope.x) / std::sqrt(square);
    double begin = -1e300, end = 1e300;
    std::uint64_t nodes[2] = {LayerLine::kNoNode, LayerLine::kNoNode};
    for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 p(own->x[k], own->y[k]);
            const glm::dvec2 edge = glm::dvec2(own->x[(k + 1) % 3], own->y[(k + 1) % 3]) - p;
            const double inside = cross(edge, foot - p), change = cross(edge, along);
            if (change == 0) {
                if (inside < 0) return;
                continue;
            }
            const double t = -inside / change;
            if (change > 0 && t > begin) {
                begin = t;
                nodes[0] = node_of(*own, k, *other);
            } else if (change < 0 && t < end) {
                end = t;
                nodes[1] = node_of(*own, k, *other);
            }
        }
    }
    if (!(begin < end)) return;
    LayerLine line;
    line.from = foot + along * begin;
    line.to = foot + along * end;
    line.nearness_from = a.nearness_at(line.from);
    line.nearness_to = a.nearness_at(line.to);
    line.owners = {a.number, b.number};
    line.nodes = {nodes[0], nodes[1]};
    const SurfaceId sa = screen_.surface_of(a.number), sb = screen_.surface_of(b.number);
    const LineClassSet contact = contact_classes(frame_.surfaces, sa, sb, 0.5 * (line.from + line.to) / 256.0, frame_.criteria);
    const LineClassSet classes =
        (LineClass::intersection | (contact & (LineClass::object | LineClass::material))) & frame_.criteria.classes;
    if (classes.empty()) return;
    line.drawn_as = *classes.first();
    lines.push_back(line);
}

}  // namespace burin
