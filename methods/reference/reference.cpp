#include "methods/reference/reference.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "methods/reference/reference_tile.h"
#include "methods/thread_times.h"
#include "render/surface_shading.h"

namespace burin {
namespace {

/// Large enough that margins do not cost more than tiles, small enough to fit into memory.
int tile_px(int samples, int margin_px) {
    if (samples > 16) return margin_px > 16 ? 64 : 32;
    return margin_px > 16 ? 128 : 64;
}

std::vector<PixelRect> tiles_of(const Frame& frame, int side) {
    std::vector<PixelRect> tiles;
    // Tiles lie on the whole picture's grid, so that a crop does not change any pixel.
    for (int y = frame.crop.y0 / side * side; y < frame.crop.y1; y += side) {
        for (int x = frame.crop.x0 / side * side; x < frame.crop.x1; x += side) {
            tiles.push_back({x, y, x + side, y + side});
        }
    }
    return tiles;
}

}  // namespace

RenderStats render_reference(const Frame& frame, const RunOptions& options, Film& film) {
    RenderStats stats;
    stats.threads = resolve_thread_count(options.threads);
    Stopwatch watch;
    const RayGeometry geometry(frame);
    const EmbreeScene rays(geometry);
    const ReferenceLines lines(geometry, rays, frame.criteria.classes, frame.criteria.cos_crease_angle,
                               std::max(frame.width, frame.height));
    const ReferenceLooseEdges loose(geometry, rays, frame.criteria.classes);
    const std::unique_ptr<const ShadedSurfaces> shaded = shaded_surfaces_of(frame, stats.threads);
    stats.prepare_s = watch.lap();

    const auto tiles = tiles_of(frame, tile_px(frame.scene->reference.samples, ReferenceTile::margin_px(frame)));
    if (options.progress != nullptr) options.progress->begin("casting rays", tiles.size());
    std::vector<std::unique_ptr<ReferenceTile>> workers(static_cast<std::size_t>(stats.threads));
    std::vector<ThreadTimes> times(workers.size());
    parallel_for(tiles.size(), stats.threads, [&](std::size_t index, int worker) {
        auto& tile = workers[static_cast<std::size_t>(worker)];
        ThreadTimes& time = times[static_cast<std::size_t>(worker)];
        if (!tile) tile = std::make_unique<ReferenceTile>(frame, geometry, rays, lines, loose, shaded.get());
        Stopwatch lap;
        tile->cast(tiles[index]);
        time.resolve += lap.lap();
        tile->find_curves();
        time.lines += lap.lap();
        tile->shade(film);
        time.shade += lap.lap();
        if (options.progress != nullptr) options.progress->advance();
    });

    if (shaded) add_notes_on(*shaded, stats.notes);
    share_out(watch.lap(), times, stats);
    stats.triangles = frame.surfaces.triangle_count();
    return stats;
}

}  // namespace burin
