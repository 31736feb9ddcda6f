#include "abuffer/hidden_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <span>

#include "abuffer/hiding/transparent_fill.h"
#include "abuffer/lines_of_crop.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "lines/dash_pen.h"
#include "lines/line_dashes.h"
#include "lines/shared_dashes.h"

namespace burin {
namespace {

constexpr int kTilePx = 32;
/// In front of the number of a line that its tile has found.
constexpr std::uint32_t kOfTile = 1u << 31;

/// A part of the picture and what strokes from beside it reach.
PixelRect with_margin(const Frame& frame, PixelRect c) {
    const int margin = static_cast<int>(std::ceil(frame.scene->lines.style.reach_px())) + 1;
    return {c.x0 - margin, c.y0 - margin, c.x1 + margin, c.y1 + margin};
}

PixelRect region_of(const Frame& frame) { return with_margin(frame, rect_with_lines(frame)); }

/// Where lines are looked for. Dashes are laid out along chains, which a crop must not cut.
PixelRect region_of_lines(const Frame& frame) {
    const bool is_dashed = hidden_dashes(frame.scene->lines.style).dash_px.has_value();
    return is_dashed ? with_margin(frame, {0, 0, frame.width, frame.height}) : region_of(frame);
}

bool overlap(const PixelRect& a, const PixelRect& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// Brings the lines that tiles have found behind `lines`, each one once, and renumbers their pieces.
void join(std::vector<HidingTileResult>& results, std::vector<WholeLine>& lines, std::vector<LinePart>& pieces) {
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
    std::size_t count = pieces.size();
    for (const HidingTileResult& result : results) count += result.pieces.size();
    pieces.reserve(count);
    for (std::size_t tile = 0; tile < results.size(); ++tile) {
        const auto first = pieces.insert(pieces.end(), results[tile].pieces.begin(), results[tile].pieces.end());
        if (number[tile].empty()) continue;
        for (LinePart& piece : std::span(first, pieces.end())) {
            if ((piece.line & kOfTile) != 0) piece.line = number[tile][piece.line & ~kOfTile];
        }
    }
}

/// Whether one piece of a line is drawn as the one before, behind however many layers they are.
bool goes_on_alike(const LinePart& before, const LinePart& piece) {
    return piece.line == before.line && piece.begin == before.end &&
           (piece.invisibility > 0) == (before.invisibility > 0) && piece.transmission == before.transmission;
}

/// Early, since they lie anywhere.
void ask_for(const WholeLine& line) {
    const char* const at = reinterpret_cast<const char*>(&line);
    for (std::size_t byte = 0; byte < sizeof line; byte += 64) __builtin_prefetch(at + byte);
}

/// The numbers of the lines that touch each tile.
TileLists<std::uint32_t> sort_by_tile(const std::vector<WholeLine>& lines, const PixelTiles& grid) {
    std::vector<std::vector<TileLists<std::uint32_t>::Record>> records(1);
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
        const glm::dvec2 a = lines[i].from / 256.0, b = lines[i].to / 256.0;
        const std::array<PolygonRows::Corner, 2> ends{{{a.x, a.y}, {b.x, b.y}}};
        grid.visit(glm::min(a, b), glm::max(a, b), PolygonRows(ends), 1, [&](std::uint32_t tile) {
            records[0].push_back({tile, i});
        });
    }
    return TileLists<std::uint32_t>(records, grid.count());
}

}  // namespace

bool HiddenPass::is_needed(const Scene& scene) {
    return scene.lines.style.hidden.style != HiddenStyle::none || has_transparent_surfaces(scene);
}

PixelTiles HiddenPass::tiles_of(const Frame& frame) {
    // Tiles end at the same places in any crop: the shortest parts of lines hang on it.
    const PixelRect r = region_of_lines(frame);
    const auto before = [](int px) { return px & -kTilePx; };
    return {{before(r.x0), before(r.y0), before(r.x1 + kTilePx - 1), before(r.y1 + kTilePx - 1)}, kTilePx};
}

bool HiddenPass::needs_all_lines(const Frame& frame) {
    return hidden_dashes(frame.scene->lines.style).dash_px || needs_all_visible_lines(frame);
}

HiddenPass::HiddenPass(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels, int threads,
                       const SmoothContours* contours)
    : frame_(frame),
      screen_(screen),
      kernels_(kernels),
      contours_(contours),
      threads_(threads),
      all_tiles_(tiles_of(frame)),
      tiles_(all_tiles_),
      intersections_(frame, screen, region_of_lines(frame)) {
    if (IntersectionLines::are_wanted(frame.criteria.classes) && !knows_pairs()) may_intersect_.emplace(*frame.scene);
}

bool HiddenPass::knows_pairs() const { return frame_.scene->intersecting_pairs && screen_.shows_all(); }

void HiddenPass::find_lines(TileRows rows, const PossibleLines* possible) {
    const LineStyle& style = frame_.scene->lines.style;
    const bool is_dashed = hidden_dashes(style).dash_px || visible_dashes(style).dash_px;
    const PixelRect region = is_dashed                 ? anywhere_on_screen()
                             : needs_all_lines(frame_) ? region_of_lines(frame_)
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
    found = intersections_.of_pairs(*frame_.scene->intersecting_pairs, threads_);
    lines_.insert(lines_.end(), found.begin(), found.end());
}

void HiddenPass::sort(TileRows rows) {
    tiles_ = all_tiles_.only(rows);
    bins_ = OccluderBins();  // before there are new ones
    const bool needs_all = may_intersect_ || has_transparent_surfaces(*frame_.scene);
    std::optional<LineDepths> depths;
    const auto slack_of = [&](const WholeLine& line) {  // a border asks for what is behind it, too
        return line_slack(frame_.surfaces, line, 0, 1, line.classes.has(LineClass::border) ? kContactPx : kLevelPx);
    };
    if (!needs_all) depths.emplace(lines_, tiles_, slack_of);
    bins_ = OccluderBins(screen_, kernels_, tiles_, threads_, depths ? &*depths : nullptr);
}

void HiddenPass::composite(Film& film) const {
    if (has_transparent_surfaces(*frame_.scene)) fill_transparent(frame_, screen_, bins_, tiles_, threads_, film);
}

void HiddenPass::find_pieces() {
    const TileLists<std::uint32_t> lines_in = sort_by_tile(lines_, tiles_);
    const PixelRect drawn = region_of(frame_);
    const std::size_t before = results_.size();
    results_.resize(before + tiles_.count());
    std::vector<std::unique_ptr<HidingTile>> tiles(static_cast<std::size_t>(threads_));
    parallel_for(tiles_.count(), threads_, [&](std::size_t index, int worker) {
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
            if (k + kAhead < numbers.size()) ask_for(lines_[numbers[k + kAhead]]);
            tile->find_pieces(lines_[numbers[k]], numbers[k], result.pieces);
        }
        for (std::uint32_t i = 0; i < result.intersections.size(); ++i) {
            tile->find_pieces(result.intersections[i], kOfTile | i, result.pieces);
        }
    });
    for (const auto& tile : tiles) {
        if (tile) fragment_count_ += tile->fragment_count();
    }
}

void HiddenPass::leave_out_dashes_along(CourseIndex& visible) { visible_courses_ = &visible; }

void HiddenPass::find() {
    lines_.clear();
    find_lines(all_tiles_.rows());
    sort(all_tiles_.rows());
    find_pieces();
    join_results();
}

void HiddenPass::join_results() {
    pieces_.clear();
    join(results_, lines_, pieces_);
    results_.clear();
}

std::vector<LayerSegment> HiddenPass::take_segments() {
    join_results();
    std::vector<LayerSegment> segments = make_segments();
    lines_.clear();
    pieces_.clear();
    return segments;
}

/// Adds a part of a line, moved to the smooth contour if it is one.
void HiddenPass::add(const WholeLine& line, LayerSegment segment, std::vector<LayerSegment>& segments) const {
    if (contours_ == nullptr) return segments.push_back(segment);
    std::vector<LinePiece> moved(1);
    moved[0].from = segment.from;
    moved[0].to = segment.to;
    moved[0].drawn_as = line.drawn_as;
    moved[0].line = line.id;
    contours_->move(moved);
    for (const LinePiece& part : moved) {
        segment.from = part.from;
        segment.to = part.to;
        segments.push_back(segment);
    }
}

/// Where the dashes of all lines are: those of features by themselves first, as of visible lines.
class HiddenPass::Dashes {
  public:
    Dashes(const std::vector<WholeLine>& lines, const Frame& frame, std::array<double, 2> dash_px, double width_px)
        : pen(dash_px, width_px), group_(lines.size()), number_(lines.size()) {
        SharedDashes shared({0, 0, frame.width, frame.height}, SharedDashes::reach_of_pen_px(width_px));
        for (const bool are_features : {true, false}) {
            std::vector<WholeLine> chosen;
            for (std::size_t i = 0; i < lines.size(); ++i) {
                if (is_feature(lines[i]) != are_features) continue;
                group_[i] = static_cast<std::uint8_t>(groups_.size());
                number_[i] = static_cast<std::uint32_t>(chosen.size());
                chosen.push_back(lines[i]);
            }
            groups_.emplace_back(chosen, frame.surfaces, pen.period_px(), shared);
        }
    }
    template <typename Visit>
    void for_parts(std::size_t line, const Visit& visit) const {
        groups_[group_[line]].for_parts(number_[line], visit);
    }

    DashPen pen;

  private:
    std::vector<LineDashes> groups_;
    std::vector<std::uint8_t> group_;    // of each line
    std::vector<std::uint32_t> number_;  // in its group
};

void HiddenPass::add_dashes(const LinePart& piece, const Dashes& dashes, std::vector<LayerSegment>& segments) const {
    const WholeLine& line = lines_[piece.line];
    LayerSegment segment;
    segment.drawn_as = line.drawn_as;
    segment.is_hidden = piece.invisibility > 0;
    segment.transmission = line.opacity_behind(piece.transmission);
    const auto add_part = [&](const DashPart& part, double from, double to) {
        const double begin = std::max(from, part.begin), end = std::min(to, part.end);
        if (!(begin < end)) return;
        const double share = part.end - part.begin, length = part.at_end - part.at_begin;
        const auto at = [&](double of_line) { return part.at_begin + length * ((of_line - part.begin) / share); };
        const auto place = [&](double along) {
            return line.at(part.begin + share * ((along - part.at_begin) / length)) / 256.0;
        };
        dashes.pen.for_dashes(at(begin), at(end), std::abs(length) / (share * line.length_px()),
                              [&](double first, double last) {
                                  segment.from = place(first);
                                  segment.to = place(last);
                                  add(line, segment, segments);
                              });
    };
    const auto add_between = [&](double from, double to) {
        dashes.for_parts(piece.line, [&](const DashPart& part) { add_part(part, from, to); });
    };
    if (!segment.is_hidden || visible_courses_ == nullptr) return add_between(piece.begin, piece.end);
    const auto covers = visible_courses_->find(line.at(piece.begin) / 256.0, line.at(piece.end) / 256.0);
    const double length = piece.end - piece.begin;
    for_uncovered(covers,
                  [&](double from, double to) { add_between(piece.begin + length * from, piece.begin + length * to); });
}

std::vector<LayerSegment> HiddenPass::make_segments() const {
    const LineStyle& look = frame_.scene->lines.style;
    const HiddenStyle style = look.hidden.style;
    std::optional<Dashes> of_hidden, seen_through;
    if (const auto dash_px = hidden_dashes(look).dash_px)
        of_hidden.emplace(lines_, frame_, *dash_px, look.hidden_width_px());
    const auto visible_px = visible_dashes(look).dash_px;
    if (visible_px && has_transparent_surfaces(*frame_.scene))
        seen_through.emplace(lines_, frame_, *visible_px, look.width_px);
    std::vector<LayerSegment> segments;
    segments.reserve(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size();) {
        constexpr std::size_t kAhead = 16;
        if (i + kAhead < pieces_.size()) {
            const WholeLine& soon = lines_[pieces_[i + kAhead].line];
            __builtin_prefetch(&soon.from);
            __builtin_prefetch(&soon.drawn_as);
        }
        LinePart piece = pieces_[i];
        while (++i < pieces_.size() && goes_on_alike(piece, pieces_[i])) piece.end = pieces_[i].end;
        const bool is_hidden = piece.invisibility > 0;
        if (piece.transmission == 0 || (is_hidden && style == HiddenStyle::none)) continue;
        const auto& dashes = is_hidden ? of_hidden : seen_through;
        if (dashes) {
            add_dashes(piece, *dashes, segments);
            continue;
        }
        const WholeLine& line = lines_[piece.line];
        LayerSegment segment;
        segment.from = line.at(piece.begin) / 256.0;
        segment.to = line.at(piece.end) / 256.0;
        segment.drawn_as = line.drawn_as;
        segment.is_hidden = is_hidden;
        segment.transmission = line.opacity_behind(piece.transmission);
        add(line, segment, segments);
    }
    return segments;
}

}  // namespace burin
