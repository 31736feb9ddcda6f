#include "output/paths/clean_paths.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "base/interrupt.h"
#include "output/paths/dash_pattern.h"
#include "output/paths/part_grid.h"

namespace burin {
namespace {

/// Lines that are no farther apart run along each other, for more than kTwicePx.
constexpr double kBesidePx = 0.25, kTwicePx = 1.5;
/// Hidden lines are cut out where their ink touches that of what they run along, up to this distance.
constexpr double kMostTouchPx = 8;
/// The sine up to which two lines run the same way.
constexpr double kParallelSine = 0.17;
constexpr double kStepPx = 0.5, kMostReachPx = 2;
/// Crumbs of hidden lines that are so near to other lines say nothing.
constexpr double kSpeckPx = 1;

double length_of(std::span<const glm::dvec2> points) {
    double length = 0;
    for (std::size_t i = 1; i < points.size(); ++i) length += glm::distance(points[i - 1], points[i]);
    return length;
}

/// A place on a line, between two of its points.
struct Place {
    std::size_t part = 0;
    double share = 0;
};

class Cleaner {
  public:
    Cleaner(const PathLines& lines, PixelRect area) : lines_(lines), grid_(area), result_(lines.without_points()) {}

    PathLines cleaned() {
        std::vector<double> lengths;
        for (const PathLine& line : lines_.lines) lengths.push_back(length_of(lines_.points_of(line)));
        std::vector<std::uint32_t> order(lines_.lines.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        // What lies highest comes first, of that the longest; crumbs come last.
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            throw_if_interrupted();
            const auto key = [&](std::uint32_t i) {
                const bool is_crumb = lengths[i] < kCrumbPx;
                return std::tuple(is_crumb, lines_.lines[i].kind.order, -lengths[i], i);
            };
            return key(a) < key(b);
        });
        for (const VectorStyle& style : lines_.styles)
            widest_px_ = std::max(widest_px_, static_cast<double>(style.width_px));
        keeps_.resize(lines_.lines.size());
        for (const std::uint32_t i : order) clean(i, lengths[i]);
        // In the order in which they came.
        for (std::uint32_t i = 0; i < lines_.lines.size(); ++i) {
            throw_if_interrupted();
            for (const Kept& kept : keeps_[i]) add(i, kept);
        }
        return std::move(result_);
    }

  private:
    struct Kept {
        bool is_whole = true;
        Place from, to;
    };

    const VectorStyle& style_of(std::uint32_t line) const { return lines_.styles[lines_.lines[line].kind.style]; }

    /// Whether the ink of one line can take the place of that of another one, or of a crumb of it, where both lie at
    /// one place.
    bool covers(std::uint32_t upper, std::uint32_t lower, bool is_crumb) const {
        if (upper == lower) return false;
        const VectorStyle &a = style_of(upper), &b = style_of(lower);
        // A crumb may lie above longer lines.
        if (lines_.lines[lower].kind.order < lines_.lines[upper].kind.order && a.color != b.color) return false;
        const bool is_one_style = lines_.lines[upper].kind.style == lines_.lines[lower].kind.style;
        if (!a.dash_px.empty()) {
            // Two patterns along each other, one of them moved, fill each other's gaps: one of them is what is meant.
            // That of a crumb is squeezed to its length, and says nothing.
            return is_one_style || (!b.dash_px.empty() && (is_crumb || is_one_pattern(a.dash_px, b.dash_px)) &&
                                    a.color == b.color && a.blend == InkBlend::over && b.blend == InkBlend::over &&
                                    a.opacity >= b.opacity && a.width_px >= b.width_px);
        }
        if (is_one_style) return a.opacity == 1 || lines_.lines[upper].chain == lines_.lines[lower].chain;
        return a.blend == InkBlend::over && a.opacity == 1 && a.width_px >= b.width_px;
    }

    void clean(std::uint32_t number, double length) {
        const PathLine& line = lines_.lines[number];
        const std::span<const glm::dvec2> points = lines_.points_of(line);
        if (style_of(number).is_outline()) {
            keeps_[number].push_back({});
            return;
        }
        if (length < kCrumbPx && (is_covered(number, points) || is_speck(number, points))) return;
        find_twice(number, points);
        if (twice_.empty()) {
            keeps_[number].push_back({});
        } else {
            keep_rest(number, points);
        }
        if (length >= kCrumbPx) long_chains_.insert(line.chain);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) grid_.add(points[i], points[i + 1], number);
    }

    bool is_near(std::uint32_t number, glm::dvec2 p, double reach_px, const glm::dvec2* way) const {
        return grid_.any_near(p, reach_px, [&](const PartGrid::Part& part) {
            if (part.line == number) return false;
            if (way != nullptr) {
                const double cross = way->x * part.way.y - way->y * part.way.x;
                if (cross * cross >= kParallelSine * kParallelSine * part.square) return false;
            }
            const double reach = way == nullptr ? reach_px : beside_px(part.line, number);
            return part.square_distance(p) <= reach * reach && covers(part.line, number, way == nullptr);
        });
    }
    /// How near a line must be to another one to run along it. A hidden line that blurs the edge of a visible one, or
    /// fills the gaps of a pattern, says nothing.
    double beside_px(std::uint32_t upper, std::uint32_t lower) const {
        const PathLine &a = lines_.lines[upper], &b = lines_.lines[lower];
        if (!b.kind.order.is_hidden || (a.kind.order.is_hidden && style_of(upper).dash_px.empty())) return kBesidePx;
        const double touch_px =
            0.5 * static_cast<double>(style_of(upper).width_px) + 0.5 * static_cast<double>(style_of(lower).width_px);
        return std::clamp(touch_px, kBesidePx, kMostTouchPx);
    }
    /// Whether the pens of others that were kept pass over all points.
    bool is_covered(std::uint32_t number, std::span<const glm::dvec2> points) const {
        const VectorStyle& style = style_of(number);
        double reach = std::clamp(0.5 * static_cast<double>(style.width_px), kBesidePx, kMostReachPx);
        // What is shorter than half a pixel where a line with a pattern goes on is none of its dashes.
        if (!style.dash_px.empty()) reach = std::max(reach, 0.5 * kCrumbPx);
        return std::all_of(points.begin(), points.end(),
                           [&](glm::dvec2 p) { return is_near(number, p, reach, nullptr); });
    }

    /// Whether a crumb of a hidden line says nothing: its chain has longer parts, it has no length for its dashes, or
    /// other lines are near.
    bool is_speck(std::uint32_t number, std::span<const glm::dvec2> points) const {
        const PathLine& line = lines_.lines[number];
        if (!line.kind.order.is_hidden) return false;
        if (!style_of(number).dash_px.empty() || long_chains_.contains(line.chain)) return true;
        return std::all_of(points.begin(), points.end(), [&](glm::dvec2 p) {
            return grid_.any_near(p, kSpeckPx, [&](const PartGrid::Part& part) {
                return part.line != number && part.square_distance(p) <= kSpeckPx * kSpeckPx;
            });
        });
    }

    /// Finds the parts of a line that run along others.
    void find_twice(std::uint32_t number, std::span<const glm::dvec2> points) {
        twice_.clear();
        double reach_px = kBesidePx;
        if (lines_.lines[number].kind.order.is_hidden)
            reach_px = std::clamp(0.5 * (widest_px_ + static_cast<double>(style_of(number).width_px)), kBesidePx,
                                  kMostTouchPx);
        bool is_beside = false;
        double length = 0;  // of the part that is beside
        Place begin;
        const auto end_part = [&](Place end) {
            if (is_beside && length > kTwicePx) twice_.emplace_back(begin, end);
            is_beside = false;
        };
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            throw_if_interrupted();
            const glm::dvec2 way = points[i + 1] - points[i];
            const double part_length = glm::length(way);
            if (!(part_length > 0)) continue;
            const glm::dvec2 unit = way / part_length;
            const int steps = std::max(1, static_cast<int>(std::ceil(std::min(part_length / kStepPx, 1e6))));
            for (int k = 0; k < steps; ++k) {
                const glm::dvec2 p = points[i] + way * ((k + 0.5) / steps);
                if (is_near(number, p, reach_px, &unit)) {
                    if (!is_beside) {
                        begin = {i, static_cast<double>(k) / steps};
                        length = 0;
                    }
                    is_beside = true;
                    length += part_length / steps;
                } else {
                    end_part({i, static_cast<double>(k) / steps});
                }
            }
        }
        end_part({points.size() - 2, 1});
    }

    void keep_rest(std::uint32_t number, std::span<const glm::dvec2> points) {
        Place at;
        const auto keep = [&](Place from, Place to) {
            if (from.part == to.part && to.share <= from.share) return;
            if (from.part + 1 == to.part && from.share >= 1 && to.share <= 0) return;
            std::vector<glm::dvec2> part = part_of(points, from, to);
            if (length_of(part) < kCrumbPx && (is_covered(number, part) || is_speck(number, part))) return;
            keeps_[number].push_back({false, from, to});
        };
        for (const auto& [begin, end] : twice_) {
            keep(at, begin);
            at = end;
        }
        keep(at, {points.size() - 2, 1});
    }
    static std::vector<glm::dvec2> part_of(std::span<const glm::dvec2> points, Place from, Place to) {
        const auto at = [&](Place p) { return glm::mix(points[p.part], points[p.part + 1], p.share); };
        std::vector<glm::dvec2> part = {at(from)};
        for (std::size_t i = from.part + 1; i <= to.part; ++i) {
            if (points[i] != part.back()) part.push_back(points[i]);
        }
        if (at(to) != part.back() || part.size() == 1) part.push_back(at(to));
        return part;
    }

    void add(std::uint32_t number, const Kept& kept) {
        PathLine line = lines_.lines[number];
        const std::span<const glm::dvec2> points = lines_.points_of(line);
        line.first_point = result_.points.size();
        if (kept.is_whole) {
            result_.points.insert(result_.points.end(), points.begin(), points.end());
        } else {
            const std::vector<glm::dvec2> part = part_of(points, kept.from, kept.to);
            result_.points.insert(result_.points.end(), part.begin(), part.end());
            line.is_closed = false;
            const std::vector<float>& dash = style_of(number).dash_px;
            if (!dash.empty()) {
                const double before = length_of(part_of(points, {0, 0}, kept.from));
                double period = 0;
                for (const float length : dash) period += static_cast<double>(length);
                line.dash_phase_px = static_cast<float>(
                    std::fmod(static_cast<double>(line.dash_phase_px) + before, std::max(period, 1e-3)));
            }
        }
        line.point_count = result_.points.size() - line.first_point;
        result_.lines.push_back(line);
    }

    const PathLines& lines_;
    PartGrid grid_;
    double widest_px_ = 0;
    PathLines result_;
    std::unordered_set<std::uint64_t> long_chains_;  // that a line longer than a crumb is of
    std::vector<std::vector<Kept>> keeps_;           // of each line
    std::vector<std::pair<Place, Place>> twice_;     // of the line that is looked at
};

}  // namespace

PathLines cleaned_paths(const PathLines& lines, PixelRect area) { return Cleaner(lines, area).cleaned(); }

}  // namespace burin
