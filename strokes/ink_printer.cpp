#include "strokes/ink_printer.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "base/parallel.h"
#include "strokes/ink_mattes.h"
#include "strokes/ink_pixels.h"
#include "strokes/ink_tile.h"
#include "strokes/pixel_filter.h"
#include "view/pixel_tiles.h"

namespace burin {
namespace {

constexpr int kInkTilePx = 32;

/// Whole tiles around a crop. They are those of the whole picture, so that each has the same strokes in any crop.
PixelRect whole_tiles(PixelRect crop) {
    const auto down = [](int px) { return px & -kInkTilePx; };
    return {down(crop.x0), down(crop.y0), down(crop.x1 + kInkTilePx - 1), down(crop.y1 + kInkTilePx - 1)};
}

/// The segments of strokes that reach each tile, and the boundaries that may cut them.
struct Bins {
    PixelTiles tiles;
    TileLists<InkSegmentRef> segments;
    TileLists<std::uint32_t> boundaries;

    Bins(const InkedLines& lines, const InkPlan& plan, bool has_sides, PixelRect crop)
        : tiles(whole_tiles(crop), kInkTilePx) {
        const double filter_px = reach_px(lines.filter);
        std::vector<std::vector<TileLists<InkSegmentRef>::Record>> segment_records(1);
        for (std::size_t i = 0; i < lines.strokes.size(); ++i) {
            const InkStroke& stroke = lines.strokes[i];
            const double halo_px = std::max(stroke.halo_px, 0.0f);
            for (std::size_t p = stroke.first_point; p + 1 < stroke.first_point + stroke.point_count; ++p) {
                const InkPoint &from = lines.points[p], &to = lines.points[p + 1];
                // At least the finest pen, and a pixel for what samples are shifted.
                const double reach =
                    0.5 * static_cast<double>(std::max({from.width_px, to.width_px, 1.0f})) + halo_px + filter_px + 1;
                tiles.visit(
                    glm::min(from.place, to.place) - reach, glm::max(from.place, to.place) + reach,
                    [&](std::uint32_t tile) {
                        segment_records[0].push_back(
                            {tile, {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(p), plan.looks[i].rank}});
                    });
            }
        }
        segments = TileLists<InkSegmentRef>(segment_records, tiles.count());
        std::vector<std::vector<TileLists<std::uint32_t>::Record>> boundary_records(1);
        if (plan.may_hide || has_sides) {
            const double reach = plan.most_radius_px + filter_px + 1;
            for (std::size_t i = 0; i < lines.boundaries.size(); ++i) {
                const InkBoundary& b = lines.boundaries[i];
                tiles.visit(glm::min(b.from, b.to) - reach, glm::max(b.from, b.to) + reach, [&](std::uint32_t tile) {
                    boundary_records[0].push_back({tile, static_cast<std::uint32_t>(i)});
                });
            }
        }
        boundaries = TileLists<std::uint32_t>(boundary_records, tiles.count());
    }
};

}  // namespace

void draw_ink(const Frame& frame, const InkedLines& lines, int threads, Film& film) {
    if (lines.strokes.empty() || frame.crop.width() <= 0 || frame.crop.height() <= 0) return;
    const InkPlan plan = plan_of(lines);
    const bool has_sides = std::any_of(lines.strokes.begin(), lines.strokes.end(),
                                       [](const InkStroke& s) { return drawn_side(s) != StrokeSide::both; });
    const Bins bins(lines, plan, has_sides, frame.crop);
    const std::unique_ptr<const FilterTable> filter = FilterTable::make(lines.filter);
    const int reach = filter ? FilterTable::kReach : 0;
    struct Worker {
        InkTile tile;
        InkPixels pixels;
        std::optional<InkMattes> mattes = std::nullopt;  // if some layer asks for it
    };
    std::vector<std::unique_ptr<Worker>> workers(static_cast<std::size_t>(resolve_thread_count(threads)));
    parallel_for(bins.tiles.count(), static_cast<int>(workers.size()), [&](std::size_t i, int worker) {
        const auto segments = bins.segments.of(i);
        if (segments.empty()) return;
        std::unique_ptr<Worker>& own = workers[static_cast<std::size_t>(worker)];
        if (own == nullptr) {
            own.reset(new Worker{InkTile(frame, lines, plan, best_kernels()),
                                 InkPixels(lines, plan, filter.get(), best_kernels(), film)});
            if (film.mattes() != nullptr)
                own->mattes.emplace(frame, lines, plan, filter.get(), best_kernels(), *film.mattes());
        }
        const PixelRect whole = bins.tiles.tile(i), &crop = frame.crop;
        const PixelRect rect{std::max(whole.x0, crop.x0), std::max(whole.y0, crop.y0), std::min(whole.x1, crop.x1),
                             std::min(whole.y1, crop.y1)};
        if (own->mattes) own->tile.tell(&own->mattes->begin(rect));
        own->tile.draw(segments, bins.boundaries.of(i),
                       {rect.x0 - reach, rect.y0 - reach, rect.x1 + reach, rect.y1 + reach});
        own->pixels.put(own->tile, rect);
        if (own->mattes) own->mattes->add(own->tile);
    });
}

}  // namespace burin
