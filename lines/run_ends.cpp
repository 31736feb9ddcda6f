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
constexpr double kCellPx = 4;
/// Pieces of the same run that are no farther along it are the end itself.
constexpr double kOwnPx = 2;
/// Runs that are shorter are crumbs, as lie about the cusps of contours: no line goes on in them.
constexpr double kCrumbPx = 2;

std::uint64_t cell_of(double x, double y) {
    const auto number = [](double at) {
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::clamp(std::floor(at / kCellPx), -1e8, 1e8)));
    };
    return std::uint64_t{number(y)} << 32 | number(x);
}

/// One end of a run that something may meet.
struct OpenEnd {
    std::uint64_t cell;
    std::size_t run;
    std::size_t which;  // 0: its beginning
    auto operator<=>(const OpenEnd&) const = default;
};

/// RunEnds looks for what meets the ends of runs.
class RunEnds {
  public:
    RunEnds(LineRuns& runs, const Projection& projection, PixelRect picture)
        : runs_(runs), projection_(projection), picture_(picture) {
        for (std::size_t i = 0; i < runs.runs.size(); ++i) {
            LineRun& run = runs.runs[i];
            if (run.is_closed || run.count == 0) continue;
            for (std::size_t which = 0; which < 2; ++which) {
                const glm::dvec2 p = place(run, which);
                if (is_at_frame(p)) {
                    run.ends[which] = RunEnd::frame;
                } else if (is_within_chain(run, which)) {
                    run.ends[which] = RunEnd::occluded;
                } else {
                    open_.push_back({cell_of(p.x, p.y), i, which});
                }
            }
        }
        std::sort(open_.begin(), open_.end());
    }

    /// Looks at a piece of run `own`, from `at_from_px` to `at_to_px`; nothing is drawn along what is of no run.
    static constexpr std::size_t kNoRun = ~std::size_t{0};
    void look_at(const LinePiece& piece, std::size_t own, double at_from_px, double at_to_px) {
        const glm::dvec2 low = glm::min(piece.from, piece.to) - kMeetsPx,
                         high = glm::max(piece.from, piece.to) + kMeetsPx;
        const auto first = [](double at) { return std::floor(at / kCellPx) * kCellPx; };
        for (double y = first(low.y); y <= high.y; y += kCellPx) {
            for (double x = first(low.x); x <= high.x; x += kCellPx) {
                const std::uint64_t cell = cell_of(x, y);
                for (auto it = std::lower_bound(open_.begin(), open_.end(), OpenEnd{cell, 0, 0});
                     it != open_.end() && it->cell == cell; ++it) {
                    meet(*it, piece, own, at_from_px, at_to_px);
                }
            }
        }
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

    void meet(const OpenEnd& end, const LinePiece& other, std::size_t own, double at_from_px, double at_to_px) {
        LineRun& run = runs_.runs[end.run];
        if (run.ends[end.which] == RunEnd::occluded) return;
        const RunPiece& last = piece_at(run, end.which);
        const double at = end.which == 0 ? last.at_from_px : last.at_to_px;
        if (own == end.run && std::max(at - at_to_px, at_from_px - at) < kOwnPx) return;
        const glm::dvec2 p = place(run, end.which), way = other.to - other.from;
        const double square = glm::dot(way, way);
        const double share = square > 0 ? std::clamp(glm::dot(p - other.from, way) / square, 0.0, 1.0) : 0.0;
        if (glm::distance(p, other.from + way * share) > kMeetsPx) return;
        const bool is_same_line = other.line == last.piece.line && other.is_hidden() != run.is_hidden;
        if (is_same_line || (other.occludes && is_in_front(other, share, last.piece, end.which))) {
            run.ends[end.which] = RunEnd::occluded;
        } else if (other.is_drawn && runs_.length_px(runs_.runs[own]) >= kCrumbPx) {
            run.ends[end.which] = RunEnd::corner;
        }
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
    std::vector<OpenEnd> open_;
};

}  // namespace

void find_run_ends(LineRuns& runs, std::span<const LinePiece> boundaries, const Projection& projection,
                   PixelRect picture) {
    RunEnds ends(runs, projection, picture);
    for (std::size_t i = 0; i < runs.runs.size(); ++i) {
        for (const RunPiece& p : runs.pieces_of(runs.runs[i])) ends.look_at(p.piece, i, p.at_from_px, p.at_to_px);
    }
    for (const LinePiece& piece : boundaries) ends.look_at(piece, RunEnds::kNoRun, 0, 0);
}

}  // namespace burin
