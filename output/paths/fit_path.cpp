#include "output/paths/fit_path.h"

#include <algorithm>
#include <cmath>

#include "output/paths/arc_fit.h"
#include "output/paths/cubic_fit.h"
#include "output/paths/simplify.h"

namespace burin {
namespace {

constexpr double kCornerCosine = 0.9063;  // of 25 degrees
/// Points that are so many tolerances off the straight line through their neighbours are none of the curve.
constexpr double kStraightShare = 0.25;
/// Curves bend a little more in one chord than in the next one.
constexpr double kSagTimes = 1.25;
/// Straight parts so short are what is left where lines were found piece by piece.
constexpr double kStubPx = 1.0 / 16;
/// Lines that go so far and back again do so between two samples, where they meet short parts of others.
constexpr double kThornPx = 0.5, kBackCosine = -0.85;
/// A straight part that is so much longer than the next one is a line, where a curve begins.
constexpr double kLongerTimes = 6, kLongerPx = 4;

/// Takes one end of each short part away that the line can do without.
void remove_stubs(bool is_closed, double tolerance_px, std::vector<glm::dvec2>& points) {
    const auto can_go = [&](glm::dvec2 before, glm::dvec2 point, glm::dvec2 after) {
        return distance_to_part(point, before, after) <= tolerance_px;
    };
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_inner = i > 0 && i + 1 < points.size();
        const bool is_short = is_inner && (glm::distance(points[i], points[i + 1]) < kStubPx ||
                                           glm::distance(points[i], points[i - 1]) < kStubPx);
        // The point before it is there, so that errors do not add up.
        if (is_short && kept.back() == points[i - 1] && can_go(points[i - 1], points[i], points[i + 1])) continue;
        // What is left of there and back again is one point.
        if (kept.empty() || kept.back() != points[i]) kept.push_back(points[i]);
    }
    const std::size_t n = kept.size();
    if (is_closed && n > 4 && kept[n - 2] != kept[1] &&
        std::min(glm::distance(kept[0], kept[1]), glm::distance(kept[n - 2], kept[0])) < kStubPx &&
        can_go(kept[n - 2], kept[0], kept[1])) {
        kept.erase(kept.begin());
        kept.back() = kept.front();
    }
    points = std::move(kept);
}

/// Takes the tips of thorns away: where a line turns back within half a pixel.
void remove_thorns(std::vector<glm::dvec2>& points) {
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_inner = !kept.empty() && i + 1 < points.size();
        if (is_inner) {
            const glm::dvec2 to = points[i] - kept.back(), from = points[i + 1] - points[i];
            const double forth = glm::length(to), back = glm::length(from);
            if (std::min(forth, back) < kThornPx && glm::dot(to, from) < kBackCosine * forth * back) continue;
        }
        if (kept.empty() || kept.back() != points[i]) kept.push_back(points[i]);
    }
    points = std::move(kept);
}

/// Of each part between two points that are left of a line, whether others lay between them: those say that it is
/// straight there.
std::vector<char> parts_with_others(std::span<const glm::dvec2> line, std::span<const glm::dvec2> left) {
    std::vector<char> have(left.size(), 0);
    auto at = std::find(line.begin(), line.end(), left.front());
    for (std::size_t i = 1; i < left.size() && at != line.end(); ++i) {
        const auto next = std::find(at + 1, line.end(), left[i]);
        have[i - 1] = next != at + 1 ? 1 : 0;
        at = next;
    }
    return have;
}

class PathFitter {
  public:
    /// `is_straight`: of each part, whether the line is known to be straight there.
    PathFitter(std::vector<glm::dvec2> points, std::span<const char> is_straight, bool is_closed,
               const FitBounds& bounds, std::vector<PathStep>& steps)
        : points_(std::move(points)), is_closed_(is_closed), bounds_(bounds), steps_(steps) {
        const std::size_t n = points_.size();
        for (std::size_t i = 0; i + 1 < n; ++i) {
            ways_.push_back(points_[i + 1] - points_[i]);
            lengths_.push_back(glm::length(ways_.back()));
        }
        for (std::size_t i = 0; i < n; ++i) is_corner_.push_back(is_corner(i) ? 1 : 0);
        for (std::size_t i = 0; i + 1 < n; ++i) sags_.push_back(is_straight[i] != 0 ? 0 : sag(i));
    }

    void fit() {
        std::size_t begin = 0;
        for (std::size_t i = 1; i < points_.size(); ++i) {
            if (i + 1 < points_.size() && is_corner_[i] == 0) continue;
            add_smooth(begin, i);
            begin = i;
        }
    }

  private:
    /// The straight parts before and after a point; false at the ends of an open line.
    bool parts_at(std::size_t i, std::size_t& before, std::size_t& after) const {
        const std::size_t parts = ways_.size();
        if ((i == 0 || i == parts) && !is_closed_) return false;
        before = i == 0 ? parts - 1 : i - 1;
        after = i == parts ? 0 : i;
        return true;
    }
    bool is_corner(std::size_t i) const {
        std::size_t before = 0, after = 0;
        if (!parts_at(i, before, after)) return true;
        const double a = lengths_[before], b = lengths_[after];
        return glm::dot(ways_[before], ways_[after]) < kCornerCosine * a * b ||
               std::max(a, b) > kLongerTimes * std::min(a, b) + kLongerPx;
    }
    /// How much the line turns at a point, in radians.
    double turn(std::size_t i) const {
        std::size_t before = 0, after = 0;
        parts_at(i, before, after);
        const glm::dvec2 a = ways_[before], b = ways_[after];
        return std::abs(std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b)));
    }
    /// How far a curve that turns as the line does at the ends of a chord is from it.
    double sag(std::size_t i) const {
        const bool has_begin = is_corner_[i] == 0, has_end = is_corner_[i + 1] == 0;
        double turns = 0;
        if (has_begin && has_end) turns = std::max(turn(i), turn(i + 1));
        if (has_begin != has_end) turns = turn(has_begin ? i : i + 1);
        return std::min(kSagTimes * lengths_[i] * turns / 8, bounds_.chord_sag_px);
    }
    /// The tangent at a point, from it towards one of its neighbours, as that of the parabola through three points.
    glm::dvec2 way_from(std::size_t i, bool is_forth) const {
        const std::size_t last = ways_.size();
        if (is_corner_[i] == 0 || (is_closed_ && (i == 0 || i == last) && is_corner_[0] == 0)) {
            std::size_t before = 0, after = 0;
            parts_at(i, before, after);
            const glm::dvec2 way = ways_[before] * (lengths_[after] / lengths_[before]) +
                                   ways_[after] * (lengths_[before] / lengths_[after]);
            if (glm::length(way) > 0) return glm::normalize(is_forth ? way : -way);
        }
        const glm::dvec2 p = points_[i], q = points_[is_forth ? i + 1 : i - 1], r = points_[is_forth ? i + 2 : i - 2];
        const double s = glm::distance(p, q), t = s + glm::distance(q, r);
        const glm::dvec2 way = (q - p) * (t / (s * (t - s))) - (r - p) * (s / (t * (t - s)));
        return glm::length(way) > 0 ? glm::normalize(way) : (q - p) / s;
    }

    void add_smooth(std::size_t begin, std::size_t end) {
        const std::span<const glm::dvec2> points = std::span(points_).subspan(begin, end - begin + 1);
        // As few straight steps as a curve has numbers are better than the curve.
        std::vector<glm::dvec2> straight;
        simplify(points, bounds_.tolerance_px, straight);
        if (points.size() > 3 && straight.size() > 4) {
            SmoothPart part;
            part.points = points;
            part.sag_px = std::span(sags_).subspan(begin, end - begin);
            part.tolerance_px = bounds_.tolerance_px;
            part.begin_way = way_from(begin, true);
            part.end_way = way_from(end, false);
            if (fit_arcs(part, steps_)) return;
            std::vector<PathStep> curves;
            fit_cubics(part, curves);
            std::size_t numbers = 0;
            for (const PathStep& step : curves) numbers += step.kind == PathStep::Kind::cubic ? 3 : 1;
            if (numbers < straight.size()) {
                steps_.insert(steps_.end(), curves.begin(), curves.end());
                return;
            }
        }
        for (std::size_t i = 1; i < straight.size(); ++i) {
            PathStep step;
            step.to = straight[i];
            steps_.push_back(step);
        }
    }

    std::vector<glm::dvec2> points_, ways_;
    std::vector<double> lengths_, sags_;
    std::vector<char> is_corner_;  // of each point; the ends of an open line are corners
    bool is_closed_;
    FitBounds bounds_;
    std::vector<PathStep>& steps_;
};

}  // namespace

glm::dvec2 fit_path(std::span<const glm::dvec2> line, bool is_closed, const FitBounds& bounds,
                    std::vector<PathStep>& steps) {
    is_closed = is_closed && line.front() == line.back();
    std::vector<glm::dvec2> points;
    simplify(line, kStraightShare * bounds.tolerance_px, points);
    remove_thorns(points);
    remove_stubs(is_closed, bounds.tolerance_px, points);
    const glm::dvec2 start = points.front();
    if (points.size() < 2) {  // a dot, and a line that the tolerance makes one
        PathStep step;
        step.to = start;
        steps.push_back(step);
    } else {
        const std::vector<char> is_straight = parts_with_others(line, points);
        PathFitter(std::move(points), is_straight, is_closed,
                   {(1 - kStraightShare) * bounds.tolerance_px, bounds.chord_sag_px}, steps)
            .fit();
    }
    return start;
}

}  // namespace burin
