#include "lines/course_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/vectors.h"

namespace burin {
namespace {

/// Two courses run nearly the same way if the sine of the angle between them is at most this. For the shortest ones it
/// is how far the end may be off: snapping turns them.
constexpr double kMostTurned = 1.0 / 8, kMostOffPx = 1.0 / 32;
/// Shorter ones may run any way.
constexpr double kHasDirectionPx = kMostOffPx / kMostTurned;
constexpr int kSmallestCellOfWaysPx = 8, kSmallestCellOfEndsPx = 2;
constexpr std::int64_t kMostCells = 1 << 19;

/// Cuts [begin, end] to where a value that runs from `at_0` at 0 to `at_1` at 1 is within [low, high].
bool cut(double at_0, double at_1, double low, double high, double& begin, double& end) {
    if (at_0 == at_1) return at_0 >= low && at_0 <= high;
    const double a = (low - at_0) / (at_1 - at_0), b = (high - at_0) / (at_1 - at_0);
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
    return begin < end;
}

}  // namespace

CourseIndex::CourseIndex(PixelRect picture, double reach_px)
    : picture_(picture),
      reach_px_(reach_px),
      ways_(grid_of(kSmallestCellOfWaysPx)),
      ends_(grid_of(kSmallestCellOfEndsPx)) {}

CourseIndex::Grid CourseIndex::grid_of(int smallest_px) const {
    Grid grid{smallest_px, 0, 0};
    const auto count = [&](int length) { return std::int64_t{length} / grid.cell_px + 1; };
    while (grid.cell_px < 2 * reach_px_ || count(picture_.width()) * count(picture_.height()) > kMostCells)
        grid.cell_px *= 2;
    grid.columns = static_cast<int>(count(picture_.width()));
    grid.rows = static_cast<int>(count(picture_.height()));
    return grid;
}

/// The number of a direction, from 0; neighbours are at most a sixteenth of a half turn apart. kDirections: none.
int CourseIndex::direction_of(glm::dvec2 along) {
    if (!(glm::length(along) >= kHasDirectionPx)) return kDirections;
    const double half_turns = std::atan2(along.y, along.x) / std::numbers::pi;
    return static_cast<int>(std::floor(half_turns * kDirections) + kDirections) % kDirections;
}

void CourseIndex::add_to(Cells& cells, const Grid& grid, std::size_t cell, std::uint32_t course) {
    if (cells.empty())
        cells.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows), kNone);
    entries_.push_back({course, cells[cell]});
    cells[cell] = static_cast<std::uint32_t>(entries_.size() - 1);
}

template <typename Visit>
void CourseIndex::for_courses(const Cells& cells, std::size_t cell, const Visit& visit) const {
    if (cells.empty()) return;
    for (std::uint32_t i = cells[cell]; i != kNone; i = entries_[i].next) visit(entries_[i].course);
}

/// Ends outside the picture are in the cells at its sides.
void CourseIndex::note_end(glm::dvec2 place, std::uint32_t course) {
    const auto number = [&](double at, int origin, int count) {
        return static_cast<std::size_t>(std::clamp(std::floor((at - origin) / ends_.cell_px), 0.0, count - 1.0));
    };
    const std::size_t column = number(place.x, picture_.x0, ends_.columns),
                      row = number(place.y, picture_.y0, ends_.rows);
    add_to(by_end_, ends_, row * static_cast<std::size_t>(ends_.columns) + column, course);
}

/// Calls visit(cell) for the cells that come within `around_px` of a way, and perhaps for a few more.
template <typename Visit>
void CourseIndex::for_cells(const Grid& grid, glm::dvec2 from, glm::dvec2 to, double around_px,
                            const Visit& visit) const {
    const glm::dvec2 origin(picture_.x0, picture_.y0);
    glm::dvec2 a = (from - origin) / double(grid.cell_px), b = (to - origin) / double(grid.cell_px);
    const double around = around_px / grid.cell_px;
    // The way is followed along the axis in which it is longer, column by column (or row by row).
    const int major = std::abs(b.x - a.x) >= std::abs(b.y - a.y) ? 0 : 1, minor = 1 - major;
    if (b[major] < a[major]) std::swap(a, b);
    const int count[2] = {grid.columns, grid.rows};
    const auto clamped = [](double v, int end) {
        return static_cast<int>(std::clamp(std::floor(v), -1.0, static_cast<double>(end)));
    };
    const double slope = b[major] > a[major] ? (b[minor] - a[minor]) / (b[major] - a[major]) : 0;
    const int last = std::min(clamped(b[major] + around, count[major]), count[major] - 1);
    for (int i = std::max(clamped(a[major] - around, count[major]), 0); i <= last; ++i) {
        const double begin = std::clamp(i - around, a[major], b[major]),
                     end = std::clamp(i + 1 + around, a[major], b[major]);
        const double p = a[minor] + slope * (begin - a[major]), q = a[minor] + slope * (end - a[major]);
        const int high = std::min(clamped(std::max(p, q) + around, count[minor]), count[minor] - 1);
        for (int j = std::max(clamped(std::min(p, q) - around, count[minor]), 0); j <= high; ++j) {
            visit(static_cast<std::size_t>(major == 0 ? j * grid.columns + i : i * grid.columns + j));
        }
    }
}

std::uint32_t CourseIndex::add(glm::dvec2 from, glm::dvec2 to) {
    const auto course = static_cast<std::uint32_t>(courses_.size());
    courses_.push_back({from, to});
    asked_.push_back(0);
    Cells& alike = by_direction_[static_cast<std::size_t>(direction_of(to - from))];
    for_cells(ways_, from, to, 0, [&](std::size_t cell) { add_to(alike, ways_, cell, course); });
    note_end(from, course);
    note_end(to, course);
    return course;
}

/// Adds the part of a way that is beside a course.
void CourseIndex::add_overlap(const Course& way, std::uint32_t course) {
    const Course& c = courses_[course];
    const glm::dvec2 along = c.to - c.from, way_along = way.to - way.from;
    const double length = glm::length(along), way_length = glm::length(way_along);
    if (!(length > 0)) return;
    const double across = std::abs(cross(along, way_along)) / std::max(length, way_length);  // of the shorter one's end
    if (across > std::max(kMostTurned * std::min(length, way_length), kMostOffPx)) return;
    double begin = 0, end = 1;
    const glm::dvec2 p = way.from - c.from, q = way.to - c.from;
    if (!cut(glm::dot(p, along), glm::dot(q, along), 0, length * length, begin, end)) return;
    const double reach = reach_px_ * length;
    if (!cut(cross(along, p), cross(along, q), -reach, reach, begin, end)) return;
    overlaps_.push_back({begin, end, course});
}

/// Makes covers of overlaps: at every place the first course counts.
void CourseIndex::choose_first_courses() {
    struct Change {
        double at;
        std::uint32_t course;
        bool begins;
    };
    std::vector<Change> changes;
    for (const Cover& o : overlaps_) {
        changes.push_back({o.begin, o.course, true});
        changes.push_back({o.end, o.course, false});
    }
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
        return a.at != b.at ? a.at < b.at : a.course != b.course ? a.course < b.course : a.begins && !b.begins;
    });
    std::set<std::uint32_t> here;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        if (changes[i].begins)
            here.insert(changes[i].course);
        else
            here.erase(changes[i].course);
        if (here.empty() || i + 1 == changes.size() || changes[i + 1].at == changes[i].at) continue;
        const double begin = changes[i].at, end = changes[i + 1].at;
        if (!covers_.empty() && covers_.back().end == begin && covers_.back().course == *here.begin()) {
            covers_.back().end = end;
        } else {
            covers_.push_back({begin, end, *here.begin()});
        }
    }
}

/// Leaves out the shortest covers, unless they cover most of the way, and closes the shortest gaps.
void CourseIndex::drop_short(double length_px) {
    const double gap = shortest_px() / length_px, least = std::min(gap, 0.5);
    std::size_t kept = 0;
    for (std::size_t first = 0; first < covers_.size();) {
        std::size_t end = first + 1;
        while (end < covers_.size() && covers_[end].begin - covers_[end - 1].end < gap) {
            covers_[end - 1].end = covers_[end].begin;
            ++end;
        }
        if (covers_[end - 1].end - covers_[first].begin >= least) {
            for (std::size_t i = first; i < end; ++i) covers_[kept++] = covers_[i];
        }
        first = end;
    }
    covers_.resize(kept);
    if (covers_.empty()) return;
    if (covers_.front().begin < gap) covers_.front().begin = 0;
    if (covers_.back().end > 1 - gap) covers_.back().end = 1;
}

std::span<const CourseIndex::Cover> CourseIndex::find(glm::dvec2 from, glm::dvec2 to) {
    overlaps_.clear();
    covers_.clear();
    const double length = glm::distance(from, to);
    if (courses_.empty() || !(length > 0)) return {};
    ++find_count_;
    const int direction = direction_of(to - from);
    const auto may_run_alike = [&](int other) {
        const int apart = std::abs(other - direction);
        return direction == kDirections || other == kDirections || apart <= 1 || apart == kDirections - 1;
    };
    for_cells(ways_, from, to, reach_px_, [&](std::size_t cell) {
        for (int other = 0; other <= kDirections; ++other) {
            if (!may_run_alike(other)) continue;
            for_courses(by_direction_[static_cast<std::size_t>(other)], cell, [&](std::uint32_t course) {
                if (asked_[course] == find_count_) return;
                asked_[course] = find_count_;
                add_overlap({from, to}, course);
            });
        }
    });
    if (overlaps_.empty()) return {};
    choose_first_courses();
    drop_short(length);
    return covers_;
}

std::span<const std::uint32_t> CourseIndex::that_end_near(glm::dvec2 place) {
    near_.clear();
    for_cells(ends_, place, place, reach_px_, [&](std::size_t cell) {
        for_courses(by_end_, cell, [&](std::uint32_t course) { near_.push_back(course); });
    });
    return near_;
}

}  // namespace burin
