#include "methods/abuffer/abuffer.h"

#include <cmath>
#include <limits>
#include <memory>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "methods/abuffer/layer_pass.h"
#include "methods/abuffer/line_tile.h"
#include "methods/abuffer/lines_of_crop.h"
#include "methods/abuffer/pixel_fill.h"
#include "methods/abuffer/smooth_contours.h"
#include "methods/abuffer/stroke_pass.h"
#include "methods/abuffer/visible_dashes.h"

namespace burin {
namespace {

struct WorkerTimes {
    double raster = 0, lines = 0, shade = 0;
    std::uint64_t fragments = 0;
};

/// Whole blocks of merged pieces around a crop from which strokes reach into it.
PixelRect region_around(PixelRect crop, double reach_px) {
    const int margin = static_cast<int>(std::ceil(reach_px)) + 1;
    const auto down = [](int v) { return (v & ~(kMergeBlockPx - 1)); };
    return {down(crop.x0 - margin), down(crop.y0 - margin), down(crop.x1 + margin + kMergeBlockPx - 1),
            down(crop.y1 + margin + kMergeBlockPx - 1)};
}

/// A crease begins where it begins to fade in.
LineCriteria criteria_of(const LineSettings& lines) {
    LineCriteria criteria;
    criteria.classes = lines.classes;
    criteria.cos_crease_angle = std::cos(glm::radians(lines.crease_fade().from_deg));
    return criteria;
}

}  // namespace

void prepare_for_abuffer(Scene& scene, int threads) {
    const LineCriteria criteria = criteria_of(scene.lines);
    scene.sharp_edges.resize(scene.meshes.size());
    parallel_for(scene.meshes.size(), threads, [&](std::size_t i, int) {
        scene.sharp_edges[i] = find_sharp_edges(scene.meshes[i], criteria);
    });
}

RenderStats render_abuffer(const Frame& given, const RunOptions& options, Film& film) {
    Frame frame = given;
    frame.criteria.cos_crease_angle = criteria_of(given.scene->lines).cos_crease_angle;
    RenderStats stats;
    stats.threads = resolve_thread_count(options.threads);
    const int per_pixel = frame.scene->abuffer.samples_per_pixel;
    const TileKernels& kernels = best_kernels();
    Stopwatch watch;
    ScreenSurfaces screen(frame.surfaces, frame.criteria, kernels, stats.threads);
    const LineSettings& lines = frame.scene->lines;
    const PixelRect region = region_around(rect_with_lines(frame), 0.5 * lines.style.width_px);
    const TriangleBins bins(screen, region, per_pixel, kernels, stats.threads);
    std::unique_ptr<SmoothContours> contours;
    if (lines.contours == Contours::smooth) {
        contours = std::make_unique<SmoothContours>(frame.surfaces, frame.criteria.cos_crease_angle, stats.threads);
    }
    stats.prepare_s = watch.lap();

    if (options.progress != nullptr) options.progress->begin("rendering", bins.tile_count());
    const auto workers = static_cast<std::size_t>(stats.threads);
    std::vector<std::unique_ptr<LineTile>> tiles(workers);
    std::vector<std::unique_ptr<PixelFiller>> fillers(workers);
    std::vector<WorkerTimes> times(workers);
    std::vector<std::vector<LineSegment>> segments(bins.tile_count());
    parallel_for(bins.tile_count(), stats.threads, [&](std::size_t index, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        if (!tiles[w]) tiles[w] = std::make_unique<LineTile>(frame, screen, bins, per_pixel, kernels);
        if (!fillers[w]) fillers[w] = std::make_unique<PixelFiller>(frame, screen, kernels);
        Stopwatch lap;
        if (bins.is_empty(index)) {
            fillers[w]->clear(bins.empty_tiles_from(index), film);
        } else {
            tiles[w]->draw(index);
            times[w].raster += lap.lap();
            tiles[w]->find_lines(segments[index]);
            if (contours) contours->move(segments[index]);
            times[w].lines += lap.lap();
            fillers[w]->fill(*tiles[w], film);
        }
        times[w].shade += lap.lap();
        if (options.progress != nullptr) options.progress->advance();
    });
    const double wall = watch.lap();
    WorkerTimes sum;
    for (std::size_t w = 0; w < workers; ++w) {
        sum.raster += times[w].raster;
        sum.lines += times[w].lines;
        sum.shade += times[w].shade;
        if (tiles[w]) sum.fragments += tiles[w]->sample_tests();
    }
    const double total = sum.raster + sum.lines + sum.shade;
    const double scale = total > 0 ? wall / total : 0;
    stats.raster_s = sum.raster * scale;
    stats.lines_s = sum.lines * scale;
    stats.shade_s = sum.shade * scale;
    stats.fragments = sum.fragments;
    if (lines.style.dash_px) segments = dashed(segments, *lines.style.dash_px, lines.style.width_px);
    if (LayerPass::is_needed(frame)) {
        LayerPass layers(frame, screen, stats.threads, contours.get());
        layers.draw_below(segments, film);
        draw_strokes(frame, segments, kernels, stats.threads, film);
        layers.draw_above(film);
        stats.fragments += layers.fragment_count();
    } else {
        draw_strokes(frame, segments, kernels, stats.threads, film);
    }
    stats.lines_s += watch.lap();
    stats.triangles = frame.surfaces.triangle_count();
    return stats;
}

}  // namespace burin
