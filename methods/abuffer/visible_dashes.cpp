#include "methods/abuffer/visible_dashes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace burin {
namespace {

/// Smaller loops come from samples beside a vertex, not from anything to be seen.
constexpr double kSmallestLoopPx = 1.0 / 16;
/// Length of what is drawn as a dot: it keeps its direction, or a dot would have no sides.
constexpr double kDotPx = 1.0 / 256;
constexpr std::uint32_t kNoEnd = 0xFFFFFFFFu;

/// Higher on the screen, then further left.
bool is_higher(glm::dvec2 a, glm::dvec2 b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }

/// The lines' pieces as chains. End 2i is the start of piece i, end 2i + 1 its end.
class Chains {
  public:
    struct Chain {
        std::vector<std::uint32_t> ends;  // by which each piece is entered
        bool is_closed = false;
    };

    explicit Chains(const std::vector<std::vector<LineSegment>>& segments) {
        for (const auto& list : segments) {
            for (const LineSegment& s : list) {
                if (s.is_drawn && s.from != s.to) pieces_.push_back(&s);
            }
        }
        link();
    }

    const LineSegment& piece(std::uint32_t end) const { return *pieces_[end / 2]; }
    double length(std::uint32_t end) const { return glm::distance(piece(end).from, piece(end).to); }

    std::vector<Chain> all() const {
        std::vector<Chain> chains;
        std::vector<bool> done(pieces_.size(), false);
        const auto follow = [&](std::uint32_t end, bool is_closed) {
            Chain chain;
            chain.is_closed = is_closed;
            for (; end != kNoEnd && !done[end / 2]; end = link_[end ^ 1]) {
                done[end / 2] = true;
                chain.ends.push_back(end);
            }
            put_in_order(chain);
            chains.push_back(std::move(chain));
        };
        for (std::uint32_t end = 0; end < link_.size(); ++end) {
            if (link_[end] == kNoEnd && !done[end / 2]) follow(end, false);
        }
        for (std::uint32_t end = 0; end < link_.size(); end += 2) {  // the rest are loops
            if (!done[end / 2]) follow(end, true);
        }
        return chains;
    }

  private:
    glm::dvec2 place(std::uint32_t end) const {
        return end % 2 == 0 ? pieces_[end / 2]->from : pieces_[end / 2]->to;
    }

    void link() {
        std::vector<std::uint32_t> ends(2 * pieces_.size());
        for (std::uint32_t i = 0; i < ends.size(); ++i) ends[i] = i;
        std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
            const glm::dvec2 p = place(a), q = place(b);
            return p != q ? is_higher(p, q) : a < b;
        });
        link_.assign(ends.size(), kNoEnd);
        for (std::size_t i = 0; i < ends.size();) {
            std::size_t next = i + 1;
            while (next < ends.size() && place(ends[next]) == place(ends[i])) ++next;
            link_node({ends.begin() + static_cast<std::ptrdiff_t>(i), ends.begin() + static_cast<std::ptrdiff_t>(next)});
            i = next;
        }
    }

    void link_node(std::vector<std::uint32_t> ends) {
        link_pairs(ends, [&](std::uint32_t end) { return piece(end).line_key; });
        std::erase_if(ends, [&](std::uint32_t end) { return link_[end] != kNoEnd; });
        if (ends.size() != 2) link_pairs(ends, [&](std::uint32_t end) { return piece(end).drawn_as; });
        if (ends.size() == 2) link_pairs(ends, [](std::uint32_t) { return 0; });
    }

    /// Links two ends with equal keys, if there is no third one.
    template <typename Key>
    void link_pairs(const std::vector<std::uint32_t>& ends, const Key& key) {
        for (const std::uint32_t a : ends) {
            std::uint32_t partner = kNoEnd;
            int count = 0;
            for (const std::uint32_t b : ends) {
                if (b == a || key(b) != key(a)) continue;
                partner = b;
                ++count;
            }
            if (count == 1) link_[a] = partner;
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

    std::vector<const LineSegment*> pieces_;
    std::vector<std::uint32_t> link_;
};

}  // namespace

std::vector<std::vector<LineSegment>> dashed(const std::vector<std::vector<LineSegment>>& segments,
                                             std::array<double, 2> dash_px, double width_px) {
    const Chains chains(segments);
    std::vector<std::vector<LineSegment>> result(1);
    for (const auto& list : segments) {
        std::copy_if(list.begin(), list.end(), std::back_inserter(result[0]), [](const LineSegment& s) { return !s.is_drawn; });
    }
    for (const Chains::Chain& chain : chains.all()) {
        double total = 0;
        for (const std::uint32_t end : chain.ends) total += chains.length(end);
        if (total < (chain.is_closed ? kSmallestLoopPx : std::max(1.0, width_px))) continue;  // a hook of facets
        double on = dash_px[0], period = dash_px[0] + dash_px[1];
        if (chain.is_closed) {
            const double stretch = total / (period * std::max(1.0, std::round(total / period)));
            on *= stretch;
            period *= stretch;
        }
        // The ends of the pen's way: a dash with its round ends is as long as asked for.
        const double inset = std::min(0.5 * on, 0.5 * width_px);
        const bool is_dotted = on - 2 * inset < kDotPx;
        double at = 0;
        for (const std::uint32_t end : chain.ends) {
            const LineSegment& piece = chains.piece(end);
            const double length = chains.length(end);
            const bool is_backwards = end % 2 == 1;
            const auto point = [&](double along) {
                const double share = std::clamp((along - at) / length, 0.0, 1.0);
                return glm::mix(piece.from, piece.to, is_backwards ? 1 - share : share);
            };
            for (double dash = std::floor(at / period); dash * period <= at + length; ++dash) {
                const double begin = std::max(at, dash * period + inset);
                const double stop = std::min(at + length, std::max(dash * period + inset, dash * period + on - inset));
                if (begin > stop) continue;
                LineSegment part = piece;
                part.from = point(is_backwards ? stop : begin);
                part.to = point(is_backwards ? begin : stop);
                if (is_dotted) {
                    const glm::dvec2 middle = 0.5 * (part.from + part.to);
                    const glm::dvec2 half = (piece.to - piece.from) * (0.5 * kDotPx / length);
                    part.from = middle - half;
                    part.to = middle + half;
                }
                result[0].push_back(part);
            }
            at += length;
        }
    }
    return result;
}

}  // namespace burin
