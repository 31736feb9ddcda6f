#include "abuffer/fine/heaps.h"

#include <algorithm>
#include <vector>

#include "abuffer/fine/fine_cells.h"
#include "lines/line_piece.h"

namespace burin {
namespace {

/// The most pairs of an edge and a triangle near it in one block: if there are more, as in a heap of very many
/// surfaces, lines are left to the samples, for time would grow with the square.
constexpr std::size_t kMostLooks = std::size_t{1} << 22;
/// Where more than kManyInCell triangles lie over each other, cells do not tell them apart; each pair is looked at more
/// closely, and far fewer are too many: meshes of small triangles and piles of a few hundred large ones stay far below.
constexpr std::size_t kManyInCell = 256, kMostLooksInHeap = std::size_t{1} << 18;
/// Tiles with no more parts of edges are quick in any case.
constexpr std::size_t kFewParts = std::size_t{1} << 12;

}  // namespace

bool are_few(std::size_t lines, std::size_t triangles_per_line) {
    return lines * triangles_per_line <= (triangles_per_line > kManyInCell ? kMostLooksInHeap : kMostLooks);
}

bool may_have_heaps(const TriangleBins& bins, std::size_t tile, std::span<const FinePart> parts) {
    if (parts.size() <= kFewParts) return false;
    std::size_t triangles = 0;
    for (const auto& runs : {bins.runs_in(tile), bins.thin_runs_in(tile)}) {
        for (const TriangleRun& run : runs) triangles += run.count;
    }
    const PixelRect rect = bins.tile(tile);
    // Blocks begin half a sample later, so that there may be parts in one before the tile's first.
    const int first_x = rect.x0 / kMergeBlockPx - 1, columns = rect.width() / kMergeBlockPx + 2;
    const int first_y = rect.y0 / kMergeBlockPx - 1, rows = rect.height() / kMergeBlockPx + 2;
    std::vector<std::size_t> in_block(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (const FinePart& part : parts) {
        const int x = std::clamp(part.block_x - first_x, 0, columns - 1),
                  y = std::clamp(part.block_y - first_y, 0, rows - 1);
        ++in_block[static_cast<std::size_t>(y * columns + x)];
    }
    const std::size_t most = *std::max_element(in_block.begin(), in_block.end());
    return !are_few(most, FineCells::least_per_cell(triangles * most / parts.size()));
}

}  // namespace burin
