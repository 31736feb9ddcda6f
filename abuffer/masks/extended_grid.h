#pragma once

#include <glm/glm.hpp>

// Extended masks of all pixels are windows of one grid of samples.

namespace burin {

/// Where the samples of extended masks lie.
///
/// A mask of `side` x `side` samples covers a pixel's own samples, `samples_per_pixel` to each axis,
/// in the middle of an apron of `apron` samples: side = samples_per_pixel + 2 * apron. All masks of
/// an image are windows of one grid of samples; sample (column, row) of the grid lies at
/// ((column + 1/2) / samples_per_pixel, (row + 1/2) / samples_per_pixel) pixels.
struct ExtendedGrid {
    int side = 8;
    int apron = 2;

    constexpr int samples_per_pixel() const { return side - 2 * apron; }
    /// Grid column (or row) of the mask's first column (or row), for a pixel's x (or y).
    constexpr int first_sample(int pixel) const { return pixel * samples_per_pixel() - apron; }

    /// Position of a mask's sample, in pixels. A sample exactly on an edge belongs to the polygon
    /// below or to the right of it, so its place is taken a trifle further there.
    glm::dvec2 position(int pixel_x, int pixel_y, int row, int column) const {
        const double s = samples_per_pixel();
        constexpr double kTrifleX = 0x1p-14, kTrifleY = 0x1p-20;
        return {(first_sample(pixel_x) + column + 0.5) / s + kTrifleX,
                (first_sample(pixel_y) + row + 0.5) / s + kTrifleY};
    }
    /// Width of a stroke along an axis-parallel boundary, one apron on either side. Pixels.
    constexpr double stroke_width_px() const { return 2.0 * apron / samples_per_pixel(); }
};

/// The grid whose strokes are closest to a width (in ratio), for masks of side x side samples:
/// 2 n / (side - 2 n) pixels for an apron of n.
constexpr ExtendedGrid grid_for_width(int side, double width_px) {
    ExtendedGrid best{side, 1};
    double best_ratio = 1e300;
    for (int apron = 1; 2 * apron < side; ++apron) {
        const ExtendedGrid grid{side, apron};
        const double width = grid.stroke_width_px();
        const double ratio = width > width_px ? width / width_px : width_px / width;
        if (ratio < best_ratio) {
            best = grid;
            best_ratio = ratio;
        }
    }
    return best;
}

}  // namespace burin
