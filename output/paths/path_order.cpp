#include "output/paths/path_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/interrupt.h"
#include "output/paths/end_tree.h"

namespace burin {
namespace {

glm::dvec2 end_of(const VectorDrawing& drawing, const VectorPath& path) {
    return path.step_count == 0 ? path.start : drawing.steps_of(path).back().to;
}

/// The steps of a path from its end to its start, and where that is.
std::vector<PathStep> reversed_steps(const VectorDrawing& drawing, const VectorPath& path) {
    std::vector<PathStep> steps(drawing.steps_of(path).begin(), drawing.steps_of(path).end());
    glm::dvec2 from = path.start;
    for (PathStep& step : steps) {
        std::swap(from, step.to);
        if (step.kind == PathStep::Kind::cubic) std::swap(step.a, step.b);
        if (step.kind == PathStep::Kind::arc) step.is_clockwise = !step.is_clockwise;
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
}

void reverse(VectorDrawing& drawing, VectorPath& path) {
    const std::vector<PathStep> steps = reversed_steps(drawing, path);
    path.start = end_of(drawing, path);
    std::copy(steps.begin(), steps.end(), drawing.steps.begin() + static_cast<std::ptrdiff_t>(path.first_step));
}

bool can_turn(const VectorDrawing& drawing, const VectorPath& path) {
    return drawing.styles[path.style].dash_px.empty();
}

double travel(const VectorDrawing& drawing) {
    double px = 0;
    for (std::size_t i = 1; i < drawing.paths.size(); ++i)
        px += glm::distance(end_of(drawing, drawing.paths[i - 1]), drawing.paths[i].start);
    return px;
}

/// A place rounded as files round it.
std::uint64_t key_of(glm::dvec2 p) {
    const auto rounded = [](double v) {
        return static_cast<std::uint64_t>(std::llround(std::clamp(v, -1e6, 1e6) * 100) + 200000000);
    };
    return rounded(p.x) << 32 | rounded(p.y);
}

/// Joins the paths of one group.
class PathMerger {
  public:
    PathMerger(const VectorDrawing& drawing, std::span<const VectorPath> paths)
        : drawing_(drawing), paths_(paths), is_done_(paths.size()) {
        for (std::size_t i = 0; i < paths.size(); ++i) {
            if (!joins(paths[i])) continue;
            ends_[key_of(paths[i].start)].push_back(2 * i);
            ends_[key_of(end_of(drawing, paths[i]))].push_back(2 * i + 1);
        }
    }

    /// Adds what the paths become to another drawing.
    void add_to(VectorDrawing& merged) {
        for (std::size_t i = 0; i < paths_.size(); ++i) {
            throw_if_interrupted();
            if (is_done_[i]) continue;
            is_done_[i] = true;
            begin(paths_[i]);
            if (joins(paths_[i])) {
                // From its end on, and then, turned round, from its start on.
                go_on();
                turn_round();
                go_on();
                turn_round();
                path_.is_closed = steps_.size() > paths_[i].step_count && key_of(path_.start) == key_of(end());
                if (path_.is_closed) steps_.back().to = path_.start;
            }
            path_.first_step = merged.steps.size();
            path_.step_count = steps_.size();
            path_.first_edge = merged.edges.size();
            path_.edge_count = names_.size();
            merged.steps.insert(merged.steps.end(), steps_.begin(), steps_.end());
            merged.edges.insert(merged.edges.end(), names_.begin(), names_.end());
            merged.paths.push_back(path_);
        }
    }

  private:
    bool joins(const VectorPath& path) const {
        return !path.is_closed && can_turn(drawing_, path) && !drawing_.styles[path.style].is_outline();
    }
    glm::dvec2 end() const { return steps_.empty() ? path_.start : steps_.back().to; }

    void begin(const VectorPath& path) {
        path_ = path;
        steps_.assign(drawing_.steps_of(path).begin(), drawing_.steps_of(path).end());
        names_.assign(drawing_.edges_of(path).begin(), drawing_.edges_of(path).end());
        known_ = {names_.begin(), names_.end()};
    }

    /// Adds paths that begin or end where the path ends.
    void go_on() {
        while (true) {
            throw_if_interrupted();
            const auto found = ends_.find(key_of(end()));
            if (found == ends_.end()) return;
            const auto next = std::find_if(found->second.begin(), found->second.end(), [&](std::size_t end) {
                const VectorPath& other = paths_[end / 2];
                return !is_done_[end / 2] && other.style == path_.style &&
                       steps_.size() + other.step_count <= kMostPathSteps;
            });
            if (next == found->second.end()) return;
            is_done_[*next / 2] = true;
            add(paths_[*next / 2], *next % 2 == 1);
        }
    }
    void add(const VectorPath& other, bool is_turned) {
        if (is_turned) {
            const std::vector<PathStep> more = reversed_steps(drawing_, other);
            steps_.insert(steps_.end(), more.begin(), more.end());
        } else {
            const std::span<const PathStep> more = drawing_.steps_of(other);
            steps_.insert(steps_.end(), more.begin(), more.end());
        }
        for (const std::uint64_t name : drawing_.edges_of(other)) {
            if (known_.insert(name).second) names_.push_back(name);
        }
        if (other.object != path_.object) path_.object = 0;
        path_.invisibility = std::min(path_.invisibility, other.invisibility);
        path_.unnamed_edges += other.unnamed_edges;
    }
    void turn_round() {
        VectorDrawing alone;
        alone.steps = std::move(steps_);
        path_.first_step = 0;
        path_.step_count = alone.steps.size();
        reverse(alone, path_);
        steps_ = std::move(alone.steps);
    }

    const VectorDrawing& drawing_;
    std::span<const VectorPath> paths_;
    std::vector<bool> is_done_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> ends_;  ///< twice a path, plus 1 for its end, by place
    VectorPath path_;                                                   ///< the one that is made
    std::vector<PathStep> steps_;
    std::vector<std::uint64_t> names_;
    std::unordered_set<std::uint64_t> known_;
};

}  // namespace

void merge_paths(VectorDrawing& drawing) {
    VectorDrawing merged = drawing;
    merged.steps.clear();
    merged.edges.clear();
    merged.paths.clear();
    for (VectorGroup& group : merged.groups) {
        const std::size_t first = merged.paths.size();
        PathMerger(drawing, drawing.paths_of(group)).add_to(merged);
        group.first_path = first;
        group.path_count = merged.paths.size() - first;
    }
    drawing = std::move(merged);
}

PenTravel sort_for_pen(VectorDrawing& drawing) {
    PenTravel result;
    result.before_px = travel(drawing);
    glm::dvec2 pen(drawing.crop.x0, drawing.crop.y0);
    for (const VectorGroup& group : drawing.groups) {
        const auto first = drawing.paths.begin() + static_cast<std::ptrdiff_t>(group.first_path);
        std::vector<VectorPath> paths(first, first + static_cast<std::ptrdiff_t>(group.path_count));
        // Of each path its start, and its end.
        std::vector<glm::dvec2> places;
        for (const VectorPath& path : paths) {
            places.push_back(path.start);
            places.push_back(end_of(drawing, path));
        }
        EndTree ends(std::move(places));
        for (std::size_t i = 0; i < paths.size(); ++i) {
            if (!can_turn(drawing, paths[i])) ends.remove(2 * i + 1);
        }
        for (std::size_t i = 0; i < paths.size(); ++i) {
            throw_if_interrupted();
            const std::size_t nearest = ends.nearest(pen);
            VectorPath path = paths[nearest / 2];
            ends.remove(nearest / 2 * 2);
            ends.remove(nearest / 2 * 2 + 1);
            if (nearest % 2 == 1) reverse(drawing, path);
            pen = end_of(drawing, path);
            *(first + static_cast<std::ptrdiff_t>(i)) = path;
        }
    }
    result.after_px = travel(drawing);
    return result;
}

std::vector<float> least_opacities(const VectorDrawing& drawing) {
    constexpr float kNothing = 1.0f / 256;
    const auto key = [](const VectorGroup& g) { return std::tuple(g.is_surface, g.is_hidden, g.set); };
    std::map<std::tuple<bool, bool, std::uint32_t>, float> strongest;
    for (const VectorGroup& group : drawing.groups) {
        float& most = strongest[key(group)];
        for (const VectorPath& path : drawing.paths_of(group))
            most = std::max(most, drawing.styles[path.style].opacity);
    }
    std::vector<float> least;
    for (const VectorGroup& group : drawing.groups) least.push_back(std::max(kNothing, 0.5f * strongest[key(group)]));
    return least;
}

OpaquePaths make_opaque(VectorDrawing& drawing) {
    OpaquePaths counts;
    std::vector<VectorPath> kept;
    const std::vector<float> least = least_opacities(drawing);
    for (std::size_t i = 0; i < drawing.groups.size(); ++i) {
        VectorGroup& group = drawing.groups[i];
        const std::size_t first = kept.size();
        for (const VectorPath& path : drawing.paths_of(group)) {
            const float opacity = drawing.styles[path.style].opacity;
            if (opacity >= least[i]) kept.push_back(path);
            if (opacity < 1) ++(opacity >= least[i] ? counts.solid : counts.left_out);
        }
        group.first_path = first;
        group.path_count = kept.size() - first;
    }
    std::erase_if(drawing.groups, [](const VectorGroup& group) { return group.path_count == 0; });
    drawing.paths = std::move(kept);
    for (VectorStyle& style : drawing.styles) {
        style.opacity = 1;
        style.blend = InkBlend::over;
    }
    return counts;
}

void make_hairlines(double width_px, VectorDrawing& drawing) {
    for (VectorStyle& style : drawing.styles) {
        style.width_px = static_cast<float>(width_px);
        style.dash_px.clear();
        style.opacity = 1;
        style.blend = InkBlend::over;
    }
}

}  // namespace burin
