#include "abuffer/visible_pass.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>

#include "abuffer/fine/fine_lines.h"
#include "abuffer/lines_of_crop.h"
#include "abuffer/samples/line_tile.h"
#include "abuffer/samples/pixel_fill.h"
#include "abuffer/screen/sampling.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/stopwatch.h"

namespace burin {
namespace {

struct WorkerTimes {
    double raster = 0, lines = 0, shade = 0, write = 0;
};

/// So many bands are finished by one thread before it goes on with tiles.
constexpr int kMostBandsAtOnce = 8;
/// Where bands are handed on, so many rows of tiles may be begun below one that is not complete, and for each thread
/// two more and what it takes in a row: their bands are there.
constexpr std::size_t kRowsAhead = 4;

/// Counts the rows of tiles that are complete, from the top.
class CompleteRows {
  public:
    explicit CompleteRows(const PixelTiles& tiles)
        : columns_(static_cast<std::size_t>(tiles.columns())), left_(tiles.count() / columns_, columns_) {}

    /// After each tile: how many rows are complete.
    std::size_t add(std::size_t tile) {
        const std::lock_guard lock(mutex_);
        --left_[tile / columns_];
        while (complete_ < left_.size() && left_[complete_] == 0) ++complete_;
        changed_.notify_all();
        return complete_;
    }
    /// Returns when fewer than so many rows lie between a tile and those that are complete. Tiles are begun in order,
    /// so whoever has the first incomplete one does not wait.
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

StrokePrinter::Lists VisiblePass::draw(PixelRect region, int tile_samples, RowPrinter* finisher,
                                       std::vector<std::vector<LinePiece>>& segments, Film& film, RenderStats& stats) {
    Stopwatch watch;
    const int per_pixel = samples_per_pixel_of(*frame_.scene);
    const bool has_fine = frame_.scene->abuffer.draws_fine_lines();
    const std::vector<LooseChunk> loose = chunks_of_loose_edges(screen_, frame_.criteria.classes);
    const bool has_edges = has_fine || !loose.empty();
    const TriangleBins bins(screen_, region, per_pixel, kernels_, threads_, tile_samples, has_edges);
    std::optional<FineEdges> fine_edges;
    const PixelTiles grid(region, tile_samples / per_pixel);
    if (has_fine) possible_lines_.emplace(screen_, threads_);
    if (has_edges)
        fine_edges.emplace(screen_, has_fine ? &*possible_lines_ : nullptr, loose, grid, per_pixel, threads_);
    if (!screen_.shows_all()) possible_lines_.reset();
    stats.prepare_s += watch.lap();

    const auto workers = static_cast<std::size_t>(threads_);
    std::vector<std::unique_ptr<SurfaceTile>> tiles(workers);
    std::vector<std::unique_ptr<LineTile>> line_tiles(workers);
    std::vector<std::unique_ptr<PixelFiller>> fillers(workers);
    std::vector<FineParts> fine_parts(workers, FineParts(screen_, kernels_, completes_lines(*frame_.scene)));
    std::vector<std::vector<FinePart>> parts(workers);
    std::vector<std::unique_ptr<FineLines>> fine_lines(workers);
    std::vector<std::vector<LinePiece>> lines_of(
        workers);  // of a tile: a list of its own would grow in memory that all share
    std::vector<WorkerTimes> times(workers);
    const std::size_t before = segments.size();
    segments.resize(before + bins.tile_count());
    CompleteRows rows(grid);
    // The first list with lines whose strokes reach rows from `y` on.
    const auto first_reaching = [&](int y) {
        const double first_y = y - finisher->reach_px() - region.y0;
        const auto row = static_cast<std::size_t>(std::max(first_y, 0.0)) / static_cast<std::size_t>(grid.tile_px());
        return row == 0 ? 0 : before + row * static_cast<std::size_t>(grid.columns());
    };
    // After a tile. The last rows are left to all threads together.
    const auto finish_rows = [&](std::size_t tile, int worker) {
        const std::size_t columns = static_cast<std::size_t>(grid.columns()), complete = rows.add(tile);
        if (finisher == nullptr || complete == 0 || complete * columns == grid.count()) return 0.0;
        const PixelRect part = finisher->take(grid.tile((complete - 1) * columns).y1, kMostBandsAtOnce);
        if (part.height() == 0) return 0.0;
        return finisher->finish_as(
            worker, part,
            StrokePrinter::Lists(segments).first(before + complete * columns).subspan(first_reaching(part.y0)));
    };
    const std::size_t most_rows =
        kRowsAhead + 2 * workers + kMostInARow * workers / static_cast<std::size_t>(grid.columns());
    const bool has_limit = finisher != nullptr && finisher->hands_on();
    const auto draw_tile = [&](std::size_t index, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        if (!tiles[w]) {
            tiles[w] = std::make_unique<SurfaceTile>(frame_, screen_, bins, per_pixel, kernels_);
            line_tiles[w] = std::make_unique<LineTile>(frame_, screen_, bins, *tiles[w], kernels_);
        }
        if (!fillers[w]) fillers[w] = std::make_unique<PixelFiller>(frame_, screen_, kernels_);
        if (has_edges && !fine_lines[w])
            fine_lines[w] =
                std::make_unique<FineLines>(frame_, screen_, bins, kernels_, region, needs_all_visible_lines(frame_));
        std::vector<LinePiece>& lines = lines_of[w];
        lines.clear();
        const auto add_fine_lines = [&] {
            parts[w].clear();
            fine_parts[w].find(tiles[w]->samples(), fine_edges->in(index), fine_edges->loose_in(index), lines,
                               parts[w]);
            fine_lines[w]->find(index, parts[w], lines);
        };
        Stopwatch lap;
        if (bins.is_empty(index)) {
            fillers[w]->clear(bins.empty_tiles_from(index), film);
            if (has_edges && fine_edges->has_any(index)) {  // it may have what is smaller than a sample
                tiles[w]->draw(index);
                add_fine_lines();
            }
        } else {
            tiles[w]->draw(index);
            times[w].raster += lap.lap();
            line_tiles[w]->find_lines(index, lines);
            if (has_edges) add_fine_lines();
            times[w].lines += lap.lap();
            fillers[w]->fill(*tiles[w], film);
        }
        segments[before + index].assign(lines.begin(), lines.end());
        times[w].shade += lap.lap();
        const double write_s = finish_rows(index, worker);
        times[w].write += write_s;
        times[w].lines += lap.lap() - write_s;
        if (progress_ != nullptr) progress_->advance();
    };
    parallel_for(bins.tile_count(), threads_, [&](std::size_t index, int worker) {
        if (has_limit) rows.wait_for_turn(index, most_rows);
        try {
            draw_tile(index, worker);
        } catch (...) {
            rows.stop();
            throw;
        }
    });
    const double wall = watch.lap();
    WorkerTimes sum;
    for (std::size_t w = 0; w < workers; ++w) {
        sum.raster += times[w].raster;
        sum.lines += times[w].lines;
        sum.shade += times[w].shade;
        sum.write += times[w].write;
        if (tiles[w]) stats.fragments += tiles[w]->sample_tests();
    }
    const double total = sum.raster + sum.lines + sum.shade + sum.write;
    const double scale = total > 0 ? wall / total : 0;
    stats.raster_s += sum.raster * scale;
    stats.lines_s += sum.lines * scale;
    stats.shade_s += sum.shade * scale;
    stats.write_s += sum.write * scale;
    return StrokePrinter::Lists(segments).subspan(
        finisher == nullptr ? 0 : std::min(first_reaching(finisher->taken_y()), segments.size()));
}

}  // namespace burin
