#include "shading/ink/found_lines.h"

#include <algorithm>

#include "base/parallel.h"
#include "lines/line_dashes.h"
#include "lines/run_ends.h"

namespace burin {

void find_sides_and_runs(const LineDrawing& drawing, const SurfaceSet& surfaces, double cos_crease_angle,
                         const FoundLinesNeeds& needs, std::span<const MeshCurvature* const> curvatures, int threads,
                         FoundLines& lines) {
    const LineDrawing::Lists visible = drawing.visible();
    // What hidden lines need is not done to visible ones, which are the same whether hidden ones are drawn or not.
    const bool has_any_chains = needs.chains || needs.hidden_chains;
    lines.runs =
        runs_of(visible, drawing.behind(), features_of(drawing.whole_lines()), surfaces,
                {needs.chains, {needs.apart_px, needs.chains}}, {has_any_chains, {needs.apart_px, has_any_chains}});
    for (const std::span<const LinePiece> list : visible) {
        for (const LinePiece& piece : list) {
            if (!piece.is_drawn && piece.occludes) lines.boundaries.push_back(piece);
        }
    }
    const PixelRect picture{0, 0, lines.width_px, lines.height_px};
    if (has_any_chains) leave_out_hairs(lines.runs, picture, !needs.chains);
    if (has_any_chains && needs.ends)
        find_run_ends(lines.runs, lines.boundaries, surfaces.projection, picture, threads, !needs.chains);
    lines.has_chains = needs.chains;
    lines.has_hidden_chains = has_any_chains;
    lines.has_normals = needs.normals;
    lines.sides.resize(lines.runs.pieces.size());
    lines.surface = needs.surface;
    const std::size_t columns = needs.surface.column_count();
    lines.surface_values.resize(2 * columns * lines.sides.size());
    const LineSidesFinder finder(surfaces, cos_crease_angle);
    const SurfaceValues values(surfaces, needs.surface, curvatures);
    constexpr std::size_t kChunk = 256;
    parallel_for((lines.sides.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
        for (std::size_t i = chunk * kChunk; i < std::min(lines.sides.size(), (chunk + 1) * kChunk); ++i) {
            FrontFace front;
            const LinePiece& piece = lines.runs.pieces[i].piece;
            lines.sides[i] = finder.sides_of(piece, needs.normals, columns > 0 ? &front : nullptr);
            if (columns > 0)
                values.write(piece, front, std::span(lines.surface_values).subspan(2 * columns * i, 2 * columns));
        }
    });
}

}  // namespace burin
