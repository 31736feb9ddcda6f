#pragma once

#include "abuffer/line_finder.h"
#include "lines/line_drawing.h"
#include "render/method.h"
#include "render/prepared.h"
#include "shading/ink/found_lines.h"

namespace burin {

/// The production A-buffer: the masks of all pixels decide where lines are, the mesh says exactly
/// where they run, and round strokes draw them at any width. It joins finding (folder abuffer) and drawing (strokes),
/// which do not know each other; lines pass from one to the other as a LineDrawing.
///
///  1. Vertices are projected and snapped once; triangles are sorted to tiles.
///  2. Per tile, the nearest surface at every sample of the image's grid is found: the resolved
///     extended masks of Patel (2000), each sample stored once instead of once per mask.
///  3. Neighbouring samples with different surfaces ask decide_line(); where it finds a line, it also
///     says where the line crosses between them. trace_cell() joins the crossings to pieces of lines.
///  4. Pixels are filled from their samples; then strokes are drawn over them.
RenderStats render_abuffer(const Frame& frame, const RunOptions& options, Film& film);

/// The same in steps, so that what is found can be drawn more than once: find_drawing() puts the surfaces into the film
/// and returns the lines, as they are found; laid_out_if_needed() makes of these what the frame's look draws;
/// draw_lines() draws that over the film.
LineDrawing find_drawing(const Frame& frame, const RunOptions& options, Film& film);
LineDrawing laid_out_if_needed(LineDrawing found, const Frame& frame, int threads);
/// For a frame with a style sheet: what shading reads of its lines. ink_lines() makes strokes of that, which draw_ink()
/// draws.
FoundLines lines_for_sheet(LineDrawing found, const Frame& frame, int threads);
/// Of the frame's surfaces it reads the projection alone.
void draw_lines(const Frame& frame, const LineDrawing& drawing, const RunOptions& options, Film& film);

/// Finds the lines of a frame with a style sheet, and all that shading reads of them: what render_abuffer() does before
/// it draws. The surfaces are in the film then.
FoundLines find_styled_lines(const Frame& frame, const RunOptions& options, Film& film, RenderStats& stats);

/// Draws lines as the frame's style sheet says, over its surfaces. Of the frame's surfaces it reads the projection
/// alone. `notes`: gets what users should know.
void draw_found_lines(const Frame& frame, const FoundLines& lines, int threads, Film& film,
                      std::vector<std::string>& notes);

/// In how many slices a frame is found under a cap for memory (0: none), and the least cap. Throws LimitError if the
/// cap is less than that.
SliceCount slices_of(const Frame& frame, std::uint64_t cap_bytes, int threads);

/// Whether the bands of a frame are finished one after the other. They are not where lines depend on others anywhere in
/// the picture.
bool abuffer_finishes_in_bands(const Frame& frame);

/// Makes what is the same for all frames of a scene; it must outlive these, and be made anew when meshes, objects or
/// line settings change. `saves_memory`: makes nothing that a frame rendered under RunOptions::memory_bytes has no use
/// for.
PreparedScene prepare_for_abuffer(const Scene& scene, int threads, bool saves_memory = false);

/// The same for a scene that something was made for before: objects may have moved since, and meshes of these numbers
/// are others. There may be more or fewer meshes behind the others; these count as changed. Returns for how many meshes
/// something was made.
std::size_t prepare_changes_for_abuffer(const Scene& scene, const std::vector<std::size_t>& changed_meshes, int threads,
                                        bool saves_memory, PreparedScene& prepared);

}  // namespace burin
