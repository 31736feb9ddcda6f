#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// Strokes are sampled at 16 x 32 places of a pixel, which are staggered so that no direction is in step with them.

namespace burin {

/// Where the samples of strokes lie: 16 rows of 32 in a pixel, in the middle of 1/16 x 1/32 of it each. Samples are
/// staggered around these places, or a stroke in step with them would be too wide or too narrow all along.
constexpr int kStrokeRows = 16, kStrokeColumns = 32;
/// How many masks of pixels behind those of a canvas are read, and written as they are. A multiple of eight.
constexpr std::size_t kRoomBehindMasks = 8;

/// Rows are shifted by less than half a column, and again so after this many of the picture: 8 pixels.
constexpr std::uint32_t kStrokeShiftRows = 128;

/// Columns further right, for each row of the picture. In a pixel, the 16 rows have 16 shifts, in an order with flat
/// spectrum (Chu 1972: n (n + 1) / 2 times an odd number); these and what is added in each pixel were chosen by search,
/// for the least sum over 128 rows that any slope of a stroke is in step with: 0.17 of all, where one order for all
/// pixels has 0.25 at least.
constexpr std::array<double, kStrokeShiftRows> make_stroke_row_shifts() {
    constexpr std::uint32_t kFactor[8] = {13, 1, 1, 13, 1, 5, 13, 5}, kAdded[8] = {30, 55, 42, 85, 40, 36, 99, 97};
    std::array<double, kStrokeShiftRows> shifts{};
    for (std::uint32_t row = 0; row < kStrokeShiftRows; ++row) {
        const std::uint32_t pixel = row / kStrokeRows, n = row % kStrokeRows;
        const std::uint32_t step = (8 * kFactor[pixel] * (n * (n + 1) / 2) + kAdded[pixel]) % kStrokeShiftRows;
        shifts[row] = (step + 0.5) / kStrokeShiftRows - 0.5;
    }
    return shifts;
}
constexpr std::array<double, kStrokeShiftRows> kStrokeRowShifts = make_stroke_row_shifts();

/// `row`: of the picture, 16 to a pixel.
constexpr double stroke_row_shift(std::int32_t row) {
    return kStrokeRowShifts[static_cast<std::uint32_t>(row) % kStrokeShiftRows];
}

/// Boundaries that are nearly horizontal, which cross less than a row in a pixel, are sampled at eight heights: each
/// set of every eighth column lies a part of a row further down. The order is van der Corput's sequence.
constexpr int kStrokeColumnSets = 8;
constexpr std::array<double, kStrokeColumnSets> kStrokeColumnShifts = {-7.0 / 16, 1.0 / 16, -3.0 / 16, 5.0 / 16,
                                                                       -5.0 / 16, 3.0 / 16, -1.0 / 16, 7.0 / 16};
/// The columns of a set, a bit each.
constexpr std::uint32_t columns_of_set(int set) { return 0x01010101u << set; }
/// Whether a boundary along (x, y) is nearly horizontal; a dot's is.
constexpr bool is_level(double x, double y) {
    const double across = x < 0 ? -x : x, down = y < 0 ? -y : y;
    return down * kStrokeRows <= across;
}

}  // namespace burin
