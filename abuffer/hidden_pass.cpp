#include "abuffer/hidden_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "abuffer/hiding/pieces_behind.h"
#include "abuffer/hiding/transparent_fill.h"
#include "base/interrupt.h"
#include "base/parallel.h"

namespace burin {
namespace {

constexpr int kTilePx = 32;
/// This bit marks the number of a line that its tile has found.
constexpr std::uint32_t kOfTile = 1u << 31;

/// The picture's part whose lines are drawn, and what strokes from beside it reach.
PixelRect with_margin(const Frame& frame, bool whole_picture) {
    const PixelRect c = whole_picture ? frame.reach() : frame.crop;
    const int margin = frame.needs.margin_px();
    return {c.x0 - margin, c.y0 - margin, c.x1 + margin, c.y1 + margin};
}

PixelRect region_of(const Frame& frame) { return with_margin(frame, frame.needs.whole_picture); }

/// The region in which lines are looked for. Dashes are laid out along chains, which a crop must not cut.
PixelRect region_of_lines(const Frame& frame) { return with_margin(frame, frame.needs.whole_picture_behind); }

bool overlap(const PixelRect& a, const PixelRect& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// Brings the lines that tiles have found behind `lines`, each one once, and renumbers their parts.
void join(std::vector<HidingTileResult>& results, std::vector<WholeLine>& lines, std::vector<LinePart>& parts) {
    struct Found {
        std::size_t tile;
        std::uint32_t index;
    };
    std::vector<Found> found;
    for (std::size_t tile = 0; tile < results.size(); ++tile) {
        for (std::uint32_t i = 0; i < results[tile].intersections.size(); ++i) found.push_back({tile, i});
    }
    const auto line = [&](const Found& f) -> const WholeLine& { return results[f.tile].intersections[f.index]; };
    const auto is_before = [&](const Found& a, const Found& b) {
        return IntersectionLines::is_before(line(a), line(b));
    };
    std::stable_sort(found.begin(), found.end(), is_before);
    std::vector<std::vector<std::uint32_t>> number(results.size());
    for (std::size_t tile = 0; tile < results.size(); ++tile) number[tile].resize(results[tile].intersections.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i == 0 || is_before(found[i - 1], found[i])) lines.push_back(line(found[i]));
        number[found[i].tile][found[i].index] = static_cast<std::uint32_t>(lines.size() - 1);
    }
    std::size_t count = parts.size();
    for (const HidingTileResult& result : results) count += result.parts.size();
    parts.reserve(count);
    for (std::size_t tile = 0; tile < results.size(); ++tile) {
        const auto first = parts.insert(parts.end(), results[tile].parts.begin(), results[tile].parts.end());
        if (number[tile].empty()) continue;
        for (LinePart& part : std::span(first, parts.end())) {
            if ((part.line & kOfTile) != 0) part.line = number[tile][part.line & ~kOfTile];
        }
    }
}

/// The numbers of the lines that touch each tile.
TileLists<std::uint32_t> sort_by_tile(const std::vector<WholeLine>& lines, const PixelTiles& grid) {
    std::vector<std::vector<TileLists<std::uint32_t>::Record>> records(1);
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
        const glm::dvec2 a = to_pixels(lines[i].from), b = to_pixels(lines[i].to);
        const std::array<PolygonRows::Corner, 2> ends{{{a.x, a.y}, {b.x, b.y}}};
        grid.visit(glm::min(a, b), glm::max(a, b), PolygonRows(ends), 1, [&](std::uint32_t tile) {
            records[0].push_back({tile, i});
        });
    }
    return TileLists<std::uint32_t>(records, grid.count());
}

}  // namespace

PixelTiles HiddenPass::tiles_of(const Frame& frame) {
    // Tiles end at the same places in any crop: the shortest parts of lines depend on it.
    const PixelRect r = region_of_lines(frame);
    const auto before = [](int px) { return px & -kTilePx; };
    return {{before(r.x0), before(r.y0), before(r.x1 + kTilePx - 1), before(r.y1 + kTilePx - 1)}, kTilePx};
}

HiddenPass::HiddenPass(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels, int threads,
                       Progress* progress)
    : frame_(frame),
      screen_(screen),
      kernels_(kernels),
      threads_(threads),
      progress_(progress),
      all_tiles_(tiles_of(frame)),
      tiles_(all_tiles_),
      intersections_(frame, screen, region_of_lines(frame)) {
    if (IntersectionLines::are_wanted(frame.criteria.classes) && !knows_pairs()) may_intersect_.emplace(*frame.scene);
}

bool HiddenPass::knows_pairs() const {
    return frame_.prepared != nullptr && frame_.prepared->intersecting_pairs && screen_.shows_all();
}

void HiddenPass::find_lines(TileRows rows, const PossibleLines* possible) {
    const DrawingNeeds& needs = frame_.needs;
    const PixelRect region = needs.whole_lines            ? anywhere_on_screen()
                             : needs.whole_picture_behind ? region_of_lines(frame_)
                                                          : all_tiles_.only(rows).rect();
    std::optional<PossibleLines> own;
    if (possible == nullptr) possible = &own.emplace(screen_, threads_);
    std::vector<WholeLine> found = find_edge_lines(frame_, screen_, *possible, region, threads_);
    if (lines_.empty()) {
        lines_ = std::move(found);
    } else {
        lines_.insert(lines_.end(), found.begin(), found.end());
    }
    if (!knows_pairs() || !IntersectionLines::are_wanted(frame_.criteria.classes)) return;
    found = intersections_.of_pairs(*frame_.prepared->intersecting_pairs, threads_);
    lines_.insert(lines_.end(), found.begin(), found.end());
}

void HiddenPass::sort(TileRows rows) {
    tiles_ = all_tiles_.only(rows);
    bins_ = OccluderBins();  // before there are new ones
    const bool needs_all = may_intersect_ || frame_.needs.is_transparent;
    std::optional<LineDepths> depths;
    const auto slack_of = [&](const WholeLine& line) {  // a border asks for what is behind it, too
        return line_slack(frame_.surfaces, line, 0, 1,
                          line.classes.has(LineClass::border) ? kDepthTolerancePx : kLevelPx);
    };
    if (!needs_all) depths.emplace(lines_, tiles_, slack_of);
    bins_ = OccluderBins(screen_, kernels_, tiles_, threads_, depths ? &*depths : nullptr);
}

void HiddenPass::composite(Film& film, const ShadedSurfaces* shaded) const {
    if (frame_.needs.is_transparent) fill_transparent(frame_, screen_, shaded, bins_, tiles_, threads_, film);
}

void HiddenPass::find_parts() {
    const TileLists<std::uint32_t> lines_in = sort_by_tile(lines_, tiles_);
    const PixelRect drawn = region_of(frame_);
    const std::size_t before = results_.size();
    results_.resize(before + tiles_.count());
    std::vector<std::unique_ptr<HidingTile>> tiles(static_cast<std::size_t>(threads_));
    const auto find_in = [&](std::size_t index, int worker) {
        const bool is_drawn = overlap(tiles_.tile(index), drawn);
        if (bins_.triangles(index).empty() || (!is_drawn && !may_intersect_)) return;
        auto& tile = tiles[static_cast<std::size_t>(worker)];
        if (!tile)
            tile = std::make_unique<HidingTile>(frame_, screen_, kernels_, bins_, tiles_, may_intersect_.has_value());
        tile->fill(index);
        HidingTileResult& result = results_[before + index];
        if (may_intersect_) tile->find_intersections(*may_intersect_, intersections_, result.intersections);
        if (!is_drawn) return;
        const std::span<const std::uint32_t> numbers = lines_in.of(index);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            if (k % 64 == 0) throw_if_interrupted();
            constexpr std::size_t kAhead = 6;
            if (k + kAhead < numbers.size()) prefetch(lines_[numbers[k + kAhead]]);
            tile->find_parts(lines_[numbers[k]], numbers[k], result.parts);
        }
        for (std::uint32_t i = 0; i < result.intersections.size(); ++i) {
            tile->find_parts(result.intersections[i], kOfTile | i, result.parts);
        }
    };
    parallel_for(tiles_.count(), threads_, [&](std::size_t index, int worker) {
        find_in(index, worker);
        if (progress_ != nullptr) progress_->advance();
    });
    for (const auto& tile : tiles) {
        if (tile) fragment_count_ += tile->fragment_count();
    }
}

void HiddenPass::join_results() {
    parts_.clear();
    join(results_, lines_, parts_);
    results_.clear();
}

std::vector<WholeLine> HiddenPass::take_lines() { return std::exchange(lines_, {}); }

}  // namespace burin
