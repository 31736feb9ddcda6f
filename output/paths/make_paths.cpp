#include "output/paths/make_paths.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/stopwatch.h"
#include "output/paths/chain_paths.h"
#include "output/paths/clean_paths.h"
#include "output/paths/cut_halos.h"
#include "output/paths/fit_path.h"
#include "output/paths/merge_strokes.h"
#include "output/paths/path_lines.h"

namespace burin {
namespace {

/// Puts what is to be one group next to each other.
void sort_to_groups(VectorGrouping grouping, std::vector<PathLine>& lines) {
    if (grouping != VectorGrouping::object) return;
    std::stable_sort(lines.begin(), lines.end(), [](const PathLine& a, const PathLine& b) {
        // Hidden ones lie below visible ones, whatever the object.
        return std::tuple(!a.kind.order.is_hidden, a.object) < std::tuple(!b.kind.order.is_hidden, b.object);
    });
}

VectorGroup group_of(VectorGrouping grouping, const PathLine& line) {
    VectorGroup group;
    group.is_hidden = line.kind.order.is_hidden;
    group.invisibility = line.kind.invisibility;
    if (grouping == VectorGrouping::object) {
        group.object = line.object;
    } else {
        group.set = line.kind.order.set;
        group.line_class = line.kind.order.drawn_as;
    }
    return group;
}

bool is_one_group(const VectorGroup& a, const VectorGroup& b) {
    const auto key = [](const VectorGroup& g) {
        return std::tuple(g.is_hidden, g.invisibility, g.set, g.line_class, g.object);
    };
    return key(a) == key(b);
}

/// Whether colour or opacity change along a stroke.
bool varies(std::span<const InkPoint> points) {
    static_assert(sizeof(InkPoint) == 48, "the ink of it, but for its width, is compared here");
    return std::any_of(points.begin(), points.end(), [&](const InkPoint& p) {
        return p.opacity != points.front().opacity || p.color != points.front().color;
    });
}

/// Adds a path, in several ones if it has more steps than all programs take.
void add_in_parts(VectorPath path, VectorDrawing& drawing) {
    const std::size_t end = path.first_step + path.step_count;
    if (path.step_count > kMostPathSteps) path.is_closed = false;
    for (std::size_t begin = path.first_step;; begin += kMostPathSteps) {
        path.first_step = begin;
        path.step_count = std::min(end - begin, kMostPathSteps);
        drawing.paths.push_back(path);
        ++drawing.groups.back().path_count;
        if (begin + path.step_count >= end) return;
        path.start = drawing.steps[begin + path.step_count - 1].to;
    }
}

/// Names the edges of a path. Of many, those at its ends, which go on behind or in front of a surface, and the least
/// names: two paths that have most of their edges in common have most of these in common, too.
void add_names(const PathLine& line, const std::vector<std::uint64_t>& edges, VectorPath& path,
               VectorDrawing& drawing) {
    path.first_edge = drawing.edges.size();
    const auto first = edges.begin() + static_cast<std::ptrdiff_t>(line.first_edge);
    if (line.edge_count <= kMostEdgeNames) {
        drawing.edges.insert(drawing.edges.end(), first, first + static_cast<std::ptrdiff_t>(line.edge_count));
        path.edge_count = line.edge_count;
        return;
    }
    std::set<std::uint64_t> names(first, first + static_cast<std::ptrdiff_t>(kMostEdgeNames - line.end_edges.size()));
    names.insert(line.end_edges.begin(), line.end_edges.end());
    drawing.edges.insert(drawing.edges.end(), names.begin(), names.end());
    path.edge_count = names.size();
    path.unnamed_edges = line.edge_count - names.size();
}

}  // namespace

std::string note_on_means(const VectorStats& stats) {
    if (stats.mean_inks == 0) return {};
    return "a path has one colour and opacity: " + std::to_string(stats.mean_inks) +
           " strokes that vary in them have their means";
}

VectorDrawing vector_drawing_of(InkedLines inked, const FoundLines& found, const VectorOptions& options,
                                VectorStats& stats) {
    if (found.projection.pixel_aspect != 1) {
        throw UsageError(
            "a vector file has no pixels that could be other than square; leave out the camera's pixel_aspect");
    }
    VectorDrawing drawing;
    drawing.width_px = found.width_px;
    drawing.height_px = found.height_px;
    drawing.crop = options.crop;
    drawing.dpi = found.dpi;
    drawing.paper_mm = found.paper_mm;
    drawing.grouping = options.grouping;
    for (const ObjectOfLines& object : found.objects) drawing.objects.push_back(object.name);

    drawing.sets = inked.sets;

    // Four steps of about the same time; the last one line by line.
    const std::size_t count = std::max<std::size_t>(inked.strokes.size(), 1);
    if (options.progress != nullptr) options.progress->begin("making paths", 4 * count);
    const auto advance = [&](std::size_t steps) {
        if (options.progress != nullptr) options.progress->advance(steps);
    };
    Stopwatch watch;
    const PixelRect picture{0, 0, found.width_px, found.height_px};
    inked = with_halos_cut(with_runs_merged(std::move(inked)), found.projection, picture);
    for (const InkStroke& stroke : inked.strokes) stats.mean_inks += varies(inked.points_of(stroke)) ? 1 : 0;
    PathLines lines = path_lines_of(inked, options.grouping, options.crop);
    stats.strokes = lines.lines.size();
    advance(count);
    lines = chained_paths(lines);
    stats.chained = lines.lines.size();
    stats.chain_s = watch.lap();
    advance(count);
    // Of what is left, other lines are the only ones that go on in each other.
    lines = chained_paths(cleaned_paths(lines, picture), true);
    stats.clean_s = watch.lap();
    advance(count);

    sort_to_groups(options.grouping, lines.lines);
    drawing.styles = lines.styles;
    for (const PathLine& line : lines.lines) {
        throw_if_interrupted();
        VectorGroup group = group_of(options.grouping, line);
        if (drawing.groups.empty() || !is_one_group(drawing.groups.back(), group)) {
            group.first_path = drawing.paths.size();
            drawing.groups.push_back(group);
        }
        VectorPath path;
        path.first_step = drawing.steps.size();
        path.is_closed = line.is_closed;
        path.style = line.kind.style;
        path.object = line.object;
        path.invisibility = line.invisibility;
        path.dash_phase_px = line.dash_phase_px;
        add_names(line, lines.edges, path, drawing);
        path.start = fit_path(lines.points_of(line), line.is_closed, options.bounds, drawing.steps);
        path.step_count = drawing.steps.size() - path.first_step;
        add_in_parts(path, drawing);
        advance(1);
    }
    stats.paths = drawing.paths.size();
    stats.fit_s = watch.lap();
    return drawing;
}

}  // namespace burin
