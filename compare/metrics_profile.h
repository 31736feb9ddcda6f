#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "compare/plane.h"

// The profile of a line is measured across it, where the true line is known.

namespace burin {

/// The centre line of a true stroke, in pixels.
struct Segment {
    glm::dvec2 a{0.0}, b{0.0};

    double length() const { return glm::distance(a, b); }
    glm::dvec2 along() const { return (b - a) / length(); }
    glm::dvec2 across() const {
        const glm::dvec2 d = along();
        return {-d.y, d.x};
    }
};

/// How much of each end of a segment is left out: strokes may end in any way. Pixels.
constexpr double kEndMargin_px = 3;

/// Area that a straight stroke of width `width_px`, infinitely long, has in a pixel whose centre is
/// `u` beside the stroke's centre line with the unit normal `across`.
double band_coverage(double u, glm::dvec2 across, double width_px);

constexpr double kWidthStep_px = 0.25;  ///< along a stroke, from one width to the next

/// The integral of coverage across the stroke (its *width*), every kWidthStep_px along it.
/// `reach_px` is how far to either side it goes.
std::vector<double> widths_along(const Plane& coverage, const Segment& segment, double reach_px);

/// Running means over `window_px` of such widths. An aliased line's stairs are at most sqrt(2) pixels
/// long: over 1.5 pixels they are even, and gaps are not.
std::vector<double> smoothed_along(std::span<const double> widths, double window_px);

double mean_of(std::span<const double> values);
double deviation_of(std::span<const double> values);  ///< standard deviation of all the values
double median_of(std::vector<double> values);

/// A pixel beside a stroke: how far its centre is from the centre line, and its coverage.
struct ProfilePoint {
    double u = 0;
    double coverage = 0;
    double ideal = 0;  ///< band_coverage() there, for the width given
};

/// All pixels whose centres are within `reach_px` of the segment, its ends left out.
std::vector<ProfilePoint> profile_points(const Plane& coverage, const Segment& segment, double reach_px,
                                         double width_px);

/// The *line spread function*: mean coverage in bins of a quarter pixel from -reach_px to reach_px.
struct LineSpread {
    static constexpr double kBin_px = 0.25;
    double first_u = 0;  ///< middle of the first bin
    std::vector<double> mean;
};
LineSpread line_spread(std::span<const ProfilePoint> points, double reach_px);

/// How much pixels at the same distance from the line differ: the deviation of the coverages in a
/// bin from their straight-line fit, root mean square over all pixels. 0 for a profile that is the
/// same in every direction and phase; the number that shows aliasing. Nothing without points.
std::optional<double> within_bin_deviation(std::span<const ProfilePoint> points, double reach_px);

/// The modulation transfer function of a line: |Fourier transform| of its spread, 1 at frequency 0.
struct Modulation {
    static constexpr double kStep = 1.0 / 32;  ///< cycles per pixel from one value to the next
    std::vector<double> values;                ///< from 0 to 2 cycles per pixel
    std::optional<double> mtf50;               ///< cycles per pixel where it falls to one half
    double energy_above_nyquist = 0;           ///< share of the energy beyond .5 cycles per pixel
};
/// The modulation of a line spread; nothing if it has no coverage.
std::optional<Modulation> modulation(const LineSpread& spread);

}  // namespace burin
