#include "methods/abuffer/fine_edges.h"

#include "base/parallel.h"
#include "methods/abuffer/layer_edges.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;

}  // namespace

FineEdges::FineEdges(const ScreenSurfaces& screen, const PixelTiles& tiles, int samples_per_pixel, int threads) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    std::vector<std::vector<TileLists<FineEdge>::Record>> records(chunks.size());
    const double offset = SampleBlocks(samples_per_pixel).half_pitch;
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
            tiles.visit((glm::dvec2(x0, y0) - offset) / 256.0, (glm::dvec2(x1, y1) - offset) / 256.0,
                        [&](std::uint32_t tile) { records[c].push_back({tile, {s.instance, h}}); });
        });
    });
    lists_ = TileLists<FineEdge>(records, tiles.count());
}

}  // namespace burin
