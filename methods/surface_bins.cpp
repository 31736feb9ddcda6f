#include "methods/surface_bins.h"

#include <algorithm>

#include "base/parallel.h"

namespace burin {
namespace {

constexpr std::uint32_t kMostInChunk = 16384;

struct Chunk {
    std::uint32_t instance, first, end;
};

std::vector<Chunk> split_into_chunks(const SurfaceSet& surfaces) {
    std::vector<Chunk> chunks;
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        const auto count = static_cast<std::uint32_t>(surfaces.instances[i].mesh->triangles.size());
        for (std::uint32_t first = 0; first < count; first += std::min(kMostInChunk, count - first)) {
            chunks.push_back({i, first, first + std::min(kMostInChunk, count - first)});
        }
    }
    return chunks;
}

/// Pixels that a polygon may touch, with a margin; empty if none.
PixelRect touched_pixels(const ScreenPolygon& polygon, int margin_px) {
    if (polygon.count == 0) return {};
    std::int32_t low_x = polygon.corners[0].x, high_x = low_x;
    std::int32_t low_y = polygon.corners[0].y, high_y = low_y;
    for (std::size_t i = 1; i < static_cast<std::size_t>(polygon.count); ++i) {
        low_x = std::min(low_x, polygon.corners[i].x);
        high_x = std::max(high_x, polygon.corners[i].x);
        low_y = std::min(low_y, polygon.corners[i].y);
        high_y = std::max(high_y, polygon.corners[i].y);
    }
    // >> rounds down also for negative numbers.
    return {(low_x >> 8) - margin_px, (low_y >> 8) - margin_px, (high_x >> 8) + margin_px + 1,
            (high_y >> 8) + margin_px + 1};
}

}  // namespace

SurfaceBins::SurfaceBins(const SurfaceSet& surfaces, PixelRect region, int tile_px, int margin_px, int threads)
    : region_(region),
      tile_px_(tile_px),
      columns_((region.width() + tile_px - 1) / tile_px),
      rows_((region.height() + tile_px - 1) / tile_px) {
    struct Record {
        std::uint32_t tile;
        SurfaceId surface;
    };
    const std::vector<Chunk> chunks = split_into_chunks(surfaces);
    std::vector<std::vector<Record>> records(chunks.size());
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) {
        for (std::uint32_t t = chunks[c].first; t < chunks[c].end; ++t) {
            const SurfaceId surface{chunks[c].instance, t};
            PixelRect box = touched_pixels(surfaces.screen_polygon(surface), margin_px);
            box = {std::max(box.x0, region.x0), std::max(box.y0, region.y0), std::min(box.x1, region.x1),
                   std::min(box.y1, region.y1)};
            if (box.x0 >= box.x1 || box.y0 >= box.y1) continue;
            for (int row = (box.y0 - region.y0) / tile_px; row <= (box.y1 - 1 - region.y0) / tile_px; ++row) {
                for (int col = (box.x0 - region.x0) / tile_px; col <= (box.x1 - 1 - region.x0) / tile_px; ++col) {
                    records[c].push_back({static_cast<std::uint32_t>(row * columns_ + col), surface});
                }
            }
        }
    });

    // A stable counting sort over the chunks in order: the same for any number of threads.
    offsets_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const auto& list : records) {
        for (const Record& r : list) ++offsets_[r.tile + 1];
    }
    for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
    sorted_.resize(offsets_.back());
    std::vector<std::size_t> next = offsets_;
    for (auto& list : records) {
        for (const Record& r : list) sorted_[next[r.tile]++] = r.surface;
        std::vector<Record>().swap(list);
    }
}

PixelRect SurfaceBins::tile(std::size_t index) const {
    const int column = static_cast<int>(index) % columns_;
    const int row = static_cast<int>(index) / columns_;
    const int x0 = region_.x0 + column * tile_px_;
    const int y0 = region_.y0 + row * tile_px_;
    return {x0, y0, std::min(x0 + tile_px_, region_.x1), std::min(y0 + tile_px_, region_.y1)};
}

}  // namespace burin
