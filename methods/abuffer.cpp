#include "methods/abuffer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>

#include "abuffer/edges/edge_lines.h"
#include "abuffer/hidden_pass.h"
#include "abuffer/lines_of_crop.h"
#include "abuffer/picture_slices.h"
#include "abuffer/screen/sampling.h"
#include "abuffer/visible_pass.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "lines/dashes.h"
#include "lines/line_dashes.h"
#include "lines/shared_dashes.h"
#include "lines/smooth_contours.h"
#include "strokes/row_printer.h"

namespace burin {
namespace {

/// Whole blocks of merged pieces around a crop from which strokes reach into it.
PixelRect region_around(PixelRect crop, double reach_px) {
    const int margin = static_cast<int>(std::ceil(reach_px)) + 1;
    const auto down = [](int v) { return (v & ~(kMergeBlockPx - 1)); };
    return {down(crop.x0 - margin), down(crop.y0 - margin), down(crop.x1 + margin + kMergeBlockPx - 1),
            down(crop.y1 + margin + kMergeBlockPx - 1)};
}

/// Forgets what cannot be seen from a row of pixels on.
template <typename Segment>
void drop_above(double y, std::vector<std::vector<Segment>>& lists) {
    for (auto& list : lists) {
        std::erase_if(list, [&](const Segment& s) { return std::max(s.from.y, s.to.y) < y; });
        if (list.capacity() > 2 * list.size()) list.shrink_to_fit();
    }
    std::erase_if(lists, [](const auto& list) { return list.empty(); });
}

/// Edges that are lines from anywhere, wherever they are on the screen.
void add_features(const Frame& frame, const ScreenSurfaces& screen, int threads, std::vector<WholeLine>& features) {
    const std::vector<WholeLine> lines =
        find_edge_lines(frame, screen, PossibleLines(screen, threads), anywhere_on_screen(), threads);
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(features), is_feature);
}

/// A crease begins where it begins to fade in.
LineCriteria criteria_of(const LineSettings& lines) {
    LineCriteria criteria;
    criteria.classes = lines.classes;
    criteria.cos_crease_angle = std::cos(glm::radians(lines.crease_fade().from_deg));
    return criteria;
}

}  // namespace

void prepare_for_abuffer(Scene& scene, int threads, bool saves_memory) {
    const LineCriteria criteria = criteria_of(scene.lines);
    scene.sharp_edges.resize(scene.meshes.size());
    // A few large meshes, or many.
    const std::size_t count = scene.meshes.size();
    const bool has_many = count >= 4 * static_cast<std::size_t>(resolve_thread_count(threads));
    parallel_for(count, has_many ? threads : 1, [&](std::size_t i, int) {
        scene.sharp_edges[i] = find_sharp_edges(scene.meshes[i], criteria, has_many ? 1 : threads);
    });
    scene.intersecting_pairs.reset();
    if (!saves_memory && HiddenPass::is_needed(scene) && IntersectionLines::are_wanted(scene.lines.classes)) {
        scene.intersecting_pairs = find_intersecting_pairs(scene, best_kernels(), threads);
    }
}

/// Hidden lines are drawn below visible ones.
bool abuffer_finishes_in_bands(const Frame& frame) {
    return !HiddenPass::is_needed(*frame.scene) && !needs_all_visible_lines(frame);
}

RenderStats render_abuffer(const Frame& given, const RunOptions& options, Film& film) {
    Frame frame = given;
    frame.criteria.cos_crease_angle = criteria_of(given.scene->lines).cos_crease_angle;
    RenderStats stats;
    stats.threads = resolve_thread_count(options.threads);
    stats.triangles = frame.surfaces.triangle_count();
    const LineSettings& lines = frame.scene->lines;
    const int per_pixel = samples_per_pixel_of(*frame.scene);
    const int tile_samples = options.tile_samples > 0 ? options.tile_samples : TileGrid::kTileSamples;
    const TileKernels& kernels = best_kernels();
    const bool has_cap = options.memory_bytes > 0;
    Stopwatch watch;
    ScreenSurfaces screen(frame.surfaces, frame.criteria, kernels, stats.threads, !has_cap);
    const PixelRect region = region_around(rect_with_lines(frame), lines.style.reach_px());
    const PixelTiles tiles(region, tile_samples / per_pixel);
    SlicePlan plan{{{tiles.rows(), {}}}, {{HiddenPass::tiles_of(frame).rows(), {}}}, {{}}};
    if (has_cap) plan = plan_slices(frame, screen, tiles, options.memory_bytes, stats.threads);
    const auto show = [&](const std::vector<std::uint32_t>& instances) {
        if (has_cap) screen.show(instances, stats.threads);
    };
    std::unique_ptr<SmoothContours> contours;
    if (lines.contours == Contours::smooth) {
        contours = std::make_unique<SmoothContours>(frame.surfaces, frame.criteria.cos_crease_angle, stats.threads);
    }
    stats.prepare_s = watch.lap();
    if (options.progress != nullptr) options.progress->begin("rendering", tiles.count());

    const bool has_layers = HiddenPass::is_needed(*frame.scene);
    std::vector<std::vector<LinePiece>> segments;
    std::optional<CourseIndex> visible_courses;  // before they are dashed
    RowPrinter finisher(frame, kernels, stats.threads, options, film);
    VisiblePass surfaces(frame, screen, kernels, stats.threads, options.progress);
    const bool waits = !abuffer_finishes_in_bands(frame);
    const auto hand_on = [&](PixelRect part) {
        stats.lines_s += watch.lap();
        finisher.hand_on(part);
        stats.write_s += watch.lap();
    };
    for (const PictureSlice& piece : plan.visible) {
        show(piece.instances);
        const PixelRect rows = tiles.only(piece.rows).rect();
        StrokePrinter::Lists unfinished =
            surfaces.draw(rows, tile_samples, waits ? nullptr : &finisher, segments, film, stats);
        const bool is_last = &piece == &plan.visible.back();
        if (waits && !is_last) continue;
        watch.lap();
        if (contours) {
            contours->move(segments, stats.threads);
            unfinished = segments;
        }
        if (const auto dash_px = visible_dashes(lines.style).dash_px) {
            std::vector<WholeLine> features;
            for (const std::vector<std::uint32_t>& group : plan.groups) {
                show(group);
                add_features(frame, screen, stats.threads, features);
            }
            const PixelRect picture{0, 0, frame.width, frame.height};
            if (hidden_dashes(lines.style).dash_px) {
                const double width_px = std::min(lines.style.width_px, lines.style.hidden_width_px());
                visible_courses = courses_of(segments, picture, SharedDashes::reach_of_pen_px(width_px));
            }
            segments = dashed(segments, *dash_px, lines.style.width_px, picture, features, frame.surfaces);
            unfinished = segments;
        }
        if (!has_layers) {
            const PixelRect part = is_last ? finisher.take_rest() : finisher.take(rows.y1);
            finisher.draw(part, unfinished);
            hand_on(part);
            if (has_cap) drop_above(finisher.taken_y() - finisher.reach_px(), segments);
        }
        stats.lines_s += watch.lap();
    }
    if (!has_layers) {
        film.end_picture();
        return stats;
    }

    HiddenPass layers(frame, screen, kernels, stats.threads, contours.get());
    if (visible_courses) layers.leave_out_dashes_along(*visible_courses);
    const PixelTiles layer_tiles = HiddenPass::tiles_of(frame);
    const bool needs_all = HiddenPass::needs_all_lines(frame);
    const PossibleLines* const possible = surfaces.possible_lines();
    for (const std::vector<std::uint32_t>& group : plan.groups) {
        if (!needs_all) break;
        show(group);
        layers.find_lines(layer_tiles.rows(), possible);
    }
    std::vector<std::vector<LayerSegment>> layer_segments;
    for (const PictureSlice& piece : plan.layers) {
        const bool is_last = &piece == &plan.layers.back();
        show(piece.instances);
        if (!needs_all) layers.find_lines(piece.rows, possible);
        layers.sort(piece.rows);
        layers.composite(film);
        layers.find_pieces();
        if (needs_all && !is_last) continue;
        layer_segments.push_back(layers.take_segments());
        const PixelRect part = is_last ? finisher.take_rest() : finisher.take(layer_tiles.only(piece.rows).rect().y1);
        if (part.height() == 0) continue;
        HiddenStrokes behind(frame, kernels, stats.threads, part, layer_segments);
        finisher.draw(part, segments, &behind);
        hand_on(part);
        if (!has_cap) continue;
        drop_above(part.y1 - finisher.reach_px(), segments);
        drop_above(part.y1 - finisher.reach_px(), layer_segments);
    }
    film.end_picture();
    stats.fragments += layers.fragment_count();
    stats.lines_s += watch.lap();
    return stats;
}

}  // namespace burin
