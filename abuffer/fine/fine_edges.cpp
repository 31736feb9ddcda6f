#include "abuffer/fine/fine_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "abuffer/screen/edge_on_screen.h"
#include "base/parallel.h"
#include "lines/line_piece.h"

namespace burin {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct EdgeEnds {
    HalfEdge half_edge;
    std::uint32_t from, to;  // vertices
};

}  // namespace

FineEdges::FineEdges(const ScreenSurfaces& screen, const PossibleLines* possible, std::span<const LooseChunk> loose,
                     const PixelTiles& tiles, int samples_per_pixel, int threads) {
    using Records = std::vector<TileLists<TileEdge>::Record>;
    const SampleBlocks blocks(samples_per_pixel);
    const PixelRect region = tiles.rect();  // of whole blocks, as are its tiles
    const int origin_x = region.x0 * kSubpixelsPerPixel + blocks.half_pitch;
    const int origin_y = region.y0 * kSubpixelsPerPixel + blocks.half_pitch;
    const int width = region.width() * kSubpixelsPerPixel, height = region.height() * kSubpixelsPerPixel;
    const int pitch_shift = std::countr_zero(static_cast<unsigned>(2 * blocks.half_pitch));
    const int tile_shift = std::countr_zero(static_cast<unsigned>(tiles.tile_px() * kSubpixelsPerPixel));
    const int columns = tiles.columns();
    const auto sort = [&](std::uint32_t instance, const ScreenVertex* vertices, const EdgeEnds& e, Records& found)
        __attribute__((always_inline)) {
        const ScreenVertex &from = vertices[e.from], &to = vertices[e.to];
        glm::ivec2 a(from.x, from.y), b(to.x, to.y);
        float nearest = std::max(from.nearness, to.nearness);
        if (a.x == ScreenVertex::kOffScreen || b.x == ScreenVertex::kOffScreen) {
            const auto cut = clipped_edge(screen, instance, e.from, e.to);
            if (!cut) return;
            a = glm::floor(cut->from);
            b = glm::floor(cut->to);
            nearest = std::nextafter(static_cast<float>(std::max(cut->nearness_from, cut->nearness_to)), kInfinity);
        }
        if (a == b) return;
        // Places count from the region's first square of samples.
        const int x0 = std::min(a.x, b.x) - origin_x, x1 = std::max(a.x, b.x) - origin_x;
        const int y0 = std::min(a.y, b.y) - origin_y, y1 = std::max(a.y, b.y) - origin_y;
        if (x1 < 0 || y1 < 0 || x0 >= width || y0 >= height) return;
        const int first_column = std::max(x0, 0) >> tile_shift, last_column = std::min(x1, width - 1) >> tile_shift;
        const int first_row = std::max(y0, 0) >> tile_shift, last_row = std::min(y1, height - 1) >> tile_shift;
        const auto add = [&](int column, int row) {
            const auto area = [&](int subpixel, int tile, int more) {
                const int sample = ((subpixel - (tile << tile_shift)) >> pitch_shift) + more;
                return static_cast<std::uint8_t>(std::clamp(sample >> TileEdge::kAreaShift, 0, 255));
            };
            found.push_back({static_cast<std::uint32_t>(row * columns + column),
                             {{instance, e.half_edge},
                              nearest,
                              area(x0, column, 0),
                              area(y0, row, 0),
                              area(x1 + 1, column, 1),
                              area(y1 + 1, row, 1)}});
        };
        if (__builtin_expect(first_column == last_column && first_row == last_row, 1))
            return add(first_column, first_row);
        for (int row = first_row; row <= last_row; ++row) {
            for (int column = first_column; column <= last_column; ++column) add(column, row);
        }
    };
    const std::size_t chunk_count = possible == nullptr ? 0 : possible->chunks.size();
    std::vector<Records> records(chunk_count), loose_records(loose.size());
    parallel_for_parts(chunk_count, threads, [&](std::size_t c, int) {
        const std::uint32_t instance = possible->chunks[c].instance;
        const ScreenMesh mesh = screen.mesh(instance);
        // All edges are prefetched first, then their vertices, which take longer to come from memory.
        std::vector<EdgeEnds> edges;
        for (const HalfEdge h : possible->edges[c]) {
            if (!is_surely_pair(mesh, h) && mesh.partners[mesh.partners[h]] != h) continue;
            edges.push_back({h, 0, 0});
            __builtin_prefetch(mesh.corners + h);
        }
        const auto find_ends = [&](EdgeEnds& e) {
            const HalfEdge k = e.half_edge % 3;
            e.from = mesh.corners[e.half_edge];
            e.to = mesh.corners[k == 2 ? e.half_edge - 2 : e.half_edge + 1];
            __builtin_prefetch(mesh.vertices + e.from);
            __builtin_prefetch(mesh.vertices + e.to);
        };
        Records found;
        constexpr std::size_t kAhead = 16;
        for (std::size_t i = 0; i < std::min(kAhead, edges.size()); ++i) find_ends(edges[i]);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (i + kAhead < edges.size()) find_ends(edges[i + kAhead]);
            sort(instance, mesh.vertices, edges[i], found);
        }
        records[c] = std::move(found);
    });
    parallel_for_parts(loose.size(), threads, [&](std::size_t c, int) {
        const std::uint32_t instance = loose[c].instance;
        const Mesh& mesh = *screen.surfaces().instances[instance].mesh;
        Records found;
        for (HalfEdge number = loose[c].begin; number < loose[c].end; ++number) {
            const auto [from, to] = mesh.loose_edge(number);
            sort(instance, screen.vertices(instance), {number, from, to}, found);
        }
        loose_records[c] = std::move(found);
    });
    lists_ = TileLists<TileEdge>(records, tiles.count());
    loose_lists_ = TileLists<TileEdge>(loose_records, tiles.count());
}

}  // namespace burin
