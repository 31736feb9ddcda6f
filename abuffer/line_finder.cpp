#include "abuffer/line_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "abuffer/edges/edge_lines.h"
#include "abuffer/hidden_pass.h"
#include "abuffer/hiding/pieces_behind.h"
#include "abuffer/picture_slices.h"
#include "abuffer/screen/sampling.h"
#include "abuffer/visible_pass.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "render/surface_shading.h"

namespace burin {
namespace {

/// The whole blocks of merged pieces around a crop from which strokes reach into it.
PixelRect region_around(PixelRect crop, int margin_px) {
    const auto down = [](int v) { return (v & ~(kMergeBlockPx - 1)); };
    return {down(crop.x0 - margin_px), down(crop.y0 - margin_px), down(crop.x1 + margin_px + kMergeBlockPx - 1),
            down(crop.y1 + margin_px + kMergeBlockPx - 1)};
}

PixelTiles tiles_of(const Frame& frame, int tile_samples) {
    return {region_around(rect_with_lines(frame), frame.needs.margin_px()), tile_samples / samples_per_pixel_of(frame)};
}

/// Finder makes one picture, and has what its passes share.
class Finder {
  public:
    Finder(const Frame& frame, const RunOptions& options, Film& film, LineDrawing& drawing, RowSink* sink,
           RenderStats& stats)
        : frame_(frame),
          options_(options),
          film_(film),
          drawing_(drawing),
          sink_(sink),
          stats_(stats),
          has_cap_(options.memory_bytes > 0),
          screen_(frame.surfaces, frame.criteria, best_kernels(), stats.threads, !has_cap_),
          shaded_(shaded_surfaces_of(frame, stats.threads)),
          tile_samples_(options.tile_samples > 0 ? options.tile_samples : TileGrid::kTileSamples),
          tiles_(tiles_of(frame, tile_samples_)),
          plan_{{{tiles_.rows(), {}}}, {{HiddenPass::tiles_of(frame).rows(), {}}}, {{}}} {
        if (has_cap_) plan_ = plan_slices(frame, screen_, tiles_, options.memory_bytes, stats.threads);
        stats_.prepare_s = watch_.lap();
        if (options.progress == nullptr) return;
        const std::size_t hidden = frame.needs.behind() ? HiddenPass::tiles_of(frame).count() : 0;
        options.progress->begin("rendering", tiles_.count() + hidden);
    }

    void run() {
        VisiblePass visible(frame_, screen_, shaded_.get(), best_kernels(), stats_.threads, options_.progress,
                            options_.depth_limit);
        find_visible(visible);
        if (frame_.needs.behind()) {
            find_behind(visible.possible_lines());
        } else if (frame_.needs.whole_lines) {
            for (const std::vector<std::uint32_t>& group : plan_.groups) {
                show(group);
                drawing_.add_whole_lines(find_edge_lines(frame_, screen_, PossibleLines(screen_, stats_.threads),
                                                         anywhere_on_screen(), stats_.threads));
            }
        }
        stats_.lines_s += watch_.lap();
        if (shaded_) add_notes_on(*shaded_, stats_.notes);
    }

  private:
    void find_visible(VisiblePass& pass) {
        RowSink* const sink = frame_.needs.behind() ? nullptr : sink_;  // hidden lines are drawn below visible ones
        for (const PictureSlice& slice : plan_.visible) {
            show(slice.instances);
            const PixelRect rows = tiles_.only(slice.rows).rect();
            pass.draw(rows, tile_samples_, sink, drawing_, film_, stats_);
            watch_.lap();
            if (sink != nullptr && &slice != &plan_.visible.back()) hand_on(rows.y1);
        }
    }

    void find_behind(const PossibleLines* possible) {
        const bool needs_all = frame_.needs.whole_picture_behind;
        HiddenPass pass(frame_, screen_, best_kernels(), stats_.threads, options_.progress);
        const PixelTiles tiles = HiddenPass::tiles_of(frame_);
        for (const std::vector<std::uint32_t>& group : plan_.groups) {
            if (!needs_all) break;
            show(group);
            pass.find_lines(tiles.rows(), possible);
        }
        for (const PictureSlice& slice : plan_.layers) {
            const bool is_last = &slice == &plan_.layers.back();
            show(slice.instances);
            if (!needs_all) pass.find_lines(slice.rows, possible);
            pass.sort(slice.rows);
            pass.composite(film_, shaded_.get());
            pass.find_parts();
            if (needs_all && !is_last) continue;
            pass.join_results();
            drawing_.add_behind(
                pieces_behind(pass.lines(), pass.parts(), frame_.needs, frame_.surfaces.farthest_nearness));
            std::vector<WholeLine> lines = pass.take_lines();
            if (frame_.needs.whole_lines) drawing_.add_whole_lines(std::move(lines));
            if (sink_ != nullptr && !is_last) hand_on(tiles.only(slice.rows).rect().y1);
        }
        stats_.fragments += pass.fragment_count();
    }

    void show(const std::vector<std::uint32_t>& instances) {
        if (has_cap_) screen_.show(instances, stats_.threads);
    }

    /// Says to the sink that rows down to `known_y` are found, and forgets what it needs no more.
    void hand_on(int known_y) {
        const double write_s = sink_->draw_rows(known_y);
        stats_.write_s += write_s;
        stats_.lines_s += watch_.lap() - write_s;
        if (has_cap_) drawing_.forget_above(sink_->first_needed_y());
    }

    Stopwatch watch_;
    const Frame& frame_;
    const RunOptions& options_;
    Film& film_;
    LineDrawing& drawing_;
    RowSink* sink_;
    RenderStats& stats_;
    bool has_cap_;
    ScreenSurfaces screen_;
    std::unique_ptr<const ShadedSurfaces> shaded_;
    int tile_samples_;
    PixelTiles tiles_;
    SlicePlan plan_;
};

}  // namespace

void find_lines(const Frame& frame, const RunOptions& options, Film& film, LineDrawing& drawing, RowSink* sink,
                RenderStats& stats) {
    stats.threads = resolve_thread_count(options.threads);
    stats.triangles = frame.surfaces.triangle_count();
    Finder(frame, options, film, drawing, sink, stats).run();
}

SliceCount count_slices(const Frame& frame, std::uint64_t cap_bytes, int threads) {
    const int count = resolve_thread_count(threads);
    ScreenSurfaces screen(frame.surfaces, frame.criteria, best_kernels(), count, false);
    constexpr std::uint64_t kNoCap = std::numeric_limits<std::uint64_t>::max();
    const SlicePlan plan =
        plan_slices(frame, screen, tiles_of(frame, TileGrid::kTileSamples), cap_bytes > 0 ? cap_bytes : kNoCap, count);
    const std::size_t slices = cap_bytes > 0 ? std::max(plan.visible.size(), plan.layers.size()) : 1;
    return {slices, plan.least_bytes};
}

}  // namespace burin
