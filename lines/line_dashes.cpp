#include "lines/line_dashes.h"

#include <algorithm>
#include <iterator>

#include "base/interrupt.h"
#include "lines/chains.h"

namespace burin {

bool is_feature(const WholeLine& line) {
    return line.classes.empty() || !line.classes.without(kClassesOfAView).empty();
}

std::vector<WholeLine> features_of(std::span<const WholeLine> lines) {
    std::vector<WholeLine> features;
    std::copy_if(lines.begin(), lines.end(), std::back_inserter(features), [](const WholeLine& line) {
        throw_if_interrupted();
        return line.is_edge() && is_feature(line);
    });
    return features;
}

LineDashes::LineDashes(std::span<const WholeLine> lines, const SurfaceSet& surfaces, double period_px,
                       SharedDashes& shared)
    : piece_of_line_(lines.size()) {
    const LineChains chains = chains_of(lines, surfaces, period_px);
    std::vector<DashPiece> pieces;
    pieces.reserve(lines.size());
    for (const std::uint32_t line : chains.lines) {
        piece_of_line_[line] = static_cast<std::uint32_t>(pieces.size());
        const auto& [at_from, at_to] = chains.positions[line];
        pieces.push_back({to_pixels(lines[line].from), to_pixels(lines[line].to), at_from, at_to});
    }
    places_ = shared.lay_out(std::move(pieces), chains.chain_ends);
}

}  // namespace burin
