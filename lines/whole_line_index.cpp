#include "lines/whole_line_index.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"

namespace burin {

WholeLineIndex::WholeLineIndex(std::span<const WholeLine> lines) : lines_(lines) {
    for (std::uint32_t i = 0; i < lines.size(); ++i) numbers_.push_back({lines[i].id, i});
    std::sort(numbers_.begin(), numbers_.end(), [](const auto& a, const auto& b) {
        throw_if_interrupted();
        return a < b;
    });
}

std::optional<std::uint32_t> WholeLineIndex::find(const LinePiece& piece) const {
    std::optional<std::uint32_t> nearest;
    double least = 0;
    const glm::dvec2 middle = 0.5 * (piece.from + piece.to);
    for (auto i = std::lower_bound(numbers_.begin(), numbers_.end(), std::pair(piece.line, 0u));
         i != numbers_.end() && i->first == piece.line; ++i) {
        const double beyond = std::abs(share_of(lines_[i->second], middle) - 0.5);
        if (nearest && beyond >= least) continue;
        nearest = i->second;
        least = beyond;
    }
    return nearest;
}

double WholeLineIndex::share_of(const WholeLine& line, glm::dvec2 place) {
    const glm::dvec2 from = to_pixels(line.from), along = to_pixels(line.to - line.from);
    return glm::dot(place - from, along) / glm::dot(along, along);
}

}  // namespace burin
