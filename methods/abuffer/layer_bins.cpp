#include "methods/abuffer/layer_bins.h"

#include "base/parallel.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;

using Record = TileLists<std::uint32_t>::Record;

void bin(const ScreenSurfaces& screen, const PixelTiles& grid, SurfaceId s, std::vector<Record>& records) {
    const std::uint32_t number = screen.number_of(s);
    const Facing facing = screen.facing(number);
    if (facing == edge_on) return;
    glm::dvec2 low(1e300), high(-1e300);
    const auto reach = [&](double x, double y) {
        low = glm::min(low, glm::dvec2(x, y) / 256.0);
        high = glm::max(high, glm::dvec2(x, y) / 256.0);
    };
    std::uint32_t value = number;
    if (facing == off_screen) {
        const ScreenPolygon polygon = screen.surfaces().screen_polygon(s);
        for (int i = 0; i < polygon.count; ++i) {
            const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
            reach(p.x, p.y);
        }
        value |= LayerBins::kClipped;
    } else {
        const ScreenVertex* const v = screen.vertices(s.instance);
        for (const std::uint32_t corner : screen.surfaces().mesh_of(s).triangles[s.triangle]) {
            reach(v[corner].x, v[corner].y);
        }
    }
    grid.visit(low, high, [&](std::uint32_t tile) { records.push_back({tile, value}); });
}

}  // namespace

LayerBins::LayerBins(const ScreenSurfaces& screen, const PixelTiles& grid, int threads) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    std::vector<std::vector<Record>> records(chunks.size());
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) {
        for (std::uint32_t t = chunks[c].begin; t < chunks[c].end; ++t) {
            bin(screen, grid, {chunks[c].instance, t}, records[c]);
        }
    });
    lists_ = TileLists<std::uint32_t>(records, grid.count());
}

}  // namespace burin
