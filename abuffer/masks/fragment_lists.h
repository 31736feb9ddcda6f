#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abuffer/masks/extended_grid.h"
#include "abuffer/masks/mask_grid.h"
#include "view/scan_convert.h"

// Triangles leave a fragment in each pixel they touch, and the fragments of a tile are sorted to pixels.

namespace burin {

/// The part of one surface that falls on one pixel and its apron.
template <typename Mask>
struct Fragment {
    Mask mask;                  ///< the samples that the surface covers, seen alone
    std::uint32_t surface = 0;  ///< a number that the owner of the lists understands
};

/// The fragments of every pixel of a rectangle, in the order in which the surfaces were added:
/// Carpenter's A-buffer (1984) with Patel's extended masks.
template <typename Mask>
class FragmentLists {
  public:
    /// Empties the lists, for the pixels [x0, x1) x [y0, y1).
    void reset(const ExtendedGrid& grid, int x0, int y0, int x1, int y1) {
        grid_ = grid;
        x0_ = x0;
        y0_ = y0;
        width_ = x1 - x0;
        height_ = y1 - y0;
        unsorted_.clear();
        unsorted_pixel_.clear();
    }

    /// Adds a surface to every pixel whose samples it covers, the apron's included.
    void add(const ScanConverter& scan, std::uint32_t surface) {
        const int s = grid_.samples_per_pixel();
        const int n = grid_.apron;
        // Pixel y has the rows [s y - n, s y + s + n).
        const int first_y = std::max(y0_, floor_divide(scan.first_row() - s - n, s) + 1);
        const int end_y = std::min(y0_ + height_, floor_divide(scan.end_row() - 1 + n, s) + 1);
        const int first_x = std::max(x0_, floor_divide(scan.first_column() - s - n, s) + 1);
        const int end_x = std::min(x0_ + width_, floor_divide(scan.end_column() - 1 + n, s) + 1);
        for (int y = first_y; y < end_y; ++y) {
            SampleSpan spans[kSide];
            const int first_row = grid_.first_sample(y);
            for (int row = 0; row < kSide; ++row) {
                const int r = first_row + row;
                if (r >= scan.first_row() && r < scan.end_row()) spans[row] = scan.span(r);
            }
            for (int x = first_x; x < end_x; ++x) add_pixel(x, y, spans, surface);
        }
    }

    /// Sorts the fragments to their pixels. Call once, when all surfaces are added.
    void finish() {
        offsets_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
        for (const std::uint32_t pixel : unsorted_pixel_) ++offsets_[pixel + 1];
        for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
        fragments_.resize(unsorted_.size());
        next_ = offsets_;
        for (std::size_t i = 0; i < unsorted_.size(); ++i) {
            fragments_[next_[unsorted_pixel_[i]]++] = unsorted_[i];
        }
    }

    std::span<const Fragment<Mask>> at(int x, int y) const {
        const std::size_t pixel = pixel_index(x, y);
        return {fragments_.data() + offsets_[pixel], offsets_[pixel + 1] - offsets_[pixel]};
    }
    std::size_t size() const { return fragments_.size(); }

  private:
    static constexpr int kSide = mask_side<Mask>;

    static int floor_divide(int a, int positive_b) {
        return a >= 0 ? a / positive_b : -((-a + positive_b - 1) / positive_b);
    }
    std::size_t pixel_index(int x, int y) const {
        return static_cast<std::size_t>(y - y0_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x - x0_);
    }

    void add_pixel(int x, int y, const SampleSpan (&spans)[kSide], std::uint32_t surface) {
        const int first_column = grid_.first_sample(x);
        Mask mask{};
        bool covers_any = false;
        for (int row = 0; row < kSide; ++row) {
            const int begin = std::max(spans[row].begin - first_column, 0);
            const int end = std::min(spans[row].end - first_column, kSide);
            if (begin >= end) continue;
            MaskGrid<Mask>::set_row(mask, row, (1u << end) - (1u << begin));
            covers_any = true;
        }
        if (!covers_any) return;
        unsorted_.push_back({mask, surface});
        unsorted_pixel_.push_back(static_cast<std::uint32_t>(pixel_index(x, y)));
    }

    ExtendedGrid grid_;
    int x0_ = 0, y0_ = 0, width_ = 0, height_ = 0;
    std::vector<Fragment<Mask>> unsorted_;
    std::vector<std::uint32_t> unsorted_pixel_;
    std::vector<Fragment<Mask>> fragments_;
    std::vector<std::size_t> offsets_;
    std::vector<std::size_t> next_;
};

}  // namespace burin
