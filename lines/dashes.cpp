#include "lines/dashes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "lines/dash_pen.h"
#include "lines/end_links.h"
#include "lines/line_dashes.h"
#include "lines/shared_dashes.h"
#include "lines/whole_line_index.h"

namespace burin {
namespace {

/// Loops smaller than this come from samples beside a vertex, not from anything to be seen.
constexpr double kSmallestLoopPx = 1.0 / 16;

/// Whether a place is higher on the screen or, at the same height, further left.
bool is_higher(glm::dvec2 a, glm::dvec2 b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }

/// ChainsOfPieces links the ends of pieces that follow each other.
class ChainsOfPieces {
  public:
    struct Chain {
        std::vector<std::uint32_t> ends;  // by which each piece is entered
        bool is_closed = false;
    };

    explicit ChainsOfPieces(std::vector<const LinePiece*> pieces) : pieces_(std::move(pieces)), links_(pieces_.size()) {
        link();
    }

    const LinePiece& piece(std::uint32_t end) const { return *pieces_[end / 2]; }
    double length(std::uint32_t end) const { return glm::distance(piece(end).from, piece(end).to); }

    /// All chains, in the order of where they begin.
    std::vector<Chain> all() const {
        std::vector<Chain> chains;
        links_.for_chains([&](const std::vector<std::uint32_t>& ends, bool is_closed) {
            chains.push_back({ends, is_closed});
            put_in_order(chains.back());
        });
        const auto is_before = [this](std::uint32_t a, std::uint32_t b) { return is_higher(place(a), place(b)); };
        std::stable_sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) {
            if (std::lexicographical_compare(a.ends.begin(), a.ends.end(), b.ends.begin(), b.ends.end(), is_before))
                return true;
            if (std::lexicographical_compare(b.ends.begin(), b.ends.end(), a.ends.begin(), a.ends.end(), is_before))
                return false;
            return is_before(a.ends.back() ^ 1, b.ends.back() ^ 1);
        });
        return chains;
    }

  private:
    glm::dvec2 place(std::uint32_t end) const { return end % 2 == 0 ? pieces_[end / 2]->from : pieces_[end / 2]->to; }

    void link() {
        std::vector<std::uint32_t> ends(2 * pieces_.size());
        for (std::uint32_t i = 0; i < ends.size(); ++i) ends[i] = i;
        std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
            const glm::dvec2 p = place(a), q = place(b);
            return p != q ? is_higher(p, q) : a < b;
        });
        for (std::size_t i = 0; i < ends.size();) {
            std::size_t next = i + 1;
            while (next < ends.size() && place(ends[next]) == place(ends[i])) ++next;
            link_node(
                {ends.begin() + static_cast<std::ptrdiff_t>(i), ends.begin() + static_cast<std::ptrdiff_t>(next)});
            i = next;
        }
    }

    void link_node(std::vector<std::uint32_t> ends) {
        link_pairs(ends, [&](std::uint32_t end) { return piece(end).line; });
        std::erase_if(ends, [&](std::uint32_t end) { return !links_.is_free(end); });
        if (ends.size() != 2) link_pairs(ends, [&](std::uint32_t end) { return piece(end).drawn_as; });
        if (ends.size() == 2) link_pairs(ends, [](std::uint32_t) { return 0; });
    }

    /// Links two ends with equal keys, if there is no third one.
    template <typename Key>
    void link_pairs(const std::vector<std::uint32_t>& ends, const Key& key) {
        for (const std::uint32_t a : ends) {
            std::uint32_t partner = a;
            int count = 0;
            for (const std::uint32_t b : ends) {
                if (b == a || key(b) != key(a)) continue;
                partner = b;
                ++count;
            }
            if (count == 1) links_.link(a, partner);
        }
    }

    static void reverse(Chain& chain) {
        std::reverse(chain.ends.begin(), chain.ends.end());
        for (std::uint32_t& end : chain.ends) end ^= 1;
    }

    /// Makes a chain begin where dashes begin.
    void put_in_order(Chain& chain) const {
        const glm::dvec2 first = place(chain.ends.front()), last = place(chain.ends.back() ^ 1);
        if (first != last) {
            if (is_higher(last, first)) reverse(chain);
            return;
        }
        double area = 0;
        for (const std::uint32_t end : chain.ends) {
            const glm::dvec2 a = place(end) - first, b = place(end ^ 1) - first;
            area += a.x * b.y - a.y * b.x;
        }
        if (area < 0) reverse(chain);  // y runs down: clockwise is positive
        if (!chain.is_closed) return;
        const auto highest = std::min_element(chain.ends.begin(), chain.ends.end(), [&](auto a, auto b) {
            const glm::dvec2 p = place(a), q = place(b);
            return p != q ? is_higher(p, q) : is_higher(place(a ^ 1), place(b ^ 1));
        });
        std::rotate(chain.ends.begin(), highest, chain.ends.end());
    }

    std::vector<const LinePiece*> pieces_;
    EndLinks links_;
};

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
bool is_drawn(const ChainsOfPieces& chains, const ChainsOfPieces::Chain& chain, double width_px) {
    double total = 0;
    for (const std::uint32_t end : chain.ends) total += chains.length(end);
    return total >= (chain.is_closed ? kSmallestLoopPx : std::max(1.0, width_px));
}

/// Adds a chain's pieces with where they stand.
void add_pieces(const ChainsOfPieces& chains, const ChainsOfPieces::Chain& chain, double period_px,
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
    const ChainsOfPieces chains(std::move(others));
    std::vector<const LinePiece*> drawn;
    std::vector<DashPiece> pieces;
    std::vector<std::size_t> chain_ends;
    for (const ChainsOfPieces::Chain& chain : chains.all()) {
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
