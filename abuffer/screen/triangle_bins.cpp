#include "abuffer/screen/triangle_bins.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "view/polygon_rows.h"
#include "view/polygon_sides.h"

namespace burin {
namespace {

struct SubpixelBox {  // in 1/256 pixel
    std::int32_t x0, y0, x1, y1;
};

struct SampleBox {  // inclusive, relative to the grid
    std::int32_t column0, row0, column1, row1;
    /// For a triangle between samples, the first one lies behind the last one.
    bool is_thin() const { return column0 > column1 || row0 > row1; }
};

template <typename Corners>
SubpixelBox box_of(const Corners& corners, int count) {
    SubpixelBox box{corners[0].x, corners[0].y, corners[0].x, corners[0].y};
    for (int k = 1; k < count; ++k) {
        const auto& c = corners[static_cast<std::size_t>(k)];
        box.x0 = std::min(box.x0, c.x);
        box.x1 = std::max(box.x1, c.x);
        box.y0 = std::min(box.y0, c.y);
        box.y1 = std::max(box.y1, c.y);
    }
    return box;
}

/// Prefetches in order, at which memory is faster than at the order of lists.
void prefetch_to_write(const TileTriangle* first, std::size_t count) {
    const char* const at = reinterpret_cast<const char*>(first);
    for (std::size_t byte = 0; byte < count * sizeof(TileTriangle); byte += 64) __builtin_prefetch(at + byte, 1);
}

/// One chunk's triangles with the tiles they touch.
struct Records {
    std::unique_ptr<TileTriangle[]> small;                            // sorted by tile
    std::vector<TileLists<TriangleRun>::Record> runs, thin_runs;      // of `small`
    std::vector<TileLists<std::uint32_t>::Record> large, thin_large;  // numbers into polygons
    std::vector<LargePolygon> polygons;
};

constexpr float kNotKnown = std::numeric_limits<float>::infinity();  // nearer than anything

/// Finds what is said of all triangles of a run.
void sum_up(TriangleRun& run) {
    typedef float Floats __attribute__((vector_size(16)));
    typedef std::uint32_t Words __attribute__((vector_size(16)));
    typedef std::int16_t Halves __attribute__((vector_size(16)));
    const auto min = [](const Halves& a, const Halves& b) { return a < b ? a : b; };
    const auto max = [](const Halves& a, const Halves& b) { return a > b ? a : b; };
    // The first columns and rows of four triangles in the low halves of words, the last ones in the high ones.
    constexpr std::uint32_t kColumns = 0x1F001F, kRows = kColumns << 5;
    const Halves least_yet = Halves{} + std::int16_t{kRows & 0xFFFF};
    Halves columns[2] = {least_yet, {}}, rows[2] = {least_yet, {}};
    Floats highest[3];  // in places of three vectors
    for (Floats& h : highest) h = Floats{} - std::numeric_limits<float>::infinity();
    const auto add = [&](const TileTriangle* four) {
        Floats v[3];
        for (int k = 0; k < 3; ++k) {  // one by one: all at once would go through memory
            std::memcpy(&v[k], reinterpret_cast<const char*>(four) + sizeof(Floats) * static_cast<std::size_t>(k),
                        sizeof(Floats));
            highest[k] = v[k] > highest[k] ? v[k] : highest[k];
        }
        const Floats first = __builtin_shufflevector(v[0], v[1], 2, 2, 5, 5),
                     second = __builtin_shufflevector(first, v[2], 0, 2, 4, 7);
        const Words blocks = Words(second);
        const Halves c = Halves(blocks & kColumns), r = Halves(blocks & kRows);
        columns[0] = min(columns[0], c);
        columns[1] = max(columns[1], c);
        rows[0] = min(rows[0], r);
        rows[1] = max(rows[1], r);
    };
    for (std::uint32_t i = 4; i < run.count; i += 4) add(run.triangles + i - 4);
    TileTriangle last[4];  // some of them once more
    for (std::uint32_t k = 0; k < 4; ++k) last[k] = run.triangles[run.count - 1 - std::min(k, run.count - 1)];
    add(last);
    const auto least = [](const Halves& v) { return static_cast<std::uint32_t>(std::min({v[0], v[2], v[4], v[6]})); };
    const auto most = [](const Halves& v) { return static_cast<std::uint32_t>(std::max({v[1], v[3], v[5], v[7]})); };
    run.highest = std::max({highest[0][1], highest[1][0], highest[1][3], highest[2][2]});
    run.blocks = TileTriangle::pack(least(columns[0]), most(columns[1]), least(rows[0]) >> 5, most(rows[1]) >> 5);
}

/// Buffers of one thread.
struct Scratch {
    static constexpr std::size_t kOthers = kChunkTriangles + kRoomBehindCulled;
    static constexpr std::size_t kRoom = 4 * std::size_t{kChunkTriangles} + kRoomBehindCulled;
    std::vector<std::uint32_t> keys, triangles, blocks, others;
    std::vector<std::uint32_t> starts;  // of those side by side with equal keys
    std::vector<float> highest;
    std::vector<TileTriangle> more_triangles;  // of the others, once for each tile
    std::vector<std::uint32_t> more_keys;
    std::vector<std::uint32_t> count, used;  // per key; keys with a count

    CulledTriangles found() {
        for (auto* list : {&keys, &triangles, &blocks, &starts}) list->resize(kRoom);
        highest.resize(kRoom);
        others.resize(kOthers);
        return {keys.data(), triangles.data(), highest.data(), blocks.data(), 0, others.data(), 0};
    }
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
        scratch.count.resize(kTriangleKinds * tile_count(), 0);
        scratch.more_triangles.clear();
        scratch.more_keys.clear();
        CulledTriangles found = scratch.found();
        kernels_.cull.triangles(surfaces_.mesh(chunk.instance), chunk.begin, chunk.end, grid_,
                                surfaces_.facings(chunk.instance), found);
        for (std::size_t i = 0; i < found.other_count; ++i)
            add_other({chunk.instance, found.others[i]}, scratch, records);
        sort(chunk.instance, found, scratch, records);
    }

  private:
    std::size_t tile_count() const {
        const int rows = ((grid_.height - 1) >> grid_.tile_shift) + 1;
        return static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(rows);
    }

    /// Sorts by counting keys. Neighbours often lie in one tile.
    void sort(std::uint32_t instance, const CulledTriangles& found, Scratch& scratch, Records& records) const {
        auto& count = scratch.count;
        scratch.used.clear();
        const auto add = [&](std::uint32_t key, std::uint32_t more) {
            if (count[key] == 0) scratch.used.push_back(key);
            count[key] += more;
        };
        const std::uint32_t* const starts = scratch.starts.data();
        const std::size_t run_count = kernels_.sort.find_runs(found.keys, found.count, scratch.starts.data());
        for (std::size_t i = 0; i < run_count; ++i) add(found.keys[starts[i]], starts[i + 1] - starts[i]);
        for (const std::uint32_t key : scratch.more_keys) add(key, 1);
        const std::size_t room = found.count + scratch.more_keys.size() + kRoomBehindRun * scratch.used.size();
        records.small = std::make_unique_for_overwrite<TileTriangle[]>(room);
        TileTriangle* const small = records.small.get();
        prefetch_to_write(small, room);
        std::uint32_t begin = 0;
        for (const std::uint32_t key : scratch.used) {
            const auto kind = static_cast<TriangleKind>(key % kTriangleKinds);
            (kind == thin ? records.thin_runs : records.runs)
                .push_back({key / kTriangleKinds, {instance, count[key], kind, 0, small + begin, kNotKnown, 0}});
            begin += std::exchange(count[key], begin) + static_cast<std::uint32_t>(kRoomBehindRun);
        }
        kernels_.sort.put_runs(found, starts, run_count, count.data(), small);
        for (std::size_t i = 0; i < scratch.more_keys.size(); ++i) {
            small[count[scratch.more_keys[i]]++] = scratch.more_triangles[i];
        }
        for (const std::uint32_t key : scratch.used) count[key] = 0;
        for (auto* list : {&records.runs, &records.thin_runs}) {
            for (auto& [tile, run] : *list) {
                run.nearness = run.triangles[run.count / 2].highest;
                // On closed surfaces these face away, as a rule; a whole run of the others is seldom hidden.
                if (run.kind == wound_clockwise) sum_up(run);
            }
        }
    }

    /// These triangles are large, not all on the screen, or in many tiles.
    void add_other(SurfaceId s, Scratch& scratch, Records& records) const {
        const std::uint32_t number = surfaces_.number_of(s);
        const ScreenTriangle t = surfaces_.triangle(s);
        const bool is_off = std::any_of(std::begin(t.corners), std::end(t.corners),
                                        [](const ScreenVertex& v) { return v.x == ScreenVertex::kOffScreen; });
        if (is_off) {
            surfaces_.set_facing(number, off_screen);
            return bin_clipped(s, number, records);
        }
        const std::int64_t area = doubled_area(t.corners[0], t.corners[1], t.corners[2]);
        surfaces_.set_facing(number, area == 0 ? edge_on : area > 0 ? clockwise : counterclockwise);
        if (area == 0) return;
        const SubpixelBox box = box_of(t.corners, 3);
        if (box.x1 - box.x0 < kLargestSmallTriangle && box.y1 - box.y0 < kLargestSmallTriangle)
            return add_small(s, t, box, scratch);
        LargePolygon large;
        large.surface = s;
        large.polygon.count = 3;
        for (std::size_t k = 0; k < 3; ++k) large.polygon.corners[k] = {t.corners[k].x, t.corners[k].y};
        large.plane = plane_of_triangle(t, number << 1);
        add_large(large, box, records);
    }

    /// Lists a small triangle once for every tile that it may touch.
    void add_small(SurfaceId s, const ScreenTriangle& t, const SubpixelBox& box, Scratch& scratch) const {
        const bool turned = surfaces_.facing(surfaces_.number_of(s)) == clockwise;
        const float highest = std::max({t.corners[0].nearness, t.corners[1].nearness, t.corners[2].nearness});
        for_tiles(box, nullptr, [&](std::uint32_t touched, const SampleBox& samples) {
            scratch.more_triangles.push_back(in_tile({s.triangle, highest, 0}, touched, samples));
            const TriangleKind kind = samples.is_thin() ? thin : turned ? wound_clockwise : wound_counterclockwise;
            scratch.more_keys.push_back(tile_key(touched, kind));
        });
    }

    void bin_clipped(SurfaceId s, std::uint32_t number, Records& records) const {
        LargePolygon large;
        large.surface = s;
        large.polygon = surfaces_.surfaces().screen_polygon(s);
        if (large.polygon.count == 0) return;
        const SubpixelBox box = box_of(large.polygon.corners, large.polygon.count);
        const DepthPlane plane = surfaces_.surfaces().plane(s);
        const SubpixelPoint at = large.polygon.corners[0];
        const double zero = surfaces_.surfaces().farthest_nearness;
        large.plane.x = at.x;
        large.plane.y = at.y;
        large.plane.nearness = static_cast<float>(plane.extended_to(to_pixels(glm::dvec2(at.x, at.y))) - zero);
        large.plane.per_x = static_cast<float>(plane.per_x / kSubpixelsPerPixel);
        large.plane.per_y = static_cast<float>(plane.per_y / kSubpixelsPerPixel);
        large.plane.low = static_cast<float>(plane.lowest - zero);
        large.plane.high = static_cast<float>(plane.highest - zero);
        large.plane.id = number << 1;
        add_large(large, box, records);
    }

    void add_large(const LargePolygon& large, const SubpixelBox& box, Records& records) const {
        const auto index = static_cast<std::uint32_t>(records.polygons.size());
        const PolygonSides sides(large.polygon);
        std::array<PolygonRows::Corner, ScreenPolygon::kMaxCorners> corners;
        const auto count = static_cast<std::size_t>(large.polygon.count);
        for (std::size_t i = 0; i < count; ++i) {
            corners[i] = {static_cast<double>(large.polygon.corners[i].x),
                          static_cast<double>(large.polygon.corners[i].y)};
        }
        const PolygonRows rows{std::span(corners).first(count)};
        bool touches = false;
        for_tiles(box, &rows, [&](std::uint32_t tile, const SampleBox& samples) {
            if (is_beside(sides, tile)) return;
            (samples.is_thin() ? records.thin_large : records.large).push_back({tile, index});
            touches = true;
        });
        if (touches) records.polygons.push_back(large);
    }

    /// What lies less than a pixel from a tile's samples belongs to it, too, for whatever looks for surfaces beside
    /// lines.
    static constexpr std::int32_t kBeside = kSubpixelsPerPixel;
    bool is_beside(const PolygonSides& sides, std::uint32_t tile) const {
        const auto tiles = static_cast<std::uint32_t>(grid_.columns);
        const auto first = [&](std::uint32_t at, std::int32_t origin) {
            return (std::int64_t{origin} + (std::int64_t{at} << grid_.tile_shift)) << grid_.pitch_shift;
        };
        const std::int64_t x = first(tile % tiles, grid_.first_column), y = first(tile / tiles, grid_.first_row);
        const std::int64_t width = std::int64_t{(1 << grid_.tile_shift) + 1} << grid_.pitch_shift;
        return sides.leave_out(x - kBeside, y - kBeside, x + width + kBeside, y + width + kBeside);
    }

    TileTriangle in_tile(TileTriangle t, std::uint32_t tile, const SampleBox& samples) const {
        const auto tiles = static_cast<std::uint32_t>(grid_.columns);
        const std::int32_t size = 1 << grid_.tile_shift;
        const auto first_column = static_cast<std::int32_t>(tile % tiles) * size;
        const auto first_row = static_cast<std::int32_t>(tile / tiles) * size;
        // A tile has one more column and row of samples.
        const auto block = [size](std::int32_t at, std::int32_t first, std::int32_t last) {
            const std::int32_t within = std::clamp(std::min(at, last) - first, 0, size);
            return static_cast<std::uint32_t>(within >> kBlockShift);
        };
        const auto [column0, column1] = std::minmax(samples.column0, samples.column1);
        const auto [row0, row1] = std::minmax(samples.row0, samples.row1);
        t.blocks =
            TileTriangle::pack(block(column0, first_column, grid_.width), block(column1, first_column, grid_.width),
                               block(row0, first_row, grid_.height), block(row1, first_row, grid_.height));
        return t;
    }

    /// Calls visit(tile, samples in the box), but for most tiles that a polygon passes by. nullptr: for all.
    template <typename Visit>
    void for_tiles(const SubpixelBox& box, const PolygonRows* polygon, const Visit& visit) const {
        // The samples in the box, relative to the grid.
        const std::int32_t half = (1 << grid_.pitch_shift) / 2;
        const auto first_from = [&](std::int32_t at) { return (at + half - 1) >> grid_.pitch_shift; };
        const auto last_before = [&](std::int32_t at) { return (at - half) >> grid_.pitch_shift; };
        const SampleBox samples{first_from(box.x0) - grid_.first_column, first_from(box.y0) - grid_.first_row,
                                last_before(box.x1) - grid_.first_column, last_before(box.y1) - grid_.first_row};
        const auto [column0, row0, column1, row1] = samples;
        if (column1 < 0 || row1 < 0 || column0 > grid_.width || row0 > grid_.height) return;
        if (samples.is_thin() && !grid_.keeps_thin) return;
        const int first_column = std::max(column0 - 1, 0) >> grid_.tile_shift,
                  last_column = std::min(column1, grid_.width - 1) >> grid_.tile_shift;
        for (int row = std::max(row0 - 1, 0) >> grid_.tile_shift;
             row <= std::min(row1, grid_.height - 1) >> grid_.tile_shift; ++row) {
            int first = first_column, last = last_column;
            if (polygon != nullptr && first < last) {
                const PolygonRows::Range range = in_row_of_tiles(*polygon, row);
                if (range.is_empty()) continue;
                const auto column_at = [&](double x) {
                    return ((static_cast<std::int32_t>(std::floor(x)) >> grid_.pitch_shift) - grid_.first_column) >>
                           grid_.tile_shift;
                };
                constexpr std::int32_t kOneMore = 1;  // the column of samples that a tile has in addition
                first = std::max(first, column_at(range.low - kBeside - ((kOneMore + 1) << grid_.pitch_shift)));
                last = std::min(last, column_at(range.high + kBeside));
            }
            for (int column = first; column <= last; ++column)
                visit(static_cast<std::uint32_t>(row * grid_.columns + column), samples);
        }
    }

    PolygonRows::Range in_row_of_tiles(const PolygonRows& polygon, int row) const {
        const std::int64_t y = (std::int64_t{grid_.first_row} + (std::int64_t{row} << grid_.tile_shift))
                               << grid_.pitch_shift;
        const std::int64_t height = std::int64_t{(1 << grid_.tile_shift) + 1} << grid_.pitch_shift;
        return polygon.between(static_cast<double>(y - kBeside), static_cast<double>(y + height + kBeside));
    }

    ScreenSurfaces& surfaces_;
    const TileGrid& grid_;
    const TileKernels& kernels_;
};

}  // namespace

bool TriangleRun::is_behind(const float* least, float high) const {
    const TileTriangle all{0, high, blocks};
    for (std::int32_t row = all.first_row(); row <= all.last_row(); ++row) {
        for (std::int32_t column = all.first_column(); column <= all.last_column(); ++column) {
            if (!(high < least[row * BlockTable::kPitch + column])) return false;
        }
    }
    return true;
}

TriangleBins::TriangleBins(ScreenSurfaces& surfaces, PixelRect region, int samples_per_pixel,
                           const TileKernels& kernels, int threads, int tile_samples, bool keeps_thin)
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
                        std::countr_zero(static_cast<unsigned>(tile_samples)),
                        keeps_thin};
    const std::vector<TriangleChunk> chunks = surfaces.chunks_of_triangles(kChunkTriangles);
    std::vector<Records> records(chunks.size());
    std::vector<Scratch> scratch(static_cast<std::size_t>(threads));
    const Binner binner(surfaces, grid, kernels);
    parallel_for_parts(chunks.size(), threads, [&](std::size_t c, int worker) {
        binner.bin(chunks[c], scratch[static_cast<std::size_t>(worker)], records[c]);
    });
    parallel_for_parts(chunks.size(), threads, [&](std::size_t c, int) { surfaces.find_line_edges(chunks[c]); });

    // The order is stable, chunk after chunk, and the same for any number of threads.
    std::vector<std::vector<TileLists<TriangleRun>::Record>> runs(chunks.size()), thin_runs(chunks.size());
    std::vector<std::vector<TileLists<std::uint32_t>::Record>> large(chunks.size()), thin_large(chunks.size());
    triangles_.resize(chunks.size());
    for (std::size_t c = 0; c < chunks.size(); ++c) {
        Records& r = records[c];
        triangles_[c] = std::move(r.small);
        runs[c] = std::move(r.runs);
        thin_runs[c] = std::move(r.thin_runs);
        const auto before = static_cast<std::uint32_t>(large_.size());
        for (auto& record : r.large) record.value += before;
        for (auto& record : r.thin_large) record.value += before;
        large[c] = std::move(r.large);
        thin_large[c] = std::move(r.thin_large);
        large_.insert(large_.end(), r.polygons.begin(), r.polygons.end());
    }
    runs_ = {runs, tile_count()};
    thin_runs_ = {thin_runs, tile_count()};
    large_in_ = {large, tile_count()};
    thin_large_in_ = {thin_large, tile_count()};
}

PixelRect TriangleBins::tile(std::size_t index) const {
    const int column = static_cast<int>(index) % columns_;
    const int row = static_cast<int>(index) / columns_;
    const int x0 = region_.x0 + column * tile_px_;
    const int y0 = region_.y0 + row * tile_px_;
    return {x0, y0, std::min(x0 + tile_px_, region_.x1), std::min(y0 + tile_px_, region_.y1)};
}

std::optional<std::size_t> TriangleBins::tile_beside(std::size_t index, int columns, int rows) const {
    const int column = static_cast<int>(index) % columns_ + columns, row = static_cast<int>(index) / columns_ + rows;
    if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return std::nullopt;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
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
