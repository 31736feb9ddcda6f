#include "methods/abuffer/fine/fine_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "lines/line_segment.h"
#include "methods/abuffer/layers/layer_edges.h"
#include "methods/abuffer/screen/edge_on_screen.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

FineEdges::FineEdges(const ScreenSurfaces& screen, const PixelTiles& tiles, int samples_per_pixel,
                     int threads) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    std::vector<std::vector<TileLists<TileEdge>::Record>> records(chunks.size());
    const SampleBlocks blocks(samples_per_pixel);
    const PixelRect region = tiles.rect();  // of whole blocks, as are its tiles
    const int first_x = region.x0 / kMergeBlockPx, first_y = region.y0 / kMergeBlockPx;
    const int columns = region.width() / kMergeBlockPx, rows = region.height() / kMergeBlockPx;
    const int pitch_shift = std::countr_zero(static_cast<unsigned>(2 * blocks.half_pitch));
    const int per_tile = tiles.tile_px() / kMergeBlockPx;
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) {
        const ScreenMesh mesh = screen.mesh(chunks[c].instance);
        // First all edges, then their vertices, which take longer to come from memory.
        std::vector<HalfEdge> edges;
        for_possible_lines(screen, chunks[c], [&](SurfaceId, HalfEdge h) {
            const HalfEdge g = mesh.partners[h];
            if (mesh.partners[g] != h) return;
            edges.push_back(h);
            __builtin_prefetch(mesh.corners + h);
        });
        const auto corner = [&](std::size_t i, HalfEdge k) {
            const HalfEdge h = edges[i];
            return mesh.corners[h - h % 3 + (h + k) % 3];
        };
        const auto vertex = [&](std::size_t i, HalfEdge k) -> const ScreenVertex& { return mesh.vertices[corner(i, k)]; };
        constexpr std::size_t kAhead = 16;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (i + kAhead < edges.size()) {
                __builtin_prefetch(&vertex(i + kAhead, 0));
                __builtin_prefetch(&vertex(i + kAhead, 1));
            }
            glm::ivec2 a(vertex(i, 0).x, vertex(i, 0).y), b(vertex(i, 1).x, vertex(i, 1).y);
            float nearest = std::max(vertex(i, 0).nearness, vertex(i, 1).nearness);
            if (a.x == ScreenVertex::kOffScreen || b.x == ScreenVertex::kOffScreen) {
                const auto cut = clipped_edge(screen, chunks[c].instance, corner(i, 0), corner(i, 1));
                if (!cut) continue;
                a = glm::floor(cut->from);
                b = glm::floor(cut->to);
                nearest = std::nextafter(static_cast<float>(std::max(cut->nearness_from, cut->nearness_to)), kInfinity);
            }
            if (a == b) continue;
            const auto [x0, x1] = std::minmax(a.x, b.x);
            const auto [y0, y1] = std::minmax(a.y, b.y);
            const int left = std::max(blocks.at(x0) - first_x, 0),
                      right = std::min(blocks.at(x1) - first_x, columns - 1);
            const int top = std::max(blocks.at(y0) - first_y, 0),
                      bottom = std::min(blocks.at(y1) - first_y, rows - 1);
            if (left > right || top > bottom) continue;
            for (int y = top / per_tile; y <= bottom / per_tile; ++y) {
                for (int x = left / per_tile; x <= right / per_tile; ++x) {
                    const auto area = [&](int subpixel, int first_px, int tile, int more) {
                        const int from_first = subpixel - (first_px + tile * tiles.tile_px()) * kSubpixelsPerPixel - blocks.half_pitch;
                        const int sample = (from_first >> pitch_shift) + more;
                        return static_cast<std::uint8_t>(std::clamp(sample >> TileEdge::kAreaShift, 0, 255));
                    };
                    records[c].push_back({static_cast<std::uint32_t>(y * tiles.columns() + x),
                                          {{chunks[c].instance, edges[i]}, nearest, area(x0, region.x0, x, 0), area(y0, region.y0, y, 0),
                                           area(x1 + 1, region.x0, x, 1), area(y1 + 1, region.y0, y, 1)}});
                }
            }
        }
    });
    lists_ = TileLists<TileEdge>(records, tiles.count());
}

}  // namespace burin
