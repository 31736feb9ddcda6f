#include "shading/ink/line_chunks.h"

namespace burin {
namespace {

/// Stretches are evaluated in chunks of this many pieces, which do not depend on the number of threads.
constexpr std::size_t kChunkPieces = 512;

}  // namespace

SetMatches match_pieces(const LineColumns& lines, const CompiledSheet& sheet) {
    const LineRuns& runs = lines.runs();
    std::vector<LineClassSet> classes;
    std::vector<std::uint8_t> invisibility;
    std::vector<LineSample> middles;
    for (std::uint32_t r = 0; r < runs.runs.size(); ++r) {
        const LineRun& run = runs.runs[r];
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            classes.push_back(runs.pieces[i].piece.classes);
            invisibility.push_back(runs.pieces[i].piece.invisibility);
            middles.push_back({r, static_cast<std::uint32_t>(i), 0.5});
        }
    }
    SampleColumns columns;
    lines.fill(middles, sheet.select_variables(), {}, columns);
    return sheet.match({classes.size(), classes, invisibility, columns.columns()});
}

std::vector<LineChunk> chunks_of(const LineRuns& runs, const SetMatches& matches, std::size_t set_count) {
    std::vector<std::vector<LineStretch>> of_set(set_count);
    for (std::uint32_t r = 0; r < runs.runs.size(); ++r) {
        const LineRun& run = runs.runs[r];
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            for (const std::uint16_t set : matches.of(i)) {
                std::vector<LineStretch>& stretches = of_set[set];
                if (!stretches.empty() && stretches.back().run == r &&
                    stretches.back().first + stretches.back().count == i) {
                    ++stretches.back().count;
                } else {
                    stretches.push_back({r, i, 1});
                }
            }
        }
    }
    std::vector<LineChunk> chunks;
    for (std::uint32_t set = 0; set < set_count; ++set) {
        bool is_new = true;
        for (const LineStretch& stretch : of_set[set]) {
            if (is_new) chunks.push_back({set, {}, 0});
            chunks.back().stretches.push_back(stretch);
            chunks.back().pieces += stretch.count;
            is_new = chunks.back().pieces >= kChunkPieces;
        }
    }
    return chunks;
}

}  // namespace burin
