#pragma once

#include <string>
#include <vector>

#include "output/output_format.h"
#include "output/paths/vector_drawing.h"

namespace burin {

/// How vector files are written, whatever their format.
struct VectorFileOptions {
    bool names_paths = true;       ///< SVG: ids and data-*
    bool is_plain_pdf = false;     ///< PDF/A-1b
    double tolerance_px = 0.02;    ///< DXF: how far lines may be from curves
    std::string fingerprint = {};  ///< of what the drawing is made from; empty: the file has none
};

/// A drawing as a file of one of the formats that is_vector() names. `notes`: gets what the format cannot say.
std::string vector_file_of(const VectorDrawing& drawing, OutputFormat format, const VectorFileOptions& options,
                           std::vector<std::string>& notes);

}  // namespace burin
