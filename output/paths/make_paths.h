#pragma once

#include <array>
#include <string>

#include "base/progress.h"
#include "output/paths/fit_path.h"
#include "output/paths/vector_drawing.h"
#include "shading/ink/found_lines.h"

namespace burin {

struct VectorOptions {
    FitBounds bounds;
    VectorGrouping grouping = VectorGrouping::line_class;
    PixelRect crop;  ///< of the picture: what is shown
    Progress* progress = nullptr;
};

/// Counts and times of making paths, for --stats.
struct VectorStats {
    std::size_t strokes = 0, chained = 0, paths = 0;
    std::size_t mean_inks = 0;  ///< strokes whose colour or opacity varies: their paths have the means
    double chain_s = 0, clean_s = 0, fit_s = 0;
    double regions_s = 0;                                ///< surfaces
    double merge_s = 0, sort_s = 0;                      ///< for machines
    std::optional<std::array<double, 2>> pen_travel_mm;  ///< between paths, before and after they were sorted
};

/// Makes a drawing of lines with their looks: joins strokes to the longest paths, takes away what is drawn twice, and
/// fits curves. `inked`: with origins. Of `lines` it reads what describes the picture, and the names of objects. Throws
/// UsageError if its pixels are not square.
VectorDrawing vector_drawing_of(InkedLines inked, const FoundLines& lines, const VectorOptions& options,
                                VectorStats& stats);

/// What users should know of paths that are not drawn as their strokes were; empty: nothing.
std::string note_on_means(const VectorStats& stats);

}  // namespace burin
