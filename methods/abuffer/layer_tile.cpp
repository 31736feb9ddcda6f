#include "methods/abuffer/layer_tile.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace burin {
namespace {

/// Cells are made so small that about so many triangles begin in one.
constexpr double kTrianglesPerCell = 40;
/// Shorter parts of lines belong to the part before. Pixels.
constexpr double kShortestPiecePx = 1.0 / 32;
constexpr float kFar = 1e30f;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

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

/// What lies around a part of a line, and is nearer than its farther end.
ScreenBox box_of(const LayerLine& line, double begin, double end) {
    const glm::dvec2 a = glm::mix(line.from, line.to, begin), b = glm::mix(line.from, line.to, end);
    const glm::vec2 low(glm::floor(glm::min(a, b))), high(glm::ceil(glm::max(a, b)));
    return {low.x, low.y, high.x, high.y, static_cast<float>(std::min(line.nearness_from, line.nearness_to)), kFar};
}

}  // namespace

bool has_transparent_surfaces(const Scene& scene) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const SceneObject& object) {
        return std::any_of(object.materials.begin(), object.materials.end(),
                           [&](std::uint32_t m) { return scene.materials[m].opacity < 1; });
    });
}

LayerTile::LayerTile(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels,
                     const LayerBins& bins, const PixelTiles& grid)
    : frame_(frame),
      screen_(screen),
      kernels_(kernels),
      bins_(bins),
      grid_(grid),
      has_transparent_(has_transparent_surfaces(*frame.scene)) {}

void LayerTile::fill(std::size_t tile) {
    rect_ = grid_.tile(tile);
    triangles_.clear();
    entries_.clear();
    set_up_.clear();
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
        if (value != number) {
            add_clipped(s, number);
            continue;
        }
        const auto& v = frame_.surfaces.mesh_of(s).triangles[s.triangle];
        const ScreenVertex* const vertices = screen_.vertices(s.instance);
        const ScreenVertex &a = vertices[v[0]], &b = vertices[v[1]], &c = vertices[v[2]];
        const auto lowest = [](auto p, auto q, auto r) { return std::min(std::min(p, q), r); };
        const auto highest = [](auto p, auto q, auto r) { return std::max(std::max(p, q), r); };
        add(number, s.instance, v,
            {static_cast<float>(lowest(a.x, b.x, c.x)), static_cast<float>(lowest(a.y, b.y, c.y)),
             static_cast<float>(highest(a.x, b.x, c.x)), static_cast<float>(highest(a.y, b.y, c.y)),
             lowest(a.nearness, b.nearness, c.nearness), highest(a.nearness, b.nearness, c.nearness)},
            kNotSetUp);
    }
    sort_into_cells();
}

void LayerTile::add(std::uint32_t number, std::uint32_t instance, const std::array<std::uint32_t, 3>& vertices,
                    const ScreenBox& box, std::uint32_t set_up) {
    const auto first = static_cast<std::uint32_t>(screen_.vertices(instance) - screen_.vertices(0));
    entries_.push_back({box, {first + vertices[0], first + vertices[1], first + vertices[2]}, number});
    set_up_.push_back(set_up);
}

double LayerTile::transmission_of(SurfaceId s) const {
    return has_transparent_ ? 1 - static_cast<double>(frame_.material_of(s).opacity) : 0;
}

void LayerTile::add_clipped(SurfaceId s, std::uint32_t number) {
    const DepthPlane plane = frame_.surfaces.plane(s);
    const double zero = frame_.surfaces.farthest_nearness;
    for (LayerTriangle& triangle : clipped_layer_triangles(screen_, s, number)) {
        triangle.transmission = transmission_of(s);
        const auto& x = triangle.x;
        const auto& y = triangle.y;
        triangles_.push_back(triangle);
        add(number, s.instance, triangle.vertices,
            {static_cast<float>(std::min({x[0], x[1], x[2]})), static_cast<float>(std::min({y[0], y[1], y[2]})),
             static_cast<float>(std::max({x[0], x[1], x[2]})), static_cast<float>(std::max({y[0], y[1], y[2]})),
             static_cast<float>(plane.lowest - zero), static_cast<float>(plane.highest - zero)},
            static_cast<std::uint32_t>(triangles_.size() - 1));
    }
}

const LayerTriangle& LayerTile::triangle(std::uint32_t i) {
    if (set_up_[i] != kNotSetUp) return triangles_[set_up_[i]];
    const std::uint32_t number = entries_[i].number;
    const SurfaceId s = screen_.surface_of(number);
    LayerTriangle triangle = layer_triangle(screen_, s, number);
    triangle.transmission = transmission_of(s);
    set_up_[i] = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(triangle);
    return triangles_.back();
}

int LayerTile::column_at(float x) const { return cell_along(x - static_cast<float>(rect_.x0 * 256), columns_); }
int LayerTile::row_at(float y) const { return cell_along(y - static_cast<float>(rect_.y0 * 256), rows_); }

int LayerTile::cell_along(float offset, int count) const {
    return std::clamp(static_cast<int>(offset * cells_per_subpixel_), 0, count - 1);
}

void LayerTile::sort_into_cells() {
    const double area = static_cast<double>(rect_.width()) * rect_.height();
    const double wanted = std::sqrt(area * kTrianglesPerCell / std::max(1.0, static_cast<double>(entries_.size())));
    cell_px_ = 1;
    while (cell_px_ < 32 && 2 * cell_px_ <= wanted) cell_px_ *= 2;
    cells_per_subpixel_ = 1 / static_cast<float>(cell_px_ * 256);
    columns_ = (rect_.width() + cell_px_ - 1) / cell_px_;
    rows_ = (rect_.height() + cell_px_ - 1) / cell_px_;
    cell_end_.assign(static_cast<std::size_t>(columns_ * rows_) + 2, 0);
    const auto for_cells = [&](const CellRange& range, const auto& visit) {
        for (int row = range.first_row; row <= range.last_row; ++row) {
            for (int column = range.first_column; column <= range.last_column; ++column) {
                visit(static_cast<std::size_t>(row * columns_ + column));
            }
        }
    };
    // Counts are kept one place further, so that filling moves each list's end to its place.
    cell_ranges_.resize(entries_.size());
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const ScreenBox& box = entries_[i].box;
        const auto number = [](int cell) { return static_cast<std::uint8_t>(cell); };
        cell_ranges_[i] = {number(column_at(box.x0)), number(column_at(box.x1)), number(row_at(box.y0)), number(row_at(box.y1))};
        for_cells(cell_ranges_[i], [&](std::size_t c) { ++cell_end_[c + 2]; });
    }
    for (std::size_t i = 2; i < cell_end_.size(); ++i) cell_end_[i] += cell_end_[i - 1];
    cell_triangles_.resize(cell_end_.back());
    cell_boxes_.resize(cell_end_.back());
    cell_vertices_.resize(cell_end_.back());
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
        for_cells(cell_ranges_[i], [&](std::size_t c) {
            const std::size_t at = cell_end_[c + 1]++;
            cell_triangles_[at] = i;
            cell_boxes_.set(at, entries_[i].box);
            cell_vertices_[at] = entries_[i].vertices;
        });
    }
    std::size_t largest = 0;
    for (std::size_t i = 0; i + 2 < cell_end_.size(); ++i) {
        largest = std::max<std::size_t>(largest, cell_end_[i + 1] - cell_end_[i]);
    }
    if (touching_.size() < largest) touching_.resize(largest);
    fragment_count_ += cell_triangles_.size();
}

/// Places in cell_triangles_.
std::span<const std::uint32_t> LayerTile::touching(std::size_t begin, std::size_t end, const ScreenBox& box,
                                                   float least_x0, float least_y0) {
    return {touching_.data(),
            kernels_.find_touching(cell_boxes_.view(), begin, end, box, least_x0, least_y0, touching_.data())};
}

/// Notes where in [begin, end] a triangle is in front of a line.
void LayerTile::hide(const LayerLine& line, std::uint32_t i, double begin, double end) {
    const LayerTriangle& t = triangle(i);
    if (lies_on(line, t) || !clip_where_hidden(line, line_slack_ + t.slack, t, begin, end)) return;
    intervals_.push_back({begin, end, t.transmission});
}

void LayerTile::find_pieces(const LayerLine& line, std::uint32_t line_number, std::vector<LayerPiece>& pieces) {
    const glm::dvec2 corner = glm::dvec2(rect_.x0, rect_.y0) * 256.0;
    double begin = 0, end = 1;
    if (!clip_to_rect(line, corner, glm::dvec2(rect_.x1, rect_.y1) * 256.0, begin, end)) return;
    intervals_.clear();
    line_slack_ = line_slack(frame_.surfaces, line);
    const glm::dvec2 a = glm::mix(line.from, line.to, begin), b = glm::mix(line.from, line.to, end);
    const int first_row = row_at(static_cast<float>(std::min(a.y, b.y)));
    const int last_row = row_at(static_cast<float>(std::max(a.y, b.y)));
    const int first_column = column_at(static_cast<float>(std::min(a.x, b.x)));
    const int last_column = column_at(static_cast<float>(std::max(a.x, b.x)));
    const double size = cell_px_ * 256.0;
    for (int row = first_row; row <= last_row; ++row) {
        for (int column = first_column; column <= last_column; ++column) {
            double from = begin, to = end;
            const glm::dvec2 low = corner + glm::dvec2(column, row) * size;
            if (!clip_to_rect(line, low, low + size, from, to)) continue;
            const Cell c = cell(column, row);
            for (const std::uint32_t i : touching(c.begin, c.end, box_of(line, from, to), -kFar, -kFar)) {
                hide(line, cell_triangles_[i], from, to);
            }
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
        for (int column = 0; column < columns_; ++column) find_in_cell(column, row, lines);
    }
}

void LayerTile::find_in_cell(int column, int row, std::vector<LayerLine>& lines) {
    // Of all cells that both triangles touch, the one with the corner where their boxes begin to overlap
    // is responsible.
    const float pitch = static_cast<float>(cell_px_ * 256);
    const float x_origin = static_cast<float>(rect_.x0 * 256), y_origin = static_cast<float>(rect_.y0 * 256);
    const float left = column == 0 ? -kFar : x_origin + pitch * static_cast<float>(column);
    const float top = row == 0 ? -kFar : y_origin + pitch * static_cast<float>(row);
    const auto from = [](float begin, float border) { return begin >= border ? -kFar : border; };
    const auto have_vertex_in_common = [&](std::size_t i, std::size_t j) {
        const auto& a = cell_vertices_[i];
        const auto& b = cell_vertices_[j];
        const auto is_in_b = [&b](std::uint32_t v) { return (v == b[0]) | (v == b[1]) | (v == b[2]); };
        return (is_in_b(a[0]) | is_in_b(a[1]) | is_in_b(a[2])) != 0;
    };
    const Cell c = cell(column, row);
    for (std::size_t i = c.begin; i + 1 < c.end; ++i) {
        const ScreenBox box = cell_boxes_[i];
        std::optional<SidePlane> plane;
        for (const std::uint32_t j : touching(i + 1, c.end, box, from(box.x0, left), from(box.y0, top))) {
            if (have_vertex_in_common(i, j)) continue;
            if (!plane) plane = side_plane(cell_vertices_[i]);
            if (is_on_one_side(*plane, cell_vertices_[j])) continue;
            if (is_on_one_side(side_plane(cell_vertices_[j]), cell_vertices_[i])) continue;
            const std::uint32_t own = cell_triangles_[i], other = cell_triangles_[j];
            triangle(own);  // both before either is looked at: setting up moves them
            triangle(other);
            intersect(triangle(own), triangle(other), lines);
        }
    }
}

LayerTile::SidePlane LayerTile::side_plane(const Corners& corners) const {
    const ScreenVertex* const v = screen_.vertices(0);
    const ScreenVertex &a = v[corners[0]], &b = v[corners[1]], &c = v[corners[2]];
    SidePlane plane;
    plane.is_on_screen = (a.x != ScreenVertex::kOffScreen) & (b.x != ScreenVertex::kOffScreen) & (c.x != ScreenVertex::kOffScreen);
    if (!plane.is_on_screen) return plane;
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double qa = static_cast<double>(a.nearness), uq = static_cast<double>(b.nearness) - qa,
                 vq = static_cast<double>(c.nearness) - qa;
    const double area = ux * vy - uy * vx, sign = area < 0 ? -1.0 : 1.0;
    plane.x = a.x;
    plane.y = a.y;
    plane.nearness = qa;
    plane.per_x = sign * (uq * vy - vq * uy);
    plane.per_y = sign * (vq * ux - uq * vx);
    plane.per_nearness = sign * area;
    plane.slack = std::abs(plane.per_x) + std::abs(plane.per_y);
    return plane;
}

/// Whether a plane does not reach through a triangle, by more than snapping does; neither need be set up for that.
bool LayerTile::is_on_one_side(const SidePlane& plane, const Corners& corners) const {
    if (!plane.is_on_screen) return false;
    const ScreenVertex* const v = screen_.vertices(0);
    double low = 0, high = 0;
    for (const std::uint32_t vertex : corners) {
        const ScreenVertex& p = v[vertex];
        if (p.x == ScreenVertex::kOffScreen) return false;
        const double gap = plane.per_x * (p.x - plane.x) + plane.per_y * (p.y - plane.y) -
                           plane.per_nearness * (static_cast<double>(p.nearness) - plane.nearness);
        low = std::min(low, gap);
        high = std::max(high, gap);
    }
    return low >= -plane.slack || high <= plane.slack;
}

void LayerTile::intersect(const LayerTriangle& a, const LayerTriangle& b, std::vector<LayerLine>& lines) const {
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
        const double slack = plane.slack + corners.slack + level_slack(frame_.surfaces, std::max(plane.nearness, corners.nearness));
        return low < -slack && high > slack;
    };
    if (!reaches_through(a, b) || !reaches_through(b, a)) return;

    // Both planes meet where gap(p) = offset + slope.p = 0; from there, the part within both triangles.
    const glm::dvec2 slope(a.per_x - b.per_x, a.per_y - b.per_y);
    const glm::dvec2 origin(a.x[0], a.y[0]);
    const double square = glm::dot(slope, slope);
    if (!(square > 0)) return;
    const glm::dvec2 foot = origin - slope * ((a.nearness_at(origin) - b.nearness_at(origin)) / square);
    const glm::dvec2 along = glm::dvec2(-slope.y, slope.x) / std::sqrt(square);
    double begin = -1e300, end = 1e300;
    struct Edge {
        const LayerTriangle *owner = nullptr, *other = nullptr;
        std::size_t corner = 0;
        std::uint64_t node() const { return owner != nullptr ? node_of(*owner, corner, *other) : LayerLine::kNoNode; }
    } first, last;  // between which the line runs
    for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = k == 2 ? 0 : k + 1;
            const glm::dvec2 p(own->x[k], own->y[k]);
            const glm::dvec2 edge = glm::dvec2(own->x[next], own->y[next]) - p;
            const double inside = cross(edge, foot - p), change = cross(edge, along);
            if (change == 0) {
                if (inside < 0) return;
                continue;
            }
            const double t = -inside / change;
            if (change > 0 && t > begin) {
                begin = t;
                first = {own, other, k};
            } else if (change < 0 && t < end) {
                end = t;
                last = {own, other, k};
            }
            if (!(begin < end)) return;
        }
    }
    LayerLine line;
    line.from = foot + along * begin;
    line.to = foot + along * end;
    line.nearness_from = a.nearness_at(line.from);
    line.nearness_to = a.nearness_at(line.to);
    line.owners = {a.number, b.number};
    line.nodes = {first.node(), last.node()};
    const SurfaceId sa = screen_.surface_of(a.number), sb = screen_.surface_of(b.number);
    if (frame_.surfaces.polygon_id(sa) == frame_.surfaces.polygon_id(sb)) return;
    const LineClassSet contact = contact_classes(frame_.surfaces, sa, sb, 0.5 * (line.from + line.to) / 256.0, frame_.criteria);
    const LineClassSet classes =
        (LineClass::intersection | (contact & (LineClass::object | LineClass::material))) & frame_.criteria.classes;
    if (classes.empty()) return;
    line.classes = classes;
    line.drawn_as = *classes.first();
    lines.push_back(line);
}

}  // namespace burin
