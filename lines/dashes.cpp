#include "lines/dashes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lines/dash_pen.h"
#include "lines/line_dashes.h"
#include "lines/piece_chains.h"
#include "lines/shared_dashes.h"
#include "lines/whole_line_index.h"

namespace burin {
namespace {

/// Loops smaller than this come from samples beside a vertex, not from anything to be seen.
constexpr double kSmallestLoopPx = 1.0 / 16;

/// Adds the dashes of a part of a piece.
void draw(const LinePiece& piece, const DashPart& part, const DashPen& pen, std::vector<LinePiece>& drawn) {
    const double share = part.end - part.begin, length = part.at_end - part.at_begin;
    const auto point = [&](double at) {
        return glm::mix(piece.from, piece.to, part.begin + share * ((at - part.at_begin) / length));
    };
    const double per_px = std::abs(length) / (share * glm::distance(piece.from, piece.to));
    pen.for_dashes(part.at_begin, part.at_end, per_px, [&](double first, double last) {
        LinePiece dash = piece;
        dash.from = point(length > 0 ? first : last);
        dash.to = point(length > 0 ? last : first);
        drawn.push_back(dash);
    });
}

/// Adds the dashes of a piece of a feature. `first`, `last`: where its ends are on the feature, as shares of it.
void draw_on_feature(const LinePiece& piece, double first, double last, const LineDashes& dashes, std::size_t feature,
                     const DashPen& pen, std::vector<LinePiece>& drawn) {
    constexpr double kFar = 1e300;
    dashes.for_parts(feature, [&](const DashPart& part) {
        // A piece may go on a little beyond its feature.
        const double low = part.begin <= 0 ? -kFar : part.begin, high = part.end >= 1 ? kFar : part.end;
        const double begin = std::max(std::min(first, last), low), end = std::min(std::max(first, last), high);
        if (!(begin < end)) return;
        const double at_begin = glm::mix(part.at_begin, part.at_end, (begin - part.begin) / (part.end - part.begin));
        const double at_end = glm::mix(part.at_begin, part.at_end, (end - part.begin) / (part.end - part.begin));
        const double s = (begin - first) / (last - first), t = (end - first) / (last - first);
        draw(piece, s < t ? DashPart{s, t, at_begin, at_end} : DashPart{t, s, at_end, at_begin}, pen, drawn);
    });
}

/// Whether a chain is long enough to be drawn: hooks of facets, and loops from samples beside a vertex, are not.
bool is_drawn(const PieceChains& chains, const PieceChains::Chain& chain, double width_px) {
    double total = 0;
    for (const std::uint32_t end : chain.ends) total += chains.length(end);
    return total >= (chain.is_closed ? kSmallestLoopPx : std::max(1.0, width_px));
}

/// Adds a chain's pieces with where they stand.
void add_pieces(const PieceChains& chains, const PieceChains::Chain& chain, double period_px,
                std::vector<DashPiece>& pieces) {
    double total = 0, at = 0;
    for (const std::uint32_t end : chain.ends) total += chains.length(end);
    const double scale = chain.is_closed ? period_px * std::max(1.0, std::round(total / period_px)) / total : 1;
    for (const std::uint32_t end : chain.ends) {
        const double begin = at;
        at += scale * chains.length(end);
        const LinePiece& piece = chains.piece(end);
        const bool is_backwards = end % 2 == 1;
        pieces.push_back({piece.from, piece.to, is_backwards ? at : begin, is_backwards ? begin : at});
    }
}

}  // namespace

std::vector<std::vector<LinePiece>> dashed(const std::vector<std::vector<LinePiece>>& lists,
                                           std::array<double, 2> dash_px, double width_px, PixelRect picture,
                                           std::span<const WholeLine> features, const SurfaceSet& surfaces) {
    std::vector<std::vector<LinePiece>> result(1);
    const DashPen pen(dash_px, width_px);
    SharedDashes shared(picture, SharedDashes::reach_of_pen_px(width_px));
    const LineDashes of_features(features, surfaces, pen.period_px(), shared);
    const WholeLineIndex on_mesh(features);
    std::vector<const LinePiece*> others;
    for (const auto& list : lists) {
        for (const LinePiece& s : list) {
            if (!s.is_drawn) {
                result[0].push_back(s);
            } else if (s.from == s.to) {
                continue;
            } else if (const auto feature = on_mesh.find(s)) {
                const double first = WholeLineIndex::share_of(features[*feature], s.from),
                             last = WholeLineIndex::share_of(features[*feature], s.to);
                draw_on_feature(s, first, last, of_features, *feature, pen, result[0]);
            } else {
                others.push_back(&s);
            }
        }
    }
    const PieceChains chains(std::move(others));
    std::vector<const LinePiece*> drawn;
    std::vector<DashPiece> pieces;
    std::vector<std::size_t> chain_ends;
    for (const PieceChains::Chain& chain : chains.all()) {
        if (!is_drawn(chains, chain, width_px)) continue;
        add_pieces(chains, chain, pen.period_px(), pieces);
        for (const std::uint32_t end : chain.ends) drawn.push_back(&chains.piece(end));
        chain_ends.push_back(pieces.size());
    }
    const DashPlaces places = shared.lay_out(std::move(pieces), chain_ends);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        places.for_parts(i, [&](const DashPart& part) { draw(*drawn[i], part, pen, result[0]); });
    }
    return result;
}

CourseIndex courses_of(const std::vector<std::vector<LinePiece>>& lists, PixelRect picture, double reach_px) {
    CourseIndex courses(picture, reach_px);
    for (const auto& list : lists) {
        for (const LinePiece& s : list) {
            const bool is_solid = s.is_drawn && s.opacity == 255;  // hidden lines shine through what fades
            if (is_solid && glm::distance(s.from, s.to) >= courses.shortest_px()) courses.add(s.from, s.to);
        }
    }
    return courses;
}

}  // namespace burin
