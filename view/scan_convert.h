#pragma once

#include <cstdint>
#include <span>

#include "kernels/scan_edge.h"
#include "view/screen_polygon.h"

// A polygon on the screen becomes the samples it covers, row by row, so that neighbours share none and miss none.

namespace burin {

/// Samples [begin, end) of one row.
struct SampleSpan {
    int begin = 0;
    int end = 0;
};

/// Finds the samples that a polygon covers, row by row.
///
/// The samples form one grid over the whole image, `samples_per_pixel` to a pixel along each axis:
/// sample (column c, row r) lies at ((c + 1/2) / s, (r + 1/2) / s) pixels. All arithmetic is exact.
///
/// A sample is covered if it lies inside; on the boundary it belongs to the polygon below or to the
/// right of it (the top-left rule). So polygons that share an edge cover each sample along it once.
class ScanConverter {
  public:
    ScanConverter(const ScreenPolygon& polygon, int samples_per_pixel);

    int first_row() const { return first_row_; }
    int end_row() const { return end_row_; }
    int first_column() const { return first_column_; }
    int end_column() const { return end_column_; }

    /// The covered samples of a row in [first_row(), end_row()).
    SampleSpan span(int row) const;

    /// Columns that hold all covered samples of rows [first, end), and perhaps one more on either side.
    SampleSpan columns_in(int first, int end) const;

    /// The edges that are not horizontal.
    std::span<const ScanEdge> edges() const { return {edges_.data(), edge_count_}; }
    /// Whether double precision holds all that span() computes: not for polygons thousands of pixels large or away.
    bool fits_doubles() const { return fits_doubles_; }

  private:
    std::size_t edge_count_ = 0;
    std::array<ScanEdge, ScreenPolygon::kMaxCorners> edges_;
    bool fits_doubles_ = true;
    int first_row_ = 0, end_row_ = 0, first_column_ = 0, end_column_ = 0;
};

}  // namespace burin
