#include "methods/abuffer/layer_tile.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace burin {
namespace {

/// Cells are made so small that about so many triangles begin in one: pairs are looked for one by one.
constexpr double kTrianglesPerCell = 2048, kTrianglesPerCellOfPairs = 80;
/// Shorter parts of lines belong to the part before. Pixels.
constexpr double kShortestPiecePx = 1.0 / 32;
constexpr float kFar = 1e30f;

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
      finds_pairs_(finds_pairs),
      cells_(kernels),
      pair_cells_(kernels) {}

void LayerTile::fill(std::size_t tile) {
    rect_ = grid_.tile(tile);
    cells_.clear(rect_);
    triangles_.clear();
    pair_entries_.clear();
    set_up_.clear();
    has_clipped_ = false;
    SurfaceId s;
    std::uint32_t first = 0, end = 0;
    const std::span<const std::uint32_t> list = bins_.triangles(tile);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::uint32_t value = list[i], number = value & ~LayerBins::kClipped;
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
        const bool is_clockwise = screen_.facing(number) == clockwise;
        const ScreenVertex &p = is_clockwise ? b : c, &q = is_clockwise ? c : b;
        const auto x = [this](const ScreenVertex& at) { return static_cast<float>(at.x - cells_.corner().x); };
        const auto y = [this](const ScreenVertex& at) { return static_cast<float>(at.y - cells_.corner().y); };
        add({{x(a), x(p), x(q)}, {y(a), y(p), y(q)}, std::max(std::max(a.nearness, b.nearness), c.nearness), number}, kNotSetUp);
        if (!finds_pairs_) continue;
        const auto first_vertex = static_cast<std::uint32_t>(vertices - screen_.vertices(0));
        pair_entries_.push_back({std::min({a.nearness, b.nearness, c.nearness}), {first_vertex + v[0], first_vertex + v[1], first_vertex + v[2]}});
    }
    cells_.sort(kTrianglesPerCell);
    cells_.make_indices();
    fragment_count_ += cells_.places().size();
}

void LayerTile::add(const CrossedTriangle& triangle, std::uint32_t set_up) {
    cells_.add(triangle);
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
        CrossedTriangle entry;
        Corners vertices;
        for (std::size_t k = 0; k < 3; ++k) {
            entry.x[k] = static_cast<float>(triangle.x[k] - cells_.corner().x);
            entry.y[k] = static_cast<float>(triangle.y[k] - cells_.corner().y);
            vertices[k] = first_vertex + triangle.vertices[k];
        }
        entry.highest = static_cast<float>(plane.highest - zero);
        entry.number = number;
        add(entry, static_cast<std::uint32_t>(triangles_.size() - 1));
        if (finds_pairs_) pair_entries_.push_back({static_cast<float>(plane.lowest - zero), vertices});
    }
}

void LayerTile::set_up(std::uint32_t i) {
    const std::uint32_t number = cells_[i].number;
    const SurfaceId s = screen_.surface_of(number);
    set_up_[i] = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(layer_triangle(screen_, s, number));
    triangles_.back().transmission = transmission_of(s);
}

/// Places in pair_cells_.
std::span<const std::uint32_t> LayerTile::touching(std::size_t begin, std::size_t end, const ScreenBox& box,
                                                   float least_x0, float least_y0) {
    return {found_.data(),
            kernels_.find_touching(cell_boxes_.view(), begin, end, box, least_x0, least_y0, found_.data())};
}

/// Notes where in a part of a line triangles are in front of it.
void LayerTile::hide(const LayerLine& line, std::span<const std::uint32_t> near, const PartInTile& part) {
    planes_.clear();
    for (const std::uint32_t i : near) triangle(i);  // all before any is looked at: setting up moves them
    for (const std::uint32_t i : near) planes_.push_back(&triangle(i));
    const PlaneLine plane_line{{line.from.x, line.to.x, part.from.x, part.to.x},
                               {line.from.y, line.to.y, part.from.y, part.to.y},
                               {line.nearness_from, line.nearness_to, part.nearness_from, part.nearness_to},
                               part.begin,
                               part.end,
                               certain_slack_};
    parts_.resize(std::max(parts_.size(), near.size()));
    const std::size_t count = kernels_.clip_hidden(planes_.data(), near.size(), plane_line, parts_.data());
    for (std::size_t k = 0; k < count; ++k) hide(line, near[parts_[k].triangle], parts_[k]);
}

void LayerTile::hide(const LayerLine& line, std::uint32_t i, const HiddenPart& hidden) {
    const LayerTriangle& t = triangle(i);
    if (line.has_more_owners && lies_on(line, t)) return;
    const Interval clear{t.number, hidden.begin, hidden.end, t.transmission};
    const Interval most{t.number, hidden.level_begin, hidden.level_end, t.transmission};
    const bool is_any_clear = hidden.is_any;
    // What is level with the line is in front where it is seen instead: what that is, is asked last.
    if (hidden.is_level && line.drawn_as != LineClass::intersection) {
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
    near_.clear();
    cells_.for_crossed(line, part.begin, part.end, line_slack_, 0, [&](std::uint32_t entry) {
        const std::uint32_t number = cells_[entry].number;
        if (number != line.owners[0] && number != line.owners[1]) near_.push_back(entry);
    });
    hide(line, near_, part);
    if (intervals_.empty()) return;
    if (line.classes.has(LineClass::border)) find_contacts(line, part);
    merge_intervals();
    const std::size_t first_piece = pieces.size();
    sweep(line, line_number, begin, end, pieces);
    drop_contacts(first_piece, pieces);
}

/// Where a border ends in contact with a surface that goes on beyond it without any line.
void LayerTile::find_contacts(const LayerLine& line, const PartInTile& part) {
    if (line.classes.has(LineClass::mark)) return;
    const double slack = line_slack(frame_.surfaces, line, part.begin, part.end, kContactPx);
    cells_.for_crossed(line, part.begin, part.end, slack, kToOneSideSubpixels, [&](std::uint32_t entry) {
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

/// Puts numbers in order.
void LayerTile::sort(std::vector<double>& values) {
    constexpr std::size_t kFew = 64, kReadMore = 3;
    const std::size_t count = values.size();
    if (count < 2) return;
    if (count > kFew) return std::sort(values.begin(), values.end());
    values.resize(count + kReadMore);
    sorted_.resize(count);
    kernels_.sort_few(values.data(), count, sorted_.data());
    values.swap(sorted_);
}

/// Where layers begin and end between the ends of a line, in order. Returns how many opaque ones are in front where it begins.
int LayerTile::find_events(double begin, double end) {
    events_.clear();
    begins_.clear();
    ends_.clear();
    int opaque = 0;
    for (const Interval& i : intervals_) {
        const bool is_opaque = i.transmission == 0;
        if (!is_opaque) {
            if (i.begin > begin) events_.push_back({i.begin, 0});
            if (i.end < end) events_.push_back({i.end, 0});
            continue;
        }
        if (i.begin <= begin) {
            ++opaque;
        } else {
            begins_.push_back(i.begin);
        }
        if (i.end < end) ends_.push_back(i.end);
    }
    const bool has_transparent = !events_.empty();
    sort(begins_);
    sort(ends_);
    auto next_end = ends_.begin();
    for (const double at : begins_) {
        for (; next_end != ends_.end() && *next_end < at; ++next_end) events_.push_back({*next_end, -1});
        events_.push_back({at, 1});
    }
    for (; next_end != ends_.end(); ++next_end) events_.push_back({*next_end, -1});
    if (has_transparent) std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    return opaque;
}

/// Counts the layers in front from one end of the line to the other.
void LayerTile::sweep(const LayerLine& line, std::uint32_t number, double begin, double end,
                      std::vector<LayerPiece>& pieces) {
    int opaque = find_events(begin, end);
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
        if (is_behind_glass) piece.transmission = static_cast<std::uint8_t>(std::lround(255 * transmission));
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
    pair_cells_.clear(rect_);
    for (std::uint32_t i = 0; i < pair_entries_.size(); ++i) pair_cells_.add(cells_[i]);
    pair_cells_.sort(kTrianglesPerCellOfPairs);
    const std::span<const std::uint32_t> places = pair_cells_.places();
    cell_boxes_.resize(places.size());
    cell_vertices_.resize(places.size());
    found_.resize(places.size());
    for (std::size_t at = 0; at < places.size(); ++at) {
        ScreenBox box = LayerCells::box_of(cells_[places[at]]);
        box.low = pair_entries_[places[at]].lowest;
        cell_boxes_.set(at, box);
        cell_vertices_[at] = pair_entries_[places[at]].vertices;
    }
    for (int row = 0; row < pair_cells_.rows(); ++row) {
        for (int column = 0; column < pair_cells_.columns(); ++column) find_pairs_in_cell(column, row);
    }
    const auto surface_of = [this](std::uint32_t i) { return screen_.surface_of(cells_[i].number); };
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
    const float left = column == 0 ? -kFar : pair_cells_.pitch() * static_cast<float>(column);
    const float top = row == 0 ? -kFar : pair_cells_.pitch() * static_cast<float>(row);
    const auto from = [](float begin, float border) { return begin >= border ? -kFar : border; };
    const auto have_vertex_in_common = [&](std::size_t i, std::size_t j) {
        const auto& a = cell_vertices_[i];
        const auto& b = cell_vertices_[j];
        const auto is_in_b = [&b](std::uint32_t v) { return (v == b[0]) | (v == b[1]) | (v == b[2]); };
        return (is_in_b(a[0]) | is_in_b(a[1]) | is_in_b(a[2])) != 0;
    };
    const LayerCells::Cell c = pair_cells_.cell(column, row);
    for (std::size_t i = c.begin; i + 1 < c.end; ++i) {
        const ScreenBox box = cell_boxes_[i];
        std::optional<SidePlane> plane;
        for (const std::uint32_t j : touching(i + 1, c.end, box, from(box.x0, left), from(box.y0, top))) {
            if (have_vertex_in_common(i, j)) continue;
            if (!plane) plane = side_plane(cell_vertices_[i]);
            if (is_on_one_side(*plane, cell_vertices_[j])) continue;
            if (is_on_one_side(side_plane(cell_vertices_[j]), cell_vertices_[i])) continue;
            pairs_.push_back({pair_cells_.places()[i], pair_cells_.places()[j]});
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
