#pragma once

#include <string>
#include <vector>

#include "base/json_writer.h"
#include "cli/arguments.h"
#include "output/film_files.h"
#include "output/paths/make_paths.h"
#include "output/paths/surface_grid.h"
#include "render/frame.h"

namespace burin {

/// Codes of sRGB by which a colour that is hardly seen differs from the paper's.
constexpr int kHardlySeen = 48;

/// Draws lines as paths, as the frame's style sheet says. Of the frame's surfaces it reads nothing. `notes`: gets what
/// users should know.
VectorDrawing draw_paths(const FoundLines& lines, const Frame& frame, const Arguments& arguments, VectorStats& stats,
                         std::vector<std::string>& notes, Progress* progress = nullptr);

/// Whether a vector file has the surfaces of a scene as filled regions: where they have a look, and the page is no one
/// of lines alone.
bool draws_regions(const Scene& scene, const Arguments& arguments);

/// Adds what is seen of surfaces to a drawing, below its lines. `notes`: gets what users should know.
void draw_regions(const SurfaceGrid& seen, VectorDrawing& drawing, VectorStats& stats, std::vector<std::string>& notes);

/// Gives a drawing its paper, and makes of it what the page of the arguments asks for. `notes`: gets
/// what users should know.
void finish_drawing(const PictureSettings& picture, const Arguments& arguments, VectorDrawing& drawing,
                    VectorStats& stats, std::vector<std::string>& notes);

/// Writes a drawing to its file. Throws InputError.
void write_vector(const VectorDrawing& drawing, const Arguments& arguments, const OutputOptions& output);

/// Adds the times of making paths to the stages, and counts behind these.
void add_stages(JsonWriter& json, const VectorStats& stats);
void add_counts(JsonWriter& json, const VectorStats& stats);

}  // namespace burin
