#include "abuffer/slice_costs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "abuffer/edges/edge_lines.h"
#include "abuffer/screen/edge_on_screen.h"
#include "abuffer/screen/triangle_bins.h"
#include "base/parallel.h"

namespace burin {
namespace {

// The numbers below are bytes. Lists that grow may have twice the room that they need.
constexpr std::uint64_t kPerSmall = sizeof(TileTriangle);
// A chunk's list in a tile, as found and as sorted, and the room behind it.
constexpr std::uint64_t kPerRun =
    2 * sizeof(TileLists<TriangleRun>::Record) + sizeof(TriangleRun) + kRoomBehindRun * sizeof(TileTriangle);
constexpr std::uint64_t kPerLarge = 20;  // a number in a tile's list, as found and as sorted
constexpr std::uint64_t kPerEdge = 56;   // that may be a line, in a tile's list, as found and as sorted
constexpr std::uint64_t kPerPolygon = 4 * sizeof(LargePolygon);
// Lines that samples miss, in one tile: a triangle that may hide some, and a half-edge that may be one. Estimated: few
// are.
constexpr std::uint64_t kPerHidingInTile = 40, kPerEdgeInTile = 50;
constexpr std::uint64_t kPerLayer = 20;         // a number in a tile's list, as found and as sorted
constexpr std::uint64_t kPerLayerInTile = 500;  // a triangle in a HidingTile and its cells, set up
// What lines take, for each triangle in a tile's list, and at most for each pixel. docs/performance/memory.md has
// examples.
constexpr std::uint64_t kLinesPerVisible = 256, kLinesPerPixel = 32, kLinesPerLayer = 100;

struct ScreenExtent {  // in pixels
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    void reach(double x, double y) {
        low = glm::min(low, to_pixels(glm::dvec2(x, y)));
        high = glm::max(high, to_pixels(glm::dvec2(x, y)));
    }
};

/// What one thread has counted.
struct Tally {
    std::vector<std::uint64_t> visible_bytes, visible_touches, layer_touches;  // per row
    std::vector<std::uint64_t> layer_tile_touches, fine_tile_bytes;            // per tile
    std::vector<std::uint32_t> last_chunk[kTriangleKinds];  // per tile: 1 + the last chunk with a run there
};

/// The box of a triangle, nothing to the right of nothing if it is not seen; whether it counts as large.
bool find_box(const ScreenSurfaces& screen, SurfaceId s, ScreenExtent& box) {
    const ScreenTriangle t = screen.triangle(s);
    const bool is_off = std::any_of(std::begin(t.corners), std::end(t.corners),
                                    [](const ScreenVertex& v) { return v.x == ScreenVertex::kOffScreen; });
    if (is_off) {
        const ScreenPolygon polygon = screen.surfaces().screen_polygon(s);
        for (int i = 0; i < polygon.count; ++i) {
            const SubpixelPoint p = polygon.corners[static_cast<std::size_t>(i)];
            box.reach(p.x, p.y);
        }
        return true;
    }
    for (const ScreenVertex& v : t.corners) box.reach(v.x, v.y);
    const glm::dvec2 size = to_subpixels(box.high - box.low);
    return std::max(size.x, size.y) >= kLargestSmallTriangle;
}

/// Edges of a triangle that may be lines, in half-edges: one where its partner counts, too, two for a border.
std::uint64_t possible_lines(const ScreenMesh& mesh, std::uint32_t triangle) {
    std::uint64_t count = 0;
    for (unsigned edges = mesh.line_edges[triangle] & 7u; edges != 0; edges &= edges - 1) {
        const HalfEdge h = 3 * triangle + static_cast<unsigned>(std::countr_zero(edges));
        count += mesh.partners[h] == h ? 2 : 1;
    }
    return count;
}

}  // namespace

SliceCosts::SliceCosts(const PixelTiles& visible, const PixelTiles* layers, int samples_per_pixel, bool has_fine,
                       int threads)
    : visible_(visible), layers_(layers), sample_px_(1.0 / samples_per_pixel), has_fine_(has_fine), threads_(threads) {
    counts_.visible_bytes.assign(static_cast<std::size_t>(visible.rows().end), 0);
    counts_.visible_touches = counts_.visible_bytes;
    if (has_fine) fine_tile_bytes_.assign(visible.count(), 0);
    if (layers == nullptr) return;
    counts_.layer_touches.assign(static_cast<std::size_t>(layers->rows().end), 0);
    layer_tile_touches_.assign(layers->count(), 0);
}

void SliceCosts::add(ScreenSurfaces& screen) {
    const std::vector<TriangleChunk> chunks = screen.chunks_of_triangles(kChunkTriangles);
    if (has_fine_) find_edges(screen, chunks);
    add_loose_edges(screen);
    std::vector<Tally> tallies(static_cast<std::size_t>(threads_));
    const auto row_of = [](const PixelTiles& tiles, std::uint32_t tile) {
        return tile / static_cast<std::uint32_t>(tiles.columns());
    };
    parallel_for_parts(chunks.size(), threads_, [&](std::size_t c, int worker) {
        Tally& tally = tallies[static_cast<std::size_t>(worker)];
        if (tally.visible_bytes.empty()) {
            tally.visible_bytes.assign(counts_.visible_bytes.size(), 0);
            tally.visible_touches = tally.visible_bytes;
            tally.layer_touches.assign(counts_.layer_touches.size(), 0);
            tally.layer_tile_touches.assign(layer_tile_touches_.size(), 0);
            tally.fine_tile_bytes.assign(fine_tile_bytes_.size(), 0);
            for (auto& last : tally.last_chunk) last.assign(visible_.count(), 0);
        }
        for (std::uint32_t triangle = chunks[c].begin; triangle < chunks[c].end; ++triangle) {
            const SurfaceId s{chunks[c].instance, triangle};
            ScreenExtent box;
            const bool is_large = find_box(screen, s, box);
            if (!(box.low.x <= box.high.x)) continue;
            if (layers_ != nullptr) {
                layers_->visit(box.low, box.high, [&](std::uint32_t tile) {
                    ++tally.layer_touches[row_of(*layers_, tile)];
                    ++tally.layer_tile_touches[tile];
                });
            }
            // The samples in the box; a tile also gets those next to its right and lower border.
            const glm::dvec2 first = glm::ceil(box.low / sample_px_ - 0.5),
                             last = glm::floor(box.high / sample_px_ - 0.5);
            const bool is_thin = first.x > last.x || first.y > last.y;
            if (is_thin && !has_fine_) continue;
            const ScreenTriangle t = screen.triangle(s);
            const bool is_clockwise = !is_large && doubled_area(t.corners[0], t.corners[1], t.corners[2]) > 0;
            const TriangleKind kind = is_thin ? thin : is_clockwise ? wound_clockwise : wound_counterclockwise;
            const std::uint64_t half_edges = has_fine_ ? possible_lines(screen.mesh(s.instance), triangle) : 0;
            std::uint32_t last_row = ~0u;
            visible_.visit(box.low - 2 * sample_px_, box.high + sample_px_, [&](std::uint32_t tile) {
                const std::uint32_t row = row_of(visible_, tile);
                std::uint64_t& cost = tally.visible_bytes[row];
                ++tally.visible_touches[row];
                cost += (is_large ? kPerLarge : kPerSmall) + half_edges * kPerEdge / 2;
                if (has_fine_) tally.fine_tile_bytes[tile] += kPerHidingInTile + half_edges * kPerEdgeInTile;
                if (is_large && row != last_row) cost += kPerPolygon;
                last_row = row;
                std::uint32_t& last_chunk = tally.last_chunk[kind][tile];
                if (!is_large && last_chunk != c + 1) cost += kPerRun;
                if (!is_large) last_chunk = static_cast<std::uint32_t>(c + 1);
            });
        }
    });
    for (const Tally& tally : tallies) {
        const auto add_to = [](std::vector<std::uint64_t>& sums, const std::vector<std::uint64_t>& values) {
            for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i];
        };
        add_to(counts_.visible_bytes, tally.visible_bytes);
        add_to(counts_.visible_touches, tally.visible_touches);
        add_to(counts_.layer_touches, tally.layer_touches);
        add_to(layer_tile_touches_, tally.layer_tile_touches);
        add_to(fine_tile_bytes_, tally.fine_tile_bytes);
    }
}

/// Counts loose edges as if marks were asked for, whether they are or not.
void SliceCosts::add_loose_edges(const ScreenSurfaces& screen) {
    const auto row_of = [](const PixelTiles& tiles, std::uint32_t tile) {
        return tile / static_cast<std::uint32_t>(tiles.columns());
    };
    for (const LooseChunk& chunk : chunks_of_loose_edges(screen, LineClass::mark)) {
        const Mesh& mesh = *screen.surfaces().instances[chunk.instance].mesh;
        for (HalfEdge number = chunk.begin; number < chunk.end; ++number) {
            const auto [from, to] = mesh.loose_edge(number);
            const auto edge = edge_on_screen(screen, chunk.instance, from, to);
            if (!edge) continue;
            ScreenExtent box;
            for (const glm::dvec2& end : {edge->from, edge->to}) box.reach(end.x, end.y);
            visible_.visit(box.low - 2 * sample_px_, box.high + sample_px_, [&](std::uint32_t tile) {
                counts_.visible_bytes[row_of(visible_, tile)] += kPerEdge;
                ++counts_.visible_touches[row_of(visible_, tile)];
                if (has_fine_) fine_tile_bytes_[tile] += kPerEdgeInTile;
            });
            if (layers_ == nullptr) continue;
            layers_->visit(box.low, box.high,
                           [&](std::uint32_t tile) { ++counts_.layer_touches[row_of(*layers_, tile)]; });
        }
    }
}

void SliceCosts::find_edges(ScreenSurfaces& screen, const std::vector<TriangleChunk>& chunks) const {
    parallel_for_parts(chunks.size(), threads_, [&](std::size_t c, int) {
        for (std::uint32_t t = chunks[c].begin; t < chunks[c].end; ++t) {
            const SurfaceId s{chunks[c].instance, t};
            const auto [p, q, r] = screen.triangle(s).corners;
            const bool is_off = std::min({p.x, q.x, r.x}) == ScreenVertex::kOffScreen;
            const std::int64_t area = is_off ? 0 : doubled_area(p, q, r);
            screen.set_facing(screen.number_of(s), is_off      ? off_screen
                                                   : area == 0 ? edge_on
                                                   : area > 0  ? clockwise
                                                               : counterclockwise);
        }
    });
    parallel_for_parts(chunks.size(), threads_, [&](std::size_t c, int) { screen.find_line_edges(chunks[c]); });
}

RowCosts SliceCosts::visible() const {
    RowCosts costs{counts_.visible_bytes, {}};
    const std::uint64_t row_px =
        static_cast<std::uint64_t>(visible_.rect().width()) * static_cast<std::uint64_t>(visible_.tile_px());
    for (const std::uint64_t touches : counts_.visible_touches) {
        costs.lines.push_back(std::min(kLinesPerVisible * touches, kLinesPerPixel * row_px));
    }
    return costs;
}

RowCosts SliceCosts::layers() const {
    RowCosts costs;
    for (const std::uint64_t touches : counts_.layer_touches) {
        costs.bins.push_back(kPerLayer * touches);
        costs.lines.push_back(kLinesPerLayer * touches);
    }
    return costs;
}

std::uint64_t SliceCosts::largest_layer_tile() const {
    const auto largest = std::max_element(layer_tile_touches_.begin(), layer_tile_touches_.end());
    return largest == layer_tile_touches_.end() ? 0 : kPerLayerInTile * *largest;
}

std::uint64_t SliceCosts::largest_fine_tile() const {
    const auto largest = std::max_element(fine_tile_bytes_.begin(), fine_tile_bytes_.end());
    return largest == fine_tile_bytes_.end() ? 0 : *largest;
}

InstanceExtent SliceCosts::extent_of(const ScreenSurfaces& screen, std::uint32_t instance) {
    const std::size_t count = screen.surfaces().instances[instance].mesh->positions.size();
    const ScreenVertex* const v = screen.vertices(instance);
    ScreenExtent box;
    for (std::size_t i = 0; i < count; ++i) {
        if (v[i].x == ScreenVertex::kOffScreen) return {glm::dvec2(-kGuardBandPx), glm::dvec2(kGuardBandPx)};
        box.reach(v[i].x, v[i].y);
    }
    return {box.low, box.high};
}

}  // namespace burin
