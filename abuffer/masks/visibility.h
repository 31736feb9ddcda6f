#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "abuffer/masks/fragment_lists.h"
#include "view/coincidence.h"
#include "view/depth_plane.h"
#include "view/projection.h"

// Fragments of a pixel become visible masks: the nearest one wins at each sample.

namespace burin {

/// Which fragment is in front at every sample of a pixel's extended mask.
template <typename Mask>
struct VisibleSamples {
    static constexpr int kSamples = mask_side<Mask> * mask_side<Mask>;
    /// Per sample (side * row + column) the number of the front fragment in the pixel's list, or the
    /// list's length for the background.
    std::array<std::uint32_t, static_cast<std::size_t>(kSamples)> owner;
    /// Per fragment, and last for the background, the samples at which it is in front. They are disjoint.
    std::vector<Mask> masks;
};

/// Resolves visibility sample by sample: the nearest plane wins, so surfaces that pass through each
/// other do so inside the pixel. This is Carpenter's (1984) question with the exact answer that
/// Jouppi and Chang's Z3 (1999) gives.
///
/// Rounding decides nothing: a surface in front wherever both are is so on the edge of one that ends at it, too, and of
/// coincident surfaces the first one in the list wins. `plane_of(fragment)` gives a fragment's DepthPlane;
/// `order_of(fragment, fragment)` their SurfaceOrder, which is asked for only where their planes are hardly apart: by
/// what snapping does, or, with `projection`, by what may separate copies of one surface.
template <typename Mask, typename PlaneOf, typename OrderOf>
void resolve_visibility(std::span<const Fragment<Mask>> fragments, const ExtendedGrid& grid, int x, int y,
                        const PlaneOf& plane_of, const OrderOf& order_of, VisibleSamples<Mask>& visible,
                        const Projection* projection = nullptr) {
    constexpr int kSide = mask_side<Mask>;
    const auto background = static_cast<std::uint32_t>(fragments.size());
    visible.owner.fill(background);
    visible.masks.assign(fragments.size() + 1, Mask{});
    std::array<double, static_cast<std::size_t>(VisibleSamples<Mask>::kSamples)> nearest;
    bool any_close = false;

    const auto for_each_sample = [&](const Mask& mask, const auto& action) {
        for (int row = 0; row < kSide; ++row) {
            for (unsigned bits = MaskGrid<Mask>::row(mask, row); bits != 0; bits &= bits - 1) {
                const int column = std::countr_zero(bits);
                action(static_cast<std::size_t>(kSide * row + column), grid.position(x, y, row, column));
            }
        }
    };
    const auto are_close = [projection](double gap, const DepthPlane& a, const DepthPlane& b, double nearness) {
        double allowed = a.snapping_error() + b.snapping_error() + 1e-5 * std::abs(nearness);
        if (projection != nullptr) {
            const double per_px = (projection->orthographic ? 1 : std::abs(nearness)) / projection->focal_px;
            allowed = std::max(allowed, kCopiesApartPx * (std::abs(a.per_x) + std::abs(a.per_y) + per_px));
        }
        return std::abs(gap) <= allowed;
    };
    for (std::uint32_t i = 0; i < background; ++i) {
        const DepthPlane& plane = plane_of(fragments[i]);
        for_each_sample(fragments[i].mask, [&](std::size_t sample, glm::dvec2 position) {
            const double nearness = plane.nearness(position);
            const std::uint32_t rival = visible.owner[sample];
            if (rival != background) {
                const double gap = nearness - nearest[sample];
                any_close = any_close || are_close(gap, plane, plane_of(fragments[rival]), nearness);
                if (gap <= 0) return;
            }
            nearest[sample] = nearness;
            visible.owner[sample] = i;
        });
    }
    // Goes through the list and lets fragments take the places of those that are in front at a sample.
    const auto settle = [&](const auto& takes_place) {
        for (std::uint32_t i = 0; i < background; ++i) {
            const DepthPlane& plane = plane_of(fragments[i]);
            for_each_sample(fragments[i].mask, [&](std::size_t sample, glm::dvec2 position) {
                const std::uint32_t owner = visible.owner[sample];
                if (owner == i) return;
                const double nearness = plane.nearness(position);
                const DepthPlane& other = plane_of(fragments[owner]);
                if (are_close(nearest[sample] - nearness, plane, other, nearness) && takes_place(i, owner))
                    visible.owner[sample] = i;
            });
        }
    };
    if (any_close) {
        settle([&](std::uint32_t i, std::uint32_t owner) {
            return order_of(fragments[i], fragments[owner]).is_in_front();
        });
        settle([&](std::uint32_t i, std::uint32_t owner) {
            return i < owner && order_of(fragments[i], fragments[owner]).are_coincident();
        });
    }
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            const std::uint32_t owner = visible.owner[static_cast<std::size_t>(kSide * row + column)];
            MaskGrid<Mask>::set_row(visible.masks[owner], row, 1u << column);
        }
    }
}

}  // namespace burin
