#include "output/paths/cut_halos.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/interrupt.h"
#include "output/paths/part_grid.h"

namespace burin {
namespace {

constexpr std::size_t kInterruptItems = 32;
constexpr double kHaloStepPx = 0.25, kExactPx = 1.0 / 128;

/// A place on a stroke: between this point and the next one.
struct HaloPlace {
    std::size_t point = 0;
    double share = 0;
};

InkPoint point_at(std::span<const InkPoint> points, HaloPlace place) {
    const InkPoint& from = points[place.point];
    if (place.share <= 0) return from;
    const InkPoint& to = points[place.point + 1];
    if (place.share >= 1) return to;
    const auto share = static_cast<float>(place.share);
    InkPoint p = from;
    static_assert(sizeof(InkPoint) == 48, "each number of it is mixed here");
    p.place = glm::mix(from.place, to.place, place.share);
    // What is equal at both ends stays as it is, to the bit.
    p.nearness += (to.nearness - from.nearness) * share;
    p.width_px += (to.width_px - from.width_px) * share;
    p.opacity += (to.opacity - from.opacity) * share;
    p.color += (to.color - from.color) * share;
    return p;
}

class HaloCutter {
  public:
    HaloCutter(const InkedLines& lines, const Projection& projection, PixelRect picture)
        : lines_(lines),
          projection_(projection),
          reach_px_(most_reach_px(lines)),
          step_px_(std::max(kHaloStepPx, reach_px_ / 64)),
          grid_(picture, reach_px_) {
        for (std::uint32_t s = 0; s < lines.strokes.size(); ++s) {
            const InkStroke& stroke = lines.strokes[s];
            if (!(stroke.halo_px > 0)) continue;
            const std::span<const InkPoint> points = lines.points_of(stroke);
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                grid_.add(points[i].place, points[i + 1].place, static_cast<std::uint32_t>(segments_.size()));
                segments_.push_back({s, stroke.first_point + i});
            }
        }
    }

    InkedLines cut() const {
        InkedLines result;
        result.filter = lines_.filter;
        result.layers = lines_.layers;
        result.sets = lines_.sets;
        for (std::size_t s = 0; s < lines_.strokes.size(); ++s) cut(s, result);
        return result;
    }

  private:
    struct Segment {
        std::uint32_t stroke;
        std::size_t point;
    };

    /// How far from its line a stroke erases others.
    static double most_reach_px(const InkedLines& lines) {
        double reach = 0;
        for (const InkStroke& stroke : lines.strokes) {
            if (!(stroke.halo_px > 0)) continue;
            for (const InkPoint& p : lines.points_of(stroke))
                reach = std::max(reach, static_cast<double>(0.5f * p.width_px + stroke.halo_px));
        }
        return reach;
    }

    bool is_erased(const InkStroke& stroke, const InkPoint& p) const {
        const double own = stroke.caps == StrokeCaps::round ? 0.5 * static_cast<double>(p.width_px) : 0;
        return grid_.any_near(p.place, reach_px_ + own, [&](const PartGrid::Part& part) {
            const Segment& segment = segments_[part.line];
            const InkStroke& front = lines_.strokes[segment.stroke];
            if (InkStroke::run_of(front.chain) == InkStroke::run_of(stroke.chain)) return false;
            const double square = part.square_distance(p.place);
            const double reach = reach_px_ + own;
            if (square >= reach * reach) return false;
            const double share =
                part.square > 0 ? std::clamp(glm::dot(p.place - part.from, part.way) / part.square, 0.0, 1.0) : 0.0;
            const InkPoint nearest = point_at(lines_.points_of(front), {segment.point - front.first_point, share});
            const double halo = static_cast<double>(front.halo_px) * halo_share(front, nearest.nearness, p.nearness);
            const double radius = 0.5 * static_cast<double>(nearest.width_px) + halo + own;
            return halo > 0 && square < radius * radius;
        });
    }
    /// The share of a halo by which it erases what is at another depth.
    double halo_share(const InkStroke& stroke, float nearness, float of_other) const {
        const auto a = static_cast<double>(nearness), b = static_cast<double>(of_other);
        const double farther_px = projection_.orthographic ? projection_.focal_px * (a - b)
                                  : b > 0                  ? projection_.focal_px * (a / b - 1)
                                                           : std::numeric_limits<double>::infinity();
        const auto from = static_cast<double>(stroke.halo_depth_px[0]),
                   to = static_cast<double>(stroke.halo_depth_px[1]);
        if (!(to > from)) return farther_px >= from ? 1 : 0;
        return std::clamp((farther_px - from) / (to - from), 0.0, 1.0);
    }

    void cut(std::size_t number, InkedLines& out) const {
        const InkStroke& stroke = lines_.strokes[number];
        const std::span<const InkPoint> points = lines_.points_of(stroke);
        bool was_erased = is_erased(stroke, points.front());
        HaloPlace begin, before;
        bool is_cut = was_erased, begins_at_halo = was_erased;
        double at_px = 0, begin_px = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            if (i % kInterruptItems == 0) throw_if_interrupted();
            const double length = glm::distance(points[i].place, points[i + 1].place);
            const int steps = std::max(1, static_cast<int>(std::ceil(std::min(length / step_px_, 1e6))));
            for (int k = 1; k <= steps; ++k) {
                const HaloPlace place{i, static_cast<double>(k) / steps};
                const bool is = is_erased(stroke, point_at(points, place));
                if (is != was_erased) {
                    // The border between the two, by halving.
                    double low = before.point == i ? before.share : 0, high = place.share;
                    while ((high - low) * length > kExactPx) {
                        const double middle = 0.5 * (low + high);
                        (is_erased(stroke, point_at(points, {i, middle})) == was_erased ? low : high) = middle;
                    }
                    const HaloPlace border{i, is ? low : high};
                    if (is) {
                        // What is no longer than wide between two halos is a dot and no line.
                        const double left_px = at_px + border.share * length - begin_px;
                        if (!begins_at_halo || left_px > static_cast<double>(point_at(points, border).width_px))
                            add(number, begin, border, begin_px, out);
                    } else {
                        begin = border;
                        begins_at_halo = true;
                        begin_px = at_px + border.share * length;
                    }
                    is_cut = true;
                    was_erased = is;
                }
                before = place;
            }
            at_px += length;
        }
        const HaloPlace end{points.size() - 2, 1};
        if (!was_erased) add(number, begin, end, begin_px, out, is_cut);
    }

    void add(std::size_t number, HaloPlace from, HaloPlace to, double at_px, InkedLines& out,
             bool is_cut = true) const {
        InkStroke stroke = lines_.strokes[number];
        const std::span<const InkPoint> points = lines_.points_of(stroke);
        stroke.first_point = out.points.size();
        out.points.push_back(point_at(points, from));
        for (std::size_t i = from.point + 1; i <= to.point; ++i) out.points.push_back(points[i]);
        out.points.push_back(point_at(points, to));
        stroke.point_count = out.points.size() - stroke.first_point;
        stroke.is_closed = stroke.is_closed && !is_cut;
        out.strokes.push_back(stroke);
        StrokeOrigin origin = lines_.origins[number];
        if (!origin.dash_px.empty()) {
            double period = 0;
            for (const float length : origin.dash_px) period += static_cast<double>(length);
            origin.dash_phase_px = static_cast<float>(
                std::fmod(static_cast<double>(origin.dash_phase_px) + at_px, std::max(period, 1e-3)));
        }
        out.origins.push_back(std::move(origin));
    }

    const InkedLines& lines_;
    const Projection& projection_;
    double reach_px_, step_px_;
    PartGrid grid_;
    std::vector<Segment> segments_;
};

}  // namespace

InkedLines with_halos_cut(InkedLines lines, const Projection& projection, PixelRect picture) {
    const bool has_halos =
        std::any_of(lines.strokes.begin(), lines.strokes.end(), [](const InkStroke& s) { return s.halo_px > 0; });
    if (!has_halos) return lines;
    return HaloCutter(lines, projection, picture).cut();
}

}  // namespace burin
