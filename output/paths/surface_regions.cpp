#include "output/paths/surface_regions.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "base/interrupt.h"
#include "output/paths/simplify.h"

namespace burin {
namespace {

/// Of strokes around opaque regions.
constexpr float kSeamPx = 0.5f;
/// How far edges may be from the middles of the grid's steps, in its cells.
constexpr double kEdgeCells = 0.5;

// Directions along the grid's lines, clockwise, y downwards.
constexpr int kWays[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/// EdgeTracer follows the edges between cells of different looks from one node where three or more meet to the next,
/// and joins them to loops around regions.
class EdgeTracer {
  public:
    explicit EdgeTracer(const SurfaceGrid& grid)
        : grid_(grid), columns_(grid.columns()), rows_(grid.rows()), is_done_{bits(), bits()} {}

    void trace() {
        for (const bool at_nodes : {true, false}) {  // then loops that meet no other edge
            for (int y = 0; y <= rows_; ++y) {
                throw_if_interrupted();
                for (int x = 0; x <= columns_; ++x) {
                    if (!has_edge_at(x, y) || (at_nodes && degree(x, y) < 3)) continue;
                    for (int way = 0; way < 4; ++way) {
                        if (is_edge(x, y, way) && !is_done(x, y, way)) follow(x, y, way);
                    }
                }
            }
        }
        for (std::uint32_t half = 0; half < 2 * edges_.size(); ++half) {
            const Edge& edge = edges_[half / 2];
            if (!edge.is_loop) starts_.emplace_back(half % 2 == 0 ? edge.begin : edge.end, half);
        }
        std::sort(starts_.begin(), starts_.end());
    }

    /// Edges without the points that they can do without.
    void simplify_edges(double bound_px) {
        lines_.clear();
        for (const Edge& edge : edges_) {
            throw_if_interrupted();
            lines_.emplace_back();
            simplify(edge.points, bound_px, lines_.back());
        }
    }

    /// The loops around all regions of a look, which lie to their left. Those that enclose nothing are left out.
    std::vector<std::vector<glm::dvec2>> loops_of(std::uint32_t look, std::span<const std::uint32_t> halves) {
        std::vector<std::vector<glm::dvec2>> loops;
        is_used_.resize(2 * edges_.size(), false);
        for (const std::uint32_t first : halves) {
            if (is_used_[first]) continue;
            std::vector<glm::dvec2> loop;
            for (std::uint32_t half = first; !is_used_[half];) {
                is_used_[half] = true;
                add(half, loop);
                if (!edges_[half / 2].is_loop) half = next_of(half, look);
            }
            loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
            if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
            if (loop.size() > 2) loops.push_back(std::move(loop));
        }
        for (const std::uint32_t half : halves) is_used_[half] = false;
        return loops;
    }

    /// For each look, the edges that it lies to the left of: twice their number, plus 1 backwards.
    std::vector<std::vector<std::uint32_t>> halves_by_look() const {
        std::vector<std::vector<std::uint32_t>> halves(grid_.looks.size());
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            halves[edges_[i].left].push_back(2 * i);
            halves[edges_[i].right].push_back(2 * i + 1);
        }
        return halves;
    }

  private:
    using Key = std::uint64_t;  ///< a node and a direction
    struct Edge {
        std::uint32_t left = 0, right = 0;
        Key begin = 0, end = 0;  ///< where it goes away from its nodes
        bool is_loop = false;
        std::vector<glm::dvec2> points;
    };

    std::vector<bool> bits() const {
        return std::vector<bool>(static_cast<std::size_t>(columns_ + 1) * static_cast<std::size_t>(rows_ + 1));
    }
    std::uint32_t look(int x, int y) const {
        if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return 0;
        return grid_
            .look_at[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x)];
    }
    /// The looks to the left and to the right of the way from a node to the next one.
    std::array<std::uint32_t, 2> beside(int x, int y, int way) const {
        switch (way) {
            case 0:
                return {look(x, y - 1), look(x, y)};
            case 1:
                return {look(x, y), look(x - 1, y)};
            case 2:
                return {look(x - 1, y), look(x - 1, y - 1)};
            default:
                return {look(x - 1, y - 1), look(x, y - 1)};
        }
    }
    bool is_edge(int x, int y, int way) const {
        const auto [left, right] = beside(x, y, way);
        return left != right;
    }
    /// Whether any edge meets a node; quick, for most have none.
    bool has_edge_at(int x, int y) const {
        const std::uint32_t first = look(x, y);
        return first != look(x - 1, y) || first != look(x, y - 1) || first != look(x - 1, y - 1);
    }
    int degree(int x, int y) const {
        int count = 0;
        for (int way = 0; way < 4; ++way) count += is_edge(x, y, way) ? 1 : 0;
        return count;
    }
    std::size_t node(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_ + 1) + static_cast<std::size_t>(x);
    }
    /// Where it is kept whether an edge is done: with the node at its left or upper end.
    std::vector<bool>::reference done(int x, int y, int way) {
        if (way >= 2) {
            x += kWays[way][0];
            y += kWays[way][1];
        }
        return is_done_[way % 2][node(x, y)];
    }
    bool is_done(int x, int y, int way) { return done(x, y, way); }

    /// The place between two places of the grid, 0 and the grid's size being the picture's border.
    double at(double cell, int count, double place, int border) const {
        if (cell <= 0) return border;
        if (cell >= count) return border + static_cast<double>(count) / grid_.places_per_px;
        return border + (cell - 0.5 + place) / grid_.places_per_px;
    }
    glm::dvec2 place_of(double x, double y) const {
        return {at(x, columns_, grid_.place.x, grid_.area.x0), at(y, rows_, grid_.place.y, grid_.area.y0)};
    }

    /// Cells in a row, along an edge.
    struct Run {
        int x, y, way, length;
    };
    glm::dvec2 place_on(const Run& run, double cells) const {
        return place_of(run.x + cells * kWays[run.way][0], run.y + cells * kWays[run.way][1]);
    }
    /// How far from its end in the run before a straight edge passes a run: in its middle on slanted edges, where every
    /// other run has one cell and those between have about as many; at its end where there is a corner.
    static double inset(const Run& run, const Run* before, const Run* two_before) {
        if (run.length == 1) return 0.5;
        if (before == nullptr || before->length > 1) return 0;
        if (two_before == nullptr || two_before->way != run.way) return 1;
        return 0.5 * std::min(run.length, two_before->length + 1);
    }
    void add_points(std::span<const Run> runs, Edge& edge) const {
        const std::size_t n = runs.size();
        const auto run_at = [&](std::size_t i, int off) -> const Run* {
            const auto at = static_cast<std::ptrdiff_t>(i) + off, count = static_cast<std::ptrdiff_t>(n);
            if (edge.is_loop) return &runs[static_cast<std::size_t>((at + 2 * count) % count)];
            return at < 0 || at >= count ? nullptr : &runs[static_cast<std::size_t>(at)];
        };
        if (!edge.is_loop) edge.points.push_back(place_on(runs.front(), 0));
        for (std::size_t i = 0; i < n; ++i) {
            const double length = runs[i].length;
            const double begin = inset(runs[i], run_at(i, -1), run_at(i, -2)),
                         end = length - inset(runs[i], run_at(i, 1), run_at(i, 2));
            if (end - begin < 0.5) {
                edge.points.push_back(place_on(runs[i], 0.5 * (begin + end)));
            } else {
                edge.points.push_back(place_on(runs[i], begin));
                edge.points.push_back(place_on(runs[i], end));
            }
        }
        edge.points.push_back(edge.is_loop ? edge.points.front() : place_on(runs.back(), runs.back().length));
    }

    void follow(int x, int y, int way) {
        Edge edge;
        std::tie(edge.left, edge.right) = std::pair(beside(x, y, way)[0], beside(x, y, way)[1]);
        edge.begin = 4 * Key{node(x, y)} + static_cast<Key>(way);
        edge.is_loop = degree(x, y) == 2;
        const int first_x = x, first_y = y;
        runs_.clear();
        while (true) {
            done(x, y, way) = true;
            if (runs_.empty() || runs_.back().way != way) runs_.push_back({x, y, way, 0});
            ++runs_.back().length;
            x += kWays[way][0];
            y += kWays[way][1];
            if (degree(x, y) != 2 || (x == first_x && y == first_y)) break;
            for (const int turn : {3, 0, 1}) {
                if (!is_edge(x, y, (way + turn) % 4)) continue;
                way = (way + turn) % 4;
                break;
            }
        }
        add_points(runs_, edge);
        edge.end = 4 * Key{node(x, y)} + static_cast<Key>((way + 2) % 4);
        edges_.push_back(std::move(edge));
    }

    void add(std::uint32_t half, std::vector<glm::dvec2>& loop) const {
        const std::vector<glm::dvec2>& line = lines_[half / 2];
        if (half % 2 == 0) {
            loop.insert(loop.end(), line.begin(), line.end());
        } else {
            loop.insert(loop.end(), line.rbegin(), line.rend());
        }
    }
    /// What goes on around the same cell at the end of an edge.
    std::uint32_t next_of(std::uint32_t half, std::uint32_t look) const {
        const Edge& edge = edges_[half / 2];
        const Key end = half % 2 == 0 ? edge.end : edge.begin;  // pointing back
        for (const Key turn : {1, 2, 3}) {                      // left, straight on, right
            const Key way = end / 4 * 4 + (end + turn) % 4;
            const auto found = std::lower_bound(starts_.begin(), starts_.end(), std::pair(way, std::uint32_t{0}));
            if (found == starts_.end() || found->first != way) continue;
            const Edge& next = edges_[found->second / 2];
            if ((found->second % 2 == 0 ? next.left : next.right) == look) return found->second;
        }
        return half;
    }

    const SurfaceGrid& grid_;
    int columns_, rows_;
    std::array<std::vector<bool>, 2> is_done_;
    std::vector<Run> runs_;  ///< of the edge that is followed
    std::vector<Edge> edges_;
    std::vector<std::vector<glm::dvec2>> lines_;
    std::vector<std::pair<Key, std::uint32_t>> starts_;
    std::vector<bool> is_used_;
};

std::uint32_t style_number(const SurfaceGrid::Look& look, VectorDrawing& drawing) {
    VectorStyle style;
    style.is_region = true;
    style.color = look.color;
    style.opacity = look.opacity;
    style.width_px = look.opacity < 1 ? 0 : kSeamPx;
    const auto found = std::find(drawing.styles.begin(), drawing.styles.end(), style);
    if (found != drawing.styles.end()) return static_cast<std::uint32_t>(found - drawing.styles.begin());
    drawing.styles.push_back(style);
    return static_cast<std::uint32_t>(drawing.styles.size() - 1);
}

/// Adds a path of loops, and returns how many steps it has.
std::size_t add_path(const std::vector<std::vector<glm::dvec2>>& loops, VectorPath path, VectorDrawing& drawing) {
    path.first_step = drawing.steps.size();
    path.start = loops.front().front();
    path.is_closed = true;
    for (const std::vector<glm::dvec2>& loop : loops) {
        PathStep step;
        if (&loop != &loops.front()) {
            step.kind = PathStep::Kind::move;
            step.to = loop.front();
            drawing.steps.push_back(step);
        }
        step.kind = PathStep::Kind::line;
        for (std::size_t i = 1; i <= loop.size(); ++i) {
            step.to = loop[i % loop.size()];
            drawing.steps.push_back(step);
        }
    }
    path.step_count = drawing.steps.size() - path.first_step;
    drawing.paths.push_back(path);
    return path.step_count;
}

}  // namespace

void add_surface_regions(const SurfaceGrid& grid, VectorDrawing& drawing) {
    EdgeTracer tracer(grid);
    tracer.trace();
    const std::vector<std::vector<std::uint32_t>> halves = tracer.halves_by_look();
    std::vector<std::uint32_t> order;
    for (std::uint32_t look = 1; look < grid.looks.size(); ++look) order.push_back(look);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto key = [&](std::uint32_t i) {
            const SurfaceGrid::Look& l = grid.looks[i];
            return std::tuple(l.object, l.color.r, l.color.g, l.color.b, l.opacity, i);
        };
        return key(a) < key(b);
    });
    // Coarser, where a path would have more steps than all programs take.
    constexpr int kMostRounds = 12;
    double bound_px = kEdgeCells / grid.places_per_px;
    const std::size_t first_path = drawing.paths.size(), first_step = drawing.steps.size();
    std::vector<VectorGroup> groups;
    for (int round = 0; round < kMostRounds; ++round, bound_px *= 2) {
        drawing.paths.resize(first_path);
        drawing.steps.resize(first_step);
        groups.clear();
        std::size_t most_steps = 0;
        tracer.simplify_edges(bound_px);
        for (const std::uint32_t look : order) {
            const auto loops = tracer.loops_of(look, halves[look]);
            if (loops.empty()) continue;
            VectorPath path;
            path.object = grid.looks[look].object;
            path.style = style_number(grid.looks[look], drawing);
            if (groups.empty() || groups.back().object != path.object) {
                VectorGroup group;
                group.is_surface = true;
                group.object = path.object;
                group.first_path = drawing.paths.size();
                groups.push_back(group);
            }
            ++groups.back().path_count;
            most_steps = std::max(most_steps, add_path(loops, path, drawing));
        }
        if (most_steps <= kMostPathSteps) break;
    }
    drawing.groups.insert(drawing.groups.begin(), groups.begin(), groups.end());
}

std::string note_on_means(const SurfaceGrid& grid) {
    if (grid.mean_objects == 0) return {};
    return "a region has one colour: " + std::to_string(grid.mean_objects) +
           (grid.mean_objects == 1 ? " object that varies in it has its mean"
                                   : " objects that vary in it have their means");
}

}  // namespace burin
