#include "lines/piece_chains.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace burin {
namespace {

/// Whether a place is higher on the screen or, at the same height, further left.
bool is_higher(glm::dvec2 a, glm::dvec2 b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }

void reverse(PieceChains::Chain& chain) {
    std::reverse(chain.ends.begin(), chain.ends.end());
    for (std::uint32_t& end : chain.ends) end ^= 1;
}

}  // namespace

PieceChains::PieceChains(std::vector<const LinePiece*> pieces) : pieces_(std::move(pieces)), links_(pieces_.size()) {
    link();
}

std::vector<PieceChains::Chain> PieceChains::all() const {
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

void PieceChains::link() {
    std::vector<std::uint32_t> ends(2 * pieces_.size());
    for (std::uint32_t i = 0; i < ends.size(); ++i) ends[i] = i;
    std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
        const glm::dvec2 p = place(a), q = place(b);
        return p != q ? is_higher(p, q) : a < b;
    });
    for (std::size_t i = 0; i < ends.size();) {
        std::size_t next = i + 1;
        while (next < ends.size() && place(ends[next]) == place(ends[i])) ++next;
        link_node({ends.begin() + static_cast<std::ptrdiff_t>(i), ends.begin() + static_cast<std::ptrdiff_t>(next)});
        i = next;
    }
}

void PieceChains::link_node(std::vector<std::uint32_t> ends) {
    link_pairs(ends, [&](std::uint32_t end) { return piece(end).line; });
    std::erase_if(ends, [&](std::uint32_t end) { return !links_.is_free(end); });
    if (ends.size() != 2) link_pairs(ends, [&](std::uint32_t end) { return piece(end).drawn_as; });
    if (ends.size() == 2) link_pairs(ends, [](std::uint32_t) { return 0; });
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

/// Makes a chain begin where dashes begin.
void PieceChains::put_in_order(Chain& chain) const {
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

}  // namespace burin
