#include "output/paths/chain_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/interrupt.h"
#include "lines/end_links.h"

namespace burin {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Ends that are no farther apart are at one place.
constexpr double kTogetherPx = 1.0 / 16;
/// Parts of one run may be so far apart, and a line shorter than a pixel from the one that it goes on in.
constexpr double kGapPx = 0.5;
/// Dashes go on if a pattern is off by no more than this.
constexpr double kPhasePx = 1.0 / 8;
/// Where more than two lines end, those belong together that turn by less than this cosine says.
constexpr double kStraightCosine = -0.5;
/// Where more ends than this meet, only lines of one edge are joined.
constexpr std::size_t kMostAtPlace = 64;

/// Chainer links the ends of lines, numbered as EndLinks does.
class Chainer {
  public:
    explicit Chainer(const PathLines& lines) : lines_(lines), links_(lines.lines.size()) {}

    PathLines chained(bool joins_crumbs) {
        link();
        link_runs();
        if (joins_crumbs) link_crumbs();
        PathLines result = lines_.without_points();
        result.edges.clear();
        links_.for_chains([&](std::vector<std::uint32_t>& ends, bool is_loop) { add_chain(ends, is_loop, result); });
        put_in_order(result);
        return result;
    }

  private:
    const PathLine& line(std::uint32_t end) const { return lines_.lines[end / 2]; }
    glm::dvec2 place(std::uint32_t end) const {
        const PathLine& l = line(end);
        return lines_.points[end % 2 == 0 ? l.first_point : l.first_point + l.point_count - 1];
    }
    /// From the end into the line, of length 1.
    glm::dvec2 inwards(std::uint32_t end) const {
        const std::span<const glm::dvec2> points = lines_.points_of(line(end));
        const std::size_t n = points.size();
        for (std::size_t i = 1; i < n; ++i) {
            const glm::dvec2 way = end % 2 == 0 ? points[i] - points[0] : points[n - 1 - i] - points[n - 1];
            const double length = glm::length(way);
            if (length > kTogetherPx || (i + 1 == n && length > 0)) return way / length;
        }
        return glm::dvec2(0.0);
    }

    /// `gap_px`: how far the two ends are apart.
    bool can_join(std::uint32_t a, std::uint32_t b, double gap_px = 0) const {
        const PathLine &x = line(a), &y = line(b);
        if (x.kind != y.kind || x.object != y.object) return false;
        const VectorStyle& style = lines_.styles[x.kind.style];
        if (style.dash_px.empty()) return true;
        // A pattern goes on from the end of one line to the beginning of the other.
        if (a % 2 == b % 2) return false;
        const std::uint32_t before = a % 2 == 1 ? a : b, after = a % 2 == 1 ? b : a;
        double period = 0;
        for (const float length : style.dash_px) period += static_cast<double>(length);
        const double off = std::remainder(static_cast<double>(line(before).dash_phase_px) + length_of(before) -
                                              static_cast<double>(line(after).dash_phase_px),
                                          std::max(period, kPhasePx));
        return std::abs(off) <= kPhasePx + gap_px;
    }
    double length_of(std::uint32_t end) const {
        double length = 0;
        const std::span<const glm::dvec2> points = lines_.points_of(line(end));
        for (std::size_t i = 1; i < points.size(); ++i) length += glm::distance(points[i - 1], points[i]);
        return length;
    }

    /// An end by rows and columns of cells; those at one place lie in neighbouring cells.
    struct Cell {
        std::int32_t row, column;
        std::uint32_t end;
        auto operator<=>(const Cell&) const = default;
    };
    /// For long lists, which are sorted until an interrupt.
    template <typename T>
    static bool is_before(const T& a, const T& b) {
        throw_if_interrupted();
        return a < b;
    }
    static std::int32_t number(double at) {
        return static_cast<std::int32_t>(std::floor(std::clamp(at / (2 * kTogetherPx), -1e9, 1e9)));
    }
    /// The end in sorted cells that lies nearest to a place, at most `reach_px` from it, of those that may be it;
    /// kNone: there is none.
    template <typename MayBe>
    std::uint32_t nearest_end(const std::vector<Cell>& cells, glm::dvec2 p, double reach_px,
                              const MayBe& may_be) const {
        std::uint32_t found = kNone;
        double nearest = reach_px;
        const std::int32_t first = number(p.x - reach_px), last = number(p.x + reach_px);
        for (std::int32_t row = number(p.y - reach_px); row <= number(p.y + reach_px); ++row) {
            for (auto it = std::lower_bound(cells.begin(), cells.end(), Cell{row, first, 0});
                 it != cells.end() && it->row == row && it->column <= last; ++it) {
                const double distance = glm::distance(place(it->end), p);
                if (distance > nearest || (distance == nearest && found != kNone) || !may_be(it->end)) continue;
                nearest = distance;
                found = it->end;
            }
        }
        return found;
    }

    void link() {
        for (std::uint32_t end = 0; end < 2 * lines_.lines.size(); ++end) {
            const PathLine& l = line(end);
            if (l.is_closed || lines_.styles[l.kind.style].is_outline()) continue;
            const glm::dvec2 p = place(end);
            cells_.push_back({number(p.y), number(p.x), end});
        }
        std::sort(cells_.begin(), cells_.end(), is_before<Cell>);
        // Each end belongs to the nearest of the places that are there, or begins one. These are not close together, so
        // few of them are looked at.
        std::vector<Cell> places;
        std::vector<std::uint32_t> place_of(2 * lines_.lines.size(), kNone);
        for (const Cell& cell : cells_) {
            throw_if_interrupted();
            const std::uint32_t found =
                nearest_end(places, place(cell.end), kTogetherPx, [](std::uint32_t) { return true; });
            if (found == kNone) places.push_back(cell);
            place_of[cell.end] = found == kNone ? cell.end : found;
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
        ends.reserve(cells_.size());
        for (const Cell& cell : cells_) ends.emplace_back(place_of[cell.end], cell.end);
        std::sort(ends.begin(), ends.end(), is_before<std::pair<std::uint32_t, std::uint32_t>>);
        std::vector<std::uint32_t> own;
        for (std::size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
            own.clear();
            for (; end < ends.size() && ends[end].first == ends[begin].first; ++end) own.push_back(ends[end].second);
            throw_if_interrupted();
            link_place(own);
        }
    }

    /// What is left that is shorter than a pixel goes on in the nearest line of its kind over a small gap, where this
    /// one ends as well.
    void link_crumbs() {
        for (std::uint32_t end = 0; end < 2 * lines_.lines.size(); ++end) {
            throw_if_interrupted();
            const PathLine& l = line(end);
            const VectorStyle& style = lines_.styles[l.kind.style];
            if (!links_.is_free(end) || l.is_closed || style.is_outline() || !style.dash_px.empty()) continue;
            if (length_of(end) >= kCrumbPx) continue;
            const std::uint32_t found = nearest_end(cells_, place(end), kGapPx, [&](std::uint32_t other) {
                return other / 2 != end / 2 && links_.is_free(other) && can_join(end, other);
            });
            if (found != kNone) links_.link(end, found);
        }
    }

    /// Strokes of one run that follow each other go on over small gaps, as runs do.
    void link_runs() {
        for (std::uint32_t end = 1; end + 1 < 2 * lines_.lines.size(); end += 2) {
            throw_if_interrupted();
            if (line(end).chain != line(end + 1).chain || !links_.is_free(end) || !links_.is_free(end + 1)) continue;
            const double gap_px = glm::distance(place(end), place(end + 1));
            if (lines_.styles[line(end).kind.style].is_outline() || line(end).is_closed || line(end + 1).is_closed ||
                gap_px > kGapPx || !can_join(end, end + 1, gap_px))
                continue;
            links_.link(end, end + 1);
        }
    }

    void link_place(std::vector<std::uint32_t>& ends) {
        // Those of one kind and object are next to each other.
        std::sort(ends.begin(), ends.end(), [this](std::uint32_t a, std::uint32_t b) {
            const auto key = [this](std::uint32_t e) { return std::tuple(line(e).kind, line(e).object, e); };
            return key(a) < key(b);
        });
        for (std::size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
            while (end < ends.size() && line(ends[end]).kind == line(ends[begin]).kind &&
                   line(ends[end]).object == line(ends[begin]).object)
                ++end;
            link_kind(std::span(ends).subspan(begin, end - begin));
        }
    }

    void link_kind(std::span<const std::uint32_t> ends) {
        if (ends.size() < 2) return;
        if (ends.size() == 2) {
            if (can_join(ends[0], ends[1]) && !is_spot(ends[0], ends[1])) links_.link(ends[0], ends[1]);
            return;
        }
        struct Pair {
            double turn;  // less is better
            std::uint32_t a, b;
            auto operator<=>(const Pair&) const = default;
        };
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const std::size_t last = ends.size() <= kMostAtPlace ? ends.size() : std::min(i + 2, ends.size());
            for (std::size_t j = i + 1; j < last; ++j) {
                if (ends[i] / 2 == ends[j] / 2 || !can_join(ends[i], ends[j])) continue;
                const double cosine = glm::dot(inwards(ends[i]), inwards(ends[j]));
                const bool is_same_edge = name_at(ends[i]) == name_at(ends[j]);
                if (cosine > kStraightCosine && !(is_same_edge && line(ends[i]).chain == line(ends[j]).chain)) continue;
                pairs.push_back({cosine - (is_same_edge ? 4 : 0), ends[i], ends[j]});
            }
        }
        std::sort(pairs.begin(), pairs.end());
        for (const Pair& pair : pairs) {
            if (links_.is_free(pair.a) && links_.is_free(pair.b)) links_.link(pair.a, pair.b);
        }
    }
    std::uint64_t name_at(std::uint32_t end) const {
        const PathLine& l = line(end);
        return lines_.edges[l.first_edge + (end % 2 == 0 ? 0 : l.edge_count - 1)];
    }
    std::uint64_t end_edge(std::uint32_t end) const { return line(end).end_edges[end % 2]; }
    /// Whether two ends are both ends of a line so short that it would be closed to nothing.
    bool is_spot(std::uint32_t a, std::uint32_t b) const { return a / 2 == b / 2 && length_of(a) < 4 * kTogetherPx; }

    void add_chain(std::vector<std::uint32_t>& ends, bool is_loop, PathLines& out) const {
        throw_if_interrupted();
        // A pattern of dashes runs as its lines do.
        if (ends.front() % 2 == 1 && !lines_.styles[line(ends.front()).kind.style].dash_px.empty()) {
            std::reverse(ends.begin(), ends.end());
            for (std::uint32_t& end : ends) end = EndLinks::other_end(end);
        }
        PathLine chain = line(ends.front());
        chain.first_point = out.points.size();
        chain.first_edge = out.edges.size();
        chain.is_closed = chain.is_closed || is_loop;
        for (const std::uint32_t end : ends) {
            const PathLine& l = line(end);
            chain.nearness = std::max(chain.nearness, l.nearness);
            chain.chain = std::min(chain.chain, l.chain);
            chain.invisibility = std::min(chain.invisibility, l.invisibility);
            const std::span<const glm::dvec2> points = lines_.points_of(l);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const glm::dvec2 p = points[EndLinks::is_beginning(end) ? i : points.size() - 1 - i];
                // Ends that are a little apart become one point.
                if (i == 0 && out.points.size() > chain.first_point &&
                    glm::distance(out.points.back(), p) <= 2 * kTogetherPx)
                    continue;
                out.points.push_back(p);
            }
            const auto first = lines_.edges.begin() + static_cast<std::ptrdiff_t>(l.first_edge);
            out.edges.insert(out.edges.end(), first, first + static_cast<std::ptrdiff_t>(l.edge_count));
        }
        if (chain.is_closed && out.points.back() != out.points[chain.first_point]) {
            if (glm::distance(out.points.back(), out.points[chain.first_point]) <= 2 * kTogetherPx)
                out.points.back() = out.points[chain.first_point];
            else
                out.points.push_back(out.points[chain.first_point]);
        }
        chain.point_count = out.points.size() - chain.first_point;
        const auto first = out.edges.begin() + static_cast<std::ptrdiff_t>(chain.first_edge);
        std::sort(first, out.edges.end());
        out.edges.erase(std::unique(first, out.edges.end()), out.edges.end());
        chain.edge_count = out.edges.size() - chain.first_edge;
        chain.end_edges = {end_edge(ends.front()), end_edge(EndLinks::other_end(ends.back()))};
        out.lines.push_back(chain);
    }

    /// Lines begin at their upper end, loops at their highest point, and run clockwise, as far as they have no dashes.
    void put_in_order(PathLines& result) const {
        const auto is_above = [](glm::dvec2 a, glm::dvec2 b) { return std::pair(a.y, a.x) < std::pair(b.y, b.x); };
        for (PathLine& l : result.lines) {
            throw_if_interrupted();
            const VectorStyle& style = result.styles[l.kind.style];
            if (!style.dash_px.empty() || style.is_outline()) continue;
            const auto first = result.points.begin() + static_cast<std::ptrdiff_t>(l.first_point);
            const auto last = first + static_cast<std::ptrdiff_t>(l.point_count);
            if (!l.is_closed) {
                if (!is_above(*first, *(last - 1))) {
                    std::reverse(first, last);
                    std::swap(l.end_edges[0], l.end_edges[1]);
                }
                continue;
            }
            double area = 0;
            for (auto p = first; p + 1 != last; ++p) area += p->x * (p + 1)->y - (p + 1)->x * p->y;
            if (area < 0) std::reverse(first, last);
            std::rotate(first, std::min_element(first, last - 1, is_above), last - 1);
            *(last - 1) = *first;
        }
        std::sort(result.lines.begin(), result.lines.end(), [&result](const PathLine& a, const PathLine& b) {
            throw_if_interrupted();
            if (a.kind.order != b.kind.order) return b.kind.order < a.kind.order;  // what is less lies above
            const auto key = [&result](const PathLine& l) {
                const glm::dvec2 p = result.points[l.first_point], q = result.points[l.first_point + 1];
                return std::tuple(-static_cast<int>(l.kind.invisibility), l.nearness, l.kind.style, p.y, p.x, q.y, q.x,
                                  l.point_count, l.chain);
            };
            return key(a) < key(b);
        });
    }

    const PathLines& lines_;
    EndLinks links_;
    std::vector<Cell> cells_;  ///< of the ends that can be joined
};

}  // namespace

PathLines chained_paths(const PathLines& lines, bool joins_crumbs) { return Chainer(lines).chained(joins_crumbs); }

}  // namespace burin
