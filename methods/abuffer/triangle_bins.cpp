#include "methods/abuffer/triangle_bins.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/parallel.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;

struct Box {  // in 1/256 pixel
    std::int32_t x0, y0, x1, y1;
};

struct SampleBox {  // inclusive, relative to the grid
    std::int32_t column0, row0, column1, row1;
};

template <typename Corners>
Box box_of(const Corners& corners, int count) {
    Box box{corners[0].x, corners[0].y, corners[0].x, corners[0].y};
    for (int k = 1; k < count; ++k) {
        const auto& c = corners[static_cast<std::size_t>(k)];
        box.x0 = std::min(box.x0, c.x);
        box.x1 = std::max(box.x1, c.x);
        box.y0 = std::min(box.y0, c.y);
        box.y1 = std::max(box.y1, c.y);
    }
    return box;
}

/// What one chunk has in one tile, wound one way.
struct TileRun {
    std::uint32_t key, begin, count;
};

/// One chunk's triangles with the tiles they touch.
struct Records {
    std::vector<TileRun> runs;             // of `small`
    std::unique_ptr<TileTriangle[]> small;  // sorted by tile
    std::vector<std::uint32_t> large_tiles, large;  // numbers into polygons
    std::vector<LargePolygon> polygons;
};

/// Buffers of one thread.
struct Scratch {
    std::vector<TileTriangle> triangles, more_triangles;  // what the kernel found; those in several tiles
    std::vector<std::uint32_t> keys, more_keys;           // of their tiles
    std::vector<std::uint32_t> count, used;                // per key; keys with a count
};

SpanPlane plane_of_triangle(const ScreenTriangle& t, std::uint32_t id) {
    const ScreenVertex &a = t.corners[0], &b = t.corners[1], &c = t.corners[2];
    const double per_area = 1.0 / static_cast<double>(doubled_area(a, b, c));
    const double qb = static_cast<double>(b.nearness) - static_cast<double>(a.nearness);
    const double qc = static_cast<double>(c.nearness) - static_cast<double>(a.nearness);
    SpanPlane plane{};
    plane.x = a.x;
    plane.y = a.y;
    plane.nearness = a.nearness;
    plane.per_x = static_cast<float>((qb * (c.y - a.y) - qc * (b.y - a.y)) * per_area);
    plane.per_y = static_cast<float>((qc * (b.x - a.x) - qb * (c.x - a.x)) * per_area);
    plane.low = std::min({a.nearness, b.nearness, c.nearness});
    plane.high = std::max({a.nearness, b.nearness, c.nearness});
    plane.id = id;
    return plane;
}

class Binner {
  public:
    Binner(ScreenSurfaces& surfaces, const TileGrid& grid, const TileKernels& kernels)
        : surfaces_(surfaces), grid_(grid), kernels_(kernels) {}

    void bin(const TriangleChunk& chunk, Scratch& scratch, Records& records) const {
        const std::size_t room = kChunkTriangles + 8;
        scratch.triangles.resize(room);
        scratch.keys.resize(room);
        scratch.count.resize(2 * tile_count(), 0);
        const std::size_t found = kernels_.cull(surfaces_.mesh(chunk.instance), chunk.begin, chunk.end, grid_,
                                                surfaces_.facings(chunk.instance), scratch.triangles.data(),
                                                scratch.keys.data());
        sort(chunk.instance, found, scratch, records);
    }

  private:
    std::size_t tile_count() const {
        const int rows = ((grid_.height - 1) >> grid_.tile_shift) + 1;
        return static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(rows);
    }

    /// Sorts by counting keys. What is not in exactly one tile goes ways of its own.
    void sort(std::uint32_t instance, std::size_t found, Scratch& scratch, Records& records) const {
        auto& count = scratch.count;
        scratch.used.clear();
        scratch.more_triangles.clear();
        scratch.more_keys.clear();
        const auto add = [&](std::uint32_t key) {
            if (count[key]++ == 0) scratch.used.push_back(key);
        };
        for (std::size_t i = 0; i < found; ++i) {
            const std::uint32_t key = scratch.keys[i];
            if (key < kNotSmall) {
                add(key);
            } else if (key == kNotSmall) {
                add_not_small({instance, scratch.triangles[i].triangle}, records);
            } else {
                find_tiles(instance, scratch.triangles[i], scratch);
            }
        }
        for (const std::uint32_t key : scratch.more_keys) add(key);
        std::uint32_t begin = 0;
        records.runs.reserve(scratch.used.size());
        for (const std::uint32_t key : scratch.used) {
            records.runs.push_back({key, begin, count[key]});
            begin += std::exchange(count[key], begin);
        }
        records.small = std::make_unique_for_overwrite<TileTriangle[]>(begin);
        TileTriangle* const small = records.small.get();
        for (std::size_t i = 0; i < found; ++i) {
            if (scratch.keys[i] < kNotSmall) small[count[scratch.keys[i]]++] = scratch.triangles[i];
        }
        for (std::size_t i = 0; i < scratch.more_keys.size(); ++i) {
            small[count[scratch.more_keys[i]]++] = scratch.more_triangles[i];
        }
        for (const std::uint32_t key : scratch.used) count[key] = 0;
    }

    /// Lists a small triangle once for every tile that it may touch.
    void find_tiles(std::uint32_t instance, const TileTriangle& found, Scratch& scratch) const {
        const ScreenTriangle t = surfaces_.triangle({instance, found.triangle});
        const bool turned = surfaces_.facing(surfaces_.number_of({instance, found.triangle})) == clockwise;
        for_tiles(box_of(t.corners, 3), [&](std::uint32_t touched, const SampleBox& samples) {
            scratch.more_triangles.push_back(in_tile(found, touched, samples));
            scratch.more_keys.push_back(2 * touched + (turned ? 1 : 0));
        });
    }

    void add_not_small(SurfaceId s, Records& records) const {
        const std::uint32_t number = surfaces_.number_of(s);
        const ScreenTriangle t = surfaces_.triangle(s);
        const bool is_off = std::any_of(std::begin(t.corners), std::end(t.corners), [](const ScreenVertex& v) {
            return v.x == ScreenVertex::kOffScreen;
        });
        if (is_off) {
            surfaces_.set_facing(number, off_screen);
            return bin_clipped(s, number, records);
        }
        const std::int64_t area = doubled_area(t.corners[0], t.corners[1], t.corners[2]);
        surfaces_.set_facing(number, area == 0 ? edge_on : area > 0 ? clockwise : counterclockwise);
        if (area == 0) return;
        LargePolygon large;
        large.surface = s;
        large.polygon.count = 3;
        for (std::size_t k = 0; k < 3; ++k) large.polygon.corners[k] = {t.corners[k].x, t.corners[k].y};
        large.plane = plane_of_triangle(t, number << 1);
        add_large(large, box_of(t.corners, 3), records);
    }

    void bin_clipped(SurfaceId s, std::uint32_t number, Records& records) const {
        LargePolygon large;
        large.surface = s;
        large.polygon = surfaces_.surfaces().screen_polygon(s);
        if (large.polygon.count == 0) return;
        const Box box = box_of(large.polygon.corners, large.polygon.count);
        const DepthPlane plane = surfaces_.surfaces().plane(s);
        const SubpixelPoint at = large.polygon.corners[0];
        const double zero = surfaces_.surfaces().farthest_nearness;
        large.plane.x = at.x;
        large.plane.y = at.y;
        large.plane.nearness =
            static_cast<float>(plane.extended_to(glm::dvec2(at.x, at.y) / 256.0) - zero);
        large.plane.per_x = static_cast<float>(plane.per_x / kSubpixelsPerPixel);
        large.plane.per_y = static_cast<float>(plane.per_y / kSubpixelsPerPixel);
        large.plane.low = static_cast<float>(plane.lowest - zero);
        large.plane.high = static_cast<float>(plane.highest - zero);
        large.plane.id = number << 1;
        add_large(large, box, records);
    }

    void add_large(const LargePolygon& large, const Box& box, Records& records) const {
        const auto index = static_cast<std::uint32_t>(records.polygons.size());
        bool touches = false;
        for_tiles(box, [&](std::uint32_t tile, const SampleBox&) {
            records.large_tiles.push_back(tile);
            records.large.push_back(index);
            touches = true;
        });
        if (touches) records.polygons.push_back(large);
    }

    TileTriangle in_tile(TileTriangle t, std::uint32_t tile, const SampleBox& samples) const {
        const auto tiles = static_cast<std::uint32_t>(grid_.columns);
        const std::int32_t size = 1 << grid_.tile_shift;
        const auto first_column = static_cast<std::int32_t>(tile % tiles) * size;
        const auto first_row = static_cast<std::int32_t>(tile / tiles) * size;
        // A tile has one more column and row of samples.
        const auto block = [size](std::int32_t at, std::int32_t first, std::int32_t last) {
            const std::int32_t within = std::clamp(std::min(at, last) - first, 0, size);
            return static_cast<std::uint8_t>(within >> kBlockShift);
        };
        t.first_column = block(samples.column0, first_column, grid_.width);
        t.last_column = block(samples.column1, first_column, grid_.width);
        t.first_row = block(samples.row0, first_row, grid_.height);
        t.last_row = block(samples.row1, first_row, grid_.height);
        return t;
    }

    /// Calls visit(tile, samples in the box).
    template <typename Visit>
    void for_tiles(const Box& box, const Visit& visit) const {
        // The samples in the box, relative to the grid.
        const std::int32_t half = (1 << grid_.pitch_shift) / 2;
        const auto first_from = [&](std::int32_t at) { return (at + half - 1) >> grid_.pitch_shift; };
        const auto last_before = [&](std::int32_t at) { return (at - half) >> grid_.pitch_shift; };
        const std::int32_t column0 = first_from(box.x0) - grid_.first_column;
        const std::int32_t column1 = last_before(box.x1) - grid_.first_column;
        const std::int32_t row0 = first_from(box.y0) - grid_.first_row;
        const std::int32_t row1 = last_before(box.y1) - grid_.first_row;
        if (column0 > column1 || row0 > row1 || column1 < 0 || row1 < 0 || column0 > grid_.width ||
            row0 > grid_.height) {
            return;
        }
        for (int row = std::max(row0 - 1, 0) >> grid_.tile_shift; row <= std::min(row1, grid_.height - 1) >> grid_.tile_shift; ++row) {
            for (int column = std::max(column0 - 1, 0) >> grid_.tile_shift;
                 column <= std::min(column1, grid_.width - 1) >> grid_.tile_shift; ++column) {
                visit(static_cast<std::uint32_t>(row * grid_.columns + column), SampleBox{column0, row0, column1, row1});
            }
        }
    }

    ScreenSurfaces& surfaces_;
    const TileGrid& grid_;
    const TileKernels& kernels_;
};

void make_ends_of_counts(std::vector<std::size_t>& end) {
    for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
}

}  // namespace

TriangleBins::TriangleBins(ScreenSurfaces& surfaces, PixelRect region, int samples_per_pixel,
                           const TileKernels& kernels, int threads, int tile_samples)
    : region_(region),
      tile_px_(tile_samples / samples_per_pixel),
      columns_((region.width() + tile_px_ - 1) / tile_px_),
      rows_((region.height() + tile_px_ - 1) / tile_px_) {
    const TileGrid grid{region.x0 * samples_per_pixel,
                        region.y0 * samples_per_pixel,
                        region.width() * samples_per_pixel,
                        region.height() * samples_per_pixel,
                        columns_,
                        std::countr_zero(static_cast<unsigned>(kSubpixelsPerPixel / samples_per_pixel)),
                        std::countr_zero(static_cast<unsigned>(tile_samples))};
    const std::vector<TriangleChunk> chunks = surfaces.chunks_of_triangles(kChunkTriangles);
    std::vector<Records> records(chunks.size());
    std::vector<Scratch> scratch(static_cast<std::size_t>(threads));
    const Binner binner(surfaces, grid, kernels);
    parallel_for(chunks.size(), threads, [&](std::size_t c, int worker) {
        binner.bin(chunks[c], scratch[static_cast<std::size_t>(worker)], records[c]);
    });
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) { surfaces.find_line_edges(chunks[c]); });

    // Stable, chunk after chunk: the same for any number of threads.
    run_end_.assign(tile_count() + 1, 0);
    large_end_.assign(tile_count() + 1, 0);
    for (Records& r : records) {
        for (const TileRun& run : r.runs) ++run_end_[run.key / 2 + 1];
        for (const std::uint32_t tile : r.large_tiles) ++large_end_[tile + 1];
    }
    make_ends_of_counts(run_end_);
    make_ends_of_counts(large_end_);
    runs_.resize(run_end_.back());
    large_sorted_.resize(large_end_.back());
    std::vector<std::size_t> next_run = run_end_, next_large = large_end_;
    triangles_.resize(chunks.size());
    for (std::size_t c = 0; c < chunks.size(); ++c) {
        Records& r = records[c];
        triangles_[c] = std::move(r.small);
        for (const TileRun& run : r.runs) {
            runs_[next_run[run.key / 2]++] = {chunks[c].instance, run.count, run.key % 2 == 1,
                                              triangles_[c].get() + run.begin};
        }
        const auto before = static_cast<std::uint32_t>(large_.size());
        for (std::size_t i = 0; i < r.large.size(); ++i) {
            large_sorted_[next_large[r.large_tiles[i]]++] = before + r.large[i];
        }
        large_.insert(large_.end(), r.polygons.begin(), r.polygons.end());
    }
}

PixelRect TriangleBins::tile(std::size_t index) const {
    const int column = static_cast<int>(index) % columns_;
    const int row = static_cast<int>(index) / columns_;
    const int x0 = region_.x0 + column * tile_px_;
    const int y0 = region_.y0 + row * tile_px_;
    return {x0, y0, std::min(x0 + tile_px_, region_.x1), std::min(y0 + tile_px_, region_.y1)};
}

PixelRect TriangleBins::empty_tiles_from(std::size_t index) const {
    const auto columns = static_cast<std::size_t>(columns_);
    if (index % columns != 0 && is_empty(index - 1)) return {};
    std::size_t last = index;
    while ((last + 1) % columns != 0 && is_empty(last + 1)) ++last;
    PixelRect rect = tile(index);
    rect.x1 = tile(last).x1;
    return rect;
}

}  // namespace burin
