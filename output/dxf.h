#pragma once

#include <string>
#include <vector>

#include "output/paths/vector_drawing.h"

namespace burin {

struct DxfOptions {
    double tolerance_px = 0.02;  ///< how far lines may be from curves
    std::string fingerprint = {};
};

/// Writes a DXF file of release 12 (ASCII): polylines in mm, y upwards, on layers VISIBLE_CREASE, HIDDEN_SILHOUETTE and
/// so on, or of objects. `notes`: gets what the file cannot say.
std::string dxf_of(const VectorDrawing& drawing, const DxfOptions& options, std::vector<std::string>& notes);

/// The number (1 to 255) of AutoCAD's colour index that is nearest to a colour of sRGB codes. Black is 7, which is
/// black on paper and white on black screens.
int nearest_color_index(glm::ivec3 codes);

}  // namespace burin
