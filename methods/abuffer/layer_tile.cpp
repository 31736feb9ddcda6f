#include "methods/abuffer/layer_tile.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace burin {
namespace {

/// Cells are made so small that about so many triangles begin in one.
constexpr double kTrianglesPerCell = 80;
/// Shorter parts of lines belong to the part before. Pixels.
constexpr double kShortestPiecePx = 1.0 / 32;
constexpr float kFar = 1e30f;

ScreenLine part_of(const LayerLine& line, double begin, double end, double slack) {
    const glm::vec2 a(glm::mix(line.from, line.to, begin)), b(glm::mix(line.from, line.to, end));
    return {a.x, a.y, b.x, b.y, static_cast<float>(line.lowest_in(begin, end) - slack)};
}

}  // namespace

LayerTile::LayerTile(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels,
                     const LayerBins& bins, const PixelTiles& grid, bool finds_pairs)
    : frame_(frame),
      screen_(screen),
      contacts_(screen),
      kernels_(kernels),
      bins_(bins),
      grid_(grid),
      has_transparent_(has_transparent_surfaces(*frame.scene)),
      finds_pairs_(finds_pairs) {}

void LayerTile::fill(std::size_t tile) {
    rect_ = grid_.tile(tile);
    triangles_.clear();
    entries_.clear();
    set_up_.clear();
    has_clipped_ = false;
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
        const auto first_vertex = static_cast<std::uint32_t>(vertices - screen_.vertices(0));
        const FlatTriangle flat = flat_triangle(a, b, c, screen_.facing(number));
        const auto lowest = [](float p, float q, float r) { return std::min(std::min(p, q), r); };
        const auto highest = [](float p, float q, float r) { return std::max(std::max(p, q), r); };
        const auto &x = flat.x, &y = flat.y;
        add({{lowest(x[0], x[1], x[2]), lowest(y[0], y[1], y[2]), highest(x[0], x[1], x[2]), highest(y[0], y[1], y[2]),
              lowest(a.nearness, b.nearness, c.nearness), flat.highest},
             flat,
             {first_vertex + v[0], first_vertex + v[1], first_vertex + v[2]},
             number},
            kNotSetUp);
    }
    looked_at_by_.assign(entries_.size(), 0);
    lines_looked_at_ = 0;
    sort_into_cells();
}

void LayerTile::add(const Entry& entry, std::uint32_t set_up) {
    entries_.push_back(entry);
    set_up_.push_back(set_up);
}

double LayerTile::transmission_of(SurfaceId s) const {
    return has_transparent_ ? 1 - static_cast<double>(frame_.material_of(s).opacity) : 0;
}

void LayerTile::add_clipped(SurfaceId s, std::uint32_t number) {
    has_clipped_ = true;
    const DepthPlane plane = frame_.surfaces.plane(s);
    const double zero = frame_.surfaces.farthest_nearness;
    const auto first_vertex = static_cast<std::uint32_t>(screen_.vertices(s.instance) - screen_.vertices(0));
    for (LayerTriangle& triangle : clipped_layer_triangles(screen_, s, number)) {
        triangle.transmission = transmission_of(s);
        triangles_.push_back(triangle);
        Entry entry;
        for (std::size_t k = 0; k < 3; ++k) {
            entry.flat.x[k] = static_cast<float>(triangle.x[k]);
            entry.flat.y[k] = static_cast<float>(triangle.y[k]);
            entry.vertices[k] = first_vertex + triangle.vertices[k];
        }
        const auto &x = entry.flat.x, &y = entry.flat.y;
        entry.box = {std::min({x[0], x[1], x[2]}), std::min({y[0], y[1], y[2]}), std::max({x[0], x[1], x[2]}),
                     std::max({y[0], y[1], y[2]}), static_cast<float>(plane.lowest - zero), static_cast<float>(plane.highest - zero)};
        entry.flat.highest = entry.box.high;
        entry.number = number;
        add(entry, static_cast<std::uint32_t>(triangles_.size() - 1));
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
    cell_entries_.resize(cell_end_.back());
    cell_triangles_.resize(cell_end_.back());
    if (finds_pairs_) {
        cell_boxes_.resize(cell_end_.back());
        cell_vertices_.resize(cell_end_.back());
    }
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
        for_cells(cell_ranges_[i], [&](std::size_t c) {
            const std::size_t at = cell_end_[c + 1]++;
            cell_entries_[at] = i;
            cell_triangles_.set(at, entries_[i].flat);
            if (!finds_pairs_) return;
            cell_boxes_.set(at, entries_[i].box);
            cell_vertices_[at] = entries_[i].vertices;
        });
    }
    std::size_t largest = 0;
    for (std::size_t i = 0; i + 2 < cell_end_.size(); ++i) {
        largest = std::max<std::size_t>(largest, cell_end_[i + 1] - cell_end_[i]);
    }
    if (found_.size() < largest) found_.resize(largest);
    fragment_count_ += cell_entries_.size();
}

/// Places in cell_entries_.
std::span<const std::uint32_t> LayerTile::touching(std::size_t begin, std::size_t end, const ScreenBox& box,
                                                   float least_x0, float least_y0) {
    return {found_.data(),
            kernels_.find_touching(cell_boxes_.view(), begin, end, box, least_x0, least_y0, found_.data())};
}

/// Notes where in a part of a line a triangle is in front of it.
void LayerTile::hide(const LayerLine& line, std::uint32_t i, const PartInTile& part) {
    const LayerTriangle& t = triangle(i);
    if (lies_on(line, t)) return;
    const double certain = certain_slack_ + t.slack;
    const double at_begin = t.nearness_at(part.from) - part.nearness_from, at_end = t.nearness_at(part.to) - part.nearness_to;
    if (std::max(at_begin, at_end) < -certain) return;
    Interval clear{t.number, part.begin, part.end, t.transmission}, most = clear;
    const bool is_any_clear = clip_where_hidden(line, certain, t, clear.begin, clear.end);
    // What is level with the line is in front where it is seen instead: what that is, is asked last.
    if (std::min(at_begin, at_end) <= certain && line.drawn_as != LineClass::intersection &&
        clip_where_hidden(line, -certain, t, most.begin, most.end)) {
        const bool is_settled = is_any_clear && clear.begin == most.begin && clear.end == most.end;
        if (!is_settled && contacts_.is_flush(line, most.begin, most.end, t, line_slack_ + t.slack, frame_.criteria, true)) {
            contacts_of_line_.push_back({most.begin, most.end, i, false});
            return;
        }
        if (!is_settled && contacts_.is_in_front(line, most.begin, most.end, t, line_slack_ + t.slack)) {
            intervals_.push_back(most);
            return;
        }
    }
    if (is_any_clear && !only_grazes(screen_, line, t)) intervals_.push_back(clear);
}

void LayerTile::find_pieces(const LayerLine& line, std::uint32_t line_number, std::vector<LayerPiece>& pieces) {
    const glm::dvec2 corner = glm::dvec2(rect_.x0, rect_.y0) * 256.0;
    double begin = 0, end = 1;
    if (!clip_to_rect(line, corner, glm::dvec2(rect_.x1, rect_.y1) * 256.0, begin, end)) return;
    intervals_.clear();
    contacts_of_line_.clear();
    line_slack_ = line_slack(frame_.surfaces, line, begin, end);
    certain_slack_ = line_slack(frame_.surfaces, line, begin, end, kCertainPx);
    const glm::dvec2 a = glm::mix(line.from, line.to, begin), b = glm::mix(line.from, line.to, end);
    const PartInTile part{begin, end, a, b, line.nearness_at(begin), line.nearness_at(end)};
    for_triangles(line, part, line_slack_, [&](std::uint32_t entry) { hide(line, entry, part); });
    if (intervals_.empty()) return;
    if (line.classes.has(LineClass::border)) find_contacts(line, part);
    merge_intervals();
    const std::size_t first_piece = pieces.size();
    sweep(line, line_number, begin, end, pieces);
    drop_contacts(first_piece, pieces);
}

/// Calls use(entry) once for each triangle that is near a part of a line, with a corner in front of it, or behind it by no
/// more than `slack`.
template <typename Use>
void LayerTile::for_triangles(const LayerLine& line, const PartInTile& part, double slack, const Use& use) {
    ++lines_looked_at_;
    const glm::dvec2 corner = glm::dvec2(rect_.x0, rect_.y0) * 256.0, a = part.from, b = part.to;
    const int first_row = row_at(static_cast<float>(std::min(a.y, b.y)));
    const int last_row = row_at(static_cast<float>(std::max(a.y, b.y)));
    const int first_column = column_at(static_cast<float>(std::min(a.x, b.x)));
    const int last_column = column_at(static_cast<float>(std::max(a.x, b.x)));
    const double size = cell_px_ * 256.0;
    for (int row = first_row; row <= last_row; ++row) {
        for (int column = first_column; column <= last_column; ++column) {
            double from = part.begin, to = part.end;
            const glm::dvec2 low = corner + glm::dvec2(column, row) * size;
            if (!clip_to_rect(line, low, low + size, from, to)) continue;
            const Cell c = cell(column, row);
            const std::size_t count = kernels_.find_hiding(cell_triangles_.view(), c.begin, c.end, part_of(line, from, to, slack), found_.data());
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint32_t entry = cell_entries_[found_[i]];
                if (std::exchange(looked_at_by_[entry], lines_looked_at_) != lines_looked_at_) use(entry);
            }
        }
    }
}

/// Where a border ends in contact with a surface that goes on beyond it without any line.
void LayerTile::find_contacts(const LayerLine& line, const PartInTile& part) {
    if (line.classes.has(LineClass::mark)) return;
    for_triangles(line, part, line_slack(frame_.surfaces, line, part.begin, part.end, kContactPx), [&](std::uint32_t entry) {
        const LayerTriangle& t = triangle(entry);
        if (lies_on(line, t)) return;
        Contact contact{part.begin, part.end, entry, false};
        const auto classes = contacts_.classes_of_contact(line, t, frame_.criteria, contact.begin, contact.end);
        if (!classes) return;
        contact.makes_line = !classes->empty();
        contacts_of_line_.push_back(contact);
    });
    // Of several the nearest counts.
    const auto is_behind_another = [&](const Contact& c) {
        const double middle = 0.5 * (c.begin + c.end);
        const glm::dvec2 at = glm::mix(line.from, line.to, middle);
        const double nearness = triangle(c.entry).nearness_at(at);
        return std::any_of(contacts_of_line_.begin(), contacts_of_line_.end(), [&](const Contact& other) {
            return other.makes_line && other.begin < middle && middle < other.end && triangle(other.entry).nearness_at(at) > nearness;
        });
    };
    for (Contact& c : contacts_of_line_) {
        if (!c.makes_line && is_behind_another(c)) c.end = c.begin;
    }
    std::erase_if(contacts_of_line_, [](const Contact& c) { return c.makes_line || c.begin >= c.end; });
}

/// Cuts them out of the pieces from `first` on.
void LayerTile::drop_contacts(std::size_t first, std::vector<LayerPiece>& pieces) {
    if (contacts_of_line_.empty()) return;
    std::sort(contacts_of_line_.begin(), contacts_of_line_.end(), [](const Contact& a, const Contact& b) { return a.begin < b.begin; });
    const std::vector<LayerPiece> whole(pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.end());
    pieces.resize(first);
    for (LayerPiece piece : whole) {
        const double end = piece.end;
        for (const Contact& contact : contacts_of_line_) {
            if (contact.begin > piece.begin && piece.begin < end) {
                piece.end = std::min(end, contact.begin);
                pieces.push_back(piece);
            }
            piece.begin = std::max(piece.begin, contact.end);
        }
        piece.end = end;
        if (piece.begin < end) pieces.push_back(piece);
    }
}

/// Joins what the parts of a clipped triangle hide, which is one layer. In order, for shares of light are multiplied.
void LayerTile::merge_intervals() {
    if (!has_clipped_ && !has_transparent_) return;
    std::sort(intervals_.begin(), intervals_.end(), [](const Interval& a, const Interval& b) {
        return a.triangle != b.triangle ? a.triangle < b.triangle : a.begin < b.begin;
    });
    std::size_t count = 1;
    for (const Interval& i : intervals_) {
        Interval& last = intervals_[count - 1];
        if (i.triangle != last.triangle || i.begin > last.end) {
            intervals_[count++] = i;
        } else {
            last.end = std::max(last.end, i.end);
        }
    }
    intervals_.resize(count);
}

/// Counts the layers in front from one end of the line to the other.
void LayerTile::sweep(const LayerLine& line, std::uint32_t number, double begin, double end,
                      std::vector<LayerPiece>& pieces) {
    events_.clear();
    int opaque = 0;  // in front where the line begins
    for (const Interval& i : intervals_) {
        const int more = i.transmission == 0 ? 1 : 0;
        if (i.begin <= begin) {
            opaque += more;
        } else {
            events_.push_back({i.begin, more});
        }
        if (i.end < end) events_.push_back({i.end, -more});
    }
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    const double shortest = std::min(kShortestPiecePx / line.length_px(), 0.5 * (end - begin));
    double start = begin;
    const std::size_t first_piece = pieces.size();
    const auto emit = [&](double to) {
        double transmission = 1;
        bool is_behind_glass = false;  // visible lines end there, however clear it is
        if (has_transparent_) {
            const double middle = 0.5 * (start + to);
            for (const Interval& i : intervals_) {
                if (!(i.transmission > 0 && i.begin < middle && middle < i.end)) continue;
                transmission *= i.transmission;
                is_behind_glass = true;
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
        if (piece.invisibility == 0 && !is_behind_glass) return;
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

void LayerTile::find_intersections(const IntersectionTest& may_intersect, const IntersectionLines& intersections,
                                   std::vector<LayerLine>& lines) {
    pairs_.clear();
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) find_pairs_in_cell(column, row);
    }
    const auto surface_of = [this](std::uint32_t i) { return screen_.surface_of(entries_[i].number); };
    for (const auto& [own, other] : pairs_) {
        if (!may_intersect.may_intersect(surface_of(own), surface_of(other))) continue;
        triangle(own);  // both before either is looked at: setting up moves them
        triangle(other);
        intersections.add(triangle(own), triangle(other), lines);
    }
}

void LayerTile::find_pairs_in_cell(int column, int row) {
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
            pairs_.push_back({cell_entries_[i], cell_entries_[j]});
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

/// Whether a plane does not reach through a triangle, by more than snapping does, nor has an edge of it; neither need be set up
/// for that.
bool LayerTile::is_on_one_side(const SidePlane& plane, const Corners& corners) const {
    if (!plane.is_on_screen) return false;
    const ScreenVertex* const v = screen_.vertices(0);
    double low = 0, high = 0;
    int in_plane = 0;
    for (const std::uint32_t vertex : corners) {
        const ScreenVertex& p = v[vertex];
        if (p.x == ScreenVertex::kOffScreen) return false;
        const double gap = plane.per_x * (p.x - plane.x) + plane.per_y * (p.y - plane.y) -
                           plane.per_nearness * (static_cast<double>(p.nearness) - plane.nearness);
        low = std::min(low, gap);
        high = std::max(high, gap);
        in_plane += std::abs(gap) <= plane.slack;
    }
    return (low >= -plane.slack || high <= plane.slack) && in_plane != 2;
}

}  // namespace burin
