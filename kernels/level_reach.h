#pragma once

namespace burin {

/// Of two surfaces the nearer one says how much they may differ and still be level, see SampleView. So the farther one
/// may be level with one that is nearer than what itself allows, up to so many times that. Always inline, for kernels
/// use it.
__attribute__((always_inline)) constexpr float level_reach(float level_per_nearness) {
    constexpr float kAny = 1e30f;
    return level_per_nearness < 0.5f ? 1 + 2 * level_per_nearness : kAny;  // at least 1 / (1 - level_per_nearness)
}

}  // namespace burin
