#include "output/paths/merge_strokes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/interrupt.h"

namespace burin {
namespace {

constexpr double kMergedGapPx = 0.5, kClosedPx = 1.0 / 16;
constexpr float kSameInk = 1.0f / 32;

bool are_alike(const InkPoint& a, const InkPoint& b) {
    static_assert(sizeof(InkPoint) == 48, "the ink of it is compared here");
    if (std::abs(a.opacity - b.opacity) > kSameInk) return false;
    for (int k = 0; k < 3; ++k) {
        if (std::abs(a.color[k] - b.color[k]) > kSameInk) return false;
    }
    return true;
}

bool goes_on(const InkedLines& lines, std::size_t i) {
    const InkStroke &a = lines.strokes[i], &b = lines.strokes[i + 1];
    const auto look = [](const InkStroke& stroke) {
        // All fields have a name here, so that a new one is thought of. Halos are cut already.
        const auto& [first, count, order, chain, caps, blend, side, is_closed, is_constant, is_behind, halo, depth] =
            stroke;
        return std::tuple(order, chain, caps, blend, side, is_behind);
    };
    if (a.is_closed || b.is_closed || look(a) != look(b)) return false;
    const StrokeOrigin &x = lines.origins[i], &y = lines.origins[i + 1];
    if (x.object != y.object || x.invisibility != y.invisibility || !x.dash_px.empty() || !y.dash_px.empty())
        return false;
    const InkPoint &end = lines.points_of(a).back(), &begin = lines.points_of(b).front();
    return glm::distance(end.place, begin.place) <= kMergedGapPx && are_alike(end, begin);
}

/// Whether strokes have one width all along.
bool has_one_width(const InkedLines& lines, std::size_t first, std::size_t last) {
    const float width = lines.points_of(lines.strokes[first]).front().width_px;
    for (std::size_t i = first; i <= last; ++i) {
        for (const InkPoint& p : lines.points_of(lines.strokes[i])) {
            if (p.width_px != width) return false;
        }
    }
    return true;
}

}  // namespace

InkedLines with_runs_merged(InkedLines lines) {
    if (lines.strokes.empty()) return lines;
    std::vector<InkStroke> strokes;
    std::vector<StrokeOrigin> origins;
    std::vector<InkPoint> points;
    points.reserve(lines.points.size());
    for (std::size_t first = 0, last = 0; first < lines.strokes.size(); first = last + 1) {
        throw_if_interrupted();
        last = first;
        while (last + 1 < lines.strokes.size() && goes_on(lines, last)) ++last;
        const bool is_merged = last > first && !has_one_width(lines, first, last);
        for (std::size_t i = first; i <= last; ++i) {
            const std::span<const InkPoint> own = lines.points_of(lines.strokes[i]);
            if (i == first || !is_merged) {
                strokes.push_back(lines.strokes[i]);
                strokes.back().first_point = points.size();
                origins.push_back(std::move(lines.origins[i]));
            }
            points.insert(points.end(), own.begin(), own.end());
            strokes.back().point_count = points.size() - strokes.back().first_point;
        }
        if (!is_merged) continue;
        InkStroke& merged = strokes.back();
        merged.is_constant = false;
        merged.is_closed = glm::distance(points[merged.first_point].place, points.back().place) <= kClosedPx;
    }
    lines.strokes = std::move(strokes);
    lines.origins = std::move(origins);
    lines.points = std::move(points);
    return lines;
}

}  // namespace burin
