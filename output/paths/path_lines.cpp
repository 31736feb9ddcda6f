#include "output/paths/path_lines.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

#include "base/interrupt.h"
#include "output/paths/clip_line.h"
#include "output/paths/outline.h"
#include "output/paths/simplify.h"

namespace burin {
namespace {

/// Points so close to the straight line through their neighbours lie on one edge.
constexpr double kStraightPx = 1.0 / 256;

/// Numbers styles, each once, in the order in which they are met.
class StyleNumbers {
  public:
    explicit StyleNumbers(std::vector<VectorStyle>& styles) : styles_(styles), slots_(64, 0) {}

    std::uint32_t number_of(VectorStyle style) {
        if (!styles_.empty() && styles_[last_] == style) return last_;
        std::size_t slot = hash(style) & (slots_.size() - 1);
        for (; slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
            if (styles_[slots_[slot] - 1] == style) return last_ = slots_[slot] - 1;
        }
        styles_.push_back(std::move(style));
        slots_[slot] = static_cast<std::uint32_t>(styles_.size());
        last_ = slots_[slot] - 1;
        if (2 * styles_.size() > slots_.size()) grow();
        return last_;
    }

  private:
    static std::size_t hash(const VectorStyle& style) {
        std::uint64_t bits = 0;
        const auto add = [&bits](float number) {
            std::uint32_t part;
            number += 0.0f;
            std::memcpy(&part, &number, sizeof part);
            bits = (bits ^ part) * 0x9E3779B97F4A7C15;
            bits ^= bits >> 29;
        };
        for (const float number : {style.width_px, style.opacity, style.color.r, style.color.g, style.color.b})
            add(number);
        for (const float length : style.dash_px) add(length);
        return static_cast<std::size_t>(bits);
    }
    void grow() {
        slots_.assign(4 * slots_.size(), 0);
        for (std::size_t i = 0; i < styles_.size(); ++i) {
            std::size_t slot = hash(styles_[i]) & (slots_.size() - 1);
            while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = static_cast<std::uint32_t>(i + 1);
        }
    }

    std::vector<VectorStyle>& styles_;
    std::vector<std::uint32_t> slots_;
    std::uint32_t last_ = 0;
};

/// A constant ink of a stroke; of one that varies, its means weighted by length.
struct MeanInk {
    float opacity;
    glm::vec3 color;
};

MeanInk mean_ink(std::span<const InkPoint> points) {
    double length = 0, opacity = 0;
    glm::dvec3 color(0.0);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double part = glm::distance(points[i].place, points[i + 1].place);
        length += part;
        opacity += part * 0.5 * (static_cast<double>(points[i].opacity) + static_cast<double>(points[i + 1].opacity));
        color += part * 0.5 * (glm::dvec3(points[i].color) + glm::dvec3(points[i + 1].color));
    }
    if (!(length > 0)) return {points.front().opacity, points.front().color};
    return {static_cast<float>(opacity / length), glm::vec3(color / length)};
}

bool is_near(PixelRect crop, std::span<const InkPoint> points) {
    double reach = 0;
    glm::dvec2 low(points.front().place), high(points.front().place);
    for (const InkPoint& p : points) {
        reach = std::max(reach, 0.5 * static_cast<double>(p.width_px));
        low = glm::min(low, p.place);
        high = glm::max(high, p.place);
    }
    return high.x + reach > crop.x0 && low.x - reach < crop.x1 && high.y + reach > crop.y0 && low.y - reach < crop.y1;
}

/// The half of a pen that draws on one side only: its line is moved by a quarter of its width.
std::vector<glm::dvec2> moved_to_side(std::span<const InkPoint> points, StrokeSide side, double width_px,
                                      bool is_closed) {
    const std::size_t n = points.size();
    std::vector<glm::dvec2> moved(n);
    const auto across = [&](std::size_t i) {  // of the way from point i to the next, to the surface in front
        const glm::dvec2 way = points[i + 1].place - points[i].place;
        const double length = glm::length(way);
        if (!(length > 0)) return glm::dvec2(0.0);
        const double turn = points[i].front_on_left ? 1 : -1;  // y points downwards: left is (y, -x)
        return glm::dvec2(way.y, -way.x) * (turn / length);
    };
    for (std::size_t i = 0; i < n; ++i) {
        const bool has_before = i > 0 || is_closed, has_after = i + 1 < n || is_closed;
        const glm::dvec2 before = has_before ? across(i > 0 ? i - 1 : n - 2) : glm::dvec2(0.0);
        const glm::dvec2 after = has_after ? across(i + 1 < n ? i : 0) : glm::dvec2(0.0);
        glm::dvec2 sum = before + after;
        const double square = glm::dot(sum, sum);
        if (has_before && has_after && square > 1) sum *= 2 / square;  // keeps the distance where the line turns
        moved[i] = points[i].place + sum * (0.25 * width_px * (side == StrokeSide::inside ? 1 : -1));
    }
    return moved;
}

/// Adds a line without the points that it can do without.
void add_line(PathLine line, std::span<const glm::dvec2> places, std::uint64_t edge, PathLines& paths) {
    line.first_point = paths.points.size();
    simplify(places, kStraightPx, paths.points);
    line.point_count = paths.points.size() - line.first_point;
    if (line.point_count < 2) {
        paths.points.resize(line.first_point);
        return;
    }
    line.first_edge = paths.edges.size();
    line.edge_count = 1;
    line.end_edges = {edge, edge};
    paths.edges.push_back(edge);
    paths.lines.push_back(line);
}

}  // namespace

PathLines path_lines_of(const InkedLines& lines, VectorGrouping grouping, PixelRect crop) {
    PathLines paths;
    StyleNumbers styles(paths.styles);
    std::vector<glm::dvec2> places;
    for (std::size_t i = 0; i < lines.strokes.size(); ++i) {
        throw_if_interrupted();
        const InkStroke& stroke = lines.strokes[i];
        const StrokeOrigin& origin = lines.origins[i];
        const std::span<const InkPoint> points = lines.points_of(stroke);
        if (!is_near(crop, points)) continue;
        VectorStyle style;
        style.blend = stroke.blend;
        style.caps = stroke.caps;
        style.dash_px = origin.dash_px;
        PathLine line;
        line.kind.order = stroke.order;
        line.kind.invisibility = grouping == VectorGrouping::invisibility ? origin.invisibility : std::uint8_t{0};
        line.object = origin.object;
        line.invisibility = origin.invisibility;
        line.chain = stroke.chain;
        line.dash_phase_px = origin.dash_phase_px;
        line.is_closed = stroke.is_closed;
        for (const InkPoint& p : points) line.nearness = std::max(line.nearness, p.nearness);
        const bool has_one_width = std::all_of(
            points.begin(), points.end(), [&](const InkPoint& p) { return p.width_px == points.front().width_px; });
        const MeanInk ink =
            stroke.is_constant ? MeanInk{points.front().opacity, points.front().color} : mean_ink(points);
        style.opacity = ink.opacity;
        style.color = ink.color;
        if (!has_one_width) {
            style.width_px = 0;
            style.dash_px.clear();
            line.is_closed = true;
            places.clear();
            add_outline(points, stroke.caps == StrokeCaps::round, stroke.is_closed, places);
            line.kind.style = styles.number_of(std::move(style));
            add_line(line, places, origin.edge, paths);
            continue;
        }
        const bool has_side = stroke.side != StrokeSide::both && points.front().occludes && !stroke.is_behind;
        const auto width_px = static_cast<double>(points.front().width_px);
        style.width_px = points.front().width_px * (has_side ? 0.5f : 1.0f);
        if (has_side) {
            places = moved_to_side(points, stroke.side, width_px, stroke.is_closed);
        } else {
            places.clear();
            for (const InkPoint& p : points) places.push_back(p.place);
        }
        line.kind.style = styles.number_of(std::move(style));
        // What lies farther beside the crop leaves no ink in it.
        const glm::dvec2 low = glm::dvec2(crop.x0, crop.y0) - 0.5 * width_px,
                         high = glm::dvec2(crop.x1, crop.y1) + 0.5 * width_px;
        const bool is_inside = std::all_of(places.begin(), places.end(), [&](glm::dvec2 p) {
            return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y;
        });
        if (is_inside) {
            add_line(line, places, origin.edge, paths);
            continue;
        }
        line.is_closed = false;
        double period = 0;
        for (const float length : origin.dash_px) period += static_cast<double>(length);
        for (const ClippedPart& part : clipped_line(places, low, high)) {
            if (period > 0) {
                const double phase = static_cast<double>(origin.dash_phase_px) + part.begin_px;
                line.dash_phase_px = static_cast<float>(std::fmod(phase, period));
            }
            add_line(line, part.points, origin.edge, paths);
        }
    }
    return paths;
}

}  // namespace burin
