#include "lines/contour_joints.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <tuple>

#include "lines/smooth_contours.h"

namespace burin {
namespace {

/// Lines that were no farther apart than this met.
constexpr double kMetPx = 0.25;
/// Ends no farther apart than this are joined.
constexpr double kJoinedPx = SmoothContours::kApartPx;
constexpr double kCellPx = 4;

/// Ends by place, in cells of the picture.
class Cells {
  public:
    void add(glm::dvec2 low, glm::dvec2 high, std::uint32_t number) {
        for_cells(low, high, [&](std::uint64_t cell) { entries_.push_back({cell, number}); });
    }
    void sort() { std::sort(entries_.begin(), entries_.end()); }
    /// Visits what is near; some ends come more than once.
    template <typename Visit>
    void visit(glm::dvec2 place, const Visit& visit) const {
        for_cells(place - kMetPx, place + kMetPx, [&](std::uint64_t cell) {
            for (auto it = std::lower_bound(entries_.begin(), entries_.end(), Entry{cell, 0});
                 it != entries_.end() && it->cell == cell; ++it) {
                visit(it->number);
            }
        });
    }

  private:
    struct Entry {
        std::uint64_t cell;
        std::uint32_t number;
        bool operator<(const Entry& o) const { return std::tie(cell, number) < std::tie(o.cell, o.number); }
    };
    template <typename Visit>
    static void for_cells(glm::dvec2 low, glm::dvec2 high, const Visit& visit) {
        const auto cell = [](double at) { return static_cast<std::int32_t>(std::floor(at / kCellPx)); };
        for (std::int32_t y = cell(low.y); y <= cell(high.y); ++y) {
            for (std::int32_t x = cell(low.x); x <= cell(high.x); ++x) {
                visit(std::uint64_t{static_cast<std::uint32_t>(y)} << 32 | static_cast<std::uint32_t>(x));
            }
        }
    }

    std::vector<Entry> entries_;
};

glm::dvec2 nearest_on(glm::dvec2 a, glm::dvec2 b, glm::dvec2 place) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    return square > 0 ? a + way * std::clamp(glm::dot(place - a, way) / square, 0.0, 1.0) : a;
}

glm::dvec2 nearest_on(const std::vector<glm::dvec2>& points, glm::dvec2 place) {
    glm::dvec2 best = points.front();
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 foot = nearest_on(points[i - 1], points[i], place);
        if (glm::distance(foot, place) < glm::distance(best, place)) best = foot;
    }
    return best;
}

class Joiner {
  public:
    Joiner(std::span<const MovedLine> lines, Joints& joints) : lines_(lines), joints_(joints) {
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            const LinePiece& s = *lines[i].given;
            lines_in_.add(glm::min(s.from, s.to), glm::max(s.from, s.to), i);
            for (const std::uint32_t end : {2 * i, 2 * i + 1}) ends_in_.add(place(end), place(end), end);
        }
        lines_in_.sort();
        ends_in_.sort();
    }

    void join(std::uint32_t end) {
        std::uint32_t hub = end;
        bool meets_end = false;
        ends_in_.visit(place(end), [&](std::uint32_t other) {
            if (other / 2 == end / 2 || glm::distance(place(other), place(end)) > kMetPx) return;
            meets_end = true;
            if (key(other) < key(hub)) hub = other;
        });
        if (meets_end) {
            if (add(end, moved(hub)) && lines_[end / 2].is_moved && !lines_[hub / 2].is_moved)
                joints_.to_lines_that_stay.push_back({end / 2, place(end)});
            return;
        }
        std::optional<std::uint32_t> beside;
        double least = kMetPx;
        lines_in_.visit(place(end), [&](std::uint32_t line) {
            if (line == end / 2) return;
            const LinePiece& s = *lines_[line].given;
            const double distance = glm::distance(nearest_on(s.from, s.to, place(end)), place(end));
            if (distance < least || (distance == least && beside && place_key(line) < place_key(*beside))) {
                least = distance;
                beside = line;
            }
        });
        if (beside && (lines_[*beside].is_moved || lines_[end / 2].is_moved))
            add(end, nearest_on(lines_[*beside].points, moved(end)));
    }

  private:
    glm::dvec2 place(std::uint32_t end) const {
        const LinePiece& s = *lines_[end / 2].given;
        return end % 2 == 0 ? s.from : s.to;
    }
    glm::dvec2 moved(std::uint32_t end) const {
        const auto& points = lines_[end / 2].points;
        return end % 2 == 0 ? points.front() : points.back();
    }
    /// Orders ends that met: the others are joined to the first one, which is one that stayed, if any did.
    std::tuple<bool, double, double> key(std::uint32_t end) const {
        const glm::dvec2 p = moved(end);
        return {lines_[end / 2].is_moved, p.x, p.y};
    }
    std::tuple<double, double, double, double> place_key(std::uint32_t line) const {
        const LinePiece& s = *lines_[line].given;
        return {s.from.x, s.from.y, s.to.x, s.to.y};
    }
    bool add(std::uint32_t end, glm::dvec2 to) {
        if (!(glm::distance(moved(end), to) > kJoinedPx)) return false;
        joints_.pieces.push_back(*lines_[end / 2].given);
        joints_.pieces.back().from = moved(end);
        joints_.pieces.back().to = to;
        return true;
    }

    std::span<const MovedLine> lines_;
    Joints& joints_;
    Cells lines_in_, ends_in_;
};

}  // namespace

Joints find_joints(std::span<const MovedLine> lines) {
    Joints joints;
    Joiner joiner(lines, joints);
    for (std::uint32_t end = 0; end < 2 * lines.size(); ++end) joiner.join(end);
    return joints;
}

}  // namespace burin
