#include "shading/surface/shadow_casters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

constexpr std::size_t kFewCasters = 32;  ///< a cell with so few needs no grid
constexpr int kMostDepth = 6;
/// For each caster: entries in the cells of one grid, and in those of all grids of a view.
constexpr std::size_t kMostEntries = 6, kMostEntriesOfAll = 24;
constexpr std::uint32_t kMostSide = 1024;

/// The range of x that a convex outline has in a row; nothing where it is not there.
struct RowRange {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

RowRange range_in_row(std::span<const glm::dvec2> outline, double top, double bottom) {
    RowRange range;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 &a = outline[i], &b = outline[i + 1 < outline.size() ? i + 1 : 0];
        if (a.y >= top && a.y <= bottom) range.add(a.x);
        for (const double y : {top, bottom}) {
            if ((a.y < y) != (b.y < y)) range.add(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
        }
    }
    return range;
}

struct Polygon {
    glm::dvec3 corners[8];
    int count = 0;
    void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

/// What of a polygon lies where `inside`, a linear function, is not negative.
template <typename Inside>
Polygon clipped(const Polygon& polygon, const Inside& inside) {
    Polygon kept;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec3 &a = polygon.corners[i], &b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
        const double at_a = inside(a), at_b = inside(b);
        if (at_a >= 0 && kept.count < 8) kept.add(a);
        if ((at_a < 0) != (at_b < 0) && kept.count < 8) kept.add(a + (b - a) * (at_a / (at_a - at_b)));
    }
    return kept;
}

}  // namespace

ShadowCasters::ShadowCasters(const SurfaceSet& surfaces, const ViewLight& light, const std::vector<bool>& is_caster)
    : light_(light) {
    least_distance_ = 8 * surfaces.coordinate_error;
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        throw_if_interrupted();
        const Mesh& mesh = *surfaces.instances[i].mesh;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const SurfaceId id{i, t};
            if (!is_caster[surfaces.material_id(id) - 1]) continue;
            glm::dvec3 corners[3];
            surfaces.view_corners(id, corners);
            Caster caster{id, corners[0], {corners[1] - corners[0], corners[2] - corners[0]}, 0};
            if (light.is_at_point) {
                const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
                double radius = 0;
                for (const glm::dvec3& c : corners) radius = std::max(radius, glm::distance(c, middle));
                caster.nearness = nearness_of(middle) + radius * (1 + 1e-9);
            } else {
                caster.nearness = std::max({nearness_of(corners[0]), nearness_of(corners[1]), nearness_of(corners[2])});
            }
            casters_.push_back(caster);
        }
    }
    sort();
}

ShadowCasters::ShadowCasters(std::vector<Caster> casters, const ViewLight& light, double least_distance)
    : light_(light), least_distance_(least_distance), casters_(std::move(casters)) {
    sort();
}

/// Makes the views from the light, and sorts the casters to the cells of their grids.
void ShadowCasters::sort() {
    if (light_.is_at_point) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {1.0, -1.0}) {
                View view;
                view.forward = view.right = view.up = glm::dvec3(0.0);
                view.forward[axis] = sign;
                view.right[(axis + 1) % 3] = view.up[(axis + 2) % 3] = 1;
                views_.push_back(view);
            }
        }
    } else {
        const glm::dvec3 l = light_.place;
        const glm::dvec3 right =
            glm::normalize(glm::cross(l, std::abs(l.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
        views_.push_back({right, glm::cross(l, right), l, -1});
    }
    for (std::size_t v = 0; v < views_.size(); ++v) {
        std::vector<std::uint32_t> seen;
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
        for (std::uint32_t i = 0; i < casters_.size(); ++i) {
            const Outline outline = outline_in(views_[v], casters_[i]);
            if (outline.count == 0) continue;
            seen.push_back(i);
            for (const glm::dvec2& p : std::span(outline.corners, static_cast<std::size_t>(outline.count))) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        if (seen.empty()) continue;
        std::stable_sort(seen.begin(), seen.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return casters_[a].nearness > casters_[b].nearness; });
        const double size = std::max({high.x - low.x, high.y - low.y, 1e-30});
        left_entries_ = kMostEntriesOfAll * seen.size();
        views_[v].grid = static_cast<std::int64_t>(grids_.size());
        grids_.emplace_back();
        add_grid(static_cast<std::uint32_t>(views_[v].grid), views_[v], low, size * (1 + 1e-9), seen, 0);
    }
}

double ShadowCasters::nearness_of(const glm::dvec3& place) const {
    return light_.is_at_point ? -glm::distance(place, light_.place) : glm::dot(place, light_.place);
}

glm::dvec2 ShadowCasters::in_view(const View& view, const glm::dvec3& place) const {
    if (!light_.is_at_point) return {glm::dot(view.right, place), glm::dot(view.up, place)};
    const glm::dvec3 way = place - light_.place;
    return glm::dvec2(glm::dot(view.right, way), glm::dot(view.up, way)) /
           std::max(glm::dot(view.forward, way), 1e-300);
}

std::size_t ShadowCasters::view_of(const glm::dvec3& place) const {
    if (!light_.is_at_point) return 0;
    const glm::dvec3 way = place - light_.place, size = glm::abs(way);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * static_cast<std::size_t>(axis) + (way[axis] < 0 ? 1 : 0);
}

ShadowCasters::Outline ShadowCasters::outline_in(const View& view, const Caster& caster) const {
    const glm::dvec3 corners[3] = {caster.corner, caster.corner + caster.edges[0], caster.corner + caster.edges[1]};
    Outline outline;
    if (!light_.is_at_point) {
        for (const glm::dvec3& corner : corners) outline.corners[outline.count++] = in_view(view, corner);
        return outline;
    }
    Polygon polygon;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 way = corner - light_.place;
        polygon.add({glm::dot(view.right, way), glm::dot(view.up, way), glm::dot(view.forward, way)});
    }
    polygon = clipped(polygon, [](const glm::dvec3& p) { return p.z + p.x; });
    polygon = clipped(polygon, [](const glm::dvec3& p) { return p.z - p.x; });
    polygon = clipped(polygon, [](const glm::dvec3& p) { return p.z + p.y; });
    polygon = clipped(polygon, [](const glm::dvec3& p) { return p.z - p.y; });
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec3& p = polygon.corners[i];
        outline.corners[outline.count++] = glm::clamp(glm::dvec2(p) / std::max(p.z, 1e-300), -1.0, 1.0);
    }
    return outline;
}

/// Sorts casters to the cells of a grid, and gives a grid of their own to cells of many.
void ShadowCasters::add_grid(std::uint32_t number, const View& view, glm::dvec2 corner, double size,
                             std::span<const std::uint32_t> casters, int depth) {
    throw_if_interrupted();
    const double wanted = std::ceil(std::sqrt(static_cast<double>(casters.size()) / 2));
    auto side = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, static_cast<double>(kMostSide)));
    Grid grid;
    // What touches a cell's border is in the cells at both sides.
    const double slack = 1e-9;
    const auto for_cells = [&](std::uint32_t caster, const auto& visit) {
        Outline outline = outline_in(view, casters_[caster]);
        const std::span corners(outline.corners, static_cast<std::size_t>(outline.count));
        double top = std::numeric_limits<double>::infinity(), bottom = -top, left = top, right = -top;
        for (glm::dvec2& p : corners) {
            p = (p - corner) * grid.cells_per_unit;
            top = std::min(top, p.y);
            bottom = std::max(bottom, p.y);
            left = std::min(left, p.x);
            right = std::max(right, p.x);
        }
        const auto cell_of = [&](double at) {
            return static_cast<std::uint32_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(side - 1)));
        };
        if (bottom < -slack || top > side + slack || right < -slack || left > side + slack) return;
        const std::uint32_t first = cell_of(top - slack), last = cell_of(bottom + slack);
        for (std::uint32_t y = first; y <= last; ++y) {
            // Of a small triangle all cells around it count.
            const RowRange range =
                last - first < 2 ? RowRange{left, right} : range_in_row(corners, y - slack, y + 1 + slack);
            if (!(range.low <= side + slack && range.high >= -slack)) continue;
            for (std::uint32_t x = cell_of(range.low - slack); x <= cell_of(range.high + slack); ++x)
                visit(y * side + x);
        }
    };
    struct Entry {
        std::uint32_t cell, caster;
    };
    std::vector<Entry> entries;
    for (;; side /= 2) {
        grid = {corner, side / size, side, static_cast<std::uint32_t>(cells_.size())};
        entries.clear();
        const std::size_t most = kMostEntries * casters.size();
        for (const std::uint32_t caster : casters) {
            for_cells(caster, [&](std::uint32_t cell) { entries.push_back({cell, caster}); });
            if (side > 1 && entries.size() > most) break;
        }
        if (side == 1 || entries.size() <= most) break;  // else most lie in many cells: larger ones are as good
    }
    cells_.resize(cells_.size() + std::size_t{side} * side);
    std::vector<std::uint32_t> starts(std::size_t{side} * side + 1, 0), sorted(entries.size());
    for (const Entry& entry : entries) ++starts[entry.cell + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (const Entry& entry : entries) sorted[next[entry.cell]++] = entry.caster;
    left_entries_ -= std::min(left_entries_, entries.size());
    entries = {};
    grids_[number] = grid;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const std::span own = std::span(sorted).subspan(starts[i], starts[i + 1] - starts[i]);
        const bool has_room = kMostEntries * own.size() <= left_entries_;
        if (own.size() > kFewCasters && side > 1 && has_room && depth < kMostDepth) {
            const auto inner = static_cast<std::uint32_t>(grids_.size());
            grids_.emplace_back();
            cells_[grid.first_cell + i] = {inner, Cell::kIsGrid};
            const double cell_size = size / side;
            add_grid(inner, view, corner + glm::dvec2(i % side, i / side) * cell_size, cell_size, own, depth + 1);
            continue;
        }
        cells_[grid.first_cell + i] = {static_cast<std::uint32_t>(order_.size()),
                                       static_cast<std::uint32_t>(own.size())};
        order_.insert(order_.end(), own.begin(), own.end());
    }
}

/// Intersects a ray with a triangle (Möller and Trumbore 1997).
bool ShadowCasters::hides(const Caster& caster, const glm::dvec3& place, const glm::dvec3& way) const {
    const glm::dvec3 p = glm::cross(way, caster.edges[1]);
    const double determinant = glm::dot(caster.edges[0], p);
    if (determinant == 0) return false;
    const double side = determinant < 0 ? -1 : 1, size = determinant * side;
    const glm::dvec3 from_corner = place - caster.corner;
    const double u = glm::dot(from_corner, p) * side;
    if (!(u >= 0 && u <= size)) return false;
    const glm::dvec3 q = glm::cross(from_corner, caster.edges[0]);
    const double v = glm::dot(way, q) * side;
    if (!(v >= 0 && u + v <= size)) return false;
    // `way` has the length 1.
    return glm::dot(caster.edges[1], q) * side > least_distance_ * size;
}

bool ShadowCasters::is_lit(const glm::dvec3& place, SurfaceId own) const {
    const View& view = views_[view_of(place)];
    if (view.grid < 0) return true;
    const glm::dvec3 way = light_.towards(place);
    const glm::dvec2 at = in_view(view, place);
    const double nearness = nearness_of(place) + least_distance_;
    for (const Grid* grid = &grids_[static_cast<std::size_t>(view.grid)];;) {
        const glm::dvec2 cell_at = glm::floor((at - grid->corner) * grid->cells_per_unit);
        const double last = grid->side - 1;
        // Places are triangles' own and lie on the grid, but for rounding or for surfaces that cast no shadow.
        if (!(cell_at.x >= -1 && cell_at.y >= -1 && cell_at.x <= last + 1 && cell_at.y <= last + 1)) return true;
        const auto x = static_cast<std::uint32_t>(std::clamp(cell_at.x, 0.0, last));
        const auto y = static_cast<std::uint32_t>(std::clamp(cell_at.y, 0.0, last));
        const Cell& cell = cells_[grid->first_cell + y * grid->side + x];
        if (cell.count == Cell::kIsGrid) {
            grid = &grids_[cell.first];
            continue;
        }
        for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
            const Caster& caster = casters_[order_[i]];
            if (caster.nearness <= nearness) return true;
            if (caster.id != own && hides(caster, place, way)) {
                if (!light_.is_at_point) return false;
                // What lies behind the light hides nothing.
                const glm::dvec3 normal = glm::cross(caster.edges[0], caster.edges[1]);
                const double to_plane = glm::dot(caster.corner - place, normal),
                             to_light = glm::dot(light_.place - place, normal);
                if (std::abs(to_plane) < std::abs(to_light)) return false;
            }
        }
        return true;
    }
}

}  // namespace burin
