#pragma once

#include <cstdint>

#include "abuffer/masks/mask_grid.h"
#include "scene/method_settings.h"

// Halos may grow by other steps than Patel's, which makes strokes of more even width.

namespace burin {

/// The mask and its eight neighbours.
template <typename Mask>
constexpr Mask dilate_eight(const Mask& mask) {
    // A step to the sides, then a step up and down, both as the part of the four-neighbour step
    // that stays in the row or in the column.
    constexpr int kSide = mask_side<Mask>;
    Mask result{};
    for (int row = 0; row < kSide; ++row) {
        unsigned bits = 0;
        for (int r = row - 1; r <= row + 1; ++r) {
            if (r < 0 || r >= kSide) continue;
            const unsigned line = MaskGrid<Mask>::row(mask, r);
            bits |= line | line << 1 | line >> 1;
        }
        MaskGrid<Mask>::set_row(result, row, bits & ((1u << kSide) - 1));
    }
    return result;
}

/// halo() with another shape of step.
template <typename Mask>
constexpr Mask shaped_halo(const Mask& mask, int steps, HaloShape shape) {
    Mask grown = mask;
    for (int i = 0; i < steps; ++i) {
        const bool eight = shape == HaloShape::eight || (shape == HaloShape::octagon && i % 2 == 1);
        grown = eight ? dilate_eight(grown) : mask_detail::dilate(grown);
    }
    return static_cast<Mask>(grown ^ mask);
}

/// edge_between() with another shape of step.
template <typename Mask>
constexpr Mask shaped_edge_between(const Mask& front, const Mask& back, int steps, HaloShape shape) {
    const Mask visible_back = static_cast<Mask>(back & ~front);
    return static_cast<Mask>((shaped_halo(front, steps, shape) & visible_back) |
                             (shaped_halo(visible_back, steps, shape) & front));
}

}  // namespace burin
