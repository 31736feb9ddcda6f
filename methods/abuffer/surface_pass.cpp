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
    const TriangleBins bins(screen_, region, per_pixel, kernels_, threads_, tile_samples);
    const bool has_fine = frame_.scene->abuffer.draws_fine_lines();
    std::optional<FineEdges> fine_edges;
    if (has_fine) fine_edges.emplace(screen_, PixelTiles(region, tile_samples / per_pixel), per_pixel, threads_);
    stats.prepare_s += watch.lap();

    const auto workers = static_cast<std::size_t>(threads_);
    std::vector<std::unique_ptr<LineTile>> tiles(workers);
    std::vector<std::unique_ptr<PixelFiller>> fillers(workers);
    std::vector<FineParts> fine(workers, FineParts(screen_, kernels_, completes_lines(*frame_.scene)));
    std::vector<std::vector<FinePart>> fine_parts(bins.tile_count());
    std::vector<WorkerTimes> times(workers);
    const std::size_t before = segments.size();
    segments.resize(before + bins.tile_count());
    parallel_for(bins.tile_count(), threads_, [&](std::size_t index, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        if (!tiles[w]) tiles[w] = std::make_unique<LineTile>(frame_, screen_, bins, per_pixel, kernels_);
        if (!fillers[w]) fillers[w] = std::make_unique<PixelFiller>(frame_, screen_, kernels_);
        Stopwatch lap;
        if (bins.is_empty(index)) {
            fillers[w]->clear(bins.empty_tiles_from(index), film);
            if (has_fine && !fine_edges->in(index).empty()) {  // it may have what is smaller than a sample
                tiles[w]->draw(index);
                fine[w].find(tiles[w]->samples(), fine_edges->in(index), {}, fine_parts[index]);
            }
        } else {
            tiles[w]->draw(index);
            times[w].raster += lap.lap();
            tiles[w]->find_lines(segments[before + index]);
            if (has_fine) {
                fine[w].find(tiles[w]->samples(), fine_edges->in(index), segments[before + index], fine_parts[index]);
            }
            if (contours_ != nullptr) contours_->move(segments[before + index]);
            times[w].lines += lap.lap();
            fillers[w]->fill(*tiles[w], film);
        }
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

    if (!has_fine) return;
    segments.push_back(find_fine_lines(frame_, screen_, kernels_, region, fine_parts, threads_));
    if (contours_ != nullptr) contours_->move(segments.back());
    stats.lines_s += watch.lap();
}

}  // namespace burin
