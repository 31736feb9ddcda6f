#include "methods/abuffer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "abuffer/edges/intersecting_pairs.h"
#include "abuffer/edges/intersection_lines.h"
#include "abuffer/line_finder.h"
#include "base/limit_error.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "lines/sharp_edges.h"
#include "render/line_layout.h"
#include "render/line_shading.h"
#include "render/mattes.h"
#include "shading/ink/ink_lines.h"
#include "strokes/ink_printer.h"
#include "strokes/row_printer.h"

namespace burin {
namespace {

/// The criteria of the scene's lines, but that a crease begins where it begins to fade in.
LineCriteria fading_criteria_of(const LineSettings& lines) {
    LineCriteria criteria = criteria_of(lines);
    criteria.cos_crease_angle = std::cos(glm::radians(lines.crease_fade().from_deg));
    return criteria;
}

/// What a piece of a line takes with a style sheet, as part of a run with all that is known there and as ink: more than
/// with any sheet that the program brings along (docs/performance/memory.md).
constexpr std::uint64_t kBytesPerInkedPiece = 1000;

/// Lines with a style sheet are all kept, with their ink, until they are drawn. How many there are is known only now.
void check_ink_fits(const LineDrawing& drawing, std::uint64_t cap_bytes) {
    if (cap_bytes == 0) return;
    std::uint64_t pieces = 0;
    for (const LineDrawing::Lists& lists : {drawing.visible(), drawing.behind()}) {
        for (const std::span<const LinePiece> list : lists) pieces += list.size();
    }
    const std::uint64_t least = pieces * kBytesPerInkedPiece;
    if (least > cap_bytes) {
        throw LimitError("this picture", (least >> 20) + 1, "draw fewer lines with its style sheet");
    }
}

Frame with_fading_creases(Frame frame) {
    frame.criteria = fading_criteria_of(frame.scene->lines);
    return frame;
}

}  // namespace

PreparedScene prepare_for_abuffer(const Scene& scene, int threads, bool saves_memory) {
    PreparedScene prepared;
    prepare_changes_for_abuffer(scene, {}, threads, saves_memory, prepared);
    return prepared;
}

std::size_t prepare_changes_for_abuffer(const Scene& scene, const std::vector<std::size_t>& changed_meshes, int threads,
                                        bool saves_memory, PreparedScene& prepared) {
    const LineCriteria criteria = fading_criteria_of(scene.lines);
    std::vector<std::size_t> meshes;
    for (const std::size_t i : changed_meshes) {
        if (i < std::min(prepared.sharp_edges.size(), scene.meshes.size())) meshes.push_back(i);
    }
    for (std::size_t i = prepared.sharp_edges.size(); i < scene.meshes.size(); ++i) meshes.push_back(i);
    prepared.sharp_edges.resize(scene.meshes.size());
    if (!meshes.empty()) prepared.curvatures = std::make_shared<SceneCurvatures>();
    // Threads share a few large meshes, or take one each of many.
    const bool has_many = meshes.size() >= 4 * static_cast<std::size_t>(resolve_thread_count(threads));
    parallel_for(meshes.size(), has_many ? threads : 1, [&](std::size_t i, int) {
        prepared.sharp_edges[meshes[i]] = find_sharp_edges(scene.meshes[meshes[i]], criteria, has_many ? 1 : threads);
    });
    prepared.intersecting_pairs.reset();
    const bool behind = draws_hidden_lines(scene) || has_transparent_surfaces(scene);
    if (!saves_memory && behind && IntersectionLines::are_wanted(scene.lines.classes)) {
        prepared.intersecting_pairs = find_intersecting_pairs(scene, best_kernels(), threads);
    }
    return meshes.size();
}

/// Bands are not finished early where there are hidden lines, for these are drawn below visible ones.
bool abuffer_finishes_in_bands(const Frame& frame) { return !frame.needs.behind() && frame.needs.rows_stand_alone(); }

RenderStats render_abuffer(const Frame& given, const RunOptions& options, Film& film) {
    const Frame frame = with_fading_creases(given);
    if (film.mattes() != nullptr) film.mattes()->clear();
    RenderStats stats;
    LineDrawing drawing;
    Stopwatch watch;
    if (frame.sheet) {
        const FoundLines lines = find_styled_lines(given, options, film, stats);
        watch.lap();
        draw_found_lines(frame, lines, stats.threads, film, stats.notes);
        stats.lines_s += watch.lap();
    } else if (frame.needs.rows_stand_alone()) {
        RowPrinter printer(frame, options, drawing, film);
        find_lines(frame, options, film, drawing, &printer, stats);
        watch.lap();
        const double write_s = printer.draw_rows(RowPrinter::kAllRows);
        stats.write_s += write_s;
        stats.lines_s += watch.lap() - write_s;
    } else {
        find_lines(frame, options, film, drawing, nullptr, stats);
        watch.lap();
        drawing = laid_out_if_needed(std::move(drawing), frame, stats.threads);
        RowPrinter(frame, options, drawing, film).draw_rows(RowPrinter::kAllRows);
        stats.lines_s += watch.lap();
    }
    film.end_picture();
    return stats;
}

FoundLines find_styled_lines(const Frame& given, const RunOptions& options, Film& film, RenderStats& stats) {
    const Frame frame = with_fading_creases(given);
    LineDrawing drawing;
    find_lines(frame, options, film, drawing, nullptr, stats);
    check_ink_fits(drawing, options.memory_bytes);
    Stopwatch watch;
    FoundLines lines = found_lines(std::move(drawing), frame, stats.threads);
    stats.lines_s += watch.lap();
    if (options.found_lines) options.found_lines(lines, film);
    return lines;
}

void draw_found_lines(const Frame& frame, const FoundLines& lines, int threads, Film& film,
                      std::vector<std::string>& notes) {
    InkWishes wishes;
    wishes.origins = film.mattes() != nullptr;
    InkedLines inked = ink_lines(lines, *frame.sheet, threads, notes, wishes);
    inked.filter = frame.scene->lines.style.filter;
    draw_ink(frame, inked, threads, film);
}

SliceCount slices_of(const Frame& frame, std::uint64_t cap_bytes, int threads) {
    return count_slices(with_fading_creases(frame), cap_bytes, threads);
}

LineDrawing find_drawing(const Frame& frame, const RunOptions& options, Film& film) {
    RenderStats stats;
    LineDrawing drawing;
    find_lines(with_fading_creases(frame), options, film, drawing, nullptr, stats);
    return drawing;
}

LineDrawing laid_out_if_needed(LineDrawing found, const Frame& frame, int threads) {
    if (frame.needs.rows_stand_alone()) return found;
    return laid_out(std::move(found), with_fading_creases(frame), threads);
}

FoundLines lines_for_sheet(LineDrawing found, const Frame& frame, int threads) {
    return found_lines(std::move(found), with_fading_creases(frame), threads);
}

void draw_lines(const Frame& frame, const LineDrawing& drawing, const RunOptions& options, Film& film) {
    RowPrinter(frame, options, drawing, film).draw_rows(RowPrinter::kAllRows);
    film.end_picture();
}

}  // namespace burin
