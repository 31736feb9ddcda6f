#include "methods/zbuffer/polygon_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkPolygons = 8192;

struct PolygonChunk {
    std::uint32_t instance, first, end;
};

/// Tiles that a polygon may touch, as columns and rows; empty if none.
PixelRect touched_tiles(const ProjectedPolygon& polygon, PixelRect region, int tile_px, double reach_px) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const ProjectedTriangle& triangle : polygon.triangles) {
        for (const ProjectedCorner& corner : triangle.corners) {
            low = glm::min(low, corner.pixel);
            high = glm::max(high, corner.pixel);
        }
    }
    low -= reach_px;
    high += reach_px;
    const bool misses = !(low.x < region.x1 && low.y < region.y1 && high.x >= region.x0 && high.y >= region.y0);
    if (misses) return {};
    const auto tile_of = [&](double position, int start, int end) {
        const double last = end - 1;
        return static_cast<int>(std::clamp(std::floor(position), double(start), last) - start) / tile_px;
    };
    return {tile_of(low.x, region.x0, region.x1), tile_of(low.y, region.y0, region.y1),
            tile_of(high.x, region.x0, region.x1) + 1, tile_of(high.y, region.y0, region.y1) + 1};
}

}  // namespace

PolygonBins::PolygonBins(const Frame& frame, const FeatureEdges& features, const DepthRange& depth, int tile_px,
                         double reach_px, int threads)
    : region_(frame.crop),
      tile_px_(tile_px),
      columns_((frame.crop.width() + tile_px - 1) / tile_px),
      rows_((frame.crop.height() + tile_px - 1) / tile_px) {
    std::vector<PolygonChunk> chunks;
    for (std::uint32_t i = 0; i < frame.surfaces.instances.size(); ++i) {
        const std::uint32_t count = frame.surfaces.instances[i].mesh->polygon_count;
        for (std::uint32_t first = 0; first < count; first += std::min(kChunkPolygons, count - first)) {
            chunks.push_back({i, first, first + std::min(kChunkPolygons, count - first)});
        }
    }
    struct Record {
        std::uint32_t tile;
        PolygonRef polygon;
    };
    std::vector<std::vector<Record>> records(chunks.size());
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) {
        ProjectedPolygon polygon;
        for (std::uint32_t p = chunks[c].first; p < chunks[c].end; ++p) {
            project_polygon(frame, features, depth, chunks[c].instance, p, polygon);
            const PixelRect tiles = touched_tiles(polygon, region_, tile_px_, reach_px);
            for (int row = tiles.y0; row < tiles.y1; ++row) {
                for (int column = tiles.x0; column < tiles.x1; ++column) {
                    records[c].push_back(
                        {static_cast<std::uint32_t>(row * columns_ + column), {chunks[c].instance, p}});
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
    std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
    for (auto& list : records) {
        for (const Record& r : list) sorted_[next[r.tile]++] = r.polygon;
        list = std::vector<Record>();  // {} would keep its memory
    }
}

PixelRect PolygonBins::tile(std::size_t index) const {
    const int column = static_cast<int>(index) % columns_, row = static_cast<int>(index) / columns_;
    const int x0 = region_.x0 + column * tile_px_, y0 = region_.y0 + row * tile_px_;
    return {x0, y0, std::min(x0 + tile_px_, region_.x1), std::min(y0 + tile_px_, region_.y1)};
}

}  // namespace burin
