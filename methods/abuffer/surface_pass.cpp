#include "methods/abuffer/surface_pass.h"

#include <memory>
#include <optional>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "methods/abuffer/fine_lines.h"
#include "methods/abuffer/line_tile.h"
#include "methods/abuffer/pixel_fill.h"
#include "methods/abuffer/sampling.h"

namespace burin {
namespace {

struct WorkerTimes {
    double raster = 0, lines = 0, shade = 0;
};

}  // namespace

void SurfacePass::draw(PixelRect region, int tile_samples, std::vector<std::vector<LineSegment>>& segments, Film& film,
                       RenderStats& stats) {
    Stopwatch watch;
    const int per_pixel = samples_per_pixel_of(*frame_.scene);
    const bool has_fine = frame_.scene->abuffer.draws_fine_lines();
    const TriangleBins bins(screen_, region, per_pixel, kernels_, threads_, tile_samples, has_fine);
    std::optional<FineEdges> fine_edges;
    if (has_fine) fine_edges.emplace(screen_, PixelTiles(region, tile_samples / per_pixel), per_pixel, threads_);
    stats.prepare_s += watch.lap();

    const auto workers = static_cast<std::size_t>(threads_);
    std::vector<std::unique_ptr<LineTile>> tiles(workers);
    std::vector<std::unique_ptr<PixelFiller>> fillers(workers);
    std::vector<FineParts> fine_parts(workers, FineParts(screen_, kernels_, completes_lines(*frame_.scene)));
    std::vector<std::vector<FinePart>> parts(workers);
    std::vector<std::unique_ptr<FineLines>> fine_lines(workers);
    std::vector<WorkerTimes> times(workers);
    const std::size_t before = segments.size();
    segments.resize(before + bins.tile_count());
    parallel_for(bins.tile_count(), threads_, [&](std::size_t index, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        if (!tiles[w]) tiles[w] = std::make_unique<LineTile>(frame_, screen_, bins, per_pixel, kernels_);
        if (!fillers[w]) fillers[w] = std::make_unique<PixelFiller>(frame_, screen_, kernels_);
        if (has_fine && !fine_lines[w]) fine_lines[w] = std::make_unique<FineLines>(frame_, screen_, bins, kernels_, region);
        std::vector<LineSegment>& lines = segments[before + index];
        const auto add_fine_lines = [&] {
            parts[w].clear();
            fine_parts[w].find(tiles[w]->samples(), fine_edges->in(index), lines, parts[w]);
            fine_lines[w]->find(index, parts[w], lines);
        };
        Stopwatch lap;
        if (bins.is_empty(index)) {
            fillers[w]->clear(bins.empty_tiles_from(index), film);
            if (has_fine && !fine_edges->in(index).empty()) {  // it may have what is smaller than a sample
                tiles[w]->draw(index);
                add_fine_lines();
            }
        } else {
            tiles[w]->draw(index);
            times[w].raster += lap.lap();
            tiles[w]->find_lines(lines);
            if (has_fine) add_fine_lines();
            times[w].lines += lap.lap();
            fillers[w]->fill(*tiles[w], film);
        }
        if (contours_ != nullptr) contours_->move(lines);
        times[w].shade += lap.lap();
        if (progress_ != nullptr) progress_->advance();
    });
    const double wall = watch.lap();
    WorkerTimes sum;
    for (std::size_t w = 0; w < workers; ++w) {
        sum.raster += times[w].raster;
        sum.lines += times[w].lines;
        sum.shade += times[w].shade;
        if (tiles[w]) stats.fragments += tiles[w]->sample_tests();
    }
    const double total = sum.raster + sum.lines + sum.shade;
    const double scale = total > 0 ? wall / total : 0;
    stats.raster_s += sum.raster * scale;
    stats.lines_s += sum.lines * scale;
    stats.shade_s += sum.shade * scale;
}

}  // namespace burin
