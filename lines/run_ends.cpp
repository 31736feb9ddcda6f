#include "lines/run_ends.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace burin {
namespace {

/// A line that comes that close to an end meets it.
constexpr double kMeetsPx = 0.5;
/// A surface in front is farther away than that from what it hides, in pixels' widths.
constexpr double kInFrontPx = 1.0;
/// No line counts as steeper: pixels' widths of depth for each pixel on the screen.
constexpr double kSteepest = 4;
/// An end so far from those of its chain is none of these.
constexpr double kWithinPx = 1.0;
/// What rounding to single precision makes of a gap.
constexpr double kRoundedGapPx = 1e-5;
/// Pieces of the same run that are no farther along it are the end itself.
constexpr double kOwnPx = 2;
/// Runs that are shorter are crumbs, as lie about the cusps of contours: no line goes on in them.
constexpr double kCrumbPx = 2;
/// The direction of a run at a place is that between places so far before and after it.
constexpr double kDirectionPx = 1.5;
/// Cosines of the angles between which a line ceases to go straight on: 30 and 10 degrees.
constexpr double kTurnedCosine = 0.866, kStraightCosine = 0.985;

/// The strip ahead of an end in which a line goes on is wider by that share of the distance, on either side.
constexpr double kWidening = 0.25;

/// One end of a run that something may meet.
struct OpenEnd {
    std::size_t run = 0;
    std::size_t which = 0;  // 0: its beginning
    glm::dvec2 place{0.0};  // in the picture
    glm::dvec2 ahead{0.0};  // the direction in which the run ends, of length 1
};

/// Where a line passes an end, at its depth: it is a corner's other side, and hides nothing of what ends there.
struct Joint {
    std::size_t run;  // RunEnds::kNoRun for a boundary
    LineId line;
    double at_px;  // along the run
};

/// What may meet an end: a piece of a run, or a boundary, along which nothing is drawn.
struct Neighbour {
    const LinePiece* piece;
    std::size_t run;    // RunEnds::kNoRun for a boundary
    std::size_t index;  // in LineRuns::pieces
};

/// How far along a piece the place lies that is nearest to another place, as a share.
double nearest_share(glm::dvec2 place, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 way = to - from;
    const double square = glm::dot(way, way);
    return square > 0 ? std::clamp(glm::dot(place - from, way) / square, 0.0, 1.0) : 0.0;
}

/// PieceCells holds pieces by the square cells of the picture that they touch.
class PieceCells {
  public:
    /// Cells are so large that a few pieces lie in one, and never larger than the search goes.
    PieceCells(PixelRect picture, std::span<const Neighbour> pieces)
        : corner_(picture.x0, picture.y0),
          cell_px_(std::clamp(std::sqrt(static_cast<double>(picture.width()) * picture.height() /
                                        (1.0 + static_cast<double>(pieces.size()))),
                              kLeastCellPx, kReachPx)),
          columns_(1 + static_cast<std::ptrdiff_t>(picture.width() / cell_px_)),
          rows_(1 + static_cast<std::ptrdiff_t>(picture.height() / cell_px_)) {
        first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
        for (const Neighbour& n : pieces) for_cells(*n.piece, [&](std::size_t cell) { ++first_[cell + 1]; });
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
        entries_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const LinePiece& piece = *pieces[i].piece;
            for_cells(piece, [&](std::size_t cell) { entries_[next[cell]++] = {piece.from, piece.to, i}; });
        }
    }

    /// Calls `visit` with the numbers of pieces around an end, the nearer cells first: of those within `around_px()`,
    /// and of those that lie ahead, within `ahead_px()`. Both may shrink meanwhile, and the former is never more. A
    /// piece may be visited several times.
    template <typename Around, typename Ahead, typename Visit>
    void for_near(const OpenEnd& from, Around&& around_px, Ahead&& ahead_px, Visit&& visit) const {
        const std::ptrdiff_t x = at(from.place.x - corner_.x, columns_), y = at(from.place.y - corner_.y, rows_);
        const auto visit_cell = [&](std::ptrdiff_t cell) {
            const std::size_t end = first_[static_cast<std::size_t>(cell) + 1];
            for (std::size_t i = first_[static_cast<std::size_t>(cell)]; i < end; ++i) {
                const Entry& e = entries_[i];
                const glm::dvec2 way = e.from + nearest_share(from.place, e.from, e.to) * (e.to - e.from) - from.place;
                const double reach = (is_ahead(from, way, 0) ? ahead_px() : around_px()) + kRoundedPx;
                if (glm::dot(way, way) <= reach * reach) visit(e.piece);
            }
        };
        const auto may_be_ahead = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
            // What lies beyond the picture is in the cells at its frame.
            if (column == 0 || row == 0 || column == columns_ - 1 || row == rows_ - 1) return true;
            const glm::dvec2 middle = corner_ + cell_px_ * (glm::dvec2(column, row) + 0.5);
            return is_ahead(from, middle - from.place, cell_px_);
        };
        for (std::ptrdiff_t ring = 0; static_cast<double>(ring - 1) * cell_px_ < ahead_px(); ++ring) {
            const bool is_far = static_cast<double>(ring - 1) * cell_px_ >= around_px();
            for (std::ptrdiff_t row = std::max<std::ptrdiff_t>(y - ring, 0); row <= std::min(y + ring, rows_ - 1);
                 ++row) {
                const bool is_whole = row == y - ring || row == y + ring;
                for (std::ptrdiff_t column = x - ring; column <= x + ring; column += is_whole ? 1 : 2 * ring) {
                    if (column < 0 || column >= columns_ || (is_far && !may_be_ahead(column, row))) continue;
                    visit_cell(row * columns_ + column);
                }
            }
        }
    }

  private:
    static constexpr double kLeastCellPx = 2, kReachPx = kMeetsPx + static_cast<double>(kFarthestGapPx);
    struct Entry {
        glm::dvec2 from, to;
        std::size_t piece;
    };

    /// Whether a place so far from another may be where RunEnds::goes_on() finds that a line goes on.
    static bool is_ahead(const OpenEnd& end, glm::dvec2 way, double radius_px) {
        const double along = glm::dot(way, end.ahead) + radius_px + kRoundedPx;
        const double beside = std::abs(way.x * end.ahead.y - way.y * end.ahead.x) - radius_px - kRoundedPx;
        return along >= -2 * kMeetsPx && beside <= 2 * kMeetsPx + kWidening * std::max(along, 0.0);
    }
    std::ptrdiff_t at(double px, std::ptrdiff_t count) const {
        return static_cast<std::ptrdiff_t>(std::clamp(px / cell_px_, 0.0, static_cast<double>(count - 1)));
    }
    /// Calls `visit` with the cells that a piece touches, row by row.
    template <typename Visit>
    void for_cells(const LinePiece& piece, Visit&& visit) const {
        const bool is_downward = piece.from.y <= piece.to.y;
        const glm::dvec2 top = (is_downward ? piece.from : piece.to) - corner_;
        const glm::dvec2 bottom = (is_downward ? piece.to : piece.from) - corner_;
        const double slope = bottom.y > top.y ? (bottom.x - top.x) / (bottom.y - top.y) : 0;
        const std::ptrdiff_t last = at(bottom.y, rows_);
        for (std::ptrdiff_t row = at(top.y, rows_); row <= last; ++row) {
            const auto x_at = [&](double y) {
                return slope == 0 || y <= top.y ? top.x : y >= bottom.y ? bottom.x : top.x + (y - top.y) * slope;
            };
            const double row_px = static_cast<double>(row) * cell_px_;
            // The first and the last row of cells have what lies beyond the picture, too.
            const double x0 = row == 0 ? top.x : x_at(row_px);
            const double x1 = row == rows_ - 1 ? bottom.x : x_at(row_px + cell_px_);
            const bool is_flat = slope == 0;
            const double low = is_flat ? std::min(top.x, bottom.x) : std::min(x0, x1);
            const double high = is_flat ? std::max(top.x, bottom.x) : std::max(x0, x1);
            const std::ptrdiff_t end = at(high + kRoundedPx, columns_);
            for (std::ptrdiff_t column = at(low - kRoundedPx, columns_); column <= end; ++column)
                visit(static_cast<std::size_t>(row * columns_ + column));
        }
    }
    static constexpr double kRoundedPx = 1e-6;

    glm::dvec2 corner_;
    double cell_px_;
    std::ptrdiff_t columns_, rows_;
    std::vector<std::size_t> first_;  // of each cell, in entries_
    std::vector<Entry> entries_;
};

/// Lines that are long enough to be a corner.
std::vector<Neighbour> corners_of(const LineRuns& runs) {
    std::vector<Neighbour> all;
    for (std::size_t i = 0; i < runs.runs.size(); ++i) {
        const LineRun& run = runs.runs[i];
        if (runs.length_px(run) < kCrumbPx) continue;
        for (std::size_t k = run.first; k < run.first + run.count; ++k) all.push_back({&runs.pieces[k].piece, i, k});
    }
    return all;
}

/// The place of a piece that is nearest to another place.
struct Nearest {
    double share = 0;  // of the way along the piece
    double distance_px = 0;
};
Nearest nearest(glm::dvec2 place, const LinePiece& other) {
    const double share = nearest_share(place, other.from, other.to);
    return {share, glm::distance(place, other.from + (other.to - other.from) * share)};
}

/// RunEnds looks for what meets the ends of runs.
class RunEnds {
  public:
    RunEnds(LineRuns& runs, std::span<const LinePiece> boundaries, const Projection& projection, PixelRect picture)
        : runs_(runs),
          projection_(projection),
          picture_(picture),
          occluders_(occluders_of(runs, boundaries)),
          corners_(corners_of(runs)),
          broken_lines_(broken_lines_of(runs)),
          occluder_cells_(picture, occluders_),
          corner_cells_(picture, corners_) {}

    /// Finds what stops the ends of one run. Changes nothing else.
    void find_ends(std::size_t of_run) {
        LineRun& run = runs_.runs[of_run];
        if (run.is_closed || run.count == 0) return;
        for (std::size_t which = 0; which < 2; ++which) {
            const glm::dvec2 p = place(run, which);
            if (is_at_frame(p)) {
                stop(run, which, RunEnd::frame);
            } else if (is_within_chain(run, which)) {
                stop(run, which, RunEnd::occluded);
            } else {
                const glm::dvec2 onward = direction_at(run, which == 0 ? 0 : run.count - 1);
                look_around({of_run, which, p, onward * (which == 0 ? -1.0 : 1.0)});
            }
        }
    }

    static constexpr std::size_t kNoRun = ~std::size_t{0};

  private:
    static std::vector<Neighbour> occluders_of(const LineRuns& runs, std::span<const LinePiece> boundaries) {
        std::vector<Neighbour> all;
        for (std::size_t i = 0; i < runs.runs.size(); ++i) {
            const LineRun& run = runs.runs[i];
            for (std::size_t k = run.first; k < run.first + run.count; ++k) {
                if (runs.pieces[k].piece.occludes) all.push_back({&runs.pieces[k].piece, i, k});
            }
        }
        for (const LinePiece& piece : boundaries) all.push_back({&piece, kNoRun, 0});
        return all;
    }
    /// The pieces of lines that are partly seen and partly hidden, by line.
    static std::vector<Neighbour> broken_lines_of(const LineRuns& runs) {
        const auto has = [&runs](bool hidden) {
            return std::any_of(runs.runs.begin(), runs.runs.end(),
                               [&](const LineRun& r) { return r.is_hidden == hidden; });
        };
        std::vector<Neighbour> all;
        if (!has(false) || !has(true)) return all;
        for (std::size_t i = 0; i < runs.runs.size(); ++i) {
            const LineRun& run = runs.runs[i];
            for (std::size_t k = run.first; k < run.first + run.count; ++k)
                all.push_back({&runs.pieces[k].piece, i, k});
        }
        std::sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
            return a.piece->line != b.piece->line ? a.piece->line < b.piece->line : a.index < b.index;
        });
        std::size_t kept = 0;
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            bool is_seen = false, is_hidden = false;
            for (end = begin; end < all.size() && all[end].piece->line == all[begin].piece->line; ++end)
                (all[end].piece->is_hidden() ? is_hidden : is_seen) = true;
            if (!is_seen || !is_hidden) continue;
            for (std::size_t i = begin; i < end; ++i) all[kept++] = all[i];
        }
        all.resize(kept);
        return all;
    }

    void look_around(const OpenEnd& end) {
        const LineRun& run = runs_.runs[end.run];
        const LineId line = piece_at(run, end.which).piece.line;
        if (run.is_hidden) {
            auto n = std::lower_bound(broken_lines_.begin(), broken_lines_.end(), line,
                                      [](const Neighbour& a, LineId b) { return a.piece->line < b; });
            for (; n != broken_lines_.end() && n->piece->line == line; ++n) meet(end, *n, {});
        }
        // What is farther away than the gaps that are known changes nothing.
        const auto reach_px = [&run, &end](float gap_px) {
            return run.ends[end.which] == RunEnd::occluded ? 0 : kMeetsPx + kRoundedGapPx + static_cast<double>(gap_px);
        };
        const auto gap_reach_px = [&] { return reach_px(run.gaps_px[end.which]); };
        const auto any_reach_px = [&] {
            return reach_px(std::max(run.gaps_px[end.which], run.onward_gaps_px[end.which]));
        };
        std::vector<Joint> joints;
        const auto at_end_px = [] { return kMeetsPx; };
        occluder_cells_.for_near(end, at_end_px, at_end_px, [&](std::size_t i) { join(end, occluders_[i], joints); });
        occluder_cells_.for_near(end, any_reach_px, any_reach_px,
                                 [&](std::size_t i) { meet(end, occluders_[i], joints); });
        corner_cells_.for_near(end, gap_reach_px, any_reach_px, [&](std::size_t i) { meet(end, corners_[i], joints); });
    }

    const RunPiece& piece_at(const LineRun& run, std::size_t which) const {
        return runs_.pieces[which == 0 ? run.first : run.first + run.count - 1];
    }
    glm::dvec2 place(const LineRun& run, std::size_t which) const {
        const LinePiece& piece = piece_at(run, which).piece;
        return which == 0 ? piece.from : piece.to;
    }
    /// Whether an edge of the mesh goes on there, hidden or seen, be its other part looked for or not.
    bool is_within_chain(const LineRun& run, std::size_t which) const {
        if (run.chain_place == 0) return false;
        const RunPiece& last = piece_at(run, which);
        return run.chain_is_closed ||
               (which == 0 ? last.at_from_px > kWithinPx : last.at_to_px < run.chain_length_px - kWithinPx);
    }
    bool is_at_frame(glm::dvec2 p) const {
        return p.x <= picture_.x0 + kMeetsPx || p.y <= picture_.y0 + kMeetsPx || p.x >= picture_.x1 - kMeetsPx ||
               p.y >= picture_.y1 - kMeetsPx;
    }

    /// The first and the last piece of what is near the piece `index` of a run.
    std::pair<std::size_t, std::size_t> around(const LineRun& run, std::size_t index) const {
        const auto pieces = runs_.pieces_of(run);
        std::size_t first = index, last = index;
        while (first > 0 && pieces[index].at_from_px - pieces[first].at_from_px < kDirectionPx) --first;
        while (last + 1 < pieces.size() && pieces[last].at_to_px - pieces[index].at_to_px < kDirectionPx) ++last;
        return {first, last};
    }
    /// The direction of a run near its piece `index`.
    glm::dvec2 direction_at(const LineRun& run, std::size_t index) const {
        const auto [first, last] = around(run, index);
        const glm::dvec2 way = runs_.pieces[run.first + last].piece.to - runs_.pieces[run.first + first].piece.from;
        const double length = glm::length(way);
        return length > 0 ? way / length : glm::dvec2(0);
    }
    /// How well a line that passes `place`, so far from the end, goes on with it: 1 straight ahead, 0 elsewhere.
    static double goes_on(const OpenEnd& end, glm::dvec2 from_end, glm::dvec2 direction) {
        const double along = glm::dot(from_end, end.ahead);
        const double beside = std::abs(from_end.x * end.ahead.y - from_end.y * end.ahead.x);
        const double is_before = std::clamp(1 + (along + kMeetsPx) / kMeetsPx, 0.0, 1.0);
        const double is_on =
            std::clamp(1 - (beside - kMeetsPx) / (kMeetsPx + kWidening * std::max(along, 0.0)), 0.0, 1.0);
        const double cosine = std::abs(glm::dot(direction, end.ahead));
        return is_before * is_on * std::clamp((cosine - kTurnedCosine) / (kStraightCosine - kTurnedCosine), 0.0, 1.0);
    }

    double at_px(const Neighbour& neighbour, double share) const {
        if (neighbour.run == kNoRun) return 0;
        const RunPiece& piece = runs_.pieces[neighbour.index];
        return glm::mix(piece.at_from_px, piece.at_to_px, share);
    }

    /// Adds a joint if a boundary passes the end at its depth.
    void join(const OpenEnd& end, const Neighbour& neighbour, std::vector<Joint>& joints) const {
        const auto [share, distance_px] = nearest(end.place, *neighbour.piece);
        if (neighbour.run == end.run || distance_px > kMeetsPx) return;
        if (is_in_front(neighbour, share, end)) return;
        joints.push_back({neighbour.run, neighbour.piece->line, at_px(neighbour, share)});
    }
    /// Whether a place of a neighbour is on a line that begins at the end or passes it, so that it is as far along that
    /// line as it is away: it may come towards the eye from there, but it hides nothing at the end.
    bool is_joined(const Neighbour& neighbour, const Nearest& at, std::span<const Joint> joints) const {
        return std::any_of(joints.begin(), joints.end(), [&](const Joint& joint) {
            if (joint.run != neighbour.run) return false;
            if (joint.run == kNoRun) return joint.line == neighbour.piece->line;
            const LineRun& run = runs_.runs[joint.run];
            double along = std::abs(at_px(neighbour, at.share) - joint.at_px);
            if (run.is_closed) along = std::min(along, std::max(runs_.length_px(run) - along, 0.0));
            return along < std::max(kOwnPx, 1 + 2 * at.distance_px);
        });
    }

    void meet(const OpenEnd& end, const Neighbour& neighbour, std::span<const Joint> joints) {
        const LinePiece& other = *neighbour.piece;
        const std::size_t own = neighbour.run, index = neighbour.index;
        LineRun& run = runs_.runs[end.run];
        if (run.ends[end.which] == RunEnd::occluded) return;
        // Whether hidden lines are looked for must not change visible ones.
        if (other.is_hidden() && !run.is_hidden) return;
        const RunPiece& last = piece_at(run, end.which);
        const Nearest at = nearest(end.place, other);
        const double gap = std::max(0.0, at.distance_px - kMeetsPx);
        if (gap >= static_cast<double>(kFarthestGapPx)) return;
        if (own == end.run) {
            const double end_at = end.which == 0 ? last.at_from_px : last.at_to_px;
            const RunPiece& piece = runs_.pieces[index];
            // A run that goes straight on is as far along itself as it is away.
            if (std::max(end_at - piece.at_to_px, piece.at_from_px - end_at) < std::max(kOwnPx, 1 + 2 * at.distance_px))
                return;
        }
        const bool is_same_line = other.line == last.piece.line && other.is_hidden() != run.is_hidden;
        if (is_same_line ||
            (other.occludes && is_in_front(neighbour, at.share, end) && !is_joined(neighbour, at, joints))) {
            meet_at(run, end.which, gap, gap, RunEnd::occluded);
        } else if (other.is_drawn && runs_.length_px(runs_.runs[own]) >= kCrumbPx) {
            const LineRun& line = runs_.runs[own];
            const glm::dvec2 from_end = glm::mix(other.from, other.to, at.share) - end.place;
            const double straight = goes_on(end, from_end, direction_at(line, index - line.first));
            meet_at(run, end.which, gap, gap + (1 - straight) * static_cast<double>(kFarthestGapPx), RunEnd::corner);
        }
    }
    static void stop(LineRun& run, std::size_t which, RunEnd by) {
        run.ends[which] = by;
        run.gaps_px[which] = run.onward_gaps_px[which] = 0;
    }
    static void meet_at(LineRun& run, std::size_t which, double gap_px, double onward_px, RunEnd by) {
        if (gap_px <= 0) run.ends[which] = by;
        const auto take = [which](std::array<float, 2>& gaps, double px) {
            gaps[which] = std::min(gaps[which], static_cast<float>(px));
        };
        take(run.gaps_px, gap_px);
        take(run.onward_gaps_px, onward_px);
    }
    /// How steeply a line comes towards the eye there: pixels' widths of depth for each pixel on the screen.
    double steepness(glm::dvec2 from, glm::dvec2 to, float nearness_from, float nearness_to) const {
        const double a = projection_.distance(nearness_from), b = projection_.distance(nearness_to);
        const double length = glm::distance(from, to);
        if (!(length > 0)) return 0;
        return std::min(std::abs(a - b) / (length * projection_.pixel_size(std::min(a, b))), kSteepest);
    }
    double steepness_at(const LineRun& run, std::size_t index) const {
        const auto [first, last] = around(run, index);
        const LinePiece &a = runs_.pieces[run.first + first].piece, &b = runs_.pieces[run.first + last].piece;
        return steepness(a.from, b.to, a.nearness_from, b.nearness_to);
    }
    bool is_in_front(const Neighbour& neighbour, double share, const OpenEnd& end) const {
        const LineRun& run = runs_.runs[end.run];
        const LinePiece &own = piece_at(run, end.which).piece, &other = *neighbour.piece;
        const double depth = projection_.distance(end.which == 0 ? own.nearness_from : own.nearness_to);
        const double other_depth = projection_.distance(
            glm::mix(static_cast<double>(other.nearness_from), static_cast<double>(other.nearness_to), share));
        const double is_nearer_px = (depth - other_depth) / projection_.pixel_size(depth);
        if (is_nearer_px <= kInFrontPx) return false;
        // Where lines are steep, their depths are as inexact as their places are.
        const double own_steepness = steepness_at(run, end.which == 0 ? 0 : run.count - 1);
        const double other_steepness =
            neighbour.run == kNoRun
                ? steepness(other.from, other.to, other.nearness_from, other.nearness_to)
                : steepness_at(runs_.runs[neighbour.run], neighbour.index - runs_.runs[neighbour.run].first);
        return is_nearer_px > kInFrontPx + kMeetsPx * (own_steepness + other_steepness);
    }

    LineRuns& runs_;
    const Projection& projection_;
    PixelRect picture_;
    std::vector<Neighbour> occluders_, corners_, broken_lines_;
    PieceCells occluder_cells_, corner_cells_;
};

}  // namespace

void find_run_ends(LineRuns& runs, std::span<const LinePiece> boundaries, const Projection& projection,
                   PixelRect picture, int threads, bool only_hidden) {
    constexpr std::size_t kRunsAtOnce = 64;
    RunEnds ends(runs, boundaries, projection, picture);
    const std::size_t count = runs.runs.size();
    parallel_for((count + kRunsAtOnce - 1) / kRunsAtOnce, threads, [&](std::size_t i, int) {
        for (std::size_t r = i * kRunsAtOnce; r < std::min(count, (i + 1) * kRunsAtOnce); ++r) {
            if (runs.runs[r].is_hidden || !only_hidden) ends.find_ends(r);
        }
    });
}

void leave_out_hairs(LineRuns& runs, PixelRect picture, bool only_hidden) {
    constexpr double kLongestPx = 1.0 / 16;
    const std::vector<Neighbour> longer = corners_of(runs);
    const PieceCells cells(picture, longer);
    const auto lies_on_longer = [&](glm::dvec2 place, const LinePiece& own) {
        bool lies = false;
        const auto reach_px = [] { return kMeetsPx; };
        cells.for_near({0, 0, place, {}}, reach_px, reach_px, [&](std::size_t i) {
            const LinePiece& other = *longer[i].piece;
            lies = lies || (other.drawn_as == own.drawn_as && other.is_hidden() == own.is_hidden() &&
                            nearest(place, other).distance_px <= kMeetsPx);
        });
        return lies;
    };
    const auto is_hair = [&](const LineRun& run) {
        const auto pieces = runs.pieces_of(run);
        return (run.is_hidden || !only_hidden) && runs.length_px(run) < kLongestPx &&
               std::all_of(pieces.begin(), pieces.end(), [&](const RunPiece& p) {
                   return lies_on_longer(p.piece.from, p.piece) && lies_on_longer(p.piece.to, p.piece);
               });
    };
    LineRuns kept;
    for (const LineRun& run : runs.runs) {
        if (is_hair(run)) continue;
        const auto pieces = runs.pieces_of(run);
        kept.runs.push_back(run);
        kept.runs.back().first = kept.pieces.size();
        kept.pieces.insert(kept.pieces.end(), pieces.begin(), pieces.end());
    }
    runs = std::move(kept);
}

}  // namespace burin
