#include "methods/abuffer/flush_cover.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

/// Cells are so many pixels wide.
constexpr int kCellShift = 3 + 8;
/// Gaps narrower than folds that are no contours. 1/64 pixel.
constexpr double kNegligibleSubpixels = 4;
/// What two samples on one plane are off it at most, for a first look: a part of a pixel's width, and of what the plane
/// rises between them.
constexpr double kAboutLevelPx = 1.0 / 16, kAboutLevelRise = 1.0 / 16;

}  // namespace

bool FlushCover::covers(const NeighbourSamples& pair, const float (&nearness)[2], HalfEdge edge) {
    const SurfaceId first = pair.surfaces[0], second = pair.surfaces[1];
    if (first.instance != second.instance || first.is_background()) return false;
    if (edge != kNoHalfEdge) {  // where the two meet, they do so at the line
        const std::uint32_t one = edge / 3, other = screen_.mesh(first.instance).partners[edge] / 3;
        if ((one == first.triangle && other == second.triangle) || (one == second.triangle && other == first.triangle)) return false;
    }
    if (!may_be_level(pair, nearness)) return false;
    if (!are_flush(first, second, pair.place(0.5))) return false;
    if (!is_filled_) fill();
    covered_.clear();
    const glm::ivec2 cell = cell_of({pair.x, pair.y});
    const glm::ivec2 low(pair.x, pair.y), high = low + (pair.down ? glm::ivec2(0, pair.pitch) : glm::ivec2(pair.pitch, 0));
    for (const Face& face : cells_[static_cast<std::size_t>(cell.y * columns_ + cell.x)]) {
        if (glm::any(glm::greaterThan(face.low, high)) || glm::any(glm::lessThan(face.high, low))) continue;
        const Interval part = part_within(pair, face.surface);
        if (!(part.begin < part.end)) continue;
        const glm::dvec2 middle = pair.place(0.5 * (part.begin + part.end));
        if (are_flush(face.surface, first, middle) || are_flush(face.surface, second, middle)) covered_.push_back(part);
    }
    std::sort(covered_.begin(), covered_.end(), [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
    const double slack = kNegligibleSubpixels / pair.pitch;
    double reached = 0;
    for (const Interval& part : covered_) {
        if (part.begin > reached + slack) return false;
        reached = std::max(reached, part.end);
    }
    return reached + slack >= 1;
}

/// False for nearly all pairs that are not of one plane.
bool FlushCover::may_be_level(const NeighbourSamples& pair, const float (&nearness)[2]) const {
    const SurfaceId a = pair.surfaces[0];
    const std::uint8_t facing = screen_.mesh(a.instance).facing[a.triangle];
    if (facing == off_screen) return true;
    const Projection& p = screen_.surfaces().projection;
    const double from = static_cast<double>(nearness[0]), to = static_cast<double>(nearness[1]);
    const double pixel = p.orthographic ? 1 / p.focal_px : (from + screen_.surfaces().farthest_nearness) / p.focal_px;
    const glm::dvec2 there = pair.place(1);
    return std::abs(extended_nearness(screen_.triangle(a), there.x, there.y) - to) <= kAboutLevelPx * pixel + kAboutLevelRise * std::abs(to - from);
}

/// Whether two triangles lie in one plane without a line between them. Those that have nothing in common on the screen are
/// compared at one place.
bool FlushCover::are_flush(SurfaceId a, SurfaceId b, glm::dvec2 subpixel) const {
    if (a.instance != b.instance) return false;
    if (a == b) return true;
    const SurfaceSet& surfaces = screen_.surfaces();
    const glm::dvec2 at = subpixel / double{kSubpixelsPerPixel};
    if (surfaces.order_at(a, b, at).is_apart) return false;  // most are, and this takes less time
    return (contact_classes(surfaces, a, b, at, criteria_) & criteria_.classes).empty() && surfaces.order_near(a, b, at).are_coincident();
}

void FlushCover::fill() {
    is_filled_ = true;
    rect_ = bins_.tile(tile_);
    const glm::ivec2 last = cell_of(glm::ivec2(rect_.x1, rect_.y1) * kSubpixelsPerPixel);
    columns_ = last.x + 1;
    rows_ = last.y + 1;
    cells_.resize(std::max(cells_.size(), static_cast<std::size_t>(columns_ * rows_)));
    for (std::vector<Face>& cell : cells_) cell.clear();
    for (const auto runs : {bins_.runs_in(tile_), bins_.thin_runs_in(tile_)}) {
        for (const TriangleRun& run : runs) {
            for (std::uint32_t i = 0; i < run.count; ++i) add({run.instance, run.triangles[i].triangle});
        }
    }
    for (const auto numbers : {bins_.large_in(tile_), bins_.thin_large_in(tile_)}) {
        for (const std::uint32_t i : numbers) add(bins_.large(i).surface);
    }
}

/// To the cells from which a pair reaches it.
void FlushCover::add(SurfaceId s) {
    const Facing facing = screen_.facing(screen_.number_of(s));
    if (facing == edge_on) return;
    Face face{s, glm::ivec2(0), glm::ivec2(0)};
    if (facing == off_screen) {
        const ScreenPolygon polygon = screen_.surfaces().screen_polygon(s);
        if (polygon.count == 0) return;
        face.low = face.high = {polygon.corners[0].x, polygon.corners[0].y};
        for (int i = 1; i < polygon.count; ++i) {
            const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
            face.low = glm::min(face.low, glm::ivec2(p.x, p.y));
            face.high = glm::max(face.high, glm::ivec2(p.x, p.y));
        }
    } else {
        const auto [a, b, c] = screen_.triangle(s).corners;
        face.low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
        face.high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
    }
    const glm::ivec2 first = cell_of(face.low - kSubpixelsPerPixel), last = cell_of(face.high);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) cells_[static_cast<std::size_t>(y * columns_ + x)].push_back(face);
    }
}

glm::ivec2 FlushCover::cell_of(glm::ivec2 subpixel) const {
    const glm::ivec2 last = glm::ivec2(rect_.width(), rect_.height()) * kSubpixelsPerPixel;
    const glm::ivec2 within = glm::clamp(subpixel - glm::ivec2(rect_.x0, rect_.y0) * kSubpixelsPerPixel, glm::ivec2(0), last);
    return {within.x >> kCellShift, within.y >> kCellShift};
}

/// Of a convex polygon; a corner on the line counts to one side, as samples on an edge belong to one.
FlushCover::Interval FlushCover::part_within(const NeighbourSamples& pair, SurfaceId s) const {
    const bool is_cut = screen_.facing(screen_.number_of(s)) == off_screen;
    ScreenPolygon polygon;
    if (is_cut) {
        polygon = screen_.surfaces().screen_polygon(s);
    } else {
        const ScreenTriangle t = screen_.triangle(s);
        polygon.count = 3;
        for (std::size_t k = 0; k < 3; ++k) polygon.corners[k] = {t.corners[k].x, t.corners[k].y};
    }
    const std::int32_t across = pair.down ? pair.x : pair.y, origin = pair.down ? pair.y : pair.x;
    Interval part{1, 0};
    for (int i = 0; i < polygon.count; ++i) {
        const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
        const SubpixelPoint q = polygon.corners[static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1)];
        const std::int32_t u = pair.down ? p.y : p.x, v = pair.down ? p.x : p.y, next_u = pair.down ? q.y : q.x, next_v = pair.down ? q.x : q.y;
        if ((v > across) == (next_v > across)) continue;
        const double at = (u + static_cast<double>(across - v) * (next_u - u) / (next_v - v) - origin) / pair.pitch;
        part.begin = std::min(part.begin, at);
        part.end = std::max(part.end, at);
    }
    return {std::max(part.begin, 0.0), std::min(part.end, 1.0)};
}

}  // namespace burin
