#include "abuffer/hiding/occluder_bins.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/parallel.h"

namespace burin {
namespace {

constexpr float kNearerThanAll = 3e38f;

using Record = TileLists<std::uint32_t>::Record;

/// Lists a triangle in the tiles that it touches, and perhaps some that it passes within a pixel.
void bin(const ScreenSurfaces& screen, const PixelTiles& grid, const LineDepths* lines, std::uint32_t instance,
         std::uint32_t t, std::vector<Record>& records) {
    const ScreenMesh& mesh = screen.mesh(instance);
    std::uint32_t value = mesh.first_number + t;
    ScreenPolygon polygon;
    float nearest = kNearerThanAll;
    if (mesh.facing[t] == off_screen) {
        polygon = screen.surfaces().screen_polygon({instance, t});
        if (polygon.count == 0) return;
        value |= OccluderBins::kClipped;
    } else {
        const std::uint32_t* const corner = mesh.corners + 3 * static_cast<std::size_t>(t);
        const ScreenVertex &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]], &c = mesh.vertices[corner[2]];
        polygon.count = 3;
        polygon.corners[0] = {a.x, a.y};
        polygon.corners[1] = {b.x, b.y};
        polygon.corners[2] = {c.x, c.y};
        nearest = std::max({a.nearness, b.nearness, c.nearness});
    }
    glm::ivec2 low(polygon.corners[0].x, polygon.corners[0].y), high = low;
    for (std::size_t i = 1; i < static_cast<std::size_t>(polygon.count); ++i) {
        const glm::ivec2 p(polygon.corners[i].x, polygon.corners[i].y);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const auto add = [&](std::uint32_t tile) { records.push_back({tile, value}); };
    const glm::ivec2 size = high - low;
    const bool may_pass_by = std::min(size.x, size.y) > grid.tile_px() * kSubpixelsPerPixel;
    std::array<PolygonRows::Corner, ScreenPolygon::kMaxCorners> corners;
    for (std::size_t i = 0; may_pass_by && i < static_cast<std::size_t>(polygon.count); ++i) {
        corners[i] = {static_cast<double>(polygon.corners[i].x), static_cast<double>(polygon.corners[i].y)};
    }
    const PolygonRows rows{std::span(corners).first(static_cast<std::size_t>(polygon.count))};
    if (lines != nullptr) {
        lines->for_tiles(low, high, nearest, may_pass_by ? &rows : nullptr, add);
    } else {
        grid.visit(low, high, add);
    }
}

void bin_all(const ScreenSurfaces& screen, const PixelTiles& grid, const TriangleChunk& chunk,
             std::vector<Record>& records) {
    const ScreenMesh& mesh = screen.mesh(chunk.instance);
    for (std::uint32_t t = chunk.begin; t < chunk.end; ++t) {
        if (mesh.facing[t] != edge_on) bin(screen, grid, nullptr, chunk.instance, t, records);
    }
}

/// Buffers of one thread.
struct Scratch {
    static constexpr std::size_t kRoom = 4 * std::size_t{kChunkTriangles} + kRoomBehindCulled;
    std::vector<std::uint32_t> found, tiles;
};

void bin_in_front(const ScreenSurfaces& screen, const TileKernels& kernels, const PixelTiles& grid,
                  const LineDepths& lines, const TriangleChunk& chunk, Scratch& scratch, std::vector<Record>& records) {
    const ScreenMesh& mesh = screen.mesh(chunk.instance);
    auto& [found, tiles] = scratch;
    found.resize(Scratch::kRoom);
    tiles.resize(Scratch::kRoom);
    const std::size_t count =
        kernels.hide.find_in_front(mesh, chunk.begin, chunk.end, lines.grid(), found.data(), tiles.data());
    records.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (mesh.facing[found[i]] == edge_on) continue;
        if (tiles[i] == kSeveralTiles) {
            bin(screen, grid, &lines, chunk.instance, found[i], records);
        } else {
            records.push_back({tiles[i], mesh.first_number + found[i]});
        }
    }
}

}  // namespace

OccluderBins::OccluderBins(const ScreenSurfaces& screen, const TileKernels& kernels, const PixelTiles& grid,
                           int threads, const LineDepths* lines) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    std::vector<std::vector<Record>> records(chunks.size());
    std::vector<Scratch> scratch(static_cast<std::size_t>(threads));
    parallel_for_parts(chunks.size(), threads, [&](std::size_t c, int worker) {
        if (lines != nullptr) {
            bin_in_front(screen, kernels, grid, *lines, chunks[c], scratch[static_cast<std::size_t>(worker)],
                         records[c]);
        } else {
            bin_all(screen, grid, chunks[c], records[c]);
        }
    });
    lists_ = TileLists<std::uint32_t>(records, grid.count());
}

}  // namespace burin
