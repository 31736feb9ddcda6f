#include "methods/abuffer/line_chains.h"

#include <algorithm>

namespace burin {
namespace {

constexpr std::uint32_t kNoEnd = 0xFFFFFFFFu;

/// End 2i is the start of line i, end 2i + 1 its end: the end of another line that each one leads to.
std::vector<std::uint32_t> link_ends(std::span<const LayerLine> lines) {
    struct NodeEnd {
        std::uint64_t node;
        std::uint32_t end;
        bool operator<(const NodeEnd& o) const { return node != o.node ? node < o.node : end < o.end; }
    };
    std::vector<NodeEnd> ends;
    ends.reserve(2 * lines.size());
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
        for (std::uint32_t k = 0; k < 2; ++k) {
            if (lines[i].nodes[k] != LayerLine::kNoNode) ends.push_back({lines[i].nodes[k], 2 * i + k});
        }
    }
    std::sort(ends.begin(), ends.end());
    std::vector<std::uint32_t> link(2 * lines.size(), kNoEnd);
    for (std::size_t i = 0; i < ends.size();) {
        std::size_t next = i + 1;
        while (next < ends.size() && ends[next].node == ends[i].node) ++next;
        if (next == i + 2) {
            link[ends[i].end] = ends[i + 1].end;
            link[ends[i + 1].end] = ends[i].end;
        }
        i = next;
    }
    return link;
}

}  // namespace

std::vector<std::array<double, 2>> positions_along_chains(std::span<const LayerLine> lines) {
    const std::vector<std::uint32_t> link = link_ends(lines);
    std::vector<std::array<double, 2>> positions(lines.size());
    std::vector<bool> done(lines.size(), false);
    const auto follow = [&](std::uint32_t end) {
        double at = 0;
        while (end != kNoEnd && !done[end / 2]) {
            const std::uint32_t line = end / 2, side = end % 2;
            done[line] = true;
            positions[line][side] = at;
            at += lines[line].length_px();
            positions[line][1 - side] = at;
            end = link[2 * line + 1 - side];
        }
    };
    for (std::uint32_t end = 0; end < link.size(); ++end) {  // open chains, from their first end
        if (link[end] == kNoEnd) follow(end);
    }
    for (std::uint32_t end = 0; end < link.size(); end += 2) follow(end);  // the rest are loops
    return positions;
}

}  // namespace burin
