#include "shading/ink/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace burin {
namespace {

PathPoint between(const PathPoint& a, const PathPoint& b, double share) {
    PathPoint p = a;
    static_assert(sizeof(InkPoint) == 48, "each number of it is mixed here");
    const auto mixed = [share](float from, float to) {
        return static_cast<float>(glm::mix(static_cast<double>(from), static_cast<double>(to), share));
    };
    p.ink.place = glm::mix(a.ink.place, b.ink.place, share);
    p.ink.nearness = mixed(a.ink.nearness, b.ink.nearness);
    p.ink.width_px = mixed(a.ink.width_px, b.ink.width_px);
    p.ink.opacity = mixed(a.ink.opacity, b.ink.opacity);
    for (int k = 0; k < 3; ++k) p.ink.color[k] = mixed(a.ink.color[k], b.ink.color[k]);
    p.at_px = glm::mix(a.at_px, b.at_px, share);
    return p;
}

/// The part of a path between two places along its chain.
StrokePath cut(const StrokePath& path, double begin, double end) {
    StrokePath part;
    const auto add = [&](const PathPoint& p) { part.push_back(p); };
    const auto first =
        std::lower_bound(path.begin(), path.end(), begin, [](const PathPoint& p, double at) { return p.at_px < at; });
    for (auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(first - path.begin() - 1, 0)); i + 1 < path.size();
         ++i) {
        const PathPoint &a = path[i], &b = path[i + 1];
        if (a.at_px > end) break;
        if (b.at_px < begin) continue;
        const double length = b.at_px - a.at_px;
        const double from = length > 0 ? std::clamp((begin - a.at_px) / length, 0.0, 1.0) : 0.0;
        const double to = length > 0 ? std::clamp((end - a.at_px) / length, 0.0, 1.0) : 1.0;
        if (part.empty()) add(from > 0 ? between(a, b, from) : a);
        add(to < 1 ? between(a, b, to) : b);
        if (to < 1) break;
    }
    return part;
}

}  // namespace

void lengthen_end(StrokePath& path, bool is_first, double px) {
    if (path.size() < 2 || px == 0) return;
    if (px < 0) {
        const double begin = path.front().at_px - (is_first ? px : 0), end = path.back().at_px + (is_first ? 0 : px);
        path = end > begin ? cut(path, begin, end) : StrokePath();
        return;
    }
    // The direction is that of the last few pixels: last parts may be short, and run anywhere.
    constexpr double kDirectionPx = 4;
    const std::size_t n = path.size();
    const auto point = [&](std::size_t i) -> const PathPoint& { return path[is_first ? i : n - 1 - i]; };
    const glm::dvec2 end = point(0).ink.place;
    glm::dvec2 from = end;
    double way_px = 0;
    for (std::size_t i = 1; i < n && way_px < kDirectionPx; ++i) {
        const glm::dvec2 next = point(i).ink.place;
        const double part_px = glm::distance(point(i - 1).ink.place, next), rest_px = kDirectionPx - way_px;
        from = part_px > rest_px ? glm::mix(point(i - 1).ink.place, next, rest_px / part_px) : next;
        way_px += part_px;
    }
    const glm::dvec2 way = end - from;
    const double length = glm::length(way);
    if (length == 0) return;
    PathPoint beyond = point(0);
    beyond.ink.place += way * (px / length);
    beyond.at_px += is_first ? -px : px;
    if (is_first) {
        path.insert(path.begin(), beyond);
    } else {
        path.back().ends_piece = false;
        path.push_back(beyond);
    }
}

void smooth_ink(StrokePath& path, double px, bool is_closed) {
    if (path.size() < 2 || !(px > 0)) return;
    StrokePath fine;
    const double step = std::max(px / 4, 0.5);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double length = path[i + 1].at_px - path[i].at_px;
        const int parts = std::clamp(static_cast<int>(std::ceil(length / step)), 1, 1 << 16);
        for (int k = 0; k < parts; ++k) fine.push_back(between(path[i], path[i + 1], static_cast<double>(k) / parts));
    }
    fine.push_back(path.back());
    // Integrals from the beginning.
    const std::size_t n = fine.size();
    std::vector<double> width(n, 0), opacity(n, 0);
    for (std::size_t i = 1; i < n; ++i) {
        const double half = 0.5 * (fine[i].at_px - fine[i - 1].at_px);
        width[i] = width[i - 1] +
                   half * (static_cast<double>(fine[i].ink.width_px) + static_cast<double>(fine[i - 1].ink.width_px));
        opacity[i] = opacity[i - 1] +
                     half * (static_cast<double>(fine[i].ink.opacity) + static_cast<double>(fine[i - 1].ink.opacity));
    }
    const double begin = fine.front().at_px, end = fine.back().at_px, total = end - begin;
    const auto integral = [&](const std::vector<double>& of, double at) {
        double turns = 0;
        if (is_closed && total > 0) {
            turns = std::floor((at - begin) / total);
            at -= turns * total;
        }
        at = std::max(std::min(at, end), begin);  // rounding may have the end before the beginning
        const auto next =
            std::upper_bound(fine.begin(), fine.end(), at, [](double v, const PathPoint& p) { return v < p.at_px; });
        const auto i = static_cast<std::size_t>(
            std::clamp<std::ptrdiff_t>(next - fine.begin(), 1, static_cast<std::ptrdiff_t>(n) - 1));
        const double length = fine[i].at_px - fine[i - 1].at_px;
        const double share = length > 0 ? (at - fine[i - 1].at_px) / length : 0;
        return turns * of.back() + glm::mix(of[i - 1], of[i], share);
    };
    const auto [least_width, most_width] =
        std::minmax_element(path.begin(), path.end(),
                            [](const PathPoint& a, const PathPoint& b) { return a.ink.width_px < b.ink.width_px; });
    const auto [least_opacity, most_opacity] = std::minmax_element(
        path.begin(), path.end(), [](const PathPoint& a, const PathPoint& b) { return a.ink.opacity < b.ink.opacity; });
    StrokePath smoothed = fine;
    for (std::size_t i = 0; i < n; ++i) {
        const double at = fine[i].at_px;
        const double from = is_closed ? at - px : std::max(at - px, begin);
        const double to = is_closed ? at + px : std::min(at + px, end);
        if (!(to > from)) continue;
        // What is left of rounding where the way is short must not leave the range of what is averaged.
        smoothed[i].ink.width_px =
            std::clamp(static_cast<float>((integral(width, to) - integral(width, from)) / (to - from)),
                       least_width->ink.width_px, most_width->ink.width_px);
        smoothed[i].ink.opacity =
            std::clamp(static_cast<float>((integral(opacity, to) - integral(opacity, from)) / (to - from)),
                       least_opacity->ink.opacity, most_opacity->ink.opacity);
    }
    path = std::move(smoothed);
}

double DashPattern::period_px() const { return std::accumulate(lengths_px.begin(), lengths_px.end(), 0.0); }

double DashPattern::share() const {
    const double period = period_px();
    double on = 0;
    for (std::size_t i = 0; i < lengths_px.size(); i += 2) on += lengths_px[i];
    return period > 0 ? on / period : 1;
}

double dash_scale(const DashPattern& pattern, double loop_px) {
    const double period = pattern.period_px();
    return loop_px > 0 ? loop_px / (period * std::max(1.0, std::round(loop_px / period))) : 1;
}

void for_dashes(const StrokePath& path, const DashPattern& pattern, double loop_px,
                const std::function<void(const StrokePath&)>& visit) {
    if (path.size() < 2) return;
    const double period = pattern.period_px();
    const double scale = dash_scale(pattern, loop_px);
    const double begin = path.front().at_px, end = path.back().at_px;
    const double first = std::floor((begin / scale + pattern.phase_px) / period) - 1;
    for (double turn = first;; ++turn) {
        double at = (turn * period - pattern.phase_px) * scale;
        if (at > end) break;
        for (std::size_t mark = 0; mark < pattern.lengths_px.size(); ++mark) {
            const double from = at, to = at + pattern.lengths_px[mark] * scale;
            at = to;
            if (mark % 2 == 1 || to <= begin || from >= end) continue;  // nothing of it is on the path
            StrokePath dash = cut(path, std::max(from, begin), std::min(to, end));
            if (dash.size() < 2) continue;
            if (pattern.has_round_caps) {
                // Ends of the line itself are no ends of a dash.
                const double at_from = from < begin ? 0 : 0.5 * static_cast<double>(dash.front().ink.width_px);
                const double at_to = to > end ? 0 : 0.5 * static_cast<double>(dash.back().ink.width_px);
                const double low = dash.front().at_px + at_from, high = dash.back().at_px - at_to;
                if (low < high) {
                    dash = cut(dash, low, high);
                } else {
                    const double middle = std::clamp(0.5 * (low + high), dash.front().at_px, dash.back().at_px);
                    dash = cut(dash, middle, middle);
                    if (dash.empty()) continue;
                    dash = {dash.front(), dash.front()};
                }
            }
            if (dash.size() >= 2) visit(dash);
        }
    }
}

}  // namespace burin
