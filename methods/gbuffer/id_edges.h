#pragma once

#include <cstdint>

#include "methods/gbuffer/raster.h"
#include "scene/gbuffer_settings.h"

// Lines are found where ids of neighbouring samples differ.

namespace burin {

/// Borders in an image of numbers: 1 where a sample's number differs from (or is less or greater
/// than) that of one of its 4 or 8 neighbours. `differs` answers on both sides of a border: two
/// samples wide. `less` and `greater` answer on one side, of whichever object has that number.
inline Raster<float> id_edges(const Raster<std::uint32_t>& ids, IdComparison comparison, int neighbours) {
    const auto answers = [comparison](std::uint32_t a, std::uint32_t b) {
        switch (comparison) {
            case IdComparison::less:
                return a < b;
            case IdComparison::greater:
                return a > b;
            default:
                return a != b;
        }
    };
    return raster_of(grown(ids.rect(), -1), [&](int x, int y) {
        const Block<std::uint32_t> n = block_at(ids, x, y);
        bool found = false;
        for (const std::uint32_t id : {n.b, n.d, n.e, n.g}) found = found || answers(n.x, id);
        if (neighbours == 8) {
            for (const std::uint32_t id : {n.a, n.c, n.f, n.h}) found = found || answers(n.x, id);
        }
        return found ? 1.0f : 0.0f;
    });
}

}  // namespace burin
