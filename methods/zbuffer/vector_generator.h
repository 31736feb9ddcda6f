#pragma once

#include <cmath>

#include "methods/zbuffer/fill_raster.h"

// Vectors are drawn as graphics hardware draws aliased lines.

namespace burin {

/// How many pixels wide an aliased line of this width is.
inline int aliased_width_px(double width_px) {
    return width_px > 1.5 ? static_cast<int>(std::lround(std::min(width_px, 1024.0))) : 1;
}

/// Calls visit(x, y, z) for the pixels of `rect` on an aliased line, as hardware draws vectors
/// (DDA): one pixel in each column of a line that is wider than high, or in each row of another
/// (its *major* axis), for those whose centres lie from the first end on and before the second. A
/// wide line is repeated across the major axis, as OpenGL does.
///
/// z is that of the line where it crosses the middle of the column; it is *not* moved to the centre
/// of the pixel. This difference to fills is what makes lines stitched (Herrell, Baldwin, Wilcox
/// 1995).
///
/// Where the line runs exactly between two pixels the one ahead on the minor axis is taken when
/// drawn towards larger major coordinates, and the one before when drawn back: ties depend on the
/// direction.
template <typename Visit>
void for_each_vector_pixel(const ProjectedCorner& from, const ProjectedCorner& to, int width_px, PixelRect rect,
                           const Visit& visit) {
    const glm::dvec2 d = to.pixel - from.pixel;
    const bool along_x = std::abs(d.x) >= std::abs(d.y);
    const int major = along_x ? 0 : 1, minor = 1 - major;
    const double length = d[major];
    if (length == 0) return;
    const bool forwards = length > 0;
    const int low = along_x ? rect.x0 : rect.y0, high = along_x ? rect.x1 : rect.y1;
    const int minor_low = along_x ? rect.y0 : rect.x0, minor_high = along_x ? rect.y1 : rect.x1;

    // Centres in [from, to), in the direction of drawing.
    const auto first_after = [&](double position) {  // the first centre strictly behind
        return static_cast<int>(std::clamp(std::floor(position + 0.5), double(low), double(high)));
    };
    int begin = forwards ? first_centre_from(from.pixel[major], low, high) : first_after(to.pixel[major]);
    int end = forwards ? first_centre_from(to.pixel[major], low, high) : first_after(from.pixel[major]);

    // Only where the line is within the rectangle; a margin for rounding and for its width.
    const double slope = d[minor] / length;
    if (slope != 0) {
        const double margin = 0.5 * width_px + 2;
        double a = from.pixel[major] + (minor_low - margin - from.pixel[minor]) / slope;
        double b = from.pixel[major] + (minor_high + margin - from.pixel[minor]) / slope;
        if (b < a) std::swap(a, b);
        begin = std::max(begin, first_centre_from(a, low, high));
        end = std::min(end, first_centre_from(b, low, high));
    }

    for (int step = begin; step < end; ++step) {
        const double t = (step + 0.5 - from.pixel[major]) / length;
        const double position = from.pixel[minor] + t * d[minor] - 0.5 * (width_px - 1);
        const double row = forwards ? std::floor(position) : std::ceil(position) - 1;
        if (!(row >= minor_low - width_px && row < minor_high)) continue;
        const double z = from.z + t * (to.z - from.z);
        const int first = std::max(static_cast<int>(row), minor_low);
        const int last = std::min(static_cast<int>(row) + width_px, minor_high);
        for (int at = first; at < last; ++at) {
            if (along_x) {
                visit(step, at, z);
            } else {
                visit(at, step, z);
            }
        }
    }
}

}  // namespace burin
