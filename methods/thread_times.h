#pragma once

#include <cstdint>
#include <span>

#include "render/stats.h"

namespace burin {

/// Seconds that one thread spent in each stage, and what it counted.
struct ThreadTimes {
    double raster = 0, resolve = 0, lines = 0, shade = 0;
    std::uint64_t fragments = 0;
};

/// Writes the times of all threads, which took `wall_s` together, to `stats`. Stages of different tiles run at the same
/// time: their share of the threads' time is their share of the wall time.
inline void share_out(double wall_s, std::span<const ThreadTimes> threads, RenderStats& stats) {
    ThreadTimes sum;
    for (const ThreadTimes& t : threads) {
        sum.raster += t.raster;
        sum.resolve += t.resolve;
        sum.lines += t.lines;
        sum.shade += t.shade;
        sum.fragments += t.fragments;
    }
    const double total = sum.raster + sum.resolve + sum.lines + sum.shade;
    const double share = total > 0 ? wall_s / total : 0;
    stats.raster_s = sum.raster * share;
    stats.resolve_s = sum.resolve * share;
    stats.lines_s = sum.lines * share;
    stats.shade_s = sum.shade * share;
    stats.fragments = sum.fragments;
}

}  // namespace burin
