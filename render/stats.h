#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace burin {

/// Wall seconds per stage, counts and notes of one render.
struct RenderStats {
    double prepare_s = 0;  ///< transforming, clipping, sorting surfaces to tiles
    double raster_s = 0;   ///< coverage masks
    double resolve_s = 0;  ///< visibility
    double lines_s = 0;
    double shade_s = 0;
    double write_s = 0;  ///< in RunOptions::finished_band
    std::uint64_t triangles = 0;
    std::uint64_t fragments = 0;
    int threads = 1;
    std::vector<std::string> notes;  ///< what the user should know of the picture
};

/// Adds the stages and counts of another part of the same picture; each note stands once.
void add(const RenderStats& more, RenderStats& sum);

}  // namespace burin
