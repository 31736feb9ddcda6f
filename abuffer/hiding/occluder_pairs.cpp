#include "abuffer/hiding/occluder_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "abuffer/edges/occluder.h"

namespace burin {
namespace {

/// Cells are made so small that about this many triangles begin in one: pairs are looked for one by one.
constexpr double kTrianglesPerPairCell = 80;
constexpr float kFarOfPairs = 1e30f;

}  // namespace

/// The places of the triangles that touch a box.
std::span<const std::uint32_t> OccluderPairs::touching(std::size_t begin, std::size_t end, const ScreenBox& box,
                                                       float least_x0, float least_y0) {
    return {found_.data(),
            kernels_.intersect.find_touching(boxes_.view(), begin, end, box, least_x0, least_y0, found_.data())};
}

std::span<const OccluderPairs::Pair> OccluderPairs::find(const OccluderCells& triangles, PixelRect rect) {
    pairs_.clear();
    cells_.clear(rect);
    CrossedTriangle* const to = cells_.add(entries_.size());
    for (std::size_t i = 0; i < entries_.size(); ++i) to[i] = triangles[i];
    cells_.sort(kTrianglesPerPairCell);
    const std::span<const std::uint32_t> places = cells_.places();
    boxes_.resize(places.size());
    vertices_.resize(places.size());
    found_.resize(places.size());
    for (std::size_t at = 0; at < places.size(); ++at) {
        ScreenBox box = OccluderCells::box_of(triangles[places[at]]);
        box.low = entries_[places[at]].lowest;
        boxes_.set(at, box);
        vertices_[at] = entries_[places[at]].vertices;
    }
    for (int row = 0; row < cells_.rows(); ++row) {
        for (int column = 0; column < cells_.columns(); ++column) find_in_cell(column, row);
    }
    return pairs_;
}

void OccluderPairs::find_in_cell(int column, int row) {
    // A pair counts in one of the cells that both triangles touch: the one with the corner where their boxes begin to
    // overlap.
    const float left = column == 0 ? -kFarOfPairs : cells_.pitch() * static_cast<float>(column);
    const float top = row == 0 ? -kFarOfPairs : cells_.pitch() * static_cast<float>(row);
    const auto from = [](float begin, float border) { return begin >= border ? -kFarOfPairs : border; };
    const auto have_vertex_in_common = [&](std::size_t i, std::size_t j) {
        const auto& a = vertices_[i];
        const auto& b = vertices_[j];
        const auto is_in_b = [&b](std::uint32_t v) { return (v == b[0]) | (v == b[1]) | (v == b[2]); };
        return (is_in_b(a[0]) | is_in_b(a[1]) | is_in_b(a[2])) != 0;
    };
    const OccluderCells::Cell c = cells_.cell(column, row);
    for (std::size_t i = c.begin; i + 1 < c.end; ++i) {
        const ScreenBox box = boxes_[i];
        std::optional<SidePlane> plane;
        for (const std::uint32_t j : touching(i + 1, c.end, box, from(box.x0, left), from(box.y0, top))) {
            if (have_vertex_in_common(i, j)) continue;
            if (!plane) plane = side_plane(vertices_[i]);
            const SidePlane other = side_plane(vertices_[j]);
            if (is_on_one_side(*plane, other, vertices_[j]) || is_on_one_side(other, *plane, vertices_[i])) continue;
            pairs_.push_back({cells_.places()[i], cells_.places()[j]});
        }
    }
}

OccluderPairs::SidePlane OccluderPairs::side_plane(const Corners& corners) const {
    const ScreenVertex* const v = screen_.vertices(0);
    const ScreenVertex &a = v[corners[0]], &b = v[corners[1]], &c = v[corners[2]];
    SidePlane plane;
    plane.is_on_screen =
        (a.x != ScreenVertex::kOffScreen) & (b.x != ScreenVertex::kOffScreen) & (c.x != ScreenVertex::kOffScreen);
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

/// Whether a plane does not reach through a triangle, by more than snapping does, nor may have an edge of it, as
/// IntersectionLines tells. `own`: the triangle's plane. Neither need be set up for that.
bool OccluderPairs::is_on_one_side(const SidePlane& plane, const SidePlane& own, const Corners& corners) const {
    if (!plane.is_on_screen || !own.is_on_screen) return false;
    const double area = std::abs(plane.per_nearness);
    const double slack = plane.slack + area * (own.slack / std::abs(own.per_nearness));
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
        in_plane += std::abs(gap) <= slack + area * level_slack(screen_.surfaces(), static_cast<double>(p.nearness));
    }
    return (low >= -plane.slack || high <= plane.slack) && in_plane != 2;
}

}  // namespace burin
