#include "methods/patel/patel.h"

#include <memory>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "methods/background_pixel.h"
#include "methods/patel/patel_tile.h"
#include "methods/surface_bins.h"
#include "methods/thread_times.h"

namespace burin {
namespace {

constexpr int kPatelTilePx = 32;

template <typename Mask>
void render_tile(PatelTile<Mask>& tile, PixelRect rect, std::span<const SurfaceId> surfaces, Film& film,
                 ThreadTimes& times) {
    Stopwatch watch;
    tile.load(rect, surfaces);
    times.raster += watch.lap();
    times.fragments += tile.fragment_count();
    for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) {
            if (tile.fragments(x, y).empty()) {
                film.put(x, y, background_pixel());
                continue;
            }
            watch.lap();
            tile.resolve(x, y);
            times.resolve += watch.lap();
            tile.find_lines(x, y);
            times.lines += watch.lap();
            film.put(x, y, tile.shade(x, y));
            times.shade += watch.lap();
        }
    }
}

template <typename Mask>
RenderStats render_with(const Frame& frame, const ExtendedGrid& grid, const RunOptions& options, Film& film) {
    RenderStats stats;
    stats.threads = resolve_thread_count(options.threads);
    Stopwatch watch;
    const int margin_px = grid.apron / grid.samples_per_pixel() + 1;
    const SurfaceBins bins(frame.surfaces, frame.crop, kPatelTilePx, margin_px, stats.threads);
    stats.prepare_s = watch.lap();

    if (options.progress != nullptr) options.progress->begin("rendering", bins.tile_count());
    std::vector<std::unique_ptr<PatelTile<Mask>>> tiles(static_cast<std::size_t>(stats.threads));
    std::vector<ThreadTimes> times(tiles.size());
    parallel_for(bins.tile_count(), stats.threads, [&](std::size_t index, int worker) {
        auto& tile = tiles[static_cast<std::size_t>(worker)];
        if (!tile) tile = std::make_unique<PatelTile<Mask>>(frame, grid);
        render_tile(*tile, bins.tile(index), bins.surfaces(index), film, times[static_cast<std::size_t>(worker)]);
        if (options.progress != nullptr) options.progress->advance();
    });

    share_out(watch.lap(), times, stats);
    stats.triangles = frame.surfaces.triangle_count();
    return stats;
}

}  // namespace

RenderStats render_patel(const Frame& frame, const RunOptions& options, Film& film) {
    return with_patel_grid(*frame.scene, [&](auto mask, const ExtendedGrid& grid) {
        return render_with<decltype(mask)>(frame, grid, options, film);
    });
}

double patel_line_width_px(int mask_bits, double width_px) {
    const int side = mask_bits == 16 ? 4 : mask_bits == 64 ? 8 : 16;
    return grid_for_width(side, width_px).stroke_width_px();
}

}  // namespace burin
