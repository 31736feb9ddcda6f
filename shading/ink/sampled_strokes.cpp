#include "shading/ink/sampled_strokes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace burin {
namespace {

constexpr double kFarthestApartPx = 8, kClosestPx = 0.25;
/// At quarters, periods that fit an interval would not be seen.
constexpr std::array<double, 3> kShares = {0.23, 0.5, 0.81};

/// A sample of a stretch with its ink.
struct Node {
    LineSample sample;
    std::uint32_t stretch = 0;
    InkValues values;
    bool is_open = false;  ///< the interval to the next node, on the same piece, may need more samples
};

/// How large a linear value looks, about as sRGB encodes it.
float encoded(float linear) { return std::sqrt(std::max(linear, 0.0f)); }

/// Whether a value lies between two others, as well as one sees.
bool is_straight(const InkValues& a, const InkValues& b, double share, const InkValues& value) {
    static_assert(sizeof(InkValues) == 6 * sizeof(float), "each number of them has a tolerance here");
    const auto s = static_cast<float>(share);
    const auto mixed = [s](float x, float y) { return x + (y - x) * s; };
    const float width = mixed(a.width_px, b.width_px);
    if (std::abs(value.width_px - width) > std::clamp(0.01f * width, 1.0f / 64, 1.0f / 8)) return false;
    if (std::abs(value.offset_px - mixed(a.offset_px, b.offset_px)) > 1.0f / 16) return false;
    if (std::abs(value.opacity - mixed(a.opacity, b.opacity)) > 1.0f / 128) return false;
    for (int k = 0; k < 3; ++k) {
        if (std::abs(encoded(value.color[k]) - encoded(mixed(a.color[k], b.color[k]))) > 1.0f / 128) return false;
    }
    return true;
}

/// Whether two depths differ by less than a small part of a pixel's width: a chain may go on at another depth.
bool are_as_near(const Projection& projection, float a, float b) {
    constexpr double kAsNearPx = 1.0 / 16;
    const double difference = std::abs(static_cast<double>(a) - static_cast<double>(b)) * projection.focal_px;
    return difference <= kAsNearPx * (projection.orthographic ? 1.0 : static_cast<double>(b));
}

/// Nodes at the ends of pieces and at most 8 pixels apart.
std::vector<Node> first_nodes(const LineColumns& lines, std::span<const LineStretch> stretches, bool varies) {
    std::vector<Node> nodes;
    for (std::uint32_t i = 0; i < stretches.size(); ++i) {
        const LineStretch& stretch = stretches[i];
        for (std::size_t p = stretch.first; p < stretch.first + stretch.count; ++p) {
            const LinePiece& piece = lines.runs().pieces[p].piece;
            const double length = glm::distance(piece.from, piece.to);
            const int parts =
                varies ? std::clamp(static_cast<int>(std::ceil(length / kFarthestApartPx)), 1, 1 << 16) : 1;
            for (int k = 0; k <= parts; ++k) {
                const double share = static_cast<double>(k) / parts;
                nodes.push_back({{stretch.run, static_cast<std::uint32_t>(p), share}, i, {}, varies && k < parts});
            }
        }
    }
    return nodes;
}

/// One more round: nodes in the middle of the intervals that need them. Returns whether any interval is still open.
bool halve(const LineColumns& lines, std::span<const ChainValues> chains, StrokeValues& values,
           std::vector<Node>& nodes) {
    std::vector<LineSample> samples;
    std::vector<const ChainValues*> of_chains;
    std::vector<std::size_t> intervals;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        if (!nodes[i].is_open) continue;
        const LineSample &a = nodes[i].sample, &b = nodes[i + 1].sample;
        const LinePiece& piece = lines.runs().pieces[a.piece].piece;
        if ((b.share - a.share) * glm::distance(piece.from, piece.to) <= kClosestPx) {
            nodes[i].is_open = false;
            continue;
        }
        intervals.push_back(i);
        for (const double share : kShares) {
            samples.push_back({a.run, a.piece, a.share + (b.share - a.share) * share});
            of_chains.push_back(&chains[nodes[i].stretch]);
        }
    }
    if (intervals.empty()) return false;
    std::vector<InkValues> found;
    values.evaluate(samples, of_chains, found);
    std::vector<Node> next;
    next.reserve(nodes.size() + intervals.size());
    std::size_t k = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        next.push_back(nodes[i]);
        if (k == intervals.size() || intervals[k] != i) continue;
        bool is_done = true;
        for (std::size_t j = 0; j < kShares.size(); ++j) {
            is_done =
                is_done && is_straight(nodes[i].values, nodes[i + 1].values, kShares[j], found[kShares.size() * k + j]);
        }
        next.back().is_open = !is_done;
        if (!is_done) {
            const std::size_t middle = kShares.size() * k + 1;
            next.push_back({samples[middle], nodes[i].stretch, found[middle], true});
        }
        ++k;
    }
    nodes.swap(next);
    return true;
}

/// Directions to the right of a run's way, at both ends of one of its pieces: in the middle between those of pieces
/// that meet, and longer where these turn, so that a moved line keeps its distance. Where a line runs to and fro within
/// a pixel or a few, its pieces run as the line does around them: contours fold back here and there, and a line that is
/// moved far from one would have a spike for each of these folds.
class Across {
  public:
    explicit Across(const LineRuns& runs) : runs_(runs) {}

    /// For a line that is moved by that much.
    glm::dvec2 at(const LineSample& sample, double offset_px) const {
        const double around_px = std::clamp(0.5 * std::abs(offset_px), kLeastAroundPx, kMostAroundPx);
        return glm::mix(joint(sample.run, sample.piece, false, around_px),
                        joint(sample.run, sample.piece, true, around_px), sample.share);
    }

  private:
    static constexpr double kLeastAroundPx = 1, kMostAroundPx = 8;
    static constexpr int kMostPieces = 256;  // that a walk passes

    /// The piece before or behind one in its run, or the same at an end.
    static std::size_t beside(const LineRun& run, std::size_t piece, bool is_behind) {
        const std::size_t last = run.first + run.count - 1;
        if (is_behind) return piece < last ? piece + 1 : run.is_closed ? run.first : piece;
        return piece > run.first ? piece - 1 : run.is_closed ? last : piece;
    }
    /// A vector across a piece and as long as it is, to the side away from the surface that ends at the piece. If no
    /// surface ends at it, or none at `own`, it is the side that is away from the surface of `own`.
    static glm::dvec2 away_across(const LinePiece& p, const LinePiece& own) {
        const auto side = static_cast<double>(to_right(own.occludes && p.occludes ? p : own));
        return glm::dvec2(p.from.y - p.to.y, p.to.x - p.from.x) * side;
    }

    /// What walks along a run, from the middle of a piece to either side, have passed.
    struct Around {
        glm::dvec2 sum{0.0};   // of away_across() of the pieces
        double length_px = 0;  // of the pieces
        double turn = 0;       // radians by which the line turns in all: turns to the left and to the right cancel
        double turns = 0;      // the same, but each turn counts by its size
    };
    /// Walks `around_px` pixels along a run, from the middle of a piece to one side, and adds what it passes to
    /// `found`.
    void look_along(const LineRun& run, std::size_t piece, bool is_behind, double around_px, const LinePiece& own,
                    Around& found) const {
        std::size_t at = piece;
        double share = 0.5;  // of the piece
        for (int i = 0; i < kMostPieces && around_px > 0; ++i) {
            const glm::dvec2 across = away_across(runs_.pieces[at].piece, own) * share;
            const double length = glm::length(across);
            if (length > 0) found.sum += across * std::min(1.0, around_px / length);
            found.length_px += std::min(length, around_px);
            around_px -= length;
            share = 1;
            const std::size_t next = beside(run, at, is_behind);
            if (next == at || next == piece) return;
            if (around_px > 0) {
                const glm::dvec2 beyond = away_across(runs_.pieces[next].piece, own);
                const glm::dvec2 before = is_behind ? across : beyond, after = is_behind ? beyond : across;
                const double turn =
                    std::atan2(before.x * after.y - before.y * after.x, before.x * after.x + before.y * after.y);
                found.turn += turn;
                found.turns += std::abs(turn);
            }
            at = next;
        }
    }
    /// A direction in which a line is moved.
    struct Direction {
        glm::dvec2 unit;
        double strength;  // share of the offset; less than 1 where the line turns back on itself and has no direction
    };
    /// The direction across a piece, away from the surface. Where the line runs to and fro, it is the mean over
    /// `around_px` to either side.
    Direction away_from(const LineRun& run, std::size_t piece, double around_px, const LinePiece& own) const {
        const glm::dvec2 across = away_across(runs_.pieces[piece].piece, own);
        const auto unit = [](glm::dvec2 v) { return v / std::max(glm::length(v), 1e-300); };
        if (glm::length(across) >= 2 * around_px) return {unit(across), 1};
        Around around;
        look_along(run, piece, true, around_px, own, around);
        look_along(run, piece, false, around_px, own, around);
        // Corners and curves turn one way, and not back. What turns to and fro, or right round, is a fold.
        constexpr double kQuarterTurn = 1.5707963267948966, kSharpestCorner = 4.0 / 3 * kQuarterTurn;
        const double excess = around.turns - std::min(std::abs(around.turn), kSharpestCorner);
        const double folds = std::clamp(2 * excess / kQuarterTurn - 0.5, 0.0, 1.0);
        if (folds == 0) return {unit(across), 1};
        const double strength = std::min(2 * glm::length(around.sum) / std::max(around.length_px, 1e-300), 1.0);
        return {unit(glm::mix(unit(across), unit(around.sum), folds)), glm::mix(1.0, strength, folds)};
    }
    glm::dvec2 joint(std::uint32_t run_number, std::size_t piece, bool is_end, double around_px) const {
        const LineRun& run = runs_.runs[run_number];
        const std::size_t other = beside(run, piece, is_end);
        const LinePiece& own_piece = runs_.pieces[piece].piece;
        const auto side = static_cast<double>(to_right(own_piece));
        const Direction own = away_from(run, piece, around_px, own_piece);
        if (other == piece) return side * own.strength * own.unit;
        // Both are the same on either side of the joint, so that the moved line has no step there.
        const Direction beyond = away_from(run, other, around_px, own_piece);
        const Direction &first = is_end ? own : beyond, &second = is_end ? beyond : own;
        const glm::dvec2 sum = first.unit + second.unit;
        const double square = glm::dot(sum, sum), strength = 0.5 * side * (first.strength + second.strength);
        constexpr double kMostLonger = 2;
        if (square < 4 / (kMostLonger * kMostLonger))
            return strength * (square > 0 ? sum * (kMostLonger / std::sqrt(square)) : first.unit);
        return strength * (2 / square) * sum;
    }

    const LineRuns& runs_;
};

}  // namespace

std::vector<SampledStroke> sample_strokes(const LineColumns& lines, std::span<const LineStretch> stretches,
                                          StrokeValues& values) {
    const std::vector<ChainValues> chains = values.chain_values(stretches);
    std::vector<Node> nodes = first_nodes(lines, stretches, values.varies());
    std::vector<LineSample> samples;
    std::vector<const ChainValues*> of_chains;
    for (const Node& node : nodes) {
        samples.push_back(node.sample);
        of_chains.push_back(&chains[node.stretch]);
    }
    std::vector<InkValues> found;
    values.evaluate(samples, of_chains, found);
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].values = found[i];
    while (halve(lines, chains, values, nodes)) {
    }

    const bool is_moved = values.style().moves_lines();
    const bool may_move = values.may_move();
    const Across across(lines.runs());
    std::vector<SampledStroke> strokes;
    for (std::size_t i = 0; i < stretches.size(); ++i) strokes.push_back({stretches[i], chains[i], {}, is_moved});
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        const LinePiece& piece = lines.runs().pieces[node.sample.piece].piece;
        PathPoint point;
        point.at_px = lines.at_of(node.sample);
        point.piece = node.sample.piece;
        point.ends_piece = node.sample.share == 1;
        point.ink.place = lines.place_of(node.sample);
        point.ink.nearness = static_cast<float>(glm::mix(static_cast<double>(piece.nearness_from),
                                                         static_cast<double>(piece.nearness_to), node.sample.share));
        point.ink.width_px = node.values.width_px;
        point.ink.opacity = node.values.opacity;
        point.ink.color = node.values.color;
        point.ink.occludes = piece.occludes;
        point.ink.front_on_left = piece.front_on_left;
        if (may_move) {
            const auto offset_px = static_cast<double>(node.values.offset_px);
            point.ink.place += across.at(node.sample, offset_px) * offset_px;
        }
        if (may_move && node.values.offset_px != 0) strokes[node.stretch].is_moved = true;
        StrokePath& path = strokes[node.stretch].path;
        // Parts of one edge may overlap by a little; places never go back.
        if (!path.empty()) point.at_px = std::max(point.at_px, path.back().at_px);
        // Where two pieces meet and nothing jumps, one point is enough.
        if (!path.empty() && node.sample.share == 0 && path.back().ink.place == point.ink.place &&
            nodes[i - 1].values == node.values &&
            are_as_near(lines.lines().projection, path.back().ink.nearness, point.ink.nearness)) {
            path.back() = point;
        } else {
            path.push_back(point);
        }
    }
    return strokes;
}

}  // namespace burin
