#include "abuffer/hiding/hiding_tile.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace burin {
namespace {

/// Cells are made so small that about this many triangles begin in one.
constexpr double kTrianglesPerHidingCell = 4096;
/// What is left of a line between contacts is at least this long.
constexpr double kShortestRestPx = 1.0 / 32;

}  // namespace

HidingTile::HidingTile(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels,
                       const OccluderBins& bins, const PixelTiles& grid, bool finds_pairs)
    : frame_(frame),
      screen_(screen),
      contacts_(screen),
      kernels_(kernels),
      bins_(bins),
      grid_(grid),
      has_transparent_(has_transparent_surfaces(*frame.scene)),
      finds_pairs_(finds_pairs),
      cells_(kernels),
      pairs_(screen, kernels),
      sweep_(kernels) {}

void HidingTile::fill(std::size_t tile) {
    rect_ = grid_.tile(tile);
    cells_.clear(rect_);
    triangles_.clear();
    pairs_.clear();
    set_up_.clear();
    has_clipped_ = false;
    SurfaceId s;
    std::uint32_t first = 0, end = 0;  // numbers of its instance
    const std::span<const std::uint32_t> list = bins_.triangles(tile);
    for (std::size_t i = 0, next; i < list.size(); i = next) {
        const std::uint32_t number = list[i] & ~OccluderBins::kClipped;
        if (number >= end) {
            s = screen_.surface_of(number);
            first = number - s.triangle;
            end = first + static_cast<std::uint32_t>(frame_.surfaces.mesh_of(s).triangles.size());
        }
        s.triangle = number - first;
        next = i + 1;
        if (list[i] != number) {
            add_clipped(s, number);
            continue;
        }
        while (next < list.size() && list[next] < end) ++next;  // not clipped
        add(s.instance, list.subspan(i, next - i));
    }
    cells_.sort(kTrianglesPerHidingCell);
    cells_.make_indices();
    fragment_count_ += cells_.places().size();
}

void HidingTile::add(std::uint32_t instance, std::span<const std::uint32_t> numbers) {
    const ScreenMesh& mesh = screen_.mesh(instance);
    const glm::ivec2 corner = cells_.corner();
    kernels_.hide.put_crossed(mesh, numbers.data(), numbers.size(), corner.x, corner.y, cells_.add(numbers.size()));
    set_up_.resize(set_up_.size() + numbers.size(), kNotSetUp);
    if (!finds_pairs_) return;
    const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices - screen_.vertices(0));
    for (const std::uint32_t number : numbers) {
        const std::uint32_t* const v = mesh.corners + 3 * std::size_t{number - mesh.first_number};
        const auto nearness = [&](std::size_t k) { return mesh.vertices[v[k]].nearness; };
        pairs_.add(std::min({nearness(0), nearness(1), nearness(2)}),
                   {first_vertex + v[0], first_vertex + v[1], first_vertex + v[2]});
    }
}

double HidingTile::transmission_of(SurfaceId s) const {
    return has_transparent_ ? 1 - static_cast<double>(frame_.material_of(s).opacity) : 0;
}

void HidingTile::add_clipped(SurfaceId s, std::uint32_t number) {
    has_clipped_ = true;
    const DepthPlane plane = frame_.surfaces.plane(s);
    const double zero = frame_.surfaces.farthest_nearness;
    const auto first_vertex = static_cast<std::uint32_t>(screen_.vertices(s.instance) - screen_.vertices(0));
    for (Occluder& triangle : clipped_occluders(screen_, s, number)) {
        triangle.transmission = transmission_of(s);
        triangles_.push_back(triangle);
        set_up_.push_back(static_cast<std::uint32_t>(triangles_.size() - 1));
        CrossedTriangle& entry = *cells_.add(1);
        OccluderPairs::Corners vertices;
        for (std::size_t k = 0; k < 3; ++k) {
            entry.x[k] = static_cast<float>(triangle.x[k] - cells_.corner().x);
            entry.y[k] = static_cast<float>(triangle.y[k] - cells_.corner().y);
            vertices[k] = first_vertex + triangle.vertices[k];
        }
        entry.highest = static_cast<float>(plane.highest - zero);
        entry.number = number;
        if (finds_pairs_) pairs_.add(static_cast<float>(plane.lowest - zero), vertices);
    }
}

void HidingTile::set_up(std::uint32_t i) {
    const std::uint32_t number = cells_[i].number;
    const SurfaceId s = screen_.surface_of(number);
    set_up_[i] = static_cast<std::uint32_t>(triangles_.size());
    set_up_occluder(screen_, s, number,
                    triangles_.emplace_back());  // where it stays: copies would wait for its parts
    triangles_.back().transmission = transmission_of(s);
}

/// Notes where in a part of a line triangles are in front of it.
void HidingTile::hide(const WholeLine& line, std::span<const std::uint32_t> near, const PartInTile& part) {
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
    const std::size_t count = kernels_.hide.clip(planes_.data(), near.size(), plane_line, parts_.data());
    for (std::size_t k = 0; k < count; ++k)
        hide(line, near[parts_[k].triangle], static_cast<const Occluder&>(*planes_[parts_[k].triangle]), parts_[k]);
}

/// Notes a part in which a triangle, entry `i`, is in front.
void HidingTile::hide(const WholeLine& line, std::uint32_t i, const Occluder& t, const HiddenPart& hidden) {
    if (line.has_more_owners && lies_on(line, t)) return;
    // What is level with the line is in front where it is seen instead: what that is, is asked last.
    if (hidden.is_level && line.drawn_as != LineClass::intersection) {
        const double begin = hidden.level_begin, end = hidden.level_end;
        const bool is_settled = hidden.is_any && hidden.begin == begin && hidden.end == end;
        if (!is_settled && contacts_.is_flush(line, begin, end, t, line_slack_ + t.slack, frame_.criteria, true)) {
            contacts_of_line_.push_back({begin, end, i, false});
            return;
        }
        if (!is_settled && !line.is_by_itself() && contacts_.is_in_front(line, begin, end, t, line_slack_ + t.slack)) {
            sweep_.add(t.number, begin, end, t.transmission);
            return;
        }
    }
    if (hidden.is_any && !only_grazes(screen_, line, t)) sweep_.add(t.number, hidden.begin, hidden.end, t.transmission);
}

void HidingTile::find_parts(const WholeLine& line, std::uint32_t line_number, std::vector<LinePart>& pieces) {
    const glm::dvec2 corner = to_subpixels(glm::dvec2(rect_.x0, rect_.y0));
    double begin = 0, end = 1;
    if (!clip_to_rect(line, corner, to_subpixels(glm::dvec2(rect_.x1, rect_.y1)), begin, end)) return;
    contacts_of_line_.clear();
    const double nearest = std::max(line.nearness_at(begin), line.nearness_at(end)), snapping = snapping_slack(line);
    line_slack_ = level_slack(frame_.surfaces, nearest) + snapping;
    certain_slack_ = level_slack(frame_.surfaces, nearest, kCertainPx) + snapping;
    const glm::dvec2 a = line.at(begin), b = line.at(end);
    const PartInTile part{begin, end, a, b, line.nearness_at(begin), line.nearness_at(end)};
    near_.clear();
    cells_.for_crossed(line, part.begin, part.end, line_slack_, 0, [&](std::uint32_t entry) {
        const std::uint32_t number = cells_[entry].number;
        if (number != line.owners[0] && number != line.owners[1]) near_.push_back(entry);
    });
    sweep_.clear(begin, end, near_.size(), has_clipped_ || has_transparent_);
    hide(line, near_, part);
    if (sweep_.is_empty()) return;
    if (line.classes.has(LineClass::border) && !line.is_wire) find_contacts(line, part);
    const std::size_t first_piece = pieces.size();
    sweep_.find_parts(line, line_number, pieces);
    drop_contacts(line, first_piece, pieces);
}

/// Finds where a border ends in contact with a surface that goes on beyond it without any line.
void HidingTile::find_contacts(const WholeLine& line, const PartInTile& part) {
    if (line.classes.has(LineClass::mark)) return;
    const double slack = line_slack(frame_.surfaces, line, part.begin, part.end, kDepthTolerancePx);
    cells_.for_crossed(line, part.begin, part.end, slack, kToOneSideSubpixels, [&](std::uint32_t entry) {
        const Occluder& t = triangle(entry);
        if (lies_on(line, t)) return;
        Contact contact{part.begin, part.end, entry, false};
        const auto classes = contacts_.classes_of_contact(line, t, frame_.criteria, contact.begin, contact.end);
        if (!classes) return;
        contact.makes_line = !classes->empty();
        contacts_of_line_.push_back(contact);
    });
    // If there are several, the nearest counts.
    const auto is_behind_another = [&](const Contact& c) {
        const double middle = 0.5 * (c.begin + c.end);
        const glm::dvec2 at = line.at(middle);
        const double nearness = triangle(c.entry).nearness_at(at);
        return std::any_of(contacts_of_line_.begin(), contacts_of_line_.end(), [&](const Contact& other) {
            return other.makes_line && other.begin < middle && middle < other.end &&
                   triangle(other.entry).nearness_at(at) > nearness;
        });
    };
    for (Contact& c : contacts_of_line_) {
        if (!c.makes_line && is_behind_another(c)) c.end = c.begin;
    }
    std::erase_if(contacts_of_line_, [](const Contact& c) { return c.makes_line || c.begin >= c.end; });
}

/// Cuts contacts out of the parts of a line, from `first` on. What is left is no dot: contacts with neighbours meet but
/// for rounding.
void HidingTile::drop_contacts(const WholeLine& line, std::size_t first, std::vector<LinePart>& pieces) {
    if (contacts_of_line_.empty()) return;
    const double shortest = kShortestRestPx / line.length_px();
    std::sort(contacts_of_line_.begin(), contacts_of_line_.end(),
              [](const Contact& a, const Contact& b) { return a.begin < b.begin; });
    const std::vector<LinePart> whole(pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.end());
    pieces.resize(first);
    for (LinePart piece : whole) {
        const double begin = piece.begin, end = piece.end;
        const auto keep_up_to = [&](double last) {
            piece.end = last;
            const bool is_whole = piece.begin == begin && last == end;
            if (is_whole || last - piece.begin >= shortest) pieces.push_back(piece);
        };
        for (const Contact& contact : contacts_of_line_) {
            if (contact.begin > piece.begin && piece.begin < end) keep_up_to(std::min(end, contact.begin));
            piece.begin = std::max(piece.begin, contact.end);
        }
        if (piece.begin < end) keep_up_to(end);
    }
}

void HidingTile::find_intersections(const IntersectionTest& may_intersect, const IntersectionLines& intersections,
                                    std::vector<WholeLine>& lines) {
    const auto surface_of = [this](std::uint32_t i) { return screen_.surface_of(cells_[i].number); };
    for (const auto& [own, other] : pairs_.find(cells_, rect_)) {
        if (!may_intersect.may_intersect(surface_of(own), surface_of(other))) continue;
        triangle(own);  // both before either is looked at: setting up moves them
        triangle(other);
        intersections.add(triangle(own), triangle(other), lines);
    }
}

}  // namespace burin
