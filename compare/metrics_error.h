#pragma once

#include <cstddef>
#include <optional>

#include "compare/plane.h"

// Line coverage of a result is compared with the truth's, pixel by pixel.

namespace burin {

/// How far the line coverage of a result is from the truth, over the *line pixels*: those where
/// either of the two has a coverage above 0. The empty paper around them would only dilute.
struct CoverageError {
    std::size_t line_pixels = 0;
    double rmse = 0;
    double max_error = 0;
    /// 20 log10(1 / rmse). Nothing if the pictures are equal.
    std::optional<double> psnr_db;
    /// PSNR without the worst 2 % of the line pixels.
    std::optional<double> psnr98_db;
};

/// Compares the coverage of two pictures. Nothing if there is no line pixel at all.
std::optional<CoverageError> coverage_error(const Plane& result, const Plane& truth);

/// Lines that one of the two pictures has, and the other has nothing like it nearby, as a share of
/// the truth's coverage.
struct LineMass {
    double missed = 0;    ///< coverage of the truth with no line of the result within a pixel
    double invented = 0;  ///< coverage of the result with no line of the truth within a pixel
};

/// Coverage below which a pixel does not count as having a line: the foot of a soft profile is no
/// line.
constexpr float kLineFloor = 1.0f / 32;

/// "Within a pixel" is the pixel itself or one of its eight neighbours. Nothing if the truth is
/// empty.
std::optional<LineMass> line_mass(const Plane& result, const Plane& truth);

/// Number of different coverages in a picture, 0 not counted.
std::size_t coverage_levels(const Plane& result);

}  // namespace burin
