#include "lines/line_runs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>
#include <utility>

#include "base/interrupt.h"
#include "lines/chains.h"
#include "lines/whole_line_index.h"

namespace burin {
namespace {

/// Pieces of one chain that are no farther apart along it, nor on the screen, are one run: a vertex may lie between
/// them.
constexpr double kTogetherPx = 0.5;
constexpr double kApartPx = 1.0, kStubPx = 1.0;
/// Chains that end closer to where they began are seen as a loop.
constexpr double kClosedPx = 1.0 / 256;

void turn(LinePiece& piece) {
    std::swap(piece.from, piece.to);
    std::swap(piece.nearness_from, piece.nearness_to);
    piece.front_on_left = !piece.front_on_left;
}

/// FeatureRuns collects the pieces that lie on whole lines, and makes runs of them.
class FeatureRuns {
  public:
    FeatureRuns(std::span<const WholeLine> features, const SurfaceSet& surfaces)
        : features_(features),
          surfaces_(surfaces),
          index_(features),
          chains_(chains_of(features, surfaces)),
          chain_of_(features.size()) {
        std::size_t begin = 0;
        for (std::uint32_t chain = 0; chain < chains_.chain_ends.size(); ++chain) {
            for (std::size_t i = begin; i < chains_.chain_ends[chain]; ++i) chain_of_[chains_.lines[i]] = chain;
            begin = chains_.chain_ends[chain];
        }
    }

    /// Takes the piece if it lies on a feature.
    bool take(const LinePiece& piece) {
        const auto line = index_.find(piece);
        if (!line || is_beyond(features_[*line], 0.5 * (piece.from + piece.to))) return false;
        const std::array<double, 2>& at = chains_.positions[*line];
        const auto place = [&](glm::dvec2 p) {
            return glm::mix(at[0], at[1], WholeLineIndex::share_of(features_[*line], p));
        };
        Placed placed{chain_of_[*line], piece.is_hidden(), {piece, place(piece.from), place(piece.to)}};
        if (placed.piece.at_to_px < placed.piece.at_from_px) {
            turn(placed.piece.piece);
            std::swap(placed.piece.at_from_px, placed.piece.at_to_px);
        }
        placed_.push_back(placed);
        return true;
    }

    void add_to(LineRuns& runs) {
        std::sort(placed_.begin(), placed_.end(), [](const Placed& a, const Placed& b) {
            const auto key = [](const Placed& p) {
                return std::tuple(p.chain, p.is_hidden, p.piece.at_from_px, p.piece.at_to_px, p.piece.piece.from.x,
                                  p.piece.piece.from.y, p.piece.piece.line.bits);
            };
            throw_if_interrupted();
            return key(a) < key(b);
        });
        for (std::size_t begin = 0, end = 0; begin < placed_.size(); begin = end) {
            throw_if_interrupted();
            const auto is_of_chain = [&](const Placed& p) {
                return p.chain == placed_[begin].chain && p.is_hidden == placed_[begin].is_hidden;
            };
            std::vector<Placed> own;
            for (; end < placed_.size() && is_of_chain(placed_[end]); ++end) {
                if (!is_stub(placed_[end], own)) own.push_back(placed_[end]);
            }
            add_chain(own, runs);
        }
    }

  private:
    /// Whether a place of an edge is not on the line that is a part of it: elsewhere the edge is a seam, where lines
    /// may be found that are none in every view.
    static bool is_beyond(const WholeLine& line, glm::dvec2 place) {
        const double share = WholeLineIndex::share_of(line, place);
        return std::max(-share, share - 1) * line.length_px() > kTogetherPx;
    }

    struct Placed {
        std::uint32_t chain;
        bool is_hidden;
        RunPiece piece;
    };

    void add_chain(std::span<const Placed> placed, LineRuns& runs) const {
        const std::uint32_t chain = placed.front().chain;
        const double length = chains_.length_px[chain];
        LineRun run;
        run.is_hidden = placed.front().is_hidden;
        run.chain_length_px = length;
        run.chain_is_closed = chains_.is_loop[chain];
        run.chain_place = place_of(features_[chains_.lines[chain == 0 ? 0 : chains_.chain_ends[chain - 1]]].id);
        // What is beyond the beginning of a loop goes on from its end.
        std::size_t first = 0;
        if (run.chain_is_closed && placed.front().piece.at_from_px < kTogetherPx &&
            placed.back().piece.at_to_px > length - kTogetherPx) {
            while (first + 1 < placed.size() && goes_on(placed[first], placed[first + 1])) ++first;
            first = (first + 1) % placed.size();
        }
        run.is_closed = first == 0 && run.chain_is_closed && covers_all(placed, length);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const std::size_t k = (first + i) % placed.size();
            const bool begins = i == 0 || (k == 0 ? run.is_closed : !goes_on(placed[k - 1], placed[k]));
            if (begins) {
                run.first = runs.pieces.size();
                run.count = 0;
                runs.runs.push_back(run);
            }
            RunPiece piece = placed[k].piece;
            if (k < first) {
                piece.at_from_px += length;
                piece.at_to_px += length;
            }
            runs.pieces.push_back(piece);
            ++runs.runs.back().count;
        }
    }
    /// A hash of the coordinates of both ends of an edge in its mesh, never 0.
    std::uint64_t place_of(LineId edge) const {
        const Mesh& mesh = *surfaces_.instances[edge.instance()].mesh;
        const HalfEdge h = edge.half_edge();
        std::array<std::uint32_t, 2> ends;
        if (mesh.is_loose(h)) {
            ends = mesh.loose_edge(h);
        } else {
            const auto& t = mesh.triangles[h / 3];
            ends = {t[h % 3], t[(h % 3 + 1) % 3]};
        }
        std::uint64_t sum = 0;  // does not depend on which way round the edge runs
        for (const std::uint32_t end : ends) {
            const glm::vec3 p = mesh.positions[end] + 0.0f;
            std::uint64_t hash = 0xCBF29CE484222325;  // FNV-1a
            for (int k = 0; k < 3; ++k) hash = (hash ^ std::bit_cast<std::uint32_t>(p[k])) * 0x100000001B3;
            sum += hash ^ hash >> 31;
        }
        return sum | 1;
    }
    static bool goes_on(const Placed& a, const Placed& b) {
        return b.piece.at_from_px <= a.piece.at_to_px + kTogetherPx &&
               glm::distance(a.piece.piece.to, b.piece.piece.from) <= kApartPx;
    }
    /// Whether a piece is a short one that lies beside a part of those before it, as there are where several lines meet
    /// between two samples. A run that went back for it would end there.
    static bool is_stub(const Placed& p, std::span<const Placed> before) {
        return !before.empty() && p.piece.at_to_px <= before.back().piece.at_to_px &&
               glm::distance(p.piece.piece.from, p.piece.piece.to) < kStubPx;
    }
    static bool covers_all(std::span<const Placed> placed, double length) {
        for (std::size_t i = 1; i < placed.size(); ++i) {
            if (!goes_on(placed[i - 1], placed[i])) return false;
        }
        return placed.front().piece.at_from_px < kTogetherPx && placed.back().piece.at_to_px > length - kTogetherPx;
    }

    std::span<const WholeLine> features_;
    const SurfaceSet& surfaces_;
    WholeLineIndex index_;
    LineChains chains_;
    std::vector<std::uint32_t> chain_of_;  // of each feature
    std::vector<Placed> placed_;
};

/// Whether a run goes the wrong way round. Contours run with the surface that ends there on their left; where no
/// surface does, loops run clockwise, and all others to the right and down. A line that grows from one picture to the
/// next so keeps its direction, and with it the side that strokes waver to.
bool runs_backwards(std::span<const RunPiece> pieces, bool is_closed) {
    double on_left = 0, area = 0;
    const glm::dvec2 begin = pieces.front().piece.from;
    for (const RunPiece& p : pieces) {
        const LinePiece& piece = p.piece;
        const glm::dvec2 a = piece.from - begin, b = piece.to - begin;
        if (piece.occludes) on_left += (piece.front_on_left ? 1 : -1) * glm::distance(a, b);
        area += a.x * b.y - a.y * b.x;
    }
    if (on_left != 0) return on_left < 0;
    if (is_closed) return area < 0;
    const glm::dvec2 way = pieces.back().piece.to - begin;
    return way.x + 0.5 * way.y < 0;
}

/// Adds the runs of lines that stand along themselves.
void add_others(std::vector<const LinePiece*> pieces, bool is_hidden, const PieceLinking& linking, LineRuns& runs) {
    const PieceChains chains(std::move(pieces), linking);
    for (const PieceChains::Chain& chain : chains.all()) {
        throw_if_interrupted();
        LineRun run;
        run.first = runs.pieces.size();
        run.count = chain.ends.size();
        run.is_hidden = is_hidden;
        for (const std::uint32_t end : chain.ends) {
            RunPiece piece{chains.piece(end), 0, chains.length(end)};
            if (!EndLinks::is_beginning(end)) turn(piece.piece);
            runs.pieces.push_back(piece);
        }
        const std::span<RunPiece> own = std::span(runs.pieces).subspan(run.first);
        if (runs_backwards(own, chain.is_closed)) {
            std::reverse(own.begin(), own.end());
            for (RunPiece& piece : own) turn(piece.piece);
        }
        double at = 0;
        for (RunPiece& piece : own) {
            piece.at_from_px = at;
            piece.at_to_px = at += piece.at_to_px;
        }
        run.is_closed = chain.is_closed ||
                        glm::distance(runs.pieces[run.first].piece.from, runs.pieces.back().piece.to) < kClosedPx;
        run.chain_length_px = at;
        run.chain_is_closed = run.is_closed;
        runs.runs.push_back(run);
    }
}

}  // namespace

LineRuns runs_of(const LineDrawing::Lists& visible, const LineDrawing::Lists& behind,
                 std::span<const WholeLine> features, const SurfaceSet& surfaces, const RunRules& of_seen,
                 const RunRules& of_hidden) {
    LineRuns runs;
    FeatureRuns of_features(features, surfaces);
    std::vector<const LinePiece*> seen, hidden;
    for (const LineDrawing::Lists* lists : {&visible, &behind}) {
        for (const std::span<const LinePiece> list : *lists) {
            for (const LinePiece& piece : list) {
                throw_if_interrupted();
                if (!piece.is_drawn || piece.from == piece.to) continue;
                const bool is_hidden = piece.is_hidden();
                if ((is_hidden ? of_hidden : of_seen).along_features && of_features.take(piece)) continue;
                (is_hidden ? hidden : seen).push_back(&piece);
            }
        }
    }
    of_features.add_to(runs);
    add_others(std::move(seen), false, of_seen.linking, runs);
    add_others(std::move(hidden), true, of_hidden.linking, runs);
    return runs;
}

}  // namespace burin
