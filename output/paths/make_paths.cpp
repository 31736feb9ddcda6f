#include "output/paths/make_paths.h"

#include <algorithm>
#include <tuple>

#include "base/stopwatch.h"
#include "output/paths/chain_paths.h"
#include "output/paths/path_lines.h"
#include "output/paths/simplify.h"

namespace burin {
namespace {

/// Puts what is to be one group next to each other, and begins groups.
void add_groups(PathLines& lines, VectorDrawing& drawing) {
    if (drawing.grouping == VectorGrouping::object) {
        std::stable_sort(lines.lines.begin(), lines.lines.end(), [](const PathLine& a, const PathLine& b) {
            // Hidden ones lie below visible ones, whatever the object.
            return std::tuple(!a.kind.order.is_hidden, a.object) < std::tuple(!b.kind.order.is_hidden, b.object);
        });
    }
    for (std::size_t i = 0; i < lines.lines.size(); ++i) {
        const PathLine& line = lines.lines[i];
        VectorGroup group;
        group.is_hidden = line.kind.order.is_hidden;
        group.invisibility = line.kind.invisibility;
        if (drawing.grouping == VectorGrouping::object) {
            group.object = line.object;
        } else {
            group.set = line.kind.order.set;
            group.line_class = line.kind.order.drawn_as;
        }
        const auto key = [](const VectorGroup& g) {
            return std::tuple(g.is_hidden, g.invisibility, g.set, g.line_class, g.object);
        };
        if (drawing.groups.empty() || key(drawing.groups.back()) != key(group)) {
            group.first_path = i;
            drawing.groups.push_back(group);
        }
        ++drawing.groups.back().path_count;
    }
}

}  // namespace

VectorDrawing vector_drawing_of(const InkedLines& inked, const FoundLines& found, const VectorOptions& options,
                                VectorStats& stats) {
    VectorDrawing drawing;
    drawing.width_px = found.width_px;
    drawing.height_px = found.height_px;
    drawing.crop = options.crop;
    drawing.dpi = found.dpi;
    drawing.grouping = options.grouping;
    for (const ObjectOfLines& object : found.objects) drawing.objects.push_back(object.name);

    drawing.sets = inked.sets;

    Stopwatch watch;
    PathLines lines = path_lines_of(inked, options.grouping, options.crop);
    stats.strokes = lines.lines.size();
    lines = chained_paths(lines);
    stats.chained = lines.lines.size();
    stats.chain_s = watch.lap();
    stats.clean_s = watch.lap();

    add_groups(lines, drawing);
    drawing.styles = lines.styles;
    std::vector<glm::dvec2> points;
    for (const PathLine& line : lines.lines) {
        points.clear();
        simplify(lines.points_of(line), options.tolerance_px, points);
        VectorPath path;
        path.start = points.front();
        path.first_step = drawing.steps.size();
        path.is_closed = line.is_closed;
        path.style = line.kind.style;
        path.object = line.object;
        path.invisibility = line.invisibility;
        path.dash_phase_px = line.dash_phase_px;
        path.first_edge = line.first_edge;
        path.edge_count = line.edge_count;
        for (std::size_t i = 1; i < points.size(); ++i) {
            PathStep step;
            step.to = points[i];
            drawing.steps.push_back(step);
        }
        path.step_count = drawing.steps.size() - path.first_step;
        drawing.paths.push_back(path);
    }
    drawing.edges = std::move(lines.edges);
    stats.paths = drawing.paths.size();
    stats.fit_s = watch.lap();
    return drawing;
}

}  // namespace burin
