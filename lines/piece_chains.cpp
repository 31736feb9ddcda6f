#include "lines/piece_chains.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

/// Whether a place is higher on the screen or, at the same height, further left.
bool is_higher(glm::dvec2 a, glm::dvec2 b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }

void reverse(PieceChains::Chain& chain) {
    std::reverse(chain.ends.begin(), chain.ends.end());
    for (std::uint32_t& end : chain.ends) end ^= 1;
}

}  // namespace

PieceChains::PieceChains(std::vector<const LinePiece*> pieces, const PieceLinking& linking)
    : pieces_(std::move(pieces)), linking_(linking), links_(pieces_.size()) {
    link();
    if (linking_.goes_straight) bridge_gaps();
}

std::vector<PieceChains::Chain> PieceChains::all() const {
    std::vector<Chain> chains;
    links_.for_chains([&](const std::vector<std::uint32_t>& ends, bool is_closed) {
        chains.push_back({ends, is_closed});
        put_in_order(chains.back());
    });
    const auto is_before = [this](std::uint32_t a, std::uint32_t b) { return is_higher(place(a), place(b)); };
    std::stable_sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) {
        throw_if_interrupted();
        if (std::lexicographical_compare(a.ends.begin(), a.ends.end(), b.ends.begin(), b.ends.end(), is_before))
            return true;
        if (std::lexicographical_compare(b.ends.begin(), b.ends.end(), a.ends.begin(), a.ends.end(), is_before))
            return false;
        return is_before(a.ends.back() ^ 1, b.ends.back() ^ 1);
    });
    return chains;
}

/// Finds the ends that are at one place. Returns all ends, place by place.
std::vector<std::uint32_t> PieceChains::find_nodes() {
    std::vector<std::uint32_t> ends(2 * pieces_.size());
    for (std::uint32_t i = 0; i < ends.size(); ++i) ends[i] = i;
    std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
        throw_if_interrupted();
        const glm::dvec2 p = place(a), q = place(b);
        return p != q ? is_higher(p, q) : a < b;
    });
    nodes_.resize(ends.size());
    std::vector<std::uint32_t> firsts;  // one end for each place, in the order of places
    for (const std::uint32_t end : ends) {
        if (firsts.empty() || place(firsts.back()) != place(end)) firsts.push_back(end);
        nodes_[end] = firsts.back();
    }
    if (linking_.apart_px <= 0) return ends;
    // Places in cells that are as wide as places may be apart.
    const auto row_of = [&](glm::dvec2 p) { return std::floor(p.y / linking_.apart_px); };
    struct Cell {
        double row, x;
        std::uint32_t end;
        bool operator<(const Cell& o) const { return std::tie(row, x, end) < std::tie(o.row, o.x, o.end); }
    };
    std::vector<Cell> cells;
    for (const std::uint32_t end : firsts) cells.push_back({row_of(place(end)), place(end).x, end});
    std::sort(cells.begin(), cells.end());
    const auto first_of = [&](std::uint32_t end) {
        while (nodes_[end] != end) end = nodes_[end] = nodes_[nodes_[end]];
        return end;
    };
    for (const Cell& cell : cells) {
        for (const double row : {cell.row, cell.row + 1}) {
            for (auto near = std::lower_bound(cells.begin(), cells.end(), Cell{row, cell.x - linking_.apart_px, 0});
                 near != cells.end() && near->row == row && near->x <= cell.x + linking_.apart_px; ++near) {
                if (glm::distance(place(near->end), place(cell.end)) > linking_.apart_px) continue;
                const std::uint32_t a = first_of(near->end), b = first_of(cell.end);
                if (is_higher(place(a), place(b))) {
                    nodes_[b] = a;
                } else {
                    nodes_[a] = b;
                }
            }
        }
    }
    for (const std::uint32_t end : ends) nodes_[end] = first_of(end);
    std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
        throw_if_interrupted();
        const glm::dvec2 p = place(nodes_[a]), q = place(nodes_[b]);
        return p != q ? is_higher(p, q) : a < b;
    });
    return ends;
}

void PieceChains::link() {
    const std::vector<std::uint32_t> ends = find_nodes();
    for (std::size_t i = 0; i < ends.size();) {
        std::size_t next = i + 1;
        while (next < ends.size() && nodes_[ends[next]] == nodes_[ends[i]]) ++next;
        link_node({ends.begin() + static_cast<std::ptrdiff_t>(i), ends.begin() + static_cast<std::ptrdiff_t>(next)});
        i = next;
    }
}

void PieceChains::link_node(std::vector<std::uint32_t> ends) {
    const auto keep_free = [&] { std::erase_if(ends, [&](std::uint32_t end) { return !links_.is_free(end); }); };
    if (linking_.goes_straight && ends.size() > 2) {
        // Hooks run to the same place as another piece, as where a contour was folded back onto itself.
        const auto is_hook = [&](std::uint32_t end) {
            return std::any_of(ends.begin(), ends.end(),
                               [&](std::uint32_t b) { return b != end && nodes_[b ^ 1] == nodes_[end ^ 1]; });
        };
        std::vector<std::uint32_t> hooks, others;
        for (const std::uint32_t end : ends) (is_hook(end) ? hooks : others).push_back(end);
        if (!hooks.empty()) {
            if (others.size() == 1) {
                links_.link(others[0], hooks[0]);
            } else {
                link_pairs(hooks, [&](std::uint32_t end) { return nodes_[end ^ 1]; });
            }
            if (others.size() < 2) return;
            ends = others;
        }
    }
    link_pairs(ends, [&](std::uint32_t end) { return piece(end).line; });
    keep_free();
    if (ends.size() != 2) link_pairs(ends, [&](std::uint32_t end) { return piece(end).drawn_as; });
    if (linking_.goes_straight) {
        keep_free();
        if (ends.size() > 2) link_straightest(ends);
    }
    if (ends.size() == 2) link_pairs(ends, [](std::uint32_t) { return 0; });
}

void PieceChains::link_straightest(const std::vector<std::uint32_t>& ends) {
    struct Pair {
        double cosine;  // -1: straight on
        std::uint32_t a, b;
    };
    constexpr double kMostCosine = -0.5;
    const auto way = [&](std::uint32_t end) {
        const glm::dvec2 from = place(end), to = place(end ^ 1);
        return (to - from) / glm::distance(from, to);
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        for (std::size_t k = i + 1; k < ends.size(); ++k) {
            if (piece(ends[i]).drawn_as != piece(ends[k]).drawn_as) continue;
            const double cosine = glm::dot(way(ends[i]), way(ends[k]));
            if (cosine < kMostCosine) pairs.push_back({cosine, ends[i], ends[k]});
        }
    }
    const auto key = [&](const Pair& p) {
        const glm::dvec2 a = place(p.a ^ 1), b = place(p.b ^ 1);
        const std::pair at_a(a.y, a.x), at_b(b.y, b.x);
        return std::tuple(p.cosine, std::min(at_a, at_b), std::max(at_a, at_b));
    };
    std::sort(pairs.begin(), pairs.end(), [&](const Pair& p, const Pair& q) { return key(p) < key(q); });
    for (const Pair& p : pairs) {
        if (links_.is_free(p.a) && links_.is_free(p.b)) links_.link(p.a, p.b);
    }
}

/// Links two ends with equal keys, if there is no third one.
template <typename Key>
void PieceChains::link_pairs(const std::vector<std::uint32_t>& ends, const Key& key) {
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

void PieceChains::bridge_gaps() {
    constexpr double kGapPx = 1;                           // what lies between a few samples
    constexpr double kCrumbPx = 1.0;                       // no chain that goes on anywhere
    constexpr double kDirectionPx = 3.0;                   // over which a chain says where it goes
    constexpr double kStraight = -0.5, kMostCosine = 0.5;  // what turns back more is a cusp
    struct Open {
        double row;
        glm::dvec2 place, way;  // into the chain
        std::uint32_t end;
        bool is_short;  // its way is that of a crumb, and says little
    };
    std::vector<Open> open;
    links_.for_chains([&](const std::vector<std::uint32_t>& ends, bool is_closed) {
        if (is_closed) return;
        double length_px = 0;
        for (const std::uint32_t end : ends) length_px += length(end);
        if (length_px < kCrumbPx) return;
        // No part of a short chain says both where it comes from and where it goes, as if it ran on in itself.
        const double direction_px = std::min(kDirectionPx, 0.5 * length_px);
        const auto way_in = [&](bool from_end) {
            const std::size_t n = ends.size();
            const glm::dvec2 from = from_end ? place(ends[n - 1] ^ 1) : place(ends[0]);
            glm::dvec2 to = from;
            double way_px = 0;
            for (std::size_t i = 0; i < n && way_px < direction_px; ++i) {
                const std::uint32_t end = from_end ? ends[n - 1 - i] : ends[i];
                const double own_px = length(end), rest_px = direction_px - way_px;
                const glm::dvec2 near = to, far = from_end ? place(end) : place(end ^ 1);
                const bool is_long = direction_px == kDirectionPx || own_px <= rest_px;
                to = is_long ? far : near + (far - near) * (rest_px / own_px);
                way_px += own_px;
            }
            const double distance = glm::distance(from, to);
            return distance > 0 ? (to - from) / distance : glm::dvec2(0.0);
        };
        for (const bool from_end : {false, true}) {
            const std::uint32_t end = from_end ? ends.back() ^ 1 : ends.front();
            open.push_back(
                {std::floor(place(end).y / kGapPx), place(end), way_in(from_end), end, length_px < kDirectionPx});
        }
    });
    const auto is_before = [](const Open& a, const Open& b) {
        return std::tie(a.row, a.place.x, a.place.y, a.end) < std::tie(b.row, b.place.x, b.place.y, b.end);
    };
    std::sort(open.begin(), open.end(), is_before);
    struct Bridge {
        bool is_short;
        double cosine, gap_px;
        std::size_t a, b;  // in `open`
    };
    std::vector<Bridge> bridges;
    for (std::size_t a = 0; a < open.size(); ++a) {
        for (const double row : {open[a].row, open[a].row + 1}) {
            const Open first{row, {open[a].place.x - kGapPx, -1e300}, {}, 0, false};
            for (auto near = std::lower_bound(open.begin(), open.end(), first, is_before);
                 near != open.end() && near->row == row && near->place.x <= open[a].place.x + kGapPx; ++near) {
                const auto b = static_cast<std::size_t>(near - open.begin());
                const double gap_px = glm::distance(near->place, open[a].place);
                if ((row == open[a].row && b <= a) || gap_px > kGapPx ||
                    piece(near->end).drawn_as != piece(open[a].end).drawn_as)
                    continue;
                const double cosine = glm::dot(near->way, open[a].way);
                if (cosine < kMostCosine) bridges.push_back({near->is_short || open[a].is_short, cosine, gap_px, a, b});
            }
        }
    }
    std::sort(bridges.begin(), bridges.end(), [](const Bridge& p, const Bridge& q) {
        return std::tie(p.is_short, p.cosine, p.gap_px, p.a, p.b) < std::tie(q.is_short, q.cosine, q.gap_px, q.a, q.b);
    });
    // What runs on straight comes first, then ends that meet nothing else; and the same again with crumbs.
    const auto first_short = std::find_if(bridges.begin(), bridges.end(), [](const Bridge& p) { return p.is_short; });
    for (const std::span<const Bridge> some :
         {std::span<const Bridge>(bridges.begin(), first_short), std::span<const Bridge>(bridges)}) {
        for (const bool is_alone : {false, true}) {
            std::vector<std::size_t> choices(open.size(), 0);
            const auto is_open = [&](const Bridge& p) {
                return open[p.a].end != open[p.b].end && links_.is_free(open[p.a].end) && links_.is_free(open[p.b].end);
            };
            for (const Bridge& p : some) {
                if (!is_open(p)) continue;
                ++choices[p.a];
                ++choices[p.b];
            }
            for (const Bridge& p : some) {
                const bool fits = is_alone ? choices[p.a] == 1 && choices[p.b] == 1 : p.cosine < kStraight;
                if (fits && is_open(p)) links_.link(open[p.a].end, open[p.b].end);
            }
        }
    }
}

/// Makes a chain begin where dashes begin.
void PieceChains::put_in_order(Chain& chain) const {
    const glm::dvec2 first = place(chain.ends.front()), last = place(chain.ends.back() ^ 1);
    if (!chain.is_closed && nodes_[chain.ends.front()] != nodes_[chain.ends.back() ^ 1]) {
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

}  // namespace burin
