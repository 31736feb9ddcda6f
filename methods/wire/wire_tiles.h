#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "methods/feature_edges.h"
#include "methods/surface_bins.h"
#include "render/method.h"
#include "view/scan_convert.h"

// A frame is drawn tile by tile, each by a renderer of its own.

namespace burin {

/// Calls visit(x, y) for the pixels of `rect` whose centres the polygon covers.
template <typename Visit>
void for_each_pixel(const ScreenPolygon& polygon, PixelRect rect, const Visit& visit) {
    const ScanConverter converter(polygon, 1);
    const int end_row = std::min(converter.end_row(), rect.y1);
    for (int y = std::max(converter.first_row(), rect.y0); y < end_row; ++y) {
        const SampleSpan span = converter.span(y);
        const int end = std::min(span.end, rect.x1);
        for (int x = std::max(span.begin, rect.x0); x < end; ++x) visit(x, y);
    }
}

/// Renders a frame tile by tile. `margin_px` is how far surfaces reach beyond their pixels;
/// make_tile(features) makes a renderer with render(rect, surfaces, film), one per thread.
template <typename MakeTile>
RenderStats render_wire_tiles(const Frame& frame, const RunOptions& options, Film& film, int margin_px,
                              const MakeTile& make_tile) {
    constexpr int kTilePx = 32;
    RenderStats stats;
    stats.threads = resolve_thread_count(options.threads);
    stats.triangles = frame.surfaces.triangle_count();
    Stopwatch watch;
    const FeatureEdges features(frame, stats.threads);
    const SurfaceBins bins(frame.surfaces, frame.crop, kTilePx, margin_px, stats.threads);
    stats.prepare_s = watch.lap();

    if (options.progress != nullptr) options.progress->begin("rendering", bins.tile_count());
    using Tile = decltype(make_tile(features));
    std::vector<std::unique_ptr<Tile>> tiles(static_cast<std::size_t>(stats.threads));
    parallel_for(bins.tile_count(), stats.threads, [&](std::size_t index, int worker) {
        auto& tile = tiles[static_cast<std::size_t>(worker)];
        if (!tile) tile = std::make_unique<Tile>(make_tile(features));
        tile->render(bins.tile(index), bins.surfaces(index), film);
        if (options.progress != nullptr) options.progress->advance();
    });
    stats.raster_s = watch.lap();
    return stats;
}

}  // namespace burin
