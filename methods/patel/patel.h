#pragma once

#include "abuffer/coverage_mask.h"
#include "abuffer/masks/extended_grid.h"
#include "render/method.h"

// Method `patel` draws lines by extended masks alone, as its author describes it.

namespace burin {

/// Mayur Patel's hidden-line A-buffer of 2000, to the letter (see PatelTile). The grid of samples
/// follows from the scene's mask size and the line width closest to the one asked for.
RenderStats render_patel(const Frame& frame, const RunOptions& options, Film& film);

/// The width that method patel draws when asked for `width_px`: 2n / (side - 2n) for some n.
double patel_line_width_px(int mask_bits, double width_px);

/// Calls function(Mask{}, grid) with the mask type and the grid that the scene asks for.
template <typename Function>
auto with_patel_grid(const Scene& scene, const Function& function) {
    const double width = scene.lines.style.width_px;
    switch (scene.patel.mask_bits) {
        case 16:
            return function(std::uint16_t{}, grid_for_width(4, width));
        case 256:
            return function(Mask256{}, grid_for_width(16, width));
        default:
            return function(std::uint64_t{}, grid_for_width(8, width));
    }
}

}  // namespace burin
