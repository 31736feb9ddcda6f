#include "scene/standard_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>

#include "scene/scene.h"

namespace burin {
namespace {

/// Between views, on paper.
constexpr double kGapMm = 10;
/// The part of the space that views fill where their scale is not given.
constexpr double kFit = 0.95;

/// Columns of a matrix: to the right, up, and to the eye.
glm::dmat3 axes_of(StandardView view, const glm::dmat3& front) {
    const glm::dvec3 r = front[0], u = front[1], f = front[2];
    switch (view) {
        case StandardView::back:
            return {-r, u, -f};
        case StandardView::top:
            return {r, -f, u};
        case StandardView::bottom:
            return {r, f, -u};
        case StandardView::left:
            return {f, u, -r};
        case StandardView::right:
            return {-f, u, r};
        case StandardView::iso: {
            const glm::dvec3 back = glm::normalize(r + u + f), right = glm::normalize(glm::cross(u, back));
            return {right, glm::cross(back, right), back};
        }
        default:
            return front;
    }
}

/// Column, to the right, and row, downwards, around the view from the front.
glm::ivec2 cell_of(StandardView view, ViewProjection projection) {
    const int side = projection == ViewProjection::third ? 1 : -1;
    switch (view) {
        case StandardView::top:
            return {0, -side};
        case StandardView::bottom:
            return {0, side};
        case StandardView::right:
            return {side, 0};
        case StandardView::left:
            return {-side, 0};
        case StandardView::back:
            return {2, 0};
        default:
            return {0, 0};
    }
}

/// A free corner, best one between views that are there.
glm::ivec2 cell_of_iso(const std::vector<glm::ivec2>& others) {
    if (others.empty()) return {0, 0};
    const auto used = [&](int axis, int at) {
        return std::any_of(others.begin(), others.end(), [&](glm::ivec2 cell) { return cell[axis] == at; });
    };
    constexpr glm::ivec2 kCorners[] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    glm::ivec2 best = kCorners[0];
    int most = -1;
    for (const glm::ivec2 corner : kCorners) {
        const int shared = (used(0, corner.x) ? 1 : 0) + (used(1, corner.y) ? 1 : 0);
        if (shared > most) best = corner;
        most = std::max(most, shared);
    }
    return best;
}

/// The axes of the view from the front.
glm::dmat3 front_axes(const glm::dvec3& direction_up) {
    const glm::dvec3 up = glm::normalize(direction_up), size = glm::abs(up);
    glm::dvec3 front = size.z > std::max(size.x, size.y) ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1);
    front = glm::normalize(front - up * glm::dot(front, up));
    return {glm::cross(up, front), up, front};
}

/// How far a scene reaches along the axes of a view.
struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

std::string mm_text(glm::dvec2 mm) {
    char text[400];
    std::string sides[2];
    for (int k = 0; k < 2; ++k) {
        std::snprintf(text, sizeof text, mm[k] < 1e6 ? "%.1f" : "%.0f", mm[k]);
        sides[k] = text;
        if (sides[k].ends_with(".0")) sides[k].resize(sides[k].size() - 2);
    }
    return sides[0] + " x " + sides[1] + " mm";
}

/// Columns or rows of the sheet.
struct Bands {
    std::map<int, double> sizes;    ///< by number: its extent in world units
    std::map<int, double> middles;  ///< in mm from the begin of the space within the margins
    std::map<int, double> lengths;  ///< in mm, to the middle of the space between them

    double whole() const {
        double sum = 0;
        for (const auto& [number, size] : sizes) sum += size;
        return sum;
    }
    double gaps_mm(double gap_mm) const { return gap_mm * static_cast<double>(sizes.size() - 1); }

    void place(double space_mm, double gap_mm, double mm_per_unit) {
        const auto count = static_cast<double>(sizes.size());
        const double rest = std::max(0.0, space_mm - whole() * mm_per_unit - gaps_mm(gap_mm)) / (count + 1);
        double at = rest;
        for (const auto& [number, size] : sizes) {
            const double length = size * mm_per_unit;
            middles[number] = at + 0.5 * length;
            lengths[number] = length + gap_mm + rest;
            at += length + gap_mm + rest;
        }
    }
};

}  // namespace

std::optional<StandardView> standard_view_named(std::string_view name) {
    const auto* const found = std::find(std::begin(kStandardViewNames), std::end(kStandardViewNames), name);
    if (found == std::end(kStandardViewNames)) return std::nullopt;
    return static_cast<StandardView>(found - std::begin(kStandardViewNames));
}

std::vector<ViewOnSheet> views_on_sheet(const std::vector<StandardView>& views, ViewProjection projection,
                                        const PictureSettings& picture, const glm::dvec3& up, const PointSource& points,
                                        double* fitting_scale) {
    const glm::dmat3 front = front_axes(up);
    std::vector<glm::dmat3> axes;
    std::vector<glm::ivec2> cells, others;
    for (const StandardView view : views) {
        axes.push_back(axes_of(view, front));
        if (view != StandardView::iso) others.push_back(cell_of(view, projection));
    }
    for (const StandardView view : views)
        cells.push_back(view == StandardView::iso ? cell_of_iso(others) : cell_of(view, projection));

    std::vector<Extent> extents(views.size());
    for_each_point(points, [&](const glm::dvec3& p) {
        for (std::size_t i = 0; i < views.size(); ++i) {
            const glm::dvec3 q = glm::transpose(axes[i]) * p;
            extents[i].low = glm::min(extents[i].low, q);
            extents[i].high = glm::max(extents[i].high, q);
        }
    });
    Bands columns, rows;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::dvec3 size = extents[i].high - extents[i].low;
        columns.sizes[cells[i].x] = std::max(columns.sizes[cells[i].x], size.x);
        rows.sizes[cells[i].y] = std::max(rows.sizes[cells[i].y], size.y);
    }
    const glm::dvec2 size(columns.whole(), rows.whole());
    if (!(std::max(size.x, size.y) > 0 && std::max(size.x, size.y) <= 1e30))
        throw InputError("the scene has no extent that views could be fitted to");
    const glm::dvec2 space = size_within_margins_mm(picture);
    const double gap = std::min(kGapMm, 0.05 * std::min(space.x, space.y));
    const glm::dvec2 room = space - glm::dvec2(columns.gaps_mm(gap), rows.gaps_mm(gap));
    const double fitting = std::min(room.x / size.x, room.y / size.y);
    const double unit_mm = picture.paper.unit_mm.value_or(1);
    if (fitting_scale != nullptr) *fitting_scale = fitting / unit_mm;
    double mm_per_unit = kFit * fitting;
    if (picture.paper.scale) {
        mm_per_unit = *picture.paper.scale * unit_mm;
        if (mm_per_unit > fitting) {
            throw UsageError("--scale: at " + text_of_scale(*picture.paper.scale) + " the views need " +
                             mm_text(size * mm_per_unit + (space - room)) + ", and within the margins the paper has " +
                             mm_text(space) + "; take at most " + text_of_scale(round_scale_down(fitting / unit_mm)));
        }
    }
    columns.place(space.x, gap, mm_per_unit);
    rows.place(space.y, gap, mm_per_unit);
    const glm::dvec2 corner(picture.paper.margin_mm[3], picture.paper.margin_mm[0]);
    std::vector<ViewOnSheet> placed;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::dvec2 middle = corner + glm::dvec2(columns.middles[cells[i].x], rows.middles[cells[i].y]);
        const glm::dvec2 half = 0.5 * glm::dvec2(columns.lengths[cells[i].x], rows.lengths[cells[i].y]);
        const Extent& extent = extents[i];
        const glm::dvec3 center = 0.5 * (extent.low + extent.high);
        const double depth = extent.high.z + glm::length(extent.high - extent.low);
        Camera camera;
        camera.orthographic = true;
        camera.to_world = glm::dmat4(axes[i]);
        camera.to_world[3] = glm::dvec4(axes[i] * glm::dvec3(center.x, center.y, depth), 1);
        camera.area = area_of_mm(picture, middle - half, middle + half);
        camera.height = 2 * half.y / mm_per_unit;
        placed.push_back({views[i], camera});
    }
    return placed;
}

}  // namespace burin
