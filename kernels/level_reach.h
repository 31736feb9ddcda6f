#pragma once

// Kernels leave out what lies behind all that is drawn, except what may still be level with it.

namespace burin {

/// How much a surface may be nearer than another one and still be level with it, as a multiple of what the farther one
/// allows: of two surfaces the nearer one says how much they may differ (see SampleView), which may be more. Always
/// inline, for kernels use it.
__attribute__((always_inline)) constexpr float level_reach(float level_per_nearness) {
    constexpr float kAny = 1e30f;
    return level_per_nearness < 0.5f ? 1 + 2 * level_per_nearness : kAny;  // at least 1 / (1 - level_per_nearness)
}

}  // namespace burin
