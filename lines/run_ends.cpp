#include "lines/run_ends.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace burin {
namespace {

/// A line that comes that close to an end meets it.
constexpr double kMeetsPx = 0.5;
/// A surface in front is farther away than that from what it hides, in pixels' widths.
constexpr double kInFrontPx = 1.0;
/// An end so far from those of its chain is none of these.
constexpr double kWithinPx = 1.0;
/// Pieces of the same run that are no farther along it are the end itself.
constexpr double kOwnPx = 2;
/// Runs that are shorter are crumbs, as lie about the cusps of contours: no line goes on in them.
constexpr double kCrumbPx = 2;
/// The direction of a run at a place is that between places so far before and after it.
constexpr double kDirectionPx = 1.5;
/// Cosines of the angles between which a line ceases to go straight on: 30 and 10 degrees.
constexpr double kTurnedCosine = 0.866, kStraightCosine = 0.985;

/// One end of a run that something may meet.
struct OpenEnd {
    std::size_t run;
    std::size_t which;  // 0: its beginning
    glm::dvec2 ahead;   // the direction in which the run ends, of length 1
};

/// EndCells holds ends by square cells of the picture; what is within reach of a place is in the nine cells around it.
class EndCells {
  public:
    static constexpr double kReachPx = kMeetsPx + static_cast<double>(kFarthestGapPx);

    explicit EndCells(PixelRect picture)
        : corner_(picture.x0, picture.y0),
          columns_(1 + static_cast<std::size_t>(picture.width() / kReachPx)),
          rows_(1 + static_cast<std::size_t>(picture.height() / kReachPx)) {}

    /// `places`: of all ends, within the picture.
    void fill(std::span<const OpenEnd> ends, std::span<const glm::dvec2> places) {
        first_.assign(columns_ * rows_ + 1, 0);
        for (const glm::dvec2& p : places) ++first_[cell_at(p) + 1];
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
        ends_.resize(ends.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < ends.size(); ++i) ends_[next[cell_at(places[i])]++] = ends[i];
    }

    /// Calls `visit` with each end that may be within reach of the box.
    template <typename Visit>
    void for_near(glm::dvec2 low, glm::dvec2 high, Visit&& visit) const {
        const std::size_t x0 = at(low.x - kReachPx - corner_.x, columns_),
                          x1 = at(high.x + kReachPx - corner_.x, columns_);
        for (std::size_t y = at(low.y - kReachPx - corner_.y, rows_); y <= at(high.y + kReachPx - corner_.y, rows_);
             ++y) {
            for (std::size_t i = first_[y * columns_ + x0]; i < first_[y * columns_ + x1 + 1]; ++i) visit(ends_[i]);
        }
    }

  private:
    static std::size_t at(double px, std::size_t count) {
        return static_cast<std::size_t>(std::clamp(px / kReachPx, 0.0, static_cast<double>(count - 1)));
    }
    std::size_t cell_at(glm::dvec2 p) const {
        return at(p.y - corner_.y, rows_) * columns_ + at(p.x - corner_.x, columns_);
    }

    glm::dvec2 corner_;
    std::size_t columns_, rows_;
    std::vector<std::size_t> first_;  // of each cell, in ends_
    std::vector<OpenEnd> ends_;
};

/// RunEnds looks for what meets the ends of runs.
class RunEnds {
  public:
    RunEnds(LineRuns& runs, const Projection& projection, PixelRect picture)
        : runs_(runs), projection_(projection), picture_(picture), cells_(picture) {
        std::vector<OpenEnd> open;
        std::vector<glm::dvec2> places;
        for (std::size_t i = 0; i < runs.runs.size(); ++i) {
            LineRun& run = runs.runs[i];
            if (run.is_closed || run.count == 0) continue;
            for (std::size_t which = 0; which < 2; ++which) {
                const glm::dvec2 p = place(run, which);
                if (is_at_frame(p)) {
                    stop(run, which, RunEnd::frame);
                } else if (is_within_chain(run, which)) {
                    stop(run, which, RunEnd::occluded);
                } else {
                    open.push_back(
                        {i, which, direction_at(run, which == 0 ? 0 : run.count - 1) * (which == 0 ? -1.0 : 1.0)});
                    places.push_back(p);
                }
            }
        }
        cells_.fill(open, places);
    }

    static constexpr std::size_t kNoRun = ~std::size_t{0};
    /// Looks at a piece of run `own`; a boundary, along which nothing is drawn, is of no run.
    void look_at(const LinePiece& piece, std::size_t own, std::size_t index) {
        cells_.for_near(glm::min(piece.from, piece.to), glm::max(piece.from, piece.to),
                        [&](const OpenEnd& end) { meet(end, piece, own, index); });
    }

  private:
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

    /// The direction of a run near its piece `index`.
    glm::dvec2 direction_at(const LineRun& run, std::size_t index) const {
        const auto pieces = runs_.pieces_of(run);
        std::size_t first = index, last = index;
        while (first > 0 && pieces[index].at_from_px - pieces[first].at_from_px < kDirectionPx) --first;
        while (last + 1 < pieces.size() && pieces[last].at_to_px - pieces[index].at_to_px < kDirectionPx) ++last;
        const glm::dvec2 way = pieces[last].piece.to - pieces[first].piece.from;
        const double length = glm::length(way);
        return length > 0 ? way / length : glm::dvec2(0);
    }
    /// How well a line that passes `place`, so far from the end, goes on with it: 1 straight ahead, 0 elsewhere.
    static double goes_on(const OpenEnd& end, glm::dvec2 from_end, glm::dvec2 direction) {
        const double along = glm::dot(from_end, end.ahead);
        const double beside = std::abs(from_end.x * end.ahead.y - from_end.y * end.ahead.x);
        const double is_before = std::clamp(1 + (along + kMeetsPx) / kMeetsPx, 0.0, 1.0);
        const double is_on = std::clamp(1 - (beside - kMeetsPx) / (kMeetsPx + 0.25 * std::max(along, 0.0)), 0.0, 1.0);
        const double cosine = std::abs(glm::dot(direction, end.ahead));
        return is_before * is_on * std::clamp((cosine - kTurnedCosine) / (kStraightCosine - kTurnedCosine), 0.0, 1.0);
    }

    void meet(const OpenEnd& end, const LinePiece& other, std::size_t own, std::size_t index) {
        LineRun& run = runs_.runs[end.run];
        if (run.ends[end.which] == RunEnd::occluded) return;
        const RunPiece& last = piece_at(run, end.which);
        const glm::dvec2 p = place(run, end.which), way = other.to - other.from;
        const double square = glm::dot(way, way);
        const double share = square > 0 ? std::clamp(glm::dot(p - other.from, way) / square, 0.0, 1.0) : 0.0;
        const double distance = glm::distance(p, other.from + way * share);
        const double gap = std::max(0.0, distance - kMeetsPx);
        if (gap >= static_cast<double>(kFarthestGapPx)) return;
        if (own == end.run) {
            const double at = end.which == 0 ? last.at_from_px : last.at_to_px;
            const RunPiece& piece = runs_.pieces[index];
            // A run that goes straight on is as far along itself as it is away.
            if (std::max(at - piece.at_to_px, piece.at_from_px - at) < std::max(kOwnPx, 1 + 2 * distance)) return;
        }
        const bool is_same_line = other.line == last.piece.line && other.is_hidden() != run.is_hidden;
        if (is_same_line || (other.occludes && is_in_front(other, share, last.piece, end.which))) {
            meet_at(run, end.which, gap, gap, RunEnd::occluded);
        } else if (other.is_drawn && runs_.length_px(runs_.runs[own]) >= kCrumbPx) {
            const LineRun& line = runs_.runs[own];
            const double straight = goes_on(end, other.from + way * share - p, direction_at(line, index - line.first));
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
    bool is_in_front(const LinePiece& other, double share, const LinePiece& own, std::size_t which) const {
        const double depth = projection_.distance(which == 0 ? own.nearness_from : own.nearness_to);
        const double other_depth = projection_.distance(
            glm::mix(static_cast<double>(other.nearness_from), static_cast<double>(other.nearness_to), share));
        return depth - other_depth > kInFrontPx * projection_.pixel_size(depth);
    }

    LineRuns& runs_;
    const Projection& projection_;
    PixelRect picture_;
    EndCells cells_;
};

}  // namespace

void find_run_ends(LineRuns& runs, std::span<const LinePiece> boundaries, const Projection& projection,
                   PixelRect picture) {
    RunEnds ends(runs, projection, picture);
    for (std::size_t i = 0; i < runs.runs.size(); ++i) {
        const LineRun& run = runs.runs[i];
        for (std::size_t k = run.first; k < run.first + run.count; ++k) ends.look_at(runs.pieces[k].piece, i, k);
    }
    for (const LinePiece& piece : boundaries) ends.look_at(piece, RunEnds::kNoRun, 0);
}

}  // namespace burin
