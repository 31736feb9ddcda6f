#include "methods/abuffer/triangle_bins.h"

#include <algorithm>

#include "base/parallel.h"

namespace burin {
namespace {

constexpr std::uint32_t kChunkTriangles = 1 << 14;

struct Chunk {
    std::uint32_t instance, first, end;
};

std::vector<Chunk> split_into_chunks(const SurfaceSet& surfaces) {
    std::vector<Chunk> chunks;
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        const auto count = static_cast<std::uint32_t>(surfaces.instances[i].mesh->triangles.size());
        for (std::uint32_t t = 0; t < count; t += kChunkTriangles) {
            chunks.push_back({i, t, std::min(count, t + kChunkTriangles)});
        }
    }
    return chunks;
}

struct Box {  // in 1/256 pixel
    std::int32_t x0, y0, x1, y1;
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

/// One chunk's triangles with the tiles they touch.
struct Records {
    std::vector<std::uint32_t> small_tiles, large_tiles;
    std::vector<ScreenTriangle> small;
    std::vector<std::uint32_t> large;  // numbers into polygons
    std::vector<LargePolygon> polygons;
};

SpanPlane plane_of_triangle(const ScreenTriangle& t) {
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
    plane.id = t.id;
    return plane;
}

class Binner {
  public:
    Binner(ScreenSurfaces& surfaces, PixelRect region, int tile_px, int columns, int samples_per_pixel)
        : surfaces_(surfaces),
          region_(region),
          tile_px_(tile_px),
          columns_(columns),
          pitch_(kSubpixelsPerPixel / samples_per_pixel) {}

    void bin(SurfaceId s, Records& records) const {
        const std::uint32_t number = surfaces_.number_of(s);
        const ScreenTriangle t = surfaces_.triangle(s);
        const bool is_off = std::any_of(std::begin(t.corners), std::end(t.corners), [](const ScreenVertex& v) {
            return v.x == ScreenVertex::kOffScreen;
        });
        if (is_off) {
            surfaces_.set_facing(number, ScreenSurfaces::off_screen);
            return bin_clipped(s, number, records);
        }
        const std::int64_t area = doubled_area(t.corners[0], t.corners[1], t.corners[2]);
        surfaces_.set_facing(number, area == 0  ? ScreenSurfaces::edge_on
                                     : area > 0 ? ScreenSurfaces::clockwise
                                                : ScreenSurfaces::counterclockwise);
        if (area == 0) return;
        const Box box = box_of(t.corners, 3);
        if (has_no_sample(box)) return;
        if (box.x1 - box.x0 < kLargestSmallTriangle && box.y1 - box.y0 < kLargestSmallTriangle) {
            for_tiles(box, [&](std::uint32_t tile) {
                records.small_tiles.push_back(tile);
                records.small.push_back(t);
            });
            return;
        }
        LargePolygon large;
        large.surface = s;
        large.polygon.count = 3;
        for (std::size_t k = 0; k < 3; ++k) large.polygon.corners[k] = {t.corners[k].x, t.corners[k].y};
        large.plane = plane_of_triangle(t);
        add_large(large, box, records);
    }

  private:
    void bin_clipped(SurfaceId s, std::uint32_t number, Records& records) const {
        LargePolygon large;
        large.surface = s;
        large.polygon = surfaces_.surfaces().screen_polygon(s);
        if (large.polygon.count == 0) return;
        const Box box = box_of(large.polygon.corners, large.polygon.count);
        if (has_no_sample(box)) return;
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
        for_tiles(box, [&](std::uint32_t tile) {
            records.large_tiles.push_back(tile);
            records.large.push_back(index);
            touches = true;
        });
        if (touches) records.polygons.push_back(large);
    }

    /// Whether a box lies between the rows or the columns of the sample grid.
    bool has_no_sample(const Box& box) const {
        const auto between = [this](std::int32_t low, std::int32_t high) {
            const int shift = kSubpixelsPerPixel / 2;  // any number of pitches
            const std::int32_t half = pitch_ / 2;
            (void)shift;
            return floor_div(low - half - 1) == floor_div(high - half);
        };
        return between(box.x0, box.x1) || between(box.y0, box.y1);
    }
    std::int32_t floor_div(std::int32_t a) const {
        return a >= 0 ? a / pitch_ : -((-a + pitch_ - 1) / pitch_);
    }

    template <typename Visit>
    void for_tiles(const Box& box, const Visit& visit) const {
        // One sample beyond its right and lower border belongs to a tile as well.
        const std::int32_t tile = tile_px_ * kSubpixelsPerPixel;
        const std::int32_t left = box.x0 - region_.x0 * kSubpixelsPerPixel;
        const std::int32_t right = box.x1 - region_.x0 * kSubpixelsPerPixel;
        const std::int32_t top = box.y0 - region_.y0 * kSubpixelsPerPixel;
        const std::int32_t bottom = box.y1 - region_.y0 * kSubpixelsPerPixel;
        const std::int32_t width = region_.width() * kSubpixelsPerPixel + pitch_;
        const std::int32_t height = region_.height() * kSubpixelsPerPixel + pitch_;
        if (right < 0 || bottom < 0 || left > width || top > height) return;
        const int last_column = std::min(right, width - pitch_ - 1) / tile;
        const int last_row = std::min(bottom, height - pitch_ - 1) / tile;
        for (int row = std::max(top - pitch_, 0) / tile; row <= last_row; ++row) {
            for (int column = std::max(left - pitch_, 0) / tile; column <= last_column; ++column) {
                visit(static_cast<std::uint32_t>(row * columns_ + column));
            }
        }
    }

    ScreenSurfaces& surfaces_;
    PixelRect region_;
    int tile_px_, columns_;
    std::int32_t pitch_;
};

template <typename Value>
void sort_by_tile(const std::vector<Records>& records, std::vector<std::uint32_t> Records::*tiles,
                  std::vector<Value> Records::*values, std::size_t tile_count, std::vector<std::size_t>& end,
                  std::vector<Value>& sorted) {
    end.assign(tile_count + 1, 0);
    for (const Records& r : records) {
        for (const std::uint32_t tile : r.*tiles) ++end[tile + 1];
    }
    for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
    sorted.resize(end.back());
    std::vector<std::size_t> next = end;
    for (const Records& r : records) {
        for (std::size_t i = 0; i < (r.*tiles).size(); ++i) sorted[next[(r.*tiles)[i]]++] = (r.*values)[i];
    }
}

}  // namespace

TriangleBins::TriangleBins(ScreenSurfaces& surfaces, PixelRect region, int tile_px, int samples_per_pixel,
                           int threads)
    : region_(region),
      tile_px_(tile_px),
      columns_((region.width() + tile_px - 1) / tile_px),
      rows_((region.height() + tile_px - 1) / tile_px) {
    const std::vector<Chunk> chunks = split_into_chunks(surfaces.surfaces());
    std::vector<Records> records(chunks.size());
    const Binner binner(surfaces, region, tile_px, columns_, samples_per_pixel);
    parallel_for(chunks.size(), threads, [&](std::size_t c, int) {
        for (std::uint32_t t = chunks[c].first; t < chunks[c].end; ++t) {
            binner.bin({chunks[c].instance, t}, records[c]);
        }
    });
    for (Records& r : records) {
        for (std::uint32_t& i : r.large) i += static_cast<std::uint32_t>(large_.size());
        large_.insert(large_.end(), r.polygons.begin(), r.polygons.end());
    }
    // Stable, chunk after chunk: the same for any number of threads.
    sort_by_tile(records, &Records::small_tiles, &Records::small, tile_count(), small_end_, small_);
    sort_by_tile(records, &Records::large_tiles, &Records::large, tile_count(), large_end_, large_sorted_);
}

PixelRect TriangleBins::tile(std::size_t index) const {
    const int column = static_cast<int>(index) % columns_;
    const int row = static_cast<int>(index) / columns_;
    const int x0 = region_.x0 + column * tile_px_;
    const int y0 = region_.y0 + row * tile_px_;
    return {x0, y0, std::min(x0 + tile_px_, region_.x1), std::min(y0 + tile_px_, region_.y1)};
}

}  // namespace burin
