#include "abuffer/visible_pass.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

#include "abuffer/fine/fine_lines.h"
#include "abuffer/fine/known_borders.h"
#include "abuffer/samples/line_tile.h"
#include "abuffer/samples/pixel_fill.h"
#include "abuffer/samples/surface_beyond.h"
#include "abuffer/screen/sampling.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/stopwatch.h"

namespace burin {
namespace {

struct WorkerTimes {
    double raster = 0, lines = 0, shade = 0, write = 0;
};

/// Where finished rows are handed on, threads must not run far ahead, for what they draw must be kept. This many rows
/// of tiles may be begun below one that is not complete; and for each thread two more, and the tiles it takes in a row.
constexpr std::size_t kRowsAhead = 4;

/// Counts the rows of tiles that are complete, from the top.
class CompleteRows {
  public:
    explicit CompleteRows(const PixelTiles& tiles)
        : columns_(static_cast<std::size_t>(tiles.columns())), left_(tiles.count() / columns_, columns_) {}

    /// Counts a finished tile; returns how many rows are complete.
    std::size_t add(std::size_t tile) {
        const std::lock_guard lock(mutex_);
        --left_[tile / columns_];
        while (complete_ < left_.size() && left_[complete_] == 0) ++complete_;
        changed_.notify_all();
        return complete_;
    }
    /// Returns when fewer than `most_rows` rows lie between a tile and those that are complete. Tiles are begun in
    /// order, so whoever has the first incomplete one does not wait.
    void wait_for_turn(std::size_t tile, std::size_t most_rows) {
        std::unique_lock lock(mutex_);
        while (!is_stopped_ && tile / columns_ >= complete_ + most_rows) {
            changed_.wait_for(lock, std::chrono::milliseconds(100));
            throw_if_interrupted();
        }
    }
    /// Nobody is to wait for a thread that failed.
    void stop() {
        const std::lock_guard lock(mutex_);
        is_stopped_ = true;
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool is_stopped_ = false;
    std::size_t columns_;
    std::vector<std::size_t> left_;  // tiles of each row
    std::size_t complete_ = 0;
};

}  // namespace

/// A Worker is what one thread of a pass has for tile after tile.
class VisiblePass::Worker {
  public:
    Worker(const Frame& frame, const ScreenSurfaces& screen, const ShadedSurfaces* shaded, const TileKernels& kernels,
           const TriangleBins& bins, const FineEdges* fine_edges, KnownBorders* known_borders, PixelRect region)
        : frame_(frame),
          screen_(screen),
          fine_edges_(fine_edges),
          bins_(bins),
          surface_(frame, screen, bins, samples_per_pixel_of(frame), kernels),
          line_tile_(frame, screen, bins, surface_, kernels),
          filler_(frame, screen, kernels, shaded),
          fine_parts_(screen, kernels, completes_lines(frame)),
          needs_beyond_(frame.needs.surfaces_beyond) {
        if (fine_edges_ != nullptr)
            fine_lines_.emplace(frame, screen, bins, kernels, region, frame.needs.whole_picture, *known_borders);
    }

    /// Fills the pixels of a tile and returns its lines, until the next call.
    std::span<const LinePiece> draw(std::size_t tile, Film& film) {
        Stopwatch lap;
        lines_.clear();
        if (bins_.is_empty(tile)) {
            filler_.clear(bins_.empty_tiles_from(tile), film);
            if (fine_edges_ != nullptr && fine_edges_->has_any(tile)) {  // it may have what is smaller than a sample
                surface_.draw(tile);
                add_fine_lines(tile);
            }
        } else {
            surface_.draw(tile);
            times.raster += lap.lap();
            line_tile_.find_lines(tile, lines_);
            if (fine_edges_ != nullptr) add_fine_lines(tile);
            if (needs_beyond_) find_surfaces_beyond(surface_.samples(), screen_, frame_.surfaces.projection, lines_);
            times.lines += lap.lap();
            filler_.fill(surface_, film);
        }
        times.shade += lap.lap();
        return lines_;
    }
    std::uint64_t sample_tests() const { return surface_.sample_tests(); }

    WorkerTimes times;

  private:
    void add_fine_lines(std::size_t tile) {
        parts_.clear();
        fine_parts_.find(surface_.samples(), fine_edges_->in(tile), fine_edges_->loose_in(tile), lines_, parts_);
        fine_lines_->find(tile, parts_, lines_);
    }

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    const FineEdges* fine_edges_;
    const TriangleBins& bins_;
    SurfaceTile surface_;
    LineTile line_tile_;
    PixelFiller filler_;
    FineParts fine_parts_;
    std::optional<FineLines> fine_lines_;
    bool needs_beyond_;
    std::vector<FinePart> parts_;
    std::vector<LinePiece> lines_;  // of a tile: a list of its own would grow in memory that all threads share
};

VisiblePass::VisiblePass(const Frame& frame, ScreenSurfaces& screen, const ShadedSurfaces* shaded,
                         const TileKernels& kernels, int threads, Progress* progress, const DepthLimit& depth_limit)
    : frame_(frame),
      screen_(screen),
      shaded_(shaded),
      kernels_(kernels),
      threads_(threads),
      progress_(progress),
      depth_complexity_(depth_limit, {0, 0, frame.width, frame.height}) {}

void VisiblePass::draw(PixelRect region, int tile_samples, RowSink* sink, LineDrawing& drawing, Film& film,
                       RenderStats& stats) {
    Stopwatch watch;
    const int per_pixel = samples_per_pixel_of(frame_);
    const bool has_fine = frame_.scene->abuffer.draws_fine_lines();
    const std::vector<LooseChunk> loose = chunks_of_loose_edges(screen_, frame_.criteria.classes);
    const bool has_edges = has_fine || !loose.empty();
    const TriangleBins bins(screen_, region, per_pixel, kernels_, threads_, tile_samples, has_edges);
    depth_complexity_.add(screen_, bins, region, threads_);
    const PixelTiles grid(region, tile_samples / per_pixel);
    if (has_fine) possible_lines_.emplace(screen_, threads_);
    std::optional<FineEdges> fine_edges;
    std::optional<KnownBorders> known_borders;
    if (has_edges) known_borders.emplace();
    if (has_edges)
        fine_edges.emplace(screen_, has_fine ? &*possible_lines_ : nullptr, loose, grid, per_pixel, threads_);
    if (!screen_.shows_all()) possible_lines_.reset();
    stats.prepare_s += watch.lap();

    std::vector<std::unique_ptr<Worker>> workers(static_cast<std::size_t>(threads_));
    drawing.begin_rows(grid);
    CompleteRows rows(grid);
    const auto columns = static_cast<std::size_t>(grid.columns());
    const std::size_t most_rows = kRowsAhead + 2 * workers.size() + kMostInARow * workers.size() / columns;
    const bool has_limit = sink != nullptr && sink->hands_on();
    const auto draw_tile = [&](std::size_t tile, int number) {
        std::unique_ptr<Worker>& worker = workers[static_cast<std::size_t>(number)];
        if (!worker) {
            worker =
                std::make_unique<Worker>(frame_, screen_, shaded_, kernels_, bins, has_edges ? &*fine_edges : nullptr,
                                         has_edges ? &*known_borders : nullptr, region);
        }
        drawing.put_visible(tile, worker->draw(tile, film));
        Stopwatch lap;
        const std::size_t complete = rows.add(tile);
        double write_s = 0;
        // The last rows are left to all threads together.
        if (sink != nullptr && complete != 0 && complete * columns != grid.count()) {
            write_s = sink->draw_rows_as(number, grid.tile((complete - 1) * columns).y1);
        }
        worker->times.write += write_s;
        worker->times.lines += lap.lap() - write_s;
        if (progress_ != nullptr) progress_->advance();
    };
    parallel_for(bins.tile_count(), threads_, [&](std::size_t tile, int worker) {
        if (has_limit) rows.wait_for_turn(tile, most_rows);
        try {
            draw_tile(tile, worker);
        } catch (...) {
            rows.stop();
            throw;
        }
    });
    const double wall = watch.lap();
    WorkerTimes sum;
    for (const std::unique_ptr<Worker>& worker : workers) {
        if (!worker) continue;
        sum.raster += worker->times.raster;
        sum.lines += worker->times.lines;
        sum.shade += worker->times.shade;
        sum.write += worker->times.write;
        stats.fragments += worker->sample_tests();
    }
    const double total = sum.raster + sum.lines + sum.shade + sum.write;
    const double scale = total > 0 ? wall / total : 0;
    stats.raster_s += sum.raster * scale;
    stats.lines_s += sum.lines * scale;
    stats.shade_s += sum.shade * scale;
    stats.write_s += sum.write * scale;
}

}  // namespace burin
