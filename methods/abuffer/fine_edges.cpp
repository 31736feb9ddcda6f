#include "methods/abuffer/fine_edges.h"

#include <algorithm>

#include "base/parallel.h"
#include "lines/line_segment.h"
#include "methods/abuffer/layer_edges.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;

}  // namespace

FineEdges::FineEdges(const ScreenSurfaces& screen, const PixelTiles& tiles, int samples_per_pixel, int threads) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    std::vector<std::vector<TileLists<FineEdge>::Record>> records(chunks.size());
    const SampleBlocks blocks(samples_per_pixel);
    const PixelRect region = tiles.rect();  // of whole blocks, as are its tiles
    const int first_x = region.x0 / kMergeBlockPx, first_y = region.y0 / kMergeBlockPx;
    const int columns = region.width() / kMergeBlockPx, rows = region.height() / kMergeBlockPx;
    const int per_tile = tiles.tile_px() / kMergeBlockPx;
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) {
        const ScreenMesh mesh = screen.mesh(chunks[c].instance);
        for_possible_lines(screen, chunks[c], [&](SurfaceId s, HalfEdge h) {
            if (mesh.partners[mesh.partners[h]] != h) return;
            const std::uint32_t* const t = mesh.corners + 3 * std::size_t{s.triangle};
            const ScreenVertex &a = mesh.vertices[t[h % 3]], &b = mesh.vertices[t[(h + 1) % 3]];
            if (a.x == ScreenVertex::kOffScreen || b.x == ScreenVertex::kOffScreen) return;
            if (a.x == b.x && a.y == b.y) return;
            const auto [x0, x1] = std::minmax(a.x, b.x);
            const auto [y0, y1] = std::minmax(a.y, b.y);
            const int left = std::max(blocks.at(x0) - first_x, 0), right = std::min(blocks.at(x1) - first_x, columns - 1);
            const int top = std::max(blocks.at(y0) - first_y, 0), bottom = std::min(blocks.at(y1) - first_y, rows - 1);
            if (left > right || top > bottom) return;
            for (int y = top / per_tile; y <= bottom / per_tile; ++y) {
                for (int x = left / per_tile; x <= right / per_tile; ++x) {
                    records[c].push_back({static_cast<std::uint32_t>(y * tiles.columns() + x), {s.instance, h}});
                }
            }
        });
    });
    lists_ = TileLists<FineEdge>(records, tiles.count());
}

}  // namespace burin
