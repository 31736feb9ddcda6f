#pragma once

#include <vector>

#include "cli/arguments.h"
#include "cli/vector_output.h"
#include "methods/method_table.h"
#include "render/frame.h"
#include "scene/standard_views.h"

namespace burin {

/// What draws the views of --views on one sheet.
struct SheetViews {
    Scene& scene;
    const Arguments& arguments;
    const std::vector<ViewOnSheet>& views;
    const PreparedScene* prepared = nullptr;

    /// As pixels: each view into its cell of a whole film.
    RenderStats draw(const Method& method, const RunOptions& run, Film& film) const;
    /// As paths. `film`: for surfaces, which nothing is read of.
    RenderStats draw_as_paths(const RunOptions& run, Film& film, VectorDrawing& drawing, VectorStats& stats) const;
};

}  // namespace burin
